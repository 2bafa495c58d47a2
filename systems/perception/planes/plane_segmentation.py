"""Plane segments and the staircase of a cloud, stage by stage.

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4 and Table 1. Every stage is a pure
function whose result can be looked at; `segment_planes` calls them in turn. Planes are
found in either of two ways: by the paper's supervoxels or by surfaces of columns.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from footfall.models.robots.robot import Sole
from footfall.models.values.perceived import PlaneSegmentation, Staircase
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.cut_sweep import CutCloud
from footfall.systems.perception.planes.flights import find_flights, floor_seen
from footfall.systems.perception.planes.levels import (
    Sampling,
    draw_levels_together,
)
from footfall.systems.perception.planes.normals import (
    filter_slopes,
    gravity_aligned_rotation,
)
from footfall.systems.perception.planes.planes import (
    FittedPlane,
    Patch,
    bound_patch,
    fit_plane,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.segments import (
    patch_segment,
    shift_segmentation,
    tread_segment,
    winding_segments,
)
from footfall.systems.perception.planes.supervoxel_planes import (
    DOWN,
    LevelVoxels,
    bound_planes,
    cluster_level,
    filter_level,
    fit_planes,
)
from footfall.systems.perception.planes.supervoxels import Supervoxels
from footfall.systems.perception.planes.surface_planes import (
    bound_surfaces,
    fit_surfaces,
)
from footfall.systems.perception.planes.surfaces import (
    Surfaces,
    cluster_surfaces,
    cut_columns,
    level_noise,
)
from footfall.systems.perception.planes.tread_candidates import join_parts
from footfall.systems.perception.planes.voxels import (
    MAX_SPARSE,
    cloud_origin,
    sparse_spacing,
    usable_points,
    voxelize,
)

MUCH_NOISE = 0.0085
"""From this noise along z on level surfaces are drawn together first, m: a range noise
of about 12 mm."""
MAX_REACH = 0.055
"""Most that this looks up and down, m: less than half of the usual rise."""
DENSE = Sampling()
"""A cloud of which nothing is known."""


@dataclass(frozen=True, eq=False)
class Stages:
    """Intermediate results, in the gravity-aligned frame G."""

    R_GW: Vector
    """Rotation from the cloud's frame into G, (3, 3)."""
    cloud: Vector
    """The usable points, (n, 3), m."""
    planes: tuple[FittedPlane, ...]
    """Planes that were fitted."""
    patches: tuple[Patch, ...]
    """The planes, bounded."""
    clusters: NDArray[np.int64]
    """Cluster of each piece of surface, or of each voxel, after Filter 3; -1 for
    none."""
    surfaces: Surfaces | None = None
    """Pieces of surface by columns; None by "supervoxels"."""
    voxels: LevelVoxels | None = None
    """Voxels after Filters 1 and 2, by "supervoxels"."""
    supervoxels: Supervoxels | None = None
    """Over-segmentation of the voxels, by "supervoxels"."""


def make_segmentation(
    patches: tuple[Patch, ...],
    cloud: Vector,
    params: PlaneSegmenterParams,
    viewpoint: Vector | None,
    R_GW: Vector,
    sampling: Sampling = DENSE,
    sole: Sole | None = None,
) -> PlaneSegmentation:
    """Finds the staircase among the patches and turns all of them into W.

    Args:
        patches: bounded pieces of level plane, in G.
        cloud: finite points in G, (n, 3), m.
        params: parameters.
        viewpoint: where they were seen from in G, (3,), m.
        R_GW: rotation from W into G, (3, 3).
        sampling: of the cloud.
        sole: of the robot, which must fit on a tread; None for any.
    """
    flights = find_flights(patches, cloud, params, viewpoint, sampling, sole)
    segments = {i: patch_segment(patch, R_GW) for i, patch in enumerate(patches)}
    for flight in flights:
        if flight.winding:
            segments.update(winding_segments(patches, flight.patches, R_GW))
            continue
        for i, tread in zip(flight.patches, flight.treads, strict=True):
            segments[i] = tread_segment(tread, flight.yaw, params.voxel_size, R_GW)
    floor = flights[0].floor if flights else floor_seen(patches, viewpoint, params)
    if floor is not None and flights and not flights[0].winding:
        segments[floor] = patch_segment(patches[floor], R_GW, flights[0].yaw)
    staircases = tuple(
        Staircase(
            treads=tuple(segments[i] for i in flight.patches),
            floor=None if flight.floor is None else segments[flight.floor],
        )
        for flight in flights
    )
    none = Staircase(floor=None if floor is None else segments[floor])
    return PlaneSegmentation(
        planes=tuple(sorted(segments.values(), key=lambda item: -item.area)),
        staircase=staircases[0] if staircases else none,
        flights=staircases,
    )


