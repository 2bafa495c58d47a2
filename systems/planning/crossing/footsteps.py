"""Footsteps over the floor to a goal that step over what lies in the way.

The steps before an obstacle are fitted so that the feet come to stand side by side
just where the key configuration begins; the two feet then cross it one after the
other, and the walk goes on without a stop.
"""

from dataclasses import dataclass
from math import atan2

import numpy as np
import shapely  # type: ignore[import-untyped]
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET, Foot, other_foot
from footfall.models.values.geometry import rotate
from footfall.models.values.obstacle import (
    Feasibility,
    KeyConfiguration,
    Obstacle,
    across,
)
from footfall.models.values.planned import Footstep, FootstepPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.approach import FloorStep, plan_approach
from footfall.systems.planning.footsteps.foothold import Refusal, wrap
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

CORRIDOR = 0.25
"""Half the width of the way that the feet take, m: they stay within, and arms are
above what can be stepped over."""
FAR = 100.0
"""Longer than any way, m."""
TOE_ROOM = 0.05
"""What the toes keep of an obstacle beyond the goal, m."""
STAND = 0.02
"""So much before the place where they land beyond an obstacle the feet may end, m."""
FLOOR = -1


@dataclass(frozen=True)
class CrossingSteps:
    """Footsteps; those that cross an obstacle have its index as their plane."""

    plan: FootstepPlan
    obstacles: tuple[Obstacle, ...] = ()
    """What is crossed, in order."""
    keys: tuple[KeyConfiguration, ...] = ()
    """The key configuration of each."""


def facing(obstacle: Obstacle, yaw: float) -> Obstacle:
    """The obstacle with its direction across it turned to lie within 90 deg of yaw."""
    turn = wrap(obstacle.yaw - yaw)
    flipped = obstacle.yaw if abs(turn) <= np.pi / 2.0 else obstacle.yaw + np.pi
    return Obstacle(
        obstacle.center,
        wrap(flipped),
        obstacle.width,
        obstacle.height,
        obstacle.length,
        obstacle.support_count,
    )


def corners(obstacle: Obstacle) -> Vector:
    """Corners of its footprint in W, (4, 2), m."""
    x_W, y_W = across(obstacle.yaw), across(obstacle.yaw + np.pi / 2.0)
    half = 0.5 * np.array([obstacle.width, obstacle.length])
    signs = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * half
    found: Vector = obstacle.center + signs @ np.array([x_W, y_W])
    return found


def in_the_way(
    obstacles: tuple[Obstacle, ...], start: Vector, goal: Vector, sole: Sole
) -> tuple[Obstacle, ...]:
    """The obstacles between a start and a goal, nearest first.

    Args:
        obstacles: all that are known.
        start: midpoint of the feet, (2,), m.
        goal: where it is to come to, (2,), m.
        sole: of the feet.
    """
    way = goal - start
    distance = float(np.linalg.norm(way))
    if distance < 1e-6:
        return ()
    yaw = atan2(way[1], way[0])
    found = []
    for obstacle in obstacles:
        front, back = along_way(obstacle, start, yaw)
        if back >= -sole.heel and front <= distance + sole.toe + TOE_ROOM:
            found.append((front, facing(obstacle, yaw)))
    return tuple(obstacle for _, obstacle in sorted(found, key=lambda item: item[0]))


def along_way(obstacle: Obstacle, start: Vector, yaw: float) -> tuple[float, float]:
    """From where to where an obstacle lies in a way that begins at start (2,), m.

    One beside the way is infinitely far, (inf, -inf).
    """
    footprint = shapely.Polygon(rotate(-yaw, corners(obstacle) - start))
    corridor = shapely.box(-FAR, -CORRIDOR, FAR, CORRIDOR)
    x = shapely.get_coordinates(shapely.intersection(footprint, corridor))[:, 0]
    return float(x.min(initial=np.inf)), float(x.max(initial=-np.inf))


def plan_crossing_steps(
    feet: Vector,
    goal: Vector,
    obstacles: tuple[Obstacle, ...],
    feasibilities: tuple[Feasibility, ...],
    sole: Sole,
    params: FootstepPlannerParams,
) -> CrossingSteps:
    """Steps to the goal over the obstacles that are in the way.

    Args:
        feet: sole poses, (2, 6), left first, level.
        goal: midpoint of the feet and heading at the end, (3,), m and rad.
        obstacles: what is in the way, nearest first, see `in_the_way`.
        feasibilities: what the feasibility unit says of each.
        sole: both soles.
        params: reach and tolerances of walking.

    Returns:
        The steps, or with status "infeasible" why there are none.
    """
    z = float(feet[:, 2].mean())
    now = {
        foot: FloorStep(foot, feet[i, :2], float(feet[i, 5]))
        for i, foot in enumerate(FEET)
    }
    steps: list[Footstep] = []
    keys: list[KeyConfiguration] = []
    last: Foot = other_foot(_lead(params))
    for index, (obstacle, answer) in enumerate(
        zip(obstacles, feasibilities, strict=True)
    ):
        name = f"the obstacle {_ahead(feet, obstacle):.2f} m ahead"
        if answer.key is None:
            return _refused(f"{name} cannot be crossed: {answer.constraint}")
        key, yaw = answer.key, obstacle.yaw
        here = rotate(-yaw, _middle(now))
        start_x = float(rotate(-yaw, obstacle.center)[0]) - obstacle.width / 2.0
        line = start_x - key.front
        if index and line < here[0] - 0.01:
            return _refused(
                f"{name} is too near to the one before it: between them the feet need "
                f"{here[0] - line:.2f} m more"
            )
        place = _on_the_way(_middle(now), goal[:2], yaw, line)
        walked = _walk(now, place, yaw, last, z, sole, params)
        if isinstance(walked, Refusal):
            return _refused(f"{name}: {walked.reason}")
        steps += walked[0]
        now = walked[1]
        lead: Foot = other_foot(steps[-1].foot) if steps else _lead(params)
        beyond = line + key.X_ads
        for foot in (lead, other_foot(lead)):
            y = float(rotate(-yaw, now[foot].p)[1])
            p = rotate(yaw, np.array([beyond, y]))
            now[foot] = FloorStep(foot, p, yaw)
            steps.append(_footstep(now[foot], z, index))
        keys.append(key)
        last = other_foot(lead)
        short = beyond - float(rotate(-yaw, goal[:2])[0])
        if index == len(obstacles) - 1 and short > STAND:
            return _refused(
                f"the goal is too near to {name}: beyond it the feet stand "
                f"{short:.2f} m farther on"
            )
    walked = _walk(now, goal[:2], float(goal[2]), last, z, sole, params)
    if isinstance(walked, Refusal):
        return _refused(f"the goal: {walked.reason}")
    steps += walked[0]
    if not steps:
        return CrossingSteps(FootstepPlan())
    return CrossingSteps(FootstepPlan(tuple(steps), "planned"), obstacles, tuple(keys))


def _refused(reason: str) -> CrossingSteps:
    return CrossingSteps(FootstepPlan((), "infeasible", reason))


def _lead(params: FootstepPlannerParams) -> Foot:
    return "left" if params.lead_foot == "left" else "right"


def _ahead(feet: Vector, obstacle: Obstacle) -> float:
    return float((obstacle.center - feet[:, :2].mean(axis=0)) @ across(obstacle.yaw))


def _middle(now: dict[Foot, FloorStep]) -> Vector:
    middle: Vector = 0.5 * (now["left"].p + now["right"].p)
    return middle


def _on_the_way(start: Vector, goal: Vector, yaw: float, x: float) -> Vector:
    """Where the straight way from start to goal meets the line x of a frame at yaw."""
    a, b = rotate(-yaw, start), rotate(-yaw, goal)
    share = 0.0 if abs(b[0] - a[0]) < 1e-6 else (x - a[0]) / (b[0] - a[0])
    y = a[1] + np.clip(share, 0.0, 1.0) * (b[1] - a[1])
    return rotate(yaw, np.array([x, y]))


def _walk(
    now: dict[Foot, FloorStep],
    place: Vector,
    yaw: float,
    last: Foot,
    z: float,
    sole: Sole,
    params: FootstepPlannerParams,
) -> tuple[list[Footstep], dict[Foot, FloorStep]] | Refusal:
    """Steps that bring both feet side by side to a place, and where they are then."""
    turned = {
        foot: FloorStep(foot, rotate(-yaw, step.p), wrap(step.yaw - yaw))
        for foot, step in now.items()
    }
    walk = plan_approach(turned, rotate(-yaw, place), last, sole, params)
    if isinstance(walk, Refusal):
        return walk
    after = dict(now)
    steps = []
    for step in walk:
        moved = FloorStep(step.foot, rotate(yaw, step.p), wrap(step.yaw + yaw))
        after[step.foot] = moved
        steps.append(_footstep(moved, z, FLOOR))
    return steps, after


def _footstep(step: FloorStep, z: float, plane: int) -> Footstep:
    p_WF: Vector = np.array([*step.p, z])
    X_WF = RigidTransform(RollPitchYaw(0.0, 0.0, step.yaw), p_WF)
    return Footstep(foot=step.foot, X_WF=X_WF, plane=plane)
