"""The motion of the whole body that follows waist and feet, and its ZMP."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import body_meshes
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.balance.dynamic_filter import multibody_zmp
from footfall.systems.planning.whole_body.leg_model import (
    LegModel,
    both_leg_angles,
    leg_model,
    leg_outline,
    rotations,
)
from footfall.systems.planning.whole_body.link_tree import (
    LinkTree,
    com_in_base,
    link_tree,
    momentum,
)


@dataclass(frozen=True)
class WholeBody:
    """The robot that plans are made with."""

    plant: MultibodyPlant
    """The robot alone, finalised, floating base first."""
    robot: RobotModel
    leg: LegModel

    @cached_property
    def meter(self) -> SelfDistanceMeter:
        """Of the robot's own collision geometry."""
        return SelfDistanceMeter(self.robot)

    @cached_property
    def tree(self) -> LinkTree:
        """The robot with joints of left leg, right leg and swinging arms, in order."""
        robot = self.robot
        legs = [name for foot in FEET for name in robot.leg_joints[foot]]
        moving = [*legs, *robot.swing_joints]
        return link_tree(self.plant, robot.base_body, moving, robot.posture)


def planning_body(robot: RobotModel, model: MultibodyPlant) -> WholeBody:
    """The robot that plans are made with: its plant and its legs' lengths and outline.

    Args:
        robot: its names.
        model: the plant of the robot alone.
    """
    surfaces = {mesh.body: mesh.vertices for mesh in body_meshes(robot)}
    foot = robot.foot_bodies["left"]
    knee = model.GetJointByName(robot.knee_joints["left"])
    outline = leg_outline(surfaces[foot], surfaces[knee.child_body().name()])
    return WholeBody(model, robot, leg_model(model, robot, outline))


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
        com: horizontal CoM, (n, 2), m.
        waist_height: of the pelvis, (n,), m.
        waist_rpy: of the pelvis, (n, 3), rad.
        feet: sole poses, (n, 2, 6).
        arms: how far the shoulders pitch to the rear of their posture, (n,) or one for
            all, rad.
        guess: offset of the waist from the CoM, (n, 2), m; None for none.
        rounds: how often the offset is corrected.
    """
    tree, n = body.tree, len(com)
    angles = np.tile(tree.posture[tree.columns], (n, 1))
    angles[:, 2 * 6 :] += np.broadcast_to(arms, n)[:, None]
    R_WP = rotations(waist_rpy)
    offset = np.zeros((n, 2)) if guess is None else guess
    for _ in range(rounds + 1):
        waist = np.column_stack([com + offset, waist_height])
        legs, short = both_leg_angles(body.leg, waist, R_WP, feet)
        angles[:, : 2 * 6] = legs.reshape(n, -1)
        p_WCom = waist + np.einsum("nij,nj->ni", R_WP, com_in_base(tree, angles))
        offset = waist[:, :2] - p_WCom[:, :2]
    q = np.tile(tree.posture, (n, 1))
    q[:, :4], q[:, 4:7] = quaternions(waist_rpy), waist
    q[:, tree.columns] = angles
    return BodyMotion(q, waist, p_WCom, legs, short)


def waist_over(body: WholeBody, com: Vector, feet: Vector, rpy: Vector) -> Vector:
    """Where the pelvis is when the CoM is at rest at `com`, (3,), m.

    Args:
        body: the robot.
        com: p_WCom, (3,), m.
        feet: sole poses, (2, 6).
        rpy: of the pelvis, (3,), rad.
    """
    height = com[2] - 0.02
    waist = np.zeros(3)
    for _ in range(8):
        found = body_motion(
            body,
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
    tree = body.tree
    return -float(com_in_base(tree, tree.posture[None, tree.columns])[0, 2])


def body_zmp(body: WholeBody, q: Vector, zmp_height: Vector, period: float) -> Vector:
    """Computes p_MB, the ZMP of a motion of the whole robot (Eq. 20), (n, 2), m.

    p_x = (m g c_x + p_z P'_x - L'_y) / (m g + P'_z), p_y likewise with + L'_x.

    Args:
        body: the robot.
        q: positions, (n, nq).
        zmp_height: height of the ground under the ZMP, (n,), m.
        period: between rows, s.
    """
    rates: Vector = np.asarray(np.gradient(q, period, axis=0))
    v = np.column_stack([spins(q[:, :4], rates[:, :4]), rates[:, 4:]])
    return multibody_zmp(momentum(body.tree, q, v), zmp_height, period)


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
