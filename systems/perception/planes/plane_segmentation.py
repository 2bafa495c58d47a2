"""Plane segments and the staircase of a cloud, stage by stage.

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4 and Table 1. Every stage is a pure
function whose result can be looked at; `segment_planes` calls them in turn.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from footfall.models.robots.robot import Sole
from footfall.models.values.perceived import PlaneSegmentation, Staircase
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.flights import find_flights, floor_seen
from footfall.systems.perception.planes.levels import (
    Sampling,
    cloud_noise,
    draw_levels_together,
)
from footfall.systems.perception.planes.normals import (
    estimate_normals,
    filter_slopes,
    gravity_aligned_rotation,
    orient_normals,
)
from footfall.systems.perception.planes.planes import (
    FittedPlane,
    Patch,
    assign_support,
    bound_patch,
    fit_plane,
    make_patches,
    ransac_planes,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.segments import (
    patch_segment,
    shift_segmentation,
    tread_segment,
    winding_segments,
)
from footfall.systems.perception.planes.stair_chain import join_parts
from footfall.systems.perception.planes.supervoxels import (
    Supervoxels,
    cluster_supervoxels,
    filter_small,
    merge_supervoxels,
)
from footfall.systems.perception.planes.voxels import (
    VoxelGrid,
    adjacent_voxels,
    cloud_origin,
    filter_sparse,
    keep_pairs,
    sparse_spacing,
    usable_points,
    voxelize,
)

MUCH_NOISE = 0.006
"""From this noise across surfaces on level ones are drawn together first, m: a range
noise of 13 mm."""
MAX_REACH = 0.055
"""Most that this looks up and down, m: less than half of the usual rise."""
DENSE = Sampling()
"""A cloud of which nothing is known."""
DOWN = np.array([0.0, 0.0, -1.0])
"""Gravity's direction in the gravity-aligned frame G that the stages work in."""


@dataclass(frozen=True, eq=False)
class LevelVoxels:
    """Voxels that Filters 1 and 2 leave: C of Algorithm 1."""

    points: Vector
    """Representative points, (m, 3), m."""
    normals: Vector
    """Their unit normals, (m, 3)."""
    pairs: NDArray[np.int64]
    """Adjacent ones, (p, 2)."""
    grid: VoxelGrid
    """The voxels before the filters."""
    member: NDArray[np.int64]
    """Index in the grid of each of the m."""
    grid_pairs: NDArray[np.int64]
    """Adjacent voxels of the grid, (q, 2)."""


@dataclass(frozen=True, eq=False)
class Stages:
    """Intermediate results, in the gravity-aligned frame G."""

    R_GW: Vector
    """Rotation from the cloud's frame into G, (3, 3)."""
    cloud: Vector
    """The usable points, (n, 3), m."""
    voxels: LevelVoxels
    """After Filters 1 and 2."""
    supervoxels: Supervoxels
    """Over-segmentation of the voxels."""
    clusters: NDArray[np.int64]
    """Cluster of each voxel after Filter 3; -1 for none."""
    planes: tuple[FittedPlane, ...]
    """Planes that RANSAC found."""
    patches: tuple[Patch, ...]
    """The planes, bounded."""


def filter_level(
    cloud: Vector, params: PlaneSegmenterParams, viewpoint: Vector | None
) -> LevelVoxels:
    """Runs Algorithm 1, lines 1 to 12: normals, Filter 1, voxels, Filter 2.

    Args:
        cloud: finite points in G, (n, 3), m.
        params: parameters.
        viewpoint: where they were seen from, (3,), m.
    """

    def normals_of(points: Vector) -> Vector:
        normals = estimate_normals(points, params.neighbors, params.threads)
        return orient_normals(points, normals, DOWN, viewpoint)

    if params.order == "normals_first":
        normals = normals_of(cloud)
        level = filter_slopes(normals, DOWN, params.slope_tolerance)
        grid = voxelize(cloud, params.voxel_size)
        occupied = voxelize(cloud[level], params.voxel_size)
        source = np.flatnonzero(level)[occupied.representative]
        voxel = grid.voxel_of_point[source]
        own = adjacent_voxels(occupied)
        kept = filter_sparse(own, len(source), params.min_neighbors)
        return LevelVoxels(
            points=cloud[source[kept]],
            normals=normals[source[kept]],
            pairs=keep_pairs(own, kept),
            grid=grid,
            member=voxel[kept],
            grid_pairs=adjacent_voxels(grid),
        )
    grid = voxelize(cloud, params.voxel_size)
    pairs = adjacent_voxels(grid)
    normals = normals_of(grid.mean)
    kept = filter_sparse(pairs, len(grid.keys), params.min_neighbors)
    kept &= filter_slopes(normals, DOWN, params.slope_tolerance)
    return LevelVoxels(
        points=cloud[grid.representative[kept]],
        normals=normals[kept],
        pairs=keep_pairs(pairs, kept),
        grid=grid,
        member=np.flatnonzero(kept),
        grid_pairs=pairs,
    )


