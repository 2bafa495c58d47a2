"""When the feet of a crossing move and where its ZMP rests."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter1d

from footfall.models.values.feet import other_foot
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.motion.step_timing import (
    TimedStep,
    along_keys,
    final_feet,
    middle_zmp,
    stance_zmp,
    step_times,
    transfers,
)


@dataclass(frozen=True)
class CrossingStep(TimedStep):
    """One footstep of a walk over obstacles in time."""

    obstacle: int
    """Index of the obstacle it crosses, -1 for none."""
    leads: bool
    """Whether it is the first foot over that obstacle: phase 1, else phase 3."""


def time_steps(
    feet: Vector,
    footsteps: tuple[Footstep, ...],
    walking: MotionPlannerParams,
    crossing: CrossingParams,
) -> tuple[tuple[CrossingStep, ...], float]:
    """Lays footsteps out in time; those with a plane cross the obstacle of that index.

    Args:
        feet: sole poses at the start, (2, 6), left first.
        footsteps: where they go, in order.
        walking: durations on free ground.
        crossing: durations over an obstacle.

    Returns:
        The steps and when the motion ends, s.
    """
    if not footsteps:
        return (), walking.lead_in
    planes = [step.plane for step in footsteps]
    leads = [p >= 0 and p not in planes[:k] for k, p in enumerate(planes)]
    before = [walking.lead_in]
    for k in range(1, len(planes)):
        near = leads[k] or planes[k - 1] >= 0
        before.append(crossing.double_support if near else walking.double_support)
    single = [
        crossing.single_support if p >= 0 else walking.single_support for p in planes
    ]
    steps = tuple(
        CrossingStep(m.foot, m.start, m.end, m.stance, *when, plane, first)
        for m, when, plane, first in zip(
            transfers(feet, footsteps),
            step_times(before, single),
            planes,
            leads,
            strict=True,
        )
    )
    return steps, steps[-1].land + walking.lead_out


def zmp_reference(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    feet: Vector,
    com: Vector,
    end: float,
    walking: MotionPlannerParams,
    crossing: CrossingParams,
    mode: Mode = "dynamic",
) -> Vector:
    """ZMP_des(t): rests on the stance foot, moves over in double support, (n, 3), m.

    Where it sets off and arrives its corners are rounded over `crossing.zmp_rounding`.

    Args:
        time: (n,), s.
        steps: of the motion.
        feet: sole poses at its start, (2, 6).
        com: p_WCom there, (3,), m.
        end: of the motion, s.
        walking: where it rests on free ground.
        crossing: where it rests in phases 1 and 3.
        mode: in "quasi_static" it goes gently and is there before a foot lifts, for
            the CoM is to go with it.
    """
    rest = crossing.quasi_static.rest if mode == "quasi_static" else 0.0
    first = middle_zmp(feet, walking)
    first[:2] = com[:2]
    keys = [(0.0, first), (0.3 * walking.lead_in, first)]
    for step in steps:
        stance = other_foot(step.foot)
        ahead = crossing.zmp_forward if step.obstacle >= 0 else walking.zmp_forward
        over = step.lift - rest
        keys.append((over, stance_zmp(step.stance, stance, ahead, walking)))
        ahead += crossing.zmp_rolling if step.leads else 0.0
        keys.append((step.land, stance_zmp(step.stance, stance, ahead, walking)))
    final = middle_zmp(final_feet(feet, steps), walking)
    keys.append((end - 0.4 * walking.lead_out, final))
    if mode == "quasi_static":
        return along_keys(time, keys, eased=True)
    # No body follows a corner: the mean over a short window takes it off.
    window = max(1, round(crossing.zmp_rounding / walking.period))
    sharp = along_keys(time, keys)
    return np.asarray(uniform_filter1d(sharp, window, axis=0, mode="nearest"))
