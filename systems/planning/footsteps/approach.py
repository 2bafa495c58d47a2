"""Steps over level floor to a stand with the feet side by side, as few as possible.

Everything is planar in a frame G of the goal: the feet are to end at yaw 0. A walk of
n + 1 steps places alternating feet; the last but one reaches the goal, the last comes
beside it. Its yaws change evenly; its displacements come from a small QP that keeps
each foot within reach of the stance foot and else spreads the way evenly. The least n
for which that QP has a solution gives the walk.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees

import daqp
import numpy as np
import shapely  # type: ignore[import-untyped]
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET, Foot, other_foot
from footfall.models.values.geometry import heading, rotate
from footfall.models.values.perceived import PlaneSegment, Staircase
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import (
    SIDE,
    Refusal,
    min_width,
    sole_corners,
    tilt,
    wrap,
)
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.standing import FLOOR


@dataclass(frozen=True)
class FloorStep:
    """A foot's place on the floor, in G."""

    foot: Foot
    p: Vector
    """(2,), m."""
    yaw: float
    """rad."""


def plan_approach(
    start: Mapping[Foot, FloorStep],
    goal: Vector,
    last: Foot,
    sole: Sole,
    params: FootstepPlannerParams,
) -> tuple[FloorStep, ...] | Refusal:
    """The fewest alternating steps that bring both feet to the goal.

    Args:
        start: where the feet are.
        goal: the point midway between the feet at the end, (2,), m, in G; no foot
            goes beyond its x.
        last: the foot to step last, where that costs no step more.
        sole: both soles.
        params: reach and tolerances.

    Returns:
        The steps, none where the feet are at the goal already, or a refusal.
    """
    ends = {
        f: goal + np.array([0.0, SIDE[f] * params.stance_width / 2.0]) for f in FEET
    }
    there = {
        f: float(np.abs(start[f].p - ends[f]).max()) <= params.stand_tolerance
        and abs(start[f].yaw) <= params.stand_turn_tolerance
        for f in FEET
    }
    if all(there.values()):
        return ()
    for n in range(params.max_approach_steps):
        # The foot that steps last alternates back to the one that steps first.
        first = last if n % 2 == 0 else other_foot(last)
        for foot in (first, other_foot(first)):
            stance = start[other_foot(foot)]
            steps: tuple[FloorStep, ...] | None = ()
            if n > 0:
                steps = _walk(stance, ends, n, sole, params)
            if steps is None or (n == 0 and not there[stance.foot]):
                continue
            beside = other_foot(steps[-1].foot) if steps else foot
            return (*steps, FloorStep(beside, ends[beside], 0.0))
    distance = float(np.linalg.norm(goal - (start["left"].p + start["right"].p) / 2.0))
    return Refusal(
        f"the stand line, {distance:.2f} m away, cannot be reached within "
        f"{params.max_approach_steps} steps"
    )


def _walk(
    stance: FloorStep,
    ends: Mapping[Foot, Vector],
    n: int,
    sole: Sole,
    params: FootstepPlannerParams,
) -> tuple[FloorStep, ...] | None:
    """N steps from a stance foot, the last of them at its foot's end; None if too few.

    Unknown are the displacements d_k of each foot in the frame of the one before it:
    minimise sum |d_k - d_side|^2 subject to p_0 + sum R_k d_k = p_n, the box of
    reachable d_k, and no p_k beyond the goal's x.
    """
    if abs(stance.yaw) > n * params.max_turn + 1e-9:
        return None
    foot = other_foot(stance.foot)
    feet = [foot if k % 2 == 0 else other_foot(foot) for k in range(n)]
    end = ends[feet[-1]]
    way = end - stance.p
    if np.linalg.norm(way) > n * np.hypot(
        params.max_step_length, params.max_stance_width
    ):
        return None
    turn = -stance.yaw / n
    yaws = [stance.yaw + k * turn for k in range(n + 1)]
    nominal = np.zeros(2 * n)
    low, high = np.empty(2 * n), np.empty(2 * n)
    low[0::2], high[0::2] = -params.max_back_step, params.max_step_length
    for k, f in enumerate(feet):
        least = min_width(turn, f, sole, params.sole_gap)
        widths = (SIDE[f] * least, SIDE[f] * params.max_stance_width)
        nominal[2 * k + 1] = SIDE[f] * params.stance_width
        low[2 * k + 1], high[2 * k + 1] = sorted(widths)
    turns = np.hstack([rotate(yaw, np.eye(2)).T for yaw in yaws[:-1]])
    below = np.tril(np.ones((n - 1, n))).repeat(2, axis=1) * turns[0]
    rows = np.ascontiguousarray(np.vstack([turns, below]))
    free = max(stance.p[0], end[0]) - stance.p[0]
    lower = np.concatenate([low, way, np.full(n - 1, -1e30)])
    upper = np.concatenate([high, way, np.full(n - 1, free)])
    sense = np.zeros(len(upper), dtype=np.int32)
    sense[2 * n : 2 * n + 2] = 5
    d, _, flag, _ = daqp.solve(np.eye(2 * n), -nominal, rows, upper, lower, sense)
    if flag < 1:
        return None
    moves = [
        rotate(yaw, move)
        for yaw, move in zip(yaws, np.reshape(d, (n, 2)), strict=False)
    ]
    places = stance.p + np.cumsum(moves, axis=0)
    places[-1] = end
    return tuple(
        FloorStep(f, p, wrap(yaw))
        for f, p, yaw in zip(feet, places, yaws[1:], strict=True)
    )


