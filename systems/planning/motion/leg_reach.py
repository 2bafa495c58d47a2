"""How low the CoM has to be so that no knee of a motion is stretched.

A knee that comes near its limit, as that of the rear leg does before it is lifted,
turns faster and faster over the last millimetres of the leg's length and stops at once.
No body follows that: the whole body's ZMP would jump by decimetres. So a motion is
planned low enough that the knees stay bent.
"""

import numpy as np

from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.step_timing import TimedStep
from footfall.systems.planning.whole_body.leg_model import rotations
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    body_motion,
    waist_above_com,
)


def height_excess(
    body: WholeBody, com: Vector, waist: Vector, feet: Vector, margin: float
) -> Vector:
    """How far the pelvis is higher than the legs reach with bent knees, (n,), m.

    Args:
        body: the robot.
        com: p_WCom, (n, 3), m.
        waist: orientation of the pelvis, roll, pitch, yaw, (n, 3), rad.
        feet: sole poses, (n, 2, 6).
        margin: how much more than their limit the knees are to be bent, rad.

    Returns:
        Zero where both knees are bent enough, and where a foot is too far for any
        height.
    """
    leg = body.leg
    pelvis = body_motion(
        body, com[:, :2], com[:, 2] + waist_above_com(body), waist, feet, 0.0
    ).waist
    R_WP = rotations(waist)
    excess = np.zeros(len(com))
    for i, foot in enumerate(FEET):
        R_WF = rotations(feet[:, i, 3:])
        p_WA = feet[:, i, :3] + leg.sole.ankle_height * R_WF[:, :, 2]
        p_AH = pelvis + R_WP @ leg.hips[foot] - p_WA
        reach = leg.hip_to_ankle(float(leg.lower[i, 3]) + margin)
        beside = (p_AH[:, :2] ** 2).sum(axis=1)
        highest = np.sqrt(np.maximum(reach**2 - beside, 0.0))
        above = np.where(highest > 0.0, p_AH[:, 2] - highest, 0.0)
        excess = np.maximum(excess, above)
    return excess


def step_drops(
    time: Vector, excess: Vector, steps: tuple[TimedStep, ...]
) -> tuple[float, ...]:
    """How much lower the CoM goes for each step, m, as much as it or the next one asks.

    Args:
        time: of every row, (n,), s.
        excess: what `height_excess` gives, (n,), m.
        steps: in their order; each counts since the one before has landed.
    """
    starts = np.searchsorted(time, [0.0, *(step.land for step in steps[:-1])])
    own = np.maximum.reduceat(excess, starts)
    return tuple(np.maximum(own, np.append(own[1:], 0.0)).tolist())