def cluster_level(
    voxels: LevelVoxels, params: PlaneSegmenterParams, sole: Sole
) -> tuple[Supervoxels, NDArray[np.int64]]:
    """Grows supervoxels, clusters them and applies Filter 3.

    Returns:
        The supervoxels and the cluster of each voxel, (m,); -1 for none.
    """
    supervoxels = cluster_supervoxels(
        voxels.points,
        voxels.normals,
        voxels.pairs,
        seed_resolution=params.seed_resolution,
        influence=params.influence,
    )
    clusters = merge_supervoxels(
        supervoxels,
        voxels.pairs,
        angle=params.merge_angle,
        offset=params.merge_offset,
    )
    return supervoxels, filter_small(clusters, params.voxel_size, sole.area)


def fit_planes(
    voxels: LevelVoxels,
    clusters: NDArray[np.int64],
    params: PlaneSegmenterParams,
    sole: Sole,
) -> tuple[FittedPlane, ...]:
    """Fits RANSAC planes within the slope tolerance, larger than a sole."""
    of = clusters if params.planes_from == "clusters" else np.minimum(clusters, 0)
    planes = ransac_planes(
        voxels.points,
        of,
        tolerance=params.plane_tolerance,
        min_inliers=params.min_voxels(sole),
        rng=np.random.default_rng(params.seed),
    )
    if not planes:
        return planes
    normals = np.array([plane.normal for plane in planes])
    level = filter_slopes(normals, DOWN, params.slope_tolerance)
    return tuple(plane for plane, good in zip(planes, level, strict=True) if good)


def bound_planes(
    planes: tuple[FittedPlane, ...],
    voxels: LevelVoxels,
    cloud: Vector,
    params: PlaneSegmenterParams,
) -> tuple[Patch, ...]:
    """Bounds the planes by the points of the cloud."""
    owner = assign_support(
        planes,
        voxels.member,
        voxels.grid.mean,
        voxels.grid_pairs,
        tolerance=params.plane_tolerance,
        rings=2,
    )
    return make_patches(
        planes,
        owner,
        voxels.grid.index,
        voxels.grid.voxel_of_point,
        cloud,
        voxel_size=params.voxel_size,
        tolerance=params.plane_tolerance,
    )


def make_segmentation(
    patches: tuple[Patch, ...],
    cloud: Vector,
    params: PlaneSegmenterParams,
    viewpoint: Vector | None,
    R_GW: Vector,
    sampling: Sampling = DENSE,
) -> PlaneSegmentation:
    """Finds the staircase among the patches and turns all of them into W.

    Args:
        patches: bounded pieces of level plane, in G.
        cloud: finite points in G, (n, 3), m.
        params: parameters.
        viewpoint: where they were seen from in G, (3,), m.
        R_GW: rotation from W into G, (3, 3).
        sampling: of the cloud.
    """
    flights = find_flights(patches, cloud, params, viewpoint, sampling)
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


def segment_planes(
    points: Vector,
    gravity: Vector,
    params: PlaneSegmenterParams,
    sole: Sole,
    viewpoint: Vector | None = None,
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
    points = np.asarray(points, dtype=np.float64) - origin
    cloud = usable_points(points) @ R_GW.T
    eye = None if viewpoint is None else R_GW @ (viewpoint - origin)
    spacing = sparse_spacing(cloud, params.voxel_size)
    if spacing > 0.0:
        params = replace(
            params, voxel_size=min(1.1 * spacing, 0.5 * params.seed_resolution)
        )
    noise = 0.0 if spacing > 0.0 else cloud_noise(cloud)
    sampling = Sampling(spacing, noise, drawn=noise > MUCH_NOISE)
    if sampling.drawn:
        cloud = draw_levels_together(cloud, min(4.0 * noise, MAX_REACH))
    lap("cloud")
    voxels = filter_level(cloud, params, eye)
    lap("filters")
    supervoxels, clusters = cluster_level(voxels, params, sole)
    lap("supervoxels")
    planes = fit_planes(voxels, clusters, params, sole)
    lap("planes")
    patches = bound_planes(planes, voxels, cloud, params)
    if params.staircase_from == "chain":
        patches = join_parts(patches, params.stairs)
    lap("boundaries")
    segmentation = make_segmentation(patches, cloud, params, eye, R_GW, sampling)
    if np.any(origin):
        segmentation = shift_segmentation(segmentation, origin)
    lap("staircase")
    segmentation = replace(segmentation, times_ms=tuple(times))
    return segmentation, Stages(
        R_GW, cloud, voxels, supervoxels, clusters, planes, patches
    )
