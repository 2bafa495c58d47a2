"""The supporting plane of a cloud by RANSAC, and the points that stand out of it.

Room paper, Sec. 2.2. W: z up, from the camera's calibration.
"""

import math
from dataclasses import dataclass, field

import numpy as np
import shapely  # type: ignore[import-untyped]
from scipy.spatial import ConvexHull, QhullError

from footfall.models.values.room import FloorEstimate, FloorPlane
from footfall.models.values.validation import (
    MAX_SEED,
    RIGHT_ANGLE,
    Parameters,
    number,
)
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.low_things import raised_points
from footfall.systems.perception.planes.normals import estimate_normals, orient_normals
from footfall.systems.perception.planes.planes import fit_plane
from footfall.systems.perception.range_noise import RangeNoise, slide_to_plane

DOWN: Vector = np.array([0.0, 0.0, -1.0])
BATCH = 24
"""Hypotheses judged at a time."""
LOW_RANGE = 2.5
"""How far beyond the floor's tolerance points may lie that count in a patch's mean."""
OUTLINE_TOLERANCE = 0.01
"""Corners of the outline that stand out by less are left out, m."""


@dataclass(kw_only=True)
class FloorParams(Parameters):
    """What counts as the floor.

    The share of a plane is that of all the points of the cloud (voxels in view,
    cropped, without the robot) that lie on it within the noise.
    """

    expected_share: float = number(0.7, least=0.05, below=1.0)
    """Share of the floor that RANSAC counts on (room paper, Sec. 2.2.2: 70 %): it sets
    how many planes are tried at least. It is no condition, since a room full of boxes,
    or with its walls in view, has a floor too; the share found is reported."""
    min_share: float = number(0.2, above=0.0, below=1.0)
    """A plane with a smaller share is no floor; the paper names no such bound."""
    max_share_below: float = number(0.05, least=0.0, most=1.0)
    """A plane with more points than this below it supports nothing: a table's top."""
    confidence: float = number(0.999, above=0.0, below=1.0)
    """Probability with which the tries are to hold one of three floor points."""
    max_tilt: float = number(0.1, "rad", above=0.0, below=RIGHT_ANGLE)
    """Most that the floor may be out of level, rad: the camera's calibration."""
    normal_points: int = number(8000, least=100, most=1_000_000)
    """How many of the points, evenly picked, get a normal and judge the planes."""
    normal_neighbors: int = number(20, least=5, most=1000)
    """Neighbours among these whose covariance gives a normal."""
    normal_tolerance: float = number(0.35, "rad", above=0.0)
    """Most that the normal of a floor point is off the vertical, beyond the tilt, rad:
    normals of noisy points scatter."""
    deviations: float = number(3.5, above=0.0)
    """Standard deviations of the noise within which a point lies on the plane."""
    min_tolerance: float = number(0.01, "m", above=0.0)
    """The least that a point may lie off the plane, m."""
    patch: float = number(0.1, "m", least=1e-3)
    """Side of patches whose mean tells what is lower than single points do, m."""
    low_height: float = number(0.025, "m", above=0.0)
    """What is lower over the floor on the mean of a patch is the floor, m."""
    max_height: float = number(2.2, "m", above=0.0)
    """What is higher above the floor stands in no one's way, m."""
    noise: RangeNoise = field(default_factory=RangeNoise)
    """Of the sensor."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Of RANSAC's choices."""


def extract_floor(
    points: Vector, viewpoint: Vector, params: FloorParams
) -> tuple[FloorEstimate, Vector]:
    """Splits a cloud into the floor and what stands on it.

    Args:
        points: the cloud in W, (n, 3), m.
        viewpoint: where it was seen from, (3,), m.
        params: what counts as the floor.

    Returns:
        The floor or why there is none, and the points above it, (m, 3), m; none where
        there is no floor.
    """
    nothing = np.zeros((0, 3))
    if len(points) < 3:
        reason = f"no floor in view: the cloud has {len(points)} points"
        return FloorEstimate(reason=reason), nothing
    judges = points[:: max(1, math.ceil(len(points) / params.normal_points))]
    best, share = _ransac(judges, viewpoint, params)
    if best is None or share < params.min_share:
        reason = (
            f"no floor in view: no level plane holds {100 * params.min_share:g} % of "
            f"the points with nothing below it, the best holds {100 * share:.0f} %"
        )
        return FloorEstimate(reason=reason), nothing
    tolerance = _tolerance(judges, viewpoint, params)
    for _ in range(2):
        inside = np.abs(_offset(judges, best)) <= tolerance
        best = _coefficients(*fit_plane(judges[inside]))
    inside = np.abs(_offset(judges, best)) <= tolerance
    outline = _outline(judges[inside], viewpoint, best)
    if outline is None:
        reason = "no floor in view: its points lie in a line"
        return FloorEstimate(reason=reason), nothing
    offset = _offset(points, best)
    tolerance = _tolerance(points, viewpoint, params)
    inside = np.abs(offset) <= tolerance
    floor = FloorPlane(best, outline, float(np.mean(inside)))
    stands_out = offset > tolerance
    stands_out |= raised_points(
        points,
        offset,
        LOW_RANGE * tolerance,
        params.noise.height_deviation(points, viewpoint),
        patch=params.patch,
        least=params.low_height,
    )
    above = points[stands_out & (offset <= params.max_height)]
    return FloorEstimate(floor), above