def approach_staircase(
    staircase: Staircase,
    ground: int,
    feet: Mapping[Foot, RigidTransform],
    stand: Vector,
    yaw: float,
    z: float,
    sole: Sole,
    params: FootstepPlannerParams,
) -> tuple[Footstep, ...] | Refusal:
    """Plans the steps to the stand line, none where the feet are on it.

    Args:
        staircase: what was seen, in W.
        ground: what is walked on: FLOOR, or the tread that is a landing.
        feet: sole frames X_WF.
        stand: where the point midway between the feet is to come to, in G, (2,), m.
        yaw: of G in W, that of the staircase, rad.
        z: height of the soles, m.
        sole: both soles.
        params: reach and tolerances.
    """
    start = {
        f: FloorStep(f, rotate(-yaw, X.translation()[:2]), wrap(heading(X) - yaw))
        for f, X in feet.items()
    }
    last: Foot = "right" if params.lead_foot == "left" else "left"
    walk = plan_approach(start, stand, last, sole, params)
    if isinstance(walk, Refusal) or not walk:
        return walk if isinstance(walk, Refusal) else ()
    plane, name = staircase.floor, "the floor before the staircase"
    if ground != FLOOR:
        plane, name = staircase.treads[ground], f"tread {ground + 1}"
    if plane is None:
        return Refusal("no floor seen between the robot and the staircase")
    slope = tilt(plane.normal)
    if slope > params.flat_tolerance:
        return Refusal(
            f"{name} slopes by {degrees(slope):.1f} deg, more "
            f"than {degrees(params.flat_tolerance):.1f} deg"
        )
    steps = tuple(_footstep(step, yaw, z, ground) for step in walk)
    if ground != FLOOR:
        refusal = _refuse_edge(plane, name, steps, sole, params)
        return refusal or steps
    toes = rotate(yaw, stand + np.array([sole.toe, 0.0]))
    unseen = shapely.Polygon(plane.polygon[:, :2]).distance(shapely.Point(toes))
    if unseen > params.floor_reach:
        return Refusal(
            f"the stand line lies {unseen:.2f} m from the floor that was seen, more "
            f"than {params.floor_reach:.2f} m"
        )
    return _refuse_collision(staircase, feet, steps, sole, params) or steps


def _footstep(step: FloorStep, yaw: float, z: float, plane: int) -> Footstep:
    """The step with a level sole at height z, in W; G is turned by `yaw`."""
    p_WF: Vector = np.array([*rotate(yaw, step.p), z])
    X_WF = RigidTransform(RollPitchYaw(0.0, 0.0, wrap(step.yaw + yaw)), p_WF)
    return Footstep(foot=step.foot, X_WF=X_WF, plane=plane)


def _refuse_edge(
    plane: PlaneSegment,
    name: str,
    steps: tuple[Footstep, ...],
    sole: Sole,
    params: FootstepPlannerParams,
) -> Refusal | None:
    """Refuses steps whose sole comes nearer to an edge of a landing than the margin.

    The riser behind it is kept off by the stand line.
    """
    room = plane.size / 2.0 - [0.0, params.edge_margin]
    for step in steps:
        corners = plane.X_WR.inverse().multiply(sole_corners(step.X_WF, sole).T)[:2]
        beyond = np.abs(corners) - room[:, None]
        if beyond.max() > 1e-6:
            return Refusal(f"the way to the stand line leads off {name}")
    return None


def _refuse_collision(
    staircase: Staircase,
    feet: Mapping[Foot, RigidTransform],
    steps: tuple[Footstep, ...],
    sole: Sole,
    params: FootstepPlannerParams,
) -> Refusal | None:
    """Refuses steps that carry a sole through a tread's rectangle (less the margin)."""
    now = dict(feet)
    swept = []
    for step in steps:
        both = [sole_corners(X, sole)[:, :2] for X in (now[step.foot], step.X_WF)]
        swept.append(np.vstack(both))
        now[step.foot] = step.X_WF
    hulls = shapely.convex_hull(shapely.multipoints(swept))
    treads = shapely.polygons([t.corners()[:, :2] for t in staircase.treads])
    treads = shapely.buffer(treads, -params.edge_margin, join_style="mitre")
    hit = shapely.intersects(hulls[:, None], treads[None, :]).any(axis=0)
    if hit.any():
        return Refusal(
            f"the way to the stand line leads through tread {int(hit.argmax()) + 1}"
        )
    return None
