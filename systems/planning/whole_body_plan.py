"""The motion of the whole body that follows waist and feet, and its ZMP."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Context

from models.robot import RobotModel
from systems.balance.dynamic_filter import momentum_trajectory, multibody_zmp
from systems.planning.leg_model import LegModel, leg_angles, rotations
from systems.ports import Vector
from systems.values import FEET


@dataclass(frozen=True)
class WholeBody:
    """The robot that plans are made with."""

    plant: MultibodyPlant
    """The robot alone, finalised, floating base first."""
    robot: RobotModel
    leg: LegModel


class BodyMotion(NamedTuple):
    """Positions of every joint along a plan."""

    q: Vector
    """(n, nq)."""
    waist: Vector
    """Origin of the pelvis, (n, 3), m."""
    com: Vector
    """p_WCom, (n, 3), m."""
    angles: Vector
    """Leg joints, left first, (n, 2, 6), rad."""
    short: Vector
    """How far each ankle is out of its leg's reach, (n, 2), m."""


def body_motion(
    body: WholeBody,
    context: Context,
    com: Vector,
    waist_height: Vector,
    waist_rpy: Vector,
    feet: Vector,
    arms: Vector | float,
    guess: Vector | None = None,
    rounds: int = 2,
) -> BodyMotion:
    """The posture of the whole body at every row (IK of the obstacle paper).

    The waist is placed so that the CoM of the whole body is where it is to be: the
    offset between the two is found by repeating legs and CoM.

    Args:
        body: the robot.
        context: scratch context of its plant.
        com: horizontal CoM, (n, 2), m.
        waist_height: of the pelvis, (n,), m.
        waist_rpy: of the pelvis, (n, 3), rad.
        feet: sole poses, (n, 2, 6).
        arms: how far the shoulders pitch to the rear of their posture, (n,) or one for
            all, rad.
        guess: offset of the waist from the CoM, (n, 2), m; None for none.
        rounds: how often the offset is corrected.
    """
    plant, robot = body.plant, body.robot
    n = len(com)
    q = np.zeros((n, plant.num_positions()))
    for name, angle in robot.posture.items():
        q[:, plant.GetJointByName(name).position_start()] = angle
    for name in robot.swing_joints:
        q[:, plant.GetJointByName(name).position_start()] += arms
    q[:, :4] = quaternions(waist_rpy)
    R_WP = rotations(waist_rpy)
    offset = np.zeros((n, 2)) if guess is None else guess
    legs, short = np.zeros((n, 2, 6)), np.zeros((n, 2))
    p_WCom = np.zeros((n, 3))
    waist = np.zeros((n, 3))
    for _ in range(rounds + 1):
        waist = np.column_stack([com + offset, waist_height])
        for i, foot in enumerate(FEET):
            found = leg_angles(body.leg, foot, waist, R_WP, feet[:, i])
            legs[:, i], short[:, i] = found
            for k, name in enumerate(robot.leg_joints[foot]):
                q[:, plant.GetJointByName(name).position_start()] = found.angles[:, k]
        q[:, 4:7] = waist
        for row in range(n):
            plant.SetPositions(context, q[row])
            p_WCom[row] = plant.CalcCenterOfMassPositionInWorld(context)
        offset = waist[:, :2] - p_WCom[:, :2]
    return BodyMotion(q, waist, p_WCom, legs, short)


def waist_over(
    body: WholeBody, context: Context, com: Vector, feet: Vector, rpy: Vector
) -> Vector:
    """Where the pelvis is when the CoM is at rest at `com`, (3,), m.

    Args:
        body: the robot.
        context: scratch context of its plant.
        com: p_WCom, (3,), m.
        feet: sole poses, (2, 6).
        rpy: of the pelvis, (3,), rad.
    """
    height = com[2] - 0.02
    waist = np.zeros(3)
    for _ in range(8):
        found = body_motion(
            body,
            context,
            com[None, :2],
            np.array([height]),
            rpy[None],
            feet[None],
            0.0,
            rounds=2,
        )
        height += com[2] - found.com[0, 2]
        waist = found.waist[0]
    return waist


def waist_above_com(body: WholeBody) -> float:
    """Height of the pelvis above the CoM in the robot's posture, m; mostly negative."""
    plant = body.plant
    context = plant.CreateDefaultContext()
    q: Vector = np.zeros(plant.num_positions())
    q[0] = 1.0
    for name, angle in body.robot.posture.items():
        q[plant.GetJointByName(name).position_start()] = angle
    plant.SetPositions(context, q)
    return -float(plant.CalcCenterOfMassPositionInWorld(context)[2])


def body_zmp(
    body: WholeBody, context: Context, q: Vector, zmp_height: Vector, period: float
) -> Vector:
    """p_MB: the ZMP of a motion of the whole robot (Eq. 20), (n, 2), m.

    Args:
        body: the robot.
        context: scratch context of its plant.
        q: positions, (n, nq).
        zmp_height: height of the ground under the ZMP, (n,), m.
        period: between rows, s.
    """
    plant = body.plant
    rates: Vector = np.asarray(np.gradient(q, period, axis=0))
    v = np.column_stack([spins(q[:, :4], rates[:, :4]), rates[:, 4:]])
    instance = plant.GetBodyByName(body.robot.base_body).model_instance()
    moved = momentum_trajectory(plant, context, instance, q, v)
    return multibody_zmp(moved, zmp_height, period)


def spins(quaternion: Vector, rate: Vector) -> Vector:
    """Angular velocities in W from quaternions (w, x, y, z) and their rates, (n, 3)."""
    w, p = quaternion[:, :1], quaternion[:, 1:]
    w_rate, p_rate = rate[:, :1], rate[:, 1:]
    spin: Vector = w * p_rate - w_rate * p + np.cross(p, p_rate)
    spin *= 2.0 / (quaternion**2).sum(axis=1)[:, None]
    return spin


def quaternions(rpy: Vector) -> Vector:
    """Unit quaternions (w, x, y, z) of roll, pitch, yaw, (n, 3), as (n, 4)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy / 2.0).T, np.sin(rpy / 2.0).T
    return np.column_stack(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )
