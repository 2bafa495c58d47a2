"""A path over the floor between the boxes, or why there is none (paper, Sec. 3.1)."""

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.values.room import Environment, PathPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.path.free_space import (
    floor_outline,
    free_space,
    refuse_place,
)
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.planning.path.path_shortening import (
    path_length,
    shorten_path,
    skip_corners,
)
from footfall.systems.planning.path.rrt_connect import GrownTrees, rrt_connect

INWARD = 1e-3
"""How far inside the free space an escape from the margin ends, m."""


def plan_path(
    environment: Environment,
    start: Vector,
    goal: Vector,
    params: PathPlannerParams,
) -> PathPlan:
    """Plans a path for the footprint and its margin by RRT-Connect, and shortens it.

    A start whose margin alone is violated, say by a box that has come near, is left on
    the shortest straight way that keeps the footprint clear. Whether start and goal
    are connected at all is decided exactly, before any tree grows.

    Args:
        environment: floor and boxes.
        start: the robot's middle, (2,), m.
        goal: where it is to go and how to face there, (x, y, yaw), (3,), m and rad.
        params: footprint and search.

    Returns:
        The path, or "refused" with the reason: no floor, a place that is outside the
        floor, in a box or too near one, a goal that is cut off, or no path found
        within the time limit. The same arguments give the same path bit for bit.
    """
    yaw = float(goal[2])
    refusal = _refuse(environment, start, goal, params)
    if refusal is not None:
        return PathPlan(goal_yaw=yaw, reason=refusal)
    outline = floor_outline(environment)
    space = free_space(outline, environment.boxes, params.clearance)
    part = space.part_of(goal[:2])
    if part is None:
        # Within the drawing of the round corners; a millimetre beyond what is allowed.
        reason = f"the goal is nearer than {params.clearance:.2f} m to a box"
        return PathPlan(goal_yaw=yaw, reason=reason)
    region = space.parts[part]
    lead = np.zeros((0, 2))
    origin = start
    if space.part_of(start) is None:
        inner = region.buffer(-INWARD)
        if not inner.is_empty:
            way = shapely.shortest_line(shapely.Point(start), inner)
            lead, origin = start[None, :], shapely.get_coordinates(way)[1]
        bare = free_space(outline, environment.boxes, params.footprint_radius)
        if inner.is_empty or not bare.holds(np.vstack([start, origin])):
            reason = "no path exists: the boxes leave no way out of the start"
            return PathPlan(goal_yaw=yaw, reason=reason)
    elif space.part_of(start) != part:
        reason = (
            "no path exists: boxes and the floor's edge cut the goal off from the "
            f"start for a footprint of {params.clearance:.2f} m"
        )
        return PathPlan(goal_yaw=yaw, reason=reason)
    best = _shortest(region, origin, goal[:2], params)
    if best is None:
        reason = f"no path found in {params.time_limit:g} s"
        return PathPlan(goal_yaw=yaw, reason=reason)
    points, growth = best
    assert growth.path is not None
    return PathPlan(
        points=np.vstack([lead, points]),
        goal_yaw=yaw,
        status="planned",
        found=np.vstack([lead, growth.path]),
        start_tree=growth.start_tree,
        goal_tree=growth.goal_tree,
    )


def _refuse(
    environment: Environment, start: Vector, goal: Vector, params: PathPlannerParams
) -> str | None:
    """Why there is nothing to plan, None where there is."""
    if environment.floor is None:
        return environment.reason or "no floor in the environment"
    if not (np.all(np.isfinite(start)) and np.all(np.isfinite(goal))):
        return f"start and goal must be finite, got {start} and {goal}"
    return refuse_place(
        "start", start, environment, params.footprint_radius
    ) or refuse_place("goal", goal[:2], environment, params.clearance)


def _shortest(
    region: shapely.Polygon, start: Vector, goal: Vector, params: PathPlannerParams
) -> tuple[Vector, GrownTrees] | None:
    """The shortest path of several searches, shortened, with its trees."""
    best: tuple[Vector, GrownTrees] | None = None
    straight = float(np.linalg.norm(goal - start))

    def is_free(segment: Vector) -> bool:
        return bool(shapely.covers(region, shapely.linestrings(segment)))

    for attempt in range(params.attempts):
        growth = rrt_connect(
            region,
            start,
            goal,
            extension=params.extension,
            time_limit=params.time_limit / params.attempts,
            seed=params.seed * params.attempts + attempt,
        )
        if growth.path is None:
            continue
        points = skip_corners(growth.path, is_free)
        if best is None or path_length(points) < path_length(best[0]):
            best = points, growth
        if path_length(best[0]) <= straight + 1e-9:
            break
    if best is None:
        return None
    return shorten_path(best[0], is_free, params.shortcuts, params.seed), best[1]
