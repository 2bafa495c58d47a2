"""What a run is measured by: slip, clearance, ZMP margin and the like, pure.

Every function takes arrays over the n samples of a run. "Loaded" means that a foot
bears more than a fifth of the robot's weight.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.scenes.tread import Tread
from footfall.models.values.vector import Vector
from footfall.systems.sensing.contact_monitor import LOADED

LIFTED = 0.02
"""Share of the weight below which a foot counts as off the ground."""
LIFTED_CORNER = 0.01
"""Height above a sole's lowest corner from which a corner bears nothing, m."""


class Interval(NamedTuple):
    """Samples `start` to `end`, the latter not included."""

    start: int
    end: int


def contact_intervals(normal_force: Vector, weight: float) -> list[Interval]:
    """Finds when a foot stood: from touch-down (loaded) until lift-off (no force).

    Args:
        normal_force: upward force on the foot, (n,), N.
        weight: of the robot, N.
    """
    intervals: list[Interval] = []
    start: int | None = None
    for index, share in enumerate(normal_force / weight):
        if start is None and share > LOADED:
            start = index
        elif start is not None and share < LIFTED:
            intervals.append(Interval(start, index))
            start = None
    if start is not None:
        intervals.append(Interval(start, len(normal_force)))
    return intervals


def foot_slip(corners: Vector, normal_force: Vector, weight: float) -> float | None:
    """Measures how far a sole slid while it was loaded, m; None where it never was.

    Within each contact the four corners' horizontal displacements from where they were
    at touch-down are sorted and the second least is taken, so that rolling over the
    toe or heel edge (two corners stay) is no slip, while sliding or turning on the
    spot is. Only loaded samples count.

    Args:
        corners: of the sole, (n, 4, 3), m.
        normal_force: upward force on the foot, (n,), N.
        weight: of the robot, N.
    """
    slips = []
    for start, end in contact_intervals(normal_force, weight):
        moved = np.linalg.norm(
            corners[start:end, :, :2] - corners[start, :, :2], axis=2
        )
        loaded = normal_force[start:end] > LOADED * weight
        slips.append(float(np.sort(moved, axis=1)[loaded, 1].max()))
    return max(slips, default=None)


def zmp_margins(
    zmp: Vector,
    corners: tuple[Vector, Vector],
    normal_forces: tuple[Vector, Vector],
    weight: float,
) -> Vector:
    """Distance of the ZMP to the edge of the support polygon, (n,), m.

    The support polygon is the hull of the corners of the feet on the ground, seen from
    above, without the corners that a rolling foot has lifted. Positive inside; nan
    where there is no ZMP.

    Args:
        zmp: (n, 2), m.
        corners: of the left and the right sole, (n, 4, 3) each, m.
        normal_forces: on each foot, (n,) each, N.
        weight: of the robot, N.
    """
    margins: Vector = np.full(len(zmp), np.nan)
    points, bearing = [], []
    for sole, force in zip(corners, normal_forces, strict=True):
        low = sole[:, :, 2] < sole[:, :, 2].min(axis=1)[:, None] + LIFTED_CORNER
        points.append(sole[:, :, :2])
        bearing.append(low & (force > LIFTED * weight)[:, None])
    points_all, bearing_all = np.hstack(points), np.hstack(bearing)
    valid = np.isfinite(zmp).all(axis=1) & bearing_all.any(axis=1)
    # A corner that bears nothing is replaced by one that does: the hull is the same.
    first = bearing_all.argmax(axis=1)
    stand_in = points_all[np.arange(len(zmp)), first][:, None, :]
    outline = np.where(bearing_all[:, :, None], points_all, stand_in)[valid]
    if not len(outline):
        return margins
    hulls = shapely.convex_hull(shapely.multipoints(list(outline)))
    places = shapely.points(zmp[valid])
    areas = shapely.get_type_id(hulls) == shapely.GeometryType.POLYGON
    edges = np.where(areas, shapely.boundary(hulls), hulls)
    distances = shapely.distance(edges, places)
    inside = areas & shapely.contains(hulls, places)
    margins[valid] = np.where(inside, distances, -distances)
    return margins


def nosings(treads: tuple[Tread, ...]) -> list[Vector]:
    """Computes the front edge of every tread as its two ends, (2, 3), m."""
    edges = []
    for tread in treads:
        half = tread.size / 2.0
        ends_R = np.array([[-half[0], -half[1], 0.0], [-half[0], half[1], 0.0]])
        edges.append(np.array(tread.X_WR.multiply(ends_R.T)).T)
    return edges


def swing_clearance(
    corners: Vector, normal_force: Vector, weight: float, edges: list[Vector]
) -> float | None:
    """Computes the least distance of a swinging sole to an edge that it passes over, m.

    An edge counts in a swing when the toes are before it at lift-off and beyond it at
    touch-down. In the plane across the edge the sole is the segment from heel to toe;
    where the heel stays before the edge (the sole lands overhanging) the toe alone is
    measured. What has passed may come down as near to the edge as it likes. Negative
    where the sole passes beneath the edge. None where no edge was passed.

    Args:
        corners: of the sole in the order of `TrueMotion.sole_corners`, (n, 4, 3), m.
        normal_force: upward force on the foot, (n,), N.
        weight: of the robot, N.
        edges: two ends each, (2, 3), m.
    """
    contacts = contact_intervals(normal_force, weight)
    heel, toe = corners[:, [0, 3]].mean(axis=1), corners[:, [1, 2]].mean(axis=1)
    clearances = []
    for before, after in pairwise(contacts):
        samples = slice(before.end - 1, after.start + 1)
        for edge in edges:
            along = (edge[1] - edge[0]) / np.linalg.norm(edge[1] - edge[0])
            ahead = np.cross(along, [0.0, 0.0, 1.0])
            if (toe[after.start] - toe[before.end - 1]) @ ahead < 0.0:
                ahead = -ahead
            p_toe, p_heel = (
                np.stack([(p[samples] - edge[0]) @ ahead, (p - edge[0])[samples, 2]], 1)
                for p in (toe, heel)
            )
            if not p_toe[0, 0] < 0.0 < p_toe[-1, 0]:
                continue
            tail = p_heel if p_heel[-1, 0] > 0.0 else p_toe
            short = np.flatnonzero(tail[:, 0] <= 0.0)
            if not len(short):  # a foot that tumbles, its heel first
                continue
            passed = int(short[-1]) + 1
            clearances.append(_min_distance_to_origin(tail[:passed], p_toe[:passed]))
    return min(clearances, default=None)


def _min_distance_to_origin(a: Vector, b: Vector) -> float:
    """Least distance of segments a-b, (n, 2) each, to the origin, negative below it."""
    direction = b - a
    length = np.maximum((direction**2).sum(axis=1), 1e-12)
    share = np.clip(-(a * direction).sum(axis=1) / length, 0.0, 1.0)
    nearest = a + share[:, None] * direction
    distance = np.linalg.norm(nearest, axis=1)
    beneath = (a[:, 0] * b[:, 0] < 0.0) & (nearest[:, 1] < 0.0)
    return float(np.where(beneath, -distance, distance).min())
