"""UBMG and what the waist does besides: height, turn and lean, and the arms' swing.

Third-order polynomials that are given by position and speed at both ends (obstacle
paper, Sec. III-C and III-D).
"""

import numpy as np

from models.robot import RobotModel
from systems.obstacle_values import KeyConfiguration
from systems.planning.crossing_params import CrossingParams
from systems.planning.crossing_timing import CrossingStep
from systems.planning.feet_adaptor import Repairs
from systems.ports import Vector
from systems.values import FEET


def third_order(u: Vector) -> Vector:
    """Third-order blend from 0 to 1, level at both ends."""
    u = np.clip(u, 0.0, 1.0)
    blend: Vector = u**2 * (3.0 - 2.0 * u)
    return blend


def share_of(step: CrossingStep, time: Vector) -> Vector:
    """Share of a step's single support that has passed, (n,); beyond [0, 1] outside."""
    share: Vector = (time - step.lift) / (step.land - step.lift)
    return share


def straddling(time: Vector, steps: tuple[CrossingStep, ...]) -> Vector:
    """0 in walking, 1 in phase 2: raised in phase 1, lowered in phase 3, (n,)."""
    total = np.zeros(len(time))
    for step in steps:
        if step.obstacle >= 0:
            blend = third_order(share_of(step, time))
            total += blend if step.leads else -blend
    return total


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
        low = ground + keys[step.obstacle].Z_hds - repairs.lowered - walking
        u = share_of(step, time)
        # High while the foot is folded over the obstacle, low while the legs straddle.
        down = third_order(1.0 + (u - 1.0) / crossing.waist_share)
        height += low * (down if step.leads else -third_order(u / crossing.waist_share))
        if repairs.raised > 0.0:
            middle = np.clip(u, 0.0, 1.0)
            height += repairs.raised * 16.0 * middle**2 * (1.0 - middle) ** 2
    return height


def waist_rpy(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    feet: Vector,
    crossing: CrossingParams,
) -> Vector:
    """Yaw midway between the feet, and what a crossing adds (Sec. III-C3), (n, 3).

    Args:
        time: (n,), s.
        steps: of the motion.
        feet: sole poses at its start, (2, 6).
        crossing: how far the pelvis leans and turns.
    """
    yaws = np.tile(feet[:, 5], (len(time), 1))
    for step in steps:
        turn = (step.end[5] - step.start[5] + np.pi) % (2.0 * np.pi) - np.pi
        yaws[:, FEET.index(step.foot)] += turn * third_order(share_of(step, time))
    rpy = np.zeros((len(time), 3))
    rpy[:, 1] = crossing.lean * straddling(time, steps)
    rpy[:, 2] = yaws.mean(axis=1)
    for step in steps:
        if step.obstacle >= 0:
            # Towards the side on which the foot that leads is not: its hip goes ahead.
            leader = step.foot == "right" if step.leads else step.foot == "left"
            blend = third_order(share_of(step, time))
            rpy[:, 2] += (
                (1.0 if leader else -1.0)
                * crossing.waist_yaw
                * (blend if step.leads else -blend)
            )
    return rpy


def arm_swing(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    robot: RobotModel,
    crossing: CrossingParams,
) -> dict[str, Vector]:
    """Shoulders that pitch back while the first foot crosses (Sec. III-D), (n,) each.

    Args:
        time: (n,), s.
        steps: of the motion.
        robot: its posture.
        crossing: how far they pitch.
    """
    if crossing.arm_swing == 0.0:
        return {}
    shape = straddling(time, steps)
    return {
        name: robot.posture[name] + crossing.arm_swing * shape
        for name in robot.posture
        if name.endswith("SHOULDER_P")
    }