def segment_supports(
    supports: Sequence[Vector],
    points: Vector,
    gravity: Vector,
    params: PlaneSegmenterParams,
    viewpoint: Vector | None = None,
) -> PlaneSegmentation:
    """Segments a cloud whose planes were found by any other method.

    Each support is fitted with a plane by least squares; those that are too steep are
    left out, the others are bounded, and the staircase is found among them.

    Args:
        supports: the points of each plane in W, (n_i, 3), m.
        points: the whole cloud in W, (n, 3), m, in which the treads' edges are sought.
        gravity: gravity in W, (3,), any length: it points down.
        params: parameters.
        viewpoint: where the cloud was seen from in W, (3,), m.

    Raises:
        ValueError: gravity has no direction.
    """
    R_GW = gravity_aligned_rotation(gravity)
    patches = []
    for support in supports:
        local = usable_points(np.asarray(support, dtype=np.float64)) @ R_GW.T
        if len(local) < 3:
            continue
        point, normal = fit_plane(local)
        if not filter_slopes(normal[None], DOWN, params.slope_tolerance)[0]:
            continue
        plane = FittedPlane(point, normal, np.arange(len(local)))
        area = params.voxel_size**2 * len(voxelize(local, params.voxel_size).keys)
        if (patch := bound_patch(plane, local, area)) is not None:
            patches.append(patch)
    cloud = usable_points(np.asarray(points, dtype=np.float64)) @ R_GW.T
    eye = None if viewpoint is None else R_GW @ viewpoint
    return make_segmentation(tuple(patches), cloud, params, eye, R_GW)


def _moved(points: Vector, origin: Vector, R_GW: Vector) -> Vector:
    """Computes points, (n, 3), from another origin in W and turned into G."""
    if np.any(origin):
        points = points - origin
    return points if np.array_equal(R_GW, np.eye(3)) else points @ R_GW.T


def is_cut_for(cut: CutCloud, gravity: Vector, params: PlaneSegmenterParams) -> bool:
    """Tells whether a cut cloud serves: of surfaces, along gravity, of a voxel's side.

    Args:
        cut: the cut cloud in W.
        gravity: gravity in W, (3,), any length: it points down.
        params: parameters of the segmentation.

    Raises:
        ValueError: gravity has no direction.
    """
    upright = np.array_equal(gravity_aligned_rotation(gravity), np.eye(3))
    return bool(
        params.method == "surfaces"
        and upright
        and cut.surfaces.cell == params.voxel_size
        and len(cut.points)
    )


