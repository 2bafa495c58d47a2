"""Eyes: width, height, position and yaw of what stands on the floor, from a scan."""

from dataclasses import dataclass

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.values.obstacle import Obstacle, ObstacleMap
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.boxes import (
    LEAST_WINDOW,
    even_rectangle,
    top_height,
)
from footfall.systems.perception.obstacles.clusters import cluster_points
from footfall.systems.perception.obstacles.low_things import (
    CELLS,
    DEVIATIONS,
    patch_sums,
)
from footfall.systems.perception.obstacles.tops import split_by_tops


@dataclass(kw_only=True)
class ObstacleFinderParams(Parameters):
    """What counts as an obstacle, and where it is looked for."""

    period: float = number(0.025, "s", least=1e-3, most=10.0)
    """Between looks at whether a sweep is finished, s."""
    reach: float = number(3.0, "m", above=0.0)
    """How far from the sensor obstacles are looked for, m, horizontally; farther ones
    are seen too thinly."""
    floor_window: float = number(0.02, "m", above=0.0)
    """Half the thickness of the level of points that is the floor, m."""
    min_height: float = number(0.02, "m", above=0.0)
    """Single points this far above the floor are not the floor's, m."""
    low_height: float = number(0.006, "m", above=0.0)
    """What is lower above the floor, on the mean of a patch, is walked on, m."""
    patch: float = number(0.06, "m", least=1e-3)
    """Side of such a patch, m."""
    deviation: float = number(0.005, "m", least=0.0)
    """Standard deviation of a point's height, m: the mean of few says less."""
    max_height: float = number(1.2, "m", above=0.0)
    """What is higher above the floor is none, m."""
    radius: float = number(0.06, "m", above=0.0)
    """Gap between points that separates two obstacles, m."""
    cell: float = number(0.02, "m", least=1e-3)
    """Columns in which points are gathered before, m."""
    min_points: int = number(40, least=3)
    """Clusters with fewer points are noise."""
    top_window: float = number(0.012, "m", above=0.0)
    """Half the thickness of the level of points that is a top, m: two deviations."""
    back_allowance: float = number(0.006, "m", least=0.0)
    """Added behind the top's farthest points, m: its edge lies up to a scan line
    beyond them."""
    tail: float = number(0.02, least=0.0, below=0.25)
    """Share of the top's points at either end that does not bound it."""


def find_obstacles(
    points: Vector, viewpoint: Vector, params: ObstacleFinderParams
) -> ObstacleMap:
    """Finds the obstacles in a cloud.

    The floor is the densest level below the sensor. What stands out of it, point by
    point or where it is low on the mean of a patch, is grouped, and a group split where
    the heights of its columns jump; each part's top is its highest dense level, and the
    least rectangle that the top's points fill is its footprint. Its thin side is what
    is stepped across.

    Args:
        points: in W, (n, 3), m.
        viewpoint: where they were seen from, (3,), m.
        params: see there.
    """
    points = points[np.isfinite(points).all(axis=1)]
    near = np.hypot(*(points[:, :2] - viewpoint[:2]).T) < params.reach
    points = points[near & (points[:, 2] < viewpoint[2] - 0.3)]
    if len(points) < params.min_points:
        return ObstacleMap(status="no floor")
    floor = floor_height(points[:, 2], params.floor_window)
    height = points[:, 2] - floor
    stands_out = (height > params.min_height) | low_patches(points, height, params)
    above = points[stands_out & (height < params.max_height)]
    labels = cluster_points(above, params.radius, params.cell)
    found = []
    for label in range(labels.max(initial=-1) + 1):
        cluster = above[labels == label]
        if len(cluster) < params.min_points:
            continue
        window = max(LEAST_WINDOW, params.top_window)
        for part in split_by_tops(cluster, params.cell, window, params.min_points):
            found.append(fit_obstacle(cluster[part], floor, viewpoint, params))
    found.sort(key=lambda item: float(np.linalg.norm(item.center - viewpoint[:2])))
    on_floor = points[np.abs(height) <= params.floor_window, :2]
    outline = shapely.get_coordinates(shapely.MultiPoint(on_floor).convex_hull)
    return ObstacleMap(tuple(found), floor, "ok", outline)


def floor_height(z: Vector, window: float) -> float:
    """Computes the densest level of heights, (n,), m: the mean of its points."""
    z = np.sort(z)
    first = np.searchsorted(z, z - window, side="left")
    last = np.searchsorted(z, z + window, side="right")
    level = float(z[int(np.argmax(last - first))])
    return float(z[np.abs(z - level) <= window].mean())


