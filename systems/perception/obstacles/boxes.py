"""Upright boxes around clusters of points that a camera above saw.

Room paper, Sec. 2.3: an obstacle is the box that contains its cluster. A camera under
the ceiling sees an obstacle's top and at most two of its sides, and errs along the
ray by centimetres, so the box is not drawn around the points themselves: the height
is where the topmost points are densest; the points of the top are slid along their
rays to that height, which takes the sensor's error out of their place; the box is the
least rectangle that these fill evenly, and reaches down to the floor.
"""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from footfall.models.values.room import FloorPlane, ObstacleBox
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.clusters import cluster_points
from footfall.systems.perception.obstacles.tops import split_by_tops
from footfall.systems.perception.range_noise import RangeNoise, slide_to_plane

LEAST_WINDOW = 0.03
"""Heights of tops that differ by less are the same, m; twice the noise where that is
more."""
MAX_JUDGES = 400
"""Points that a first look at the angles uses; more would not change the choice."""
MIN_TOP = 12
"""Fewer points make no top; then all points of the cluster bound the box."""

FLATNESS = 0.02
"""How much larger than the least a rectangle nearly as good may be."""
YAW_TAIL = 0.25
"""Part of the tail that is left out to find the yaw: a side that is cut off by more
turns too far before its rectangle grows."""


