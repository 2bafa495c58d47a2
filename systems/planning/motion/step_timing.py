"""What every walk shares: footsteps in time, contact phases and where the ZMP rests."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from footfall.models.values.feet import FEET, Foot, other_foot
from footfall.models.values.planned import ContactPhase, Footstep
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.swing_trajectory import quintic
from footfall.systems.planning.motion.toe_off import heading

FREE = 1e-6
"""Weight of the ZMP's error at the very ends of a motion, of that between."""


@dataclass(frozen=True)
class Transfer:
    """One footstep: which foot goes from where to where."""

    foot: Foot
    start: Vector
    """Sole pose it leaves, (6,)."""
    end: Vector
    """Sole pose it takes, (6,)."""
    stance: Vector
    """Sole pose of the other foot meanwhile, (6,)."""


@dataclass(frozen=True)
class TimedStep(Transfer):
    """One footstep in time."""

    push: float
    """When the double support before it begins, s."""
    lift: float
    """When the foot leaves the ground, s."""
    land: float
    """When it is back, s."""


def transfers(feet: Vector, footsteps: tuple[Footstep, ...]) -> tuple[Transfer, ...]:
    """Which foot goes from where to where.

    Args:
        feet: sole poses at the start, (2, 6), left first.
        footsteps: where they go, in order.
    """
    poses = dict(zip(FEET, feet, strict=True))
    found = []
    for step in footsteps:
        rpy = step.X_WF.rotation().ToRollPitchYaw().vector()
        end: Vector = np.concatenate([step.X_WF.translation(), rpy])
        stance = poses[other_foot(step.foot)]
        found.append(Transfer(step.foot, poses[step.foot], end, stance))
        poses[step.foot] = end
    return tuple(found)


def step_times(
    before: Sequence[float], single: Sequence[float]
) -> tuple[tuple[float, float, float], ...]:
    """When each step's double support begins, its foot lifts and lands, s.

    Args:
        before: duration of the double support before each step, s.
        single: duration of each single support, s.
    """
    found = []
    push = 0.0
    for wait, duration in zip(before, single, strict=True):
        lift = push + wait
        found.append((push, lift, lift + duration))
        push = lift + duration
    return tuple(found)


def final_feet(feet: Vector, steps: Sequence[Transfer]) -> Vector:
    """Where both feet are after the last step, (2, 6)."""
    last = {step.foot: step.end for step in steps}
    return np.array([last.get(foot, feet[i]) for i, foot in enumerate(FEET)])


def contact_phases(steps: Sequence[TimedStep], end: float) -> tuple[ContactPhase, ...]:
    """The contact phases of a whole motion that ends at `end`, s."""
    phases = []
    for step in steps:
        phases.append(ContactPhase(step.push, step.lift, FEET, None))
        phases.append(
            ContactPhase(step.lift, step.land, (other_foot(step.foot),), step.foot)
        )
    phases.append(ContactPhase(steps[-1].land if steps else 0.0, end, FEET, None))
    return tuple(phases)


def stance_zmp(
    pose: Vector, foot: Foot, forward: float, params: MotionPlannerParams
) -> Vector:
    """Where the ZMP is to be while the robot stands on one foot, p_WZmp, (3,)."""
    left: Vector = heading(pose[5] + np.pi / 2.0)
    inward = -left if foot == "left" else left
    p_WZmp = pose[:3].copy()
    p_WZmp[:2] += forward * heading(pose[5]) + params.zmp_inward * inward
    return p_WZmp


def middle_zmp(feet: Vector, params: MotionPlannerParams) -> Vector:
    """Where the ZMP is to be while the robot stands on both feet, p_WZmp, (3,)."""
    both = [
        stance_zmp(feet[i], foot, params.zmp_forward, params)
        for i, foot in enumerate(FEET)
    ]
    middle: Vector = np.mean(both, axis=0)
    return middle


def zmp_weight(time: Vector, end: float, params: MotionPlannerParams) -> Vector:
    """How much the ZMP is to keep to its reference: little at both ends of a motion.

    A CoM at rest sets off towards one foot by a push of the other, and comes to rest
    likewise. A ZMP that is held to its reference meanwhile jumps by 3 cm in 20 ms; with
    the weight growing by a constant rate over the lead-in, where both feet are down
    and leave it room, it swings by about as much in half a second.

    Args:
        time: (n,), s.
        end: of the motion, s.
        params: lead-in and lead-out.

    Returns:
        (n,), from `FREE` at either end to 1.
    """
    before = np.maximum(0.0, 1.0 - time / params.lead_in)
    after = np.maximum(0.0, 1.0 - (end - time) / params.lead_out)
    weight: Vector = FREE ** (before + after)
    return weight


def along_keys(
    time: Vector, keys: Sequence[tuple[float, Vector]], eased: bool = False
) -> Vector:
    """Points at given times on the straight lines between keys.

    Args:
        time: (n,), s.
        keys: when, s, and where, (3,), m; in order.
        eased: at rest at every key, with a quintic between; else at constant speed.

    Returns:
        (n, 3), m; before the first key the first point, after the last the last.
    """
    times = np.array([when for when, _ in keys])
    points = np.array([point for _, point in keys])
    if not eased:
        return np.column_stack([np.interp(time, times, column) for column in points.T])
    place = np.interp(time, times, np.arange(len(keys), dtype=np.float64))
    before = np.minimum(place.astype(np.intp), len(keys) - 2)
    u = quintic(place - before)[:, None]
    eased_points: Vector = points[before] + u * (points[before + 1] - points[before])
    return eased_points