def segment_planes(
    points: Vector,
    gravity: Vector,
    params: PlaneSegmenterParams,
    sole: Sole,
    viewpoint: Vector | None = None,
    cut: CutCloud | None = None,
) -> tuple[PlaneSegmentation, Stages]:
    """Segments a cloud into planes and finds the staircase among them.

    Args:
        points: the cloud, (n, 3), m, in any frame W; points that are not finite are
            left out. An empty cloud has an empty segmentation.
        gravity: gravity in W, (3,), any length: it points down.
        params: parameters.
        sole: of the robot; what is smaller is no plane to stand on.
        viewpoint: where the cloud was seen from, (3,), m. Without it normals are
            turned up, so that a ceiling is a plane too.
        cut: the same cloud where it was cut line by line as it came. It stands for the
            points if it fits (see `is_cut_for`).

    Returns:
        The segmentation, in W, and the intermediate results, in the gravity-aligned G.

    Raises:
        ValueError: gravity has no direction, points are not (n, 3).
    """
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"points: must be (n, 3), got {points.shape}")
    times: list[tuple[str, float]] = []
    start = perf_counter()

    def lap(stage: str) -> None:
        nonlocal start
        now = perf_counter()
        times.append((stage, (now - start) * 1e3))
        start = now

    R_GW = gravity_aligned_rotation(gravity)
    # A cloud far away is worked on near the origin, where numbers are fine.
    origin = cloud_origin(points)
    eye = None if viewpoint is None else R_GW @ (viewpoint - origin)
    if cut is not None and (
        viewpoint is None or np.any(origin) or not is_cut_for(cut, gravity, params)
    ):
        cut = None
    if cut is not None:
        cloud = cut.points
    else:
        moved = _moved(np.asarray(points, dtype=np.float64), origin, R_GW)
        cloud = usable_points(moved)
        if eye is not None and params.method == "surfaces":
            # Of what is higher than the eye it sees no upper side.
            cloud = np.compress(cloud[:, 2] < eye[2], cloud, axis=0)
    dense = (len(points) if cut is None else cut.seen) > MAX_SPARSE
    spacing = 0.0 if dense else sparse_spacing(cloud, params.voxel_size)
    if spacing > 0.0:
        params = replace(
            params, voxel_size=min(1.1 * spacing, 0.5 * params.seed_resolution)
        )
    if cut is None or spacing > 0.0:
        surfaces = cut_columns(cloud, params.voxel_size)
    else:
        surfaces = cut.surfaces
    noise = 0.0 if spacing > 0.0 else level_noise(surfaces, cloud)
    sampling = Sampling(spacing, noise, drawn=noise > MUCH_NOISE)
    if sampling.drawn:
        cloud = draw_levels_together(cloud, min(3.0 * noise, MAX_REACH))
        surfaces = cut_columns(cloud, params.voxel_size)
    lap("cloud")
    voxels: LevelVoxels | None = None
    supervoxels: Supervoxels | None = None
    if params.method == "supervoxels":
        voxels = filter_level(cloud, params, eye)
        lap("filters")
        supervoxels, clusters = cluster_level(voxels, params, sole)
        lap("supervoxels")
        planes = fit_planes(voxels, clusters, params, sole)
        lap("planes")
        patches = bound_planes(planes, voxels, cloud, params)
    else:
        clusters = cluster_surfaces(
            surfaces, eye, offset=params.merge_offset, min_area=sole.area
        )
        lap("clusters")
        planes = fit_surfaces(
            surfaces,
            clusters,
            offset=params.merge_offset,
            angle=params.bend_angle,
            tolerance=params.plane_tolerance,
            slope_tolerance=params.slope_tolerance,
            min_area=sole.area,
            seed=params.seed,
        )
        lap("planes")
        patches = bound_surfaces(surfaces, planes, cloud, params.plane_tolerance)
    if params.staircase_from == "chain":
        patches = join_parts(patches, params.stairs)
    lap("boundaries")
    segmentation = make_segmentation(patches, cloud, params, eye, R_GW, sampling, sole)
    if np.any(origin):
        segmentation = shift_segmentation(segmentation, origin)
    lap("staircase")
    return replace(segmentation, times_ms=tuple(times)), Stages(
        R_GW=R_GW,
        cloud=cloud,
        planes=planes,
        patches=patches,
        clusters=clusters,
        surfaces=None if params.method == "supervoxels" else surfaces,
        voxels=voxels,
        supervoxels=supervoxels,
    )
