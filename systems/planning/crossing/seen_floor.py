"""Plans how far towards its goal a robot may walk on the floor that it has seen.

Beyond the floor that was seen anything may stand in the way, and near its edge the top
of what stands there was not seen. The robot walks to where it is sure, looks again and
goes on from there.
"""

from dataclasses import dataclass
from math import atan2

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.robots.robot import Sole
from footfall.models.values.geometry import rotate
from footfall.models.values.obstacle import Obstacle, ObstacleMap
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.footsteps import FAR, along_way
from footfall.systems.planning.footsteps.foothold import Refusal, wrap

EDGE = 0.5
"""Within this of the edge of the floor that was seen, m, an obstacle of 0.3 m may have
its top out of sight."""
ROOM = 0.20
"""What the toes keep of such an obstacle where the robot stops, m."""
MARGIN = 0.05
"""What the toes keep of the edge of the floor that was seen, m."""
BEYOND = 0.45
"""What the feet need beyond an obstacle to land and to stand, m."""
NEAR = 0.3
"""A walk this short needs no look, m: the feet are there already."""
LEAST = 0.1
"""A segment is at least this long, m."""
FACING = np.radians(20.0)
"""The robot looks along the walk when it is turned from it by less, rad."""


@dataclass(frozen=True, eq=False)
class WalkSegment:
    """A straight walk that ends with the next look."""

    goal: Vector
    """Midpoint of the feet and heading, (3,), m and rad."""
    obstacles: tuple[Obstacle, ...]
    """What is known well enough to be planned with, as it was given."""
    final: bool
    """Whether it ends at the goal itself."""


def plan_walk_segment(
    seen: ObstacleMap, start: Vector, goal: Vector, sole: Sole
) -> WalkSegment | Refusal:
    """Plans the next straight segment of the walk to a goal.

    Args:
        seen: floor and obstacles of the last look.
        start: midpoint of the feet and heading, (3,), m and rad.
        goal: the same at the end.
        sole: of the feet.

    Returns:
        The walk to the goal where the floor was seen all along; else to where it was,
        or a turn on the spot towards the goal; a refusal where the robot looked and yet
        saw too little.
    """
    offset = goal[:2] - start[:2]
    distance = float(np.linalg.norm(offset))
    if distance < NEAR:
        return WalkSegment(goal, seen.obstacles, final=True)
    yaw = atan2(offset[1], offset[0])
    known = _seen_along(rotate(-yaw, seen.floor_outline - start[:2]))
    stop = known - sole.toe - MARGIN
    certain = []
    for obstacle in seen.obstacles:
        front, back = along_way(obstacle, start[:2], yaw)
        in_sight = back <= known - EDGE
        if in_sight or front > min(stop, distance) + sole.toe + MARGIN:
            certain.append(obstacle)
        else:
            stop = min(stop, front - sole.toe - ROOM)
    if distance <= stop:
        return WalkSegment(goal, seen.obstacles, final=True)
    # Farthest first: where one moves the stop, the next before it has its say.
    extents = [along_way(obstacle, start[:2], yaw) for obstacle in certain]
    for front, back in sorted(extents, reverse=True):
        if front < stop + sole.toe + ROOM and back + BEYOND > stop:
            stop = min(stop, front - sole.toe - ROOM)
    if stop >= LEAST:
        p = start[:2] + stop * offset / distance
        return WalkSegment(np.array([*p, yaw]), tuple(certain), final=False)
    if abs(wrap(yaw - start[2])) > FACING:
        return WalkSegment(np.array([*start[:2], yaw]), (), final=False)
    return Refusal(
        f"the floor towards the goal is seen for {known:.2f} m only: too little to go "
        "nearer and look again"
    )


def _seen_along(outline: Vector) -> float:
    """Computes how far the x axis from the origin runs inside an outline, m."""
    if len(outline) < 3:
        return 0.0
    ray = shapely.LineString([(0.0, 0.0), (FAR, 0.0)])
    cut = shapely.get_coordinates(shapely.intersection(ray, shapely.Polygon(outline)))
    return float(cut[:, 0].max(initial=0.0))
