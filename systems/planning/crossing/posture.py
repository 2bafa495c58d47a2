"""UBMG and what the waist does besides: height, turn and lean, and the arms' swing.

Third-order polynomials that are given by position and speed at both ends (obstacle
paper, Sec. III-C and III-D).
"""

import numpy as np

from footfall.models.values.feet import FEET
from footfall.models.values.obstacle import KeyConfiguration
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import Repairs
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.crossing.timing import CrossingStep
from footfall.systems.planning.footsteps.foothold import SIDE
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.motion.thigh_clearance import inward_bow


def third_order(u: Vector) -> Vector:
    """Third-order blend from 0 to 1, level at both ends."""
    u = np.clip(u, 0.0, 1.0)
    blend: Vector = u**2 * (3.0 - 2.0 * u)
    return blend


def share_of(step: CrossingStep, time: Vector) -> Vector:
    """Share of a step's single support that has passed, (n,); beyond [0, 1] outside."""
    share: Vector = (time - step.lift) / (step.land - step.lift)
    return share


def straddling(
    time: Vector, steps: tuple[CrossingStep, ...], mode: Mode = "dynamic"
) -> Vector:
    """0 in walking, 1 when phase 3 begins and lowered in it, (n,).

    It is raised in phase 1; in "quasi_static" in phase 2, while both feet carry.
    """
    total = np.zeros(len(time))
    for step in steps:
        if step.obstacle < 0:
            continue
        if not step.leads:
            total -= third_order(share_of(step, time))
            if mode == "quasi_static":
                total += shift_over(step, time)
        elif mode == "dynamic":
            total += third_order(share_of(step, time))
    return total


def shift_over(step: CrossingStep, time: Vector) -> Vector:
    """0 before a step's double support, 1 after it, (n,)."""
    return third_order((time - step.push) / (step.lift - step.push))


def waist_height(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    keys: tuple[KeyConfiguration, ...],
    walking: float,
    ground: float,
    repairs: Repairs,
    crossing: CrossingParams,
) -> Vector:
    """From walking height to Z_hds in phase 1 and back in phase 3, (n,), m.

    Where phase 2 has an end of its own, to Z_end in it.

    Args:
        time: (n,), s.
        steps: of the motion.
        keys: the key configuration over each obstacle.
        walking: height in walking, m.
        ground: height of the floor, m.
        repairs: by which it is raised or lowered.
        crossing: in which share of the phases it changes.
    """
    height = np.full(len(time), walking)
    for step in steps:
        if step.obstacle < 0:
            continue
        key, u = keys[step.obstacle], share_of(step, time)
        low = ground + key.Z_hds - repairs.lowered - walking
        # High while the foot is folded over the obstacle, low while the legs straddle.
        if step.leads:
            height += low * third_order(1.0 + (u - 1.0) / crossing.waist_share)
        else:
            last = low + (0.0 if key.Z_end is None else key.Z_end - key.Z_hds)
            height += (last - low) * shift_over(step, time)
            height -= last * third_order(u / crossing.waist_share)
        if repairs.raised > 0.0:
            middle = np.clip(u, 0.0, 1.0)
            height += repairs.raised * 16.0 * middle**2 * (1.0 - middle) ** 2
    return height


def waist_rpy(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    feet: Vector,
    crossing: CrossingParams,
    mode: Mode = "dynamic",
) -> Vector:
    """Yaw midway between the feet, and what a crossing adds (Sec. III-C3), (n, 3).

    The paper turns the waist in yaw; that it also rolls, to raise the hip of the foot
    that passes the obstacle, is ours: this robot's thigh would else meet its pelvis.

    Args:
        time: (n,), s.
        steps: of the motion.
        feet: sole poses at its start, (2, 6).
        crossing: how far the pelvis leans, turns and rolls.
        mode: see `straddling`.
    """
    yaws = np.tile(feet[:, 5], (len(time), 1))
    for step in steps:
        turn = (step.end[5] - step.start[5] + np.pi) % (2.0 * np.pi) - np.pi
        yaws[:, FEET.index(step.foot)] += turn * third_order(share_of(step, time))
    rpy = np.zeros((len(time), 3))
    rpy[:, 1] = crossing.lean * straddling(time, steps, mode)
    rpy[:, 2] = yaws.mean(axis=1)
    for step in steps:
        if step.obstacle >= 0:
            # Towards the side on which the foot that leads is not: its hip goes ahead.
            leader = step.foot == "right" if step.leads else step.foot == "left"
            blend = third_order(share_of(step, time))
            u = np.clip(share_of(step, time), 0.0, 1.0)
            rpy[:, 0] += SIDE[step.foot] * crossing.waist_roll * inward_bow(u)
            rpy[:, 2] += (
                (1.0 if leader else -1.0)
                * crossing.waist_yaw
                * (blend if step.leads else -blend)
            )
    return rpy


def arm_swing(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    crossing: CrossingParams,
    mode: Mode = "dynamic",
) -> Vector:
    """How far the shoulders pitch to the rear while the robot crosses, (n,), rad.

    Args:
        time: (n,), s.
        steps: of the motion.
        crossing: how far they pitch (Sec. III-D).
        mode: see `straddling`.
    """
    return crossing.arm_swing * straddling(time, steps, mode)
