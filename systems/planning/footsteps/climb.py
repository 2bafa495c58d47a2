"""Footsteps up the treads of an estimated staircase (stair paper, Sec. 6.1)."""

from collections.abc import Mapping
from math import degrees

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import Foot, other_foot
from footfall.models.values.geometry import heading, rotate
from footfall.models.values.perceived import PlaneSegment
from footfall.models.values.planned import Footstep
from footfall.systems.planning.footsteps.foothold import (
    SIDE,
    Refusal,
    foothold_x,
    lateral_interval,
    min_width,
    sole_pose,
    tilt,
    wrap,
)
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.standing import FLOOR, HIDDEN


def staircase_yaw(treads: list[PlaneSegment]) -> float:
    """Mean yaw of the treads, weighted by their rectangles' areas, rad."""
    weights = [float(np.prod(tread.size)) for tread in treads]
    reference = heading(treads[0].X_WR)
    turns = [wrap(heading(tread.X_WR) - reference) for tread in treads]
    return wrap(reference + float(np.average(turns, weights=weights)))


def refuse_unclimbable(
    treads: tuple[PlaneSegment, ...],
    ahead: list[int],
    ground: int,
    z: float,
    yaw: float,
    params: FootstepPlannerParams,
) -> Refusal | None:
    """Refuses treads that no footstep can make good: too high, steep or turned away."""
    below, name = (
        z,
        {FLOOR: "the floor", HIDDEN: "the feet"}.get(ground, f"tread {ground + 1}"),
    )
    for i in ahead:
        tread = treads[i]
        slope = tilt(tread.normal)
        if slope > params.max_slope:
            return Refusal(
                f"tread {i + 1} slopes by {degrees(slope):.1f} deg, more than "
                f"{degrees(params.max_slope):.1f} deg"
            )
        turn = abs(wrap(heading(tread.X_WR) - yaw))
        if turn > params.max_tread_turn:
            return Refusal(
                f"tread {i + 1} is turned by {degrees(turn):.1f} deg from the "
                f"staircase, more than {degrees(params.max_tread_turn):.1f} deg"
            )
        height = float(tread.X_WR.translation()[2])
        rise = height - below
        if rise > params.max_rise:
            return Refusal(
                f"tread {i + 1} rises {rise:.2f} m above {name}, more than the "
                f"{params.max_rise:.2f} m the robot can climb"
            )
        if rise < 0.0:
            return Refusal(f"tread {i + 1} lies {-rise:.2f} m below {name}")
        below, name = height, f"tread {i + 1}"
    return None


def lateral_position(
    treads: tuple[PlaneSegment, ...],
    above: list[int],
    yaw: float,
    y: float,
    sole: Sole,
    params: FootstepPlannerParams,
) -> float | Refusal:
    """The y_S between the feet, nearest to y, at which both fit as many treads as may.

    The paper keeps it constant, so it is chosen for all treads that were seen; those
    that do not agree with the ones before are left to a later scan.
    """
    half = params.stance_width / 2.0
    low, high = -np.inf, np.inf
    for i in above:
        least, largest = lateral_interval(treads[i], yaw, sole, params.side_margin)
        new_low, new_high = max(low, least + half), min(high, largest - half)
        if new_low > new_high:
            if i == above[0]:
                need = params.stance_width + 2.0 * (
                    sole.half_width + params.side_margin
                )
                return Refusal(
                    f"tread {i + 1} is {treads[i].size[1]:.3f} m wide, less than the "
                    f"{need:.3f} m that both feet need"
                )
            break
        low, high = new_low, new_high
    return float(min(max(y, low), high))


def climb_treads(
    treads: tuple[PlaneSegment, ...],
    ahead: list[int],
    feet: Mapping[Foot, RigidTransform],
    lead: Foot,
    yaw: float,
    y: float,
    sole: Sole,
    params: FootstepPlannerParams,
) -> tuple[Footstep, ...] | Refusal:
    """Both feet onto each tread in turn; stops before a later one that does not fit."""
    now = dict(feet)
    steps: list[Footstep] = []
    for i in ahead:
        above = treads[i + 1] if i + 1 < len(treads) else None
        pair: list[Footstep] = []
        for foot in (lead, other_foot(lead)):
            y_foot = y + SIDE[foot] * params.stance_width / 2.0
            x = foothold_x(treads[i], above, yaw, y_foot, y, sole, params)
            if isinstance(x, Refusal):
                refusal: Refusal | None = x
            else:
                p = rotate(yaw, np.array([x, y_foot]))
                X_WF = sole_pose(treads[i], p, yaw, sole, params.flat_tolerance)
                pair.append(Footstep(foot=foot, X_WF=X_WF, plane=i))
                refusal = _refuse_reach(now[other_foot(foot)], pair[-1], sole, params)
                now[foot] = X_WF
            if refusal is not None:
                if steps:
                    return tuple(steps)
                return Refusal(f"tread {i + 1} {refusal.reason}")
        steps += pair
    return tuple(steps)


def _refuse_reach(
    X_WStance: RigidTransform,
    step: Footstep,
    sole: Sole,
    params: FootstepPlannerParams,
) -> Refusal | None:
    """Refuses a step up that is out of reach from the stance foot."""
    yaw = heading(X_WStance)
    p_W, p_WStance = step.X_WF.translation(), X_WStance.translation()
    x, y = rotate(-yaw, np.array([p_W[0] - p_WStance[0], p_W[1] - p_WStance[1]]))
    turn = wrap(heading(step.X_WF) - yaw)
    if x > params.max_climb_length:
        return Refusal(
            f"needs a step of {x:.2f} m from the stance foot, more than "
            f"{params.max_climb_length:.2f} m"
        )
    if x < -params.max_back_step:
        return Refusal(
            f"needs a step back of {-x:.2f} m from the stance foot, more than "
            f"{params.max_back_step:.2f} m"
        )
    if abs(turn) > params.max_turn:
        return Refusal(
            f"is turned by {degrees(abs(turn)):.1f} deg from the stance foot, more "
            f"than {degrees(params.max_turn):.1f} deg"
        )
    width = SIDE[step.foot] * y
    least = min_width(turn, step.foot, sole, params.sole_gap)
    if not least - 1e-9 <= width <= params.max_stance_width + 1e-9:
        return Refusal(
            f"needs the {step.foot} foot {width:.2f} m beside the other one, outside "
            f"{least:.2f} to {params.max_stance_width:.2f} m"
        )
    return None
