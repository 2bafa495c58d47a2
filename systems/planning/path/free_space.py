"""Where the middle of a round footprint may be: the floor less the inflated boxes.

For a disc the configuration space is planar and its free part an exact set of
polygons: whether two points are connected is a matter of being in the same one.
"""

from dataclasses import dataclass
from math import cos, pi

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.values.room import Environment, ObstacleBox
from footfall.models.values.vector import Vector

ARC_SEGMENTS = 8
"""Straight pieces a quarter circle is drawn with."""


@dataclass(frozen=True, eq=False)
class FreeSpace:
    """The free polygons for one clearance."""

    parts: tuple[shapely.Polygon, ...]
    """Polygons that are not connected with each other, prepared for queries."""

    def part_of(self, p: Vector) -> int | None:
        """The part that holds the point (2,), m; None where it is not free."""
        for index, part in enumerate(self.parts):
            if shapely.intersects_xy(part, p[0], p[1]):
                return index
        return None

    def holds(self, line: Vector) -> bool:
        """Whether the whole polyline, (n, 2), m, is free."""
        drawn = shapely.linestrings(line)
        return any(bool(shapely.covers(part, drawn)) for part in self.parts)


def free_space(
    floor: Vector, boxes: tuple[ObstacleBox, ...], clearance: float
) -> FreeSpace:
    """The points that keep a clearance from every box and from the floor's edge.

    Round corners are drawn outside the true arcs, so that what is called free is.

    Args:
        floor: outline of the floor, (n, 2), m.
        boxes: obstacles, of whatever height.
        clearance: m.
    """
    ground = shapely.Polygon(floor)
    # The chords of a circle this much larger touch the wanted one from outside.
    radius = clearance / cos(pi / (4.0 * ARC_SEGMENTS))
    inner = ground.buffer(-clearance, join_style="mitre")
    if boxes:
        feet = shapely.polygons(np.stack([box.footprint() for box in boxes]))
        grown = shapely.buffer(feet, radius, quad_segs=ARC_SEGMENTS)
        inner = inner.difference(shapely.union_all(grown))
    parts = tuple(part for part in shapely.get_parts(inner) if part.area > 0.0)
    shapely.prepare(list(parts))
    return FreeSpace(parts)


def floor_outline(environment: Environment) -> Vector:
    """Outline of the floor seen from above, (n, 2), m.

    Raises:
        ValueError: the environment has no floor.
    """
    if environment.floor is None:
        raise ValueError("the environment has no floor")
    return environment.floor.polygon[:, :2]


def refuse_place(
    place: str, p: Vector, environment: Environment, least: float
) -> str | None:
    """Why a footprint cannot be at a point, in a line; None where it can.

    Args:
        place: what the point is, e.g. "goal".
        p: the point, (2,), m.
        environment: floor and boxes.
        least: least distance to boxes and to the floor's edge, m.
    """
    where = f"the {place} ({p[0]:z.2f}, {p[1]:z.2f}) m"
    point = shapely.Point(p)
    ground = shapely.Polygon(floor_outline(environment))
    if not ground.covers(point):
        return f"{where} is outside the floor that was seen"
    for box in environment.boxes:
        distance = shapely.Polygon(box.footprint()).distance(point)
        if distance == 0.0:
            return f"{where} is inside {box.name}"
        if distance < least:
            return (
                f"{where} is in collision: {distance:.2f} m from {box.name}, where "
                f"the footprint takes {least:.2f} m"
            )
    distance = ground.exterior.distance(point)
    if distance < least:
        return (
            f"{where} is {distance:.2f} m from the edge of the floor that was seen, "
            f"where the footprint takes {least:.2f} m"
        )
    return None