def _ransac(
    points: Vector, viewpoint: Vector, params: FloorParams
) -> tuple[Vector | None, float]:
    """Finds the level plane with the most inliers, and their share of the points.

    The three points of a hypothesis are picked among those whose normal, turned to the
    viewpoint, is near the vertical. Tries go on until with the best share so far one
    would have hit three inliers with the confidence asked for.
    """
    normals = estimate_normals(points, params.normal_neighbors, 1)
    normals = orient_normals(points, normals, DOWN, viewpoint)
    least = math.cos(min(params.max_tilt + params.normal_tolerance, math.pi / 2.0))
    level = np.flatnonzero(normals[:, 2] >= least)
    tolerance = _tolerance(points, viewpoint, params)
    rng = np.random.default_rng(params.seed)
    best: Vector | None = None
    share, tried, wanted = 0.0, 0, _tries(params.expected_share, params)
    while len(level) >= 3 and tried < wanted:
        triple = points[level[rng.integers(0, len(level), (BATCH, 3))]]
        tried += BATCH
        planes = _planes(triple, params.max_tilt)
        if len(planes):
            off = points @ planes[:, :3].T + planes[:, 3]
            on = (np.abs(off) <= tolerance[:, None]).mean(axis=0)
            below = (off < -tolerance[:, None]).mean(axis=0)
            on[below > params.max_share_below] = 0.0
            first = int(np.argmax(on))
            if on[first] > share:
                best, share = planes[first], float(on[first])
        # Of the level points the share that lies on the plane is larger still.
        wanted = _tries(max(min(share, params.expected_share), 0.1), params)
    return best, share


def _tries(share: float, params: FloorParams) -> int:
    """Computes how many triples hold one of inliers alone with the confidence asked."""
    return math.ceil(math.log(1.0 - params.confidence) / math.log1p(-(share**3)))


def _planes(triple: Vector, max_tilt: float) -> Vector:
    """Computes planes through triples of points, (n, 3, 3), nearly level, (m, 4)."""
    normals = np.cross(triple[:, 1] - triple[:, 0], triple[:, 2] - triple[:, 0])
    length = np.linalg.norm(normals, axis=1)
    steep = np.abs(normals[:, 2]) <= math.cos(max_tilt) * np.maximum(length, 1e-9)
    normals, length, origins = (a[~steep] for a in (normals, length, triple[:, 0]))
    normals = normals / (length * np.sign(normals[:, 2]))[:, None]
    return np.column_stack([normals, -np.sum(normals * origins, axis=1)])


def _coefficients(point: Vector, normal: Vector) -> Vector:
    return np.append(normal, -float(normal @ point))


def _offset(points: Vector, coefficients: Vector) -> Vector:
    return np.asarray(points @ coefficients[:3] + coefficients[3])


def _tolerance(points: Vector, viewpoint: Vector, params: FloorParams) -> Vector:
    """Computes the largest distance of inliers from a level plane, (n,), m."""
    deviation = params.noise.height_deviation(points, viewpoint)
    return np.maximum(params.deviations * deviation, params.min_tolerance)


def _outline(inliers: Vector, viewpoint: Vector, coefficients: Vector) -> Vector | None:
    """Computes the convex outline of the floor seen, (n, 3); None for a line."""
    on_plane = slide_to_plane(inliers, viewpoint, coefficients)
    try:
        hull = ConvexHull(on_plane[:, :2])
    except (QhullError, ValueError):
        return None
    polygon = shapely.Polygon(on_plane[hull.vertices, :2])
    ring = shapely.get_coordinates(polygon.simplify(OUTLINE_TOLERANCE).exterior)[:-1]
    a, b, c, d = coefficients
    z = -(ring @ np.array([a, b]) + d) / c
    return np.column_stack([ring, z])
