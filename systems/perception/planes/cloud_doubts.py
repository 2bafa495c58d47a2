"""Telling why a cloud may hold no plane: its scale, spacing, place and gravity."""

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.normals import (
    estimate_normals,
    gravity_direction,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.voxels import (
    FARTHEST,
    cloud_origin,
    point_spacing,
    usable_points,
    voxelize,
)

SAMPLE = 2000
"""Normals that are compared; more would tell the same."""
LARGE, VAST = 100.0, 1000.0
"""Clouds of these sizes, m, may be of centimetres, and must be of millimetres."""
MIN_SURFACE = 0.2
"""Share of normals that agree on a surface; of noise one in twenty-five does."""


def describe_cloud(points: Vector) -> str:
    """Says in a line how many points a cloud has, how far it extends, how dense it is.

    Args:
        points: finite, (n, 3), at least one, m.
    """
    dx, dy, dz = (
        f"{size:,.0f}" if size >= 1e3 else f"{size:.3g}"
        for size in np.ptp(points, axis=0)
    )
    return (
        f"{len(points):,} point{'s' * (len(points) != 1)} in {dx} x {dy} x "
        f"{dz} m, typically {point_spacing(points):.2g} m apart"
    )


def doubt_cloud(
    points: Vector, gravity: Vector, params: PlaneSegmenterParams, sole_voxels: int
) -> tuple[str, ...]:
    """Says what is likely wrong with a cloud in which no plane was found.

    Args:
        points: finite, (n, 3), at least one, m.
        gravity: gravity in the cloud's frame, (3,), any length.
        params: what it was segmented with.
        sole_voxels: how many voxels a sole covers: the least plane.

    Returns:
        At least one line, the likeliest first.
    """
    if len(points) < sole_voxels:
        return (
            f"it has fewer points than a sole has voxels ({sole_voxels} of "
            f"{params.voxel_size:g} m)",
        )
    return (
        _doubt_origin(points)
        or _doubt_scale(points, params, np.sqrt(sole_voxels) * params.voxel_size)
        or _doubt_density(points, params)
        or _doubt_gravity(points, gravity, params)
        or (
            "nothing in it is flat, level and as large as a sole "
            f"({sole_voxels} voxels of {params.voxel_size:g} m)",
        )
    )


def _doubt_origin(points: Vector) -> tuple[str, ...]:
    """Doubts about where the points lie: at the origin, or too far from it."""
    distance = np.linalg.norm(points, axis=1)
    at_origin = np.count_nonzero(distance == 0.0) / len(points)
    if at_origin == 1.0:
        return ("all points lie at the origin: was the file written with its points?",)
    if at_origin > 0.5:
        return (f"{at_origin:.0%} of the points lie at the origin: rays that missed?",)
    # A cloud of millimetres is far from the origin, too, but not for its size.
    size = float(np.max(np.ptp(points, axis=0)))
    moved = usable_points(points - cloud_origin(points))
    if len(moved) < 0.5 * len(points) and size < np.median(distance):
        return (
            f"it lies {np.median(distance):,.0f} m from the origin, and what is beyond "
            f"{FARTHEST:,.0f} m is left out: subtract an offset",
        )
    return ()


def _doubt_scale(
    points: Vector, params: PlaneSegmenterParams, sole: float
) -> tuple[str, ...]:
    """Doubts about the unit of the points; a sole is so large, m."""
    farthest = float(np.max(np.linalg.norm(points, axis=1)))
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    if size < sole:
        of = "the origin" if farthest < sole else "each other"
        within = farthest if farthest < sole else size
        return (f"all points lie within {within:.1g} m of {of}: are these metres?",)
    low, high = np.percentile(points, [1.0, 99.0], axis=0)
    size, spacing = float(np.max(high - low)), point_spacing(points)
    if size < LARGE or spacing < params.voxel_size:
        return ()
    unit = "millimetres" if size >= VAST else "centimetres or millimetres"
    return (
        f"it is {size:,.0f} m across with points {spacing:.2g} m apart: are these "
        f"{unit}?",
    )


def _doubt_density(points: Vector, params: PlaneSegmenterParams) -> tuple[str, ...]:
    """Doubts about how close points are to one another."""
    spacing = point_spacing(points)
    if spacing <= params.voxel_size:
        return ()
    return (
        f"its points are farther apart ({spacing:.2g} m) than voxels are large "
        f"({params.voxel_size:g} m): it is too sparse",
    )


def _doubt_gravity(
    points: Vector, gravity: Vector, params: PlaneSegmenterParams
) -> tuple[str, ...]:
    """Doubts about the direction of gravity, by the normals that agree with most."""
    near = usable_points(points - cloud_origin(points))
    grid = voxelize(near, params.voxel_size)
    if not len(grid.mean):
        return ()
    normals = estimate_normals(grid.mean, params.neighbors, params.threads)
    normals = normals[:: -(-len(normals) // SAMPLE)]
    cosine = np.abs(normals @ normals.T)
    agree = np.mean(cosine > np.cos(params.slope_tolerance), axis=1)
    most = int(np.argmax(agree))
    up = -gravity_direction(gravity)
    normal = normals[most] * (1.0 if normals[most] @ up >= 0.0 else -1.0)
    slope = float(np.arccos(np.clip(normal @ up, -1.0, 1.0)))
    if agree[most] < MIN_SURFACE or slope <= params.slope_tolerance:
        return ()
    x, y, z = np.round(-normal, 2) + 0.0
    return (
        f"{agree[most]:.0%} of its surface leans by {np.degrees(slope):.0f} deg, and "
        f"more than {np.degrees(params.slope_tolerance):.0f} deg is no plane to step "
        f"on; it would be level with gravity along {x:g},{y:g},{z:g}: is that right?",
    )