def low_patches(
    points: Vector, height: Vector, params: ObstacleFinderParams
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Selects points where the floor is raised by less than single points can tell.

    Args:
        points: (n, 3), m.
        height: above the floor, (n,), m.
        params: see there.

    Returns:
        (n,), true where the low points of the patch about a point are high enough on
        the mean: by `low_height` and by five deviations of that mean.
    """
    raised = np.zeros(len(points), dtype=np.bool_)
    low = np.flatnonzero(np.abs(height) <= params.min_height)
    if not len(low):
        return raised
    index = np.floor(points[low, :2] / (params.patch / CELLS)).astype(np.int64)
    index -= index.min(axis=0)
    shape = (int(index[:, 0].max()) + 1, int(index[:, 1].max()) + 1)
    flat = index[:, 0] * shape[1] + index[:, 1]
    total = patch_sums(flat, shape, height[low]).ravel()[flat]
    count = np.maximum(np.rint(patch_sums(flat, shape).ravel()[flat]), 1.0)
    least = DEVIATIONS * params.deviation / np.sqrt(count)
    raised[low] = total / count > np.maximum(params.low_height, least)
    return raised


def fit_obstacle(
    points: Vector, floor: float, viewpoint: Vector, params: ObstacleFinderParams
) -> Obstacle:
    """Fits rectangle and height to one group of points.

    Args:
        points: at least three, in W, (n, 3), m.
        floor: height of what it stands on, m.
        viewpoint: where it was seen from, (3,), m.
        params: see `ObstacleFinderParams`.
    """
    z_top = top_height(points[:, 2], params.top_window, 0.35)
    top = points[points[:, 2] > z_top - 0.5 * params.top_window]
    plan = top[:, :2]
    if len(top) >= params.min_points // 2:
        # The rays of the top's points meet it at its height: that takes the noise
        # along the ray out of their place.
        ray = top - viewpoint
        scale = (z_top - viewpoint[2]) / np.minimum(ray[:, 2], -1e-3)
        plan = viewpoint[:2] + scale[:, None] * ray[:, :2]
    middle, yaw, extent = even_rectangle(plan, params.tail)
    if extent[0] > extent[1]:
        yaw, extent = yaw + np.pi / 2.0, extent[::-1]
    height = points[:, 2] - floor
    face = points[(height > params.min_height) & (points[:, 2] < z_top - 0.02)]
    refined = _front_face(face[:, :2], viewpoint[:2], params)
    if refined is not None:
        yaw, front = refined
        x_W = np.array([np.cos(yaw), np.sin(yaw)])
        y_W = np.array([-x_W[1], x_W[0]])
        back = float(np.quantile(plan @ x_W, 1.0 - params.tail)) + params.back_allowance
        width = max(back - front, params.back_allowance)
        sides = np.quantile(points[:, :2] @ y_W, [params.tail, 1.0 - params.tail])
        beyond = (sides[1] - sides[0]) * params.tail / (1.0 - 2.0 * params.tail)
        middle = (front + 0.5 * width) * x_W + 0.5 * sides.sum() * y_W
        extent = np.array([width, sides[1] - sides[0] + 2.0 * beyond])
    return Obstacle(
        center=middle,
        yaw=yaw,
        width=float(extent[0]),
        height=float(z_top - floor),
        length=float(extent[1]),
        support_count=len(points),
    )


def _front_face(
    face: Vector, viewpoint: Vector, params: ObstacleFinderParams
) -> tuple[float, float] | None:
    """Finds the direction across the face seen, away from the sensor, and its place.

    Args:
        face: points below the top, (n, 2), m.
        viewpoint: (2,), m.
        params: how many points make a face.

    Returns:
        Yaw, rad, and the distance of the face along it from W's origin, m; None where
        the points lie on no single face.
    """
    for _ in range(2):
        if len(face) < params.min_points // 2:
            return None
        middle = face.mean(axis=0)
        _, _, axes = np.linalg.svd(face - middle, full_matrices=False)
        x_W = axes[1] if axes[1] @ (middle - viewpoint) >= 0.0 else -axes[1]
        off = (face - middle) @ x_W
        face = face[np.abs(off - np.median(off)) < 0.02]
    spread, length = off.std(), np.ptp((face - middle) @ axes[0])
    if spread > 0.012 or length < 4.0 * spread:
        return None
    front = float(np.median(face @ x_W))
    return float(np.arctan2(x_W[1], x_W[0])), front