@dataclass(kw_only=True)
class ObstacleClustererParams(Parameters):
    """How the points above the floor become boxes."""

    radius: float = number(0.06, "m", above=0.0)
    """Gap between points that separates two obstacles, m; above the spacing of the
    points at the far end."""
    cell: float = number(0.02, "m", least=1e-3)
    """Columns in which points are gathered before, m: the leaf of the voxel grid."""
    min_points: int = number(30, least=3)
    """Clusters with fewer points are noise."""
    tail: float = number(0.04, least=0.0, below=0.25)
    """Share of the top's points at either end that does not bound the box: they are
    noise or side. What they would span is added, as points fill a top evenly."""
    top_share: float = number(0.35, above=0.0, most=1.0)
    """How dense the points of a top are at least, of the densest height."""
    noise: RangeNoise = field(default_factory=RangeNoise)
    """Of the sensor."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.cell < self.radius:
            raise ValueError(f"cell: must be less than radius, got {self.cell:g} m")


def find_boxes(
    points: Vector,
    floor: FloorPlane,
    viewpoint: Vector,
    params: ObstacleClustererParams,
) -> tuple[ObstacleBox, ...]:
    """Finds the obstacles in the points above the floor.

    Args:
        points: in W, (n, 3), m.
        floor: what they stand on.
        viewpoint: where they were seen from, (3,), m.
        params: how they are told apart.

    Returns:
        Their boxes, from the least x to the largest, named "box_0" and so on.
    """
    labels = cluster_points(points, params.radius, params.cell)
    order = np.argsort(labels, kind="stable")
    bounds = np.searchsorted(labels[order], np.arange(labels.max(initial=-1) + 2))
    found = []
    for begin, end in pairwise(bounds):
        if end - begin < params.min_points:
            continue
        cluster = points[order[begin:end]]
        deviation = float(np.median(params.noise.height_deviation(cluster, viewpoint)))
        window = max(LEAST_WINDOW, 2.0 * deviation)
        found += [
            fit_box(cluster[part], floor, viewpoint, params)
            for part in split_by_tops(cluster, params.cell, window, params.min_points)
        ]
    found.sort(key=lambda box: (box.center[0], box.center[1]))
    return tuple(
        ObstacleBox(f"box_{i}", box.center, box.yaw, box.size, box.support_count)
        for i, box in enumerate(found)
    )


def fit_box(
    points: Vector,
    floor: FloorPlane,
    viewpoint: Vector,
    params: ObstacleClustererParams,
) -> ObstacleBox:
    """Fits an upright box to one cluster, from the floor to its top.

    Args:
        points: at least three, in W, (n, 3), m.
        floor: what it stands on.
        viewpoint: where it was seen from, (3,), m.
        params: noise and tails.
    """
    deviation = float(np.median(params.noise.height_deviation(points, viewpoint)))
    z_top = top_height(points[:, 2], 2.0 * deviation + 0.005, params.top_share)
    # Half a deviation below the top the points of the sides are as few as can be,
    # while a top that is thinned evenly keeps its extent.
    top = points[points[:, 2] > z_top - 0.5 * deviation]
    if len(top) >= MIN_TOP:
        level = np.array([0.0, 0.0, 1.0, -z_top])
        plan = slide_to_plane(top, viewpoint, level)[:, :2]
    else:
        plan = points[:, :2]
    middle, yaw, extent = even_rectangle(plan, params.tail)
    z_floor = floor.height(middle)
    height = max(z_top - z_floor, params.cell)
    center = np.append(middle, z_floor + height / 2.0)
    size = np.append(np.maximum(extent, params.cell), height)
    return ObstacleBox("", center, yaw, size, len(points))


def top_height(z: Vector, half_window: float, share: float) -> float:
    """Estimates the height of an object's top face: its highest dense level.

    Args:
        z: heights of its points, (n,), m.
        half_window: half of the thickness of the level, m: two deviations.
        share: how many points the level has at least, of the densest level's.

    Returns:
        Mean height of the level's points, m.
    """
    z = np.sort(z)
    first = np.searchsorted(z, z - half_window, side="left")
    last = np.searchsorted(z, z + half_window, side="right")
    dense = np.flatnonzero(last - first >= share * (last - first).max())
    top = float(z[dense[-1]])
    # From the rim of the level to its middle.
    for _ in range(20):
        level = z[
            np.searchsorted(z, top - half_window) : np.searchsorted(
                z, top + half_window, side="right"
            )
        ]
        top = float(level.mean())
    return top


def even_rectangle(plan: Vector, tail: float) -> tuple[Vector, float, Vector]:
    """Fits the least rectangle that points fill evenly, from the points' quantiles.

    Args:
        plan: points, (n, 2), m.
        tail: share of the points at either end that is not trusted.

    Returns:
        Its middle, (2,), m; the direction of its x, in [-pi/4, pi/4), rad; its side
        lengths, (2,), m.
    """
    judges = plan[:: max(1, len(plan) // MAX_JUDGES)]
    coarse = np.radians(np.arange(-45.0, 45.0, 3.0))
    angle = _min_angle(judges, coarse, YAW_TAIL * tail)
    finer = angle + np.radians(np.arange(-4.0, 4.1, 0.5))
    angle = _min_angle(plan, finer, YAW_TAIL * tail)
    (low,), (high,) = _spans(plan, np.array([angle]), tail)
    c, s = np.cos(angle), np.sin(angle)
    x, y = (low + high) / 2.0
    middle = np.array([x * c - y * s, x * s + y * c])
    quarters = np.floor(angle / (np.pi / 2.0) + 0.5)
    extent = high - low if quarters % 2 == 0 else (high - low)[::-1]
    return middle, float(angle - quarters * np.pi / 2.0), extent


def _min_angle(plan: Vector, angles: Vector, tail: float) -> float:
    """Finds the angle, of (m,), rad, whose rectangle is least.

    About the true angle the area hardly changes as long as a turn moves the sides by
    less than the tails, so the middle of all angles that are nearly as good counts.
    """
    low, high = _spans(plan, angles, tail)
    area = np.prod(high - low, axis=1)
    good = angles[area <= (1.0 + FLATNESS) * area.min()]
    best = float(angles[np.argmin(area)])
    # The angles repeat after a quarter turn.
    near = (good - best + np.pi / 4.0) % (np.pi / 2.0) - np.pi / 4.0
    return best + float(near.mean())


def _spans(plan: Vector, angles: Vector, tail: float) -> tuple[Vector, Vector]:
    """Computes ends, (m, 2), m, of points along the axes of frames turned by (m,)."""
    c, s = np.cos(angles), np.sin(angles)
    along = np.stack(
        [
            np.outer(c, plan[:, 0]) + np.outer(s, plan[:, 1]),
            np.outer(c, plan[:, 1]) - np.outer(s, plan[:, 0]),
        ],
        axis=1,
    )
    along.sort(axis=2)
    last = along.shape[2] - 1
    cut = round(tail * last)
    low, high = along[:, :, cut], along[:, :, last - cut]
    beyond = (high - low) * cut / max(last - 2 * cut, 1)
    return low - beyond, high + beyond
