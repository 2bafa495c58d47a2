"""Velocity-level inverse kinematics of a floating-base robot as one QP.

Objective and constraints are those of the stair paper (Sec. 6.1): CoM, free foot and
posture are tracked, feet on the ground are held, joint speeds and positions stay
within their limits. The pelvis' orientation is tracked besides.
"""

from dataclasses import dataclass

import daqp
import numpy as np
from pydrake.math import RollPitchYaw, RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import JacobianWrtVariable
from pydrake.systems.framework import Context

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector


@dataclass(kw_only=True)
class IkParams(Parameters):
    """Weights and gains of the QP."""

    period: float = number(
        0.005, "s", least=1e-4, most=0.1, shared="parameters.control_period"
    )
    """Between ticks, s."""
    com_weight: float = number(1.0, above=0.0)
    """w_CoM of the horizontal CoM velocity error, s^2/m^2 (stair paper, Sec. 6.1)."""
    height_weight: float = number(0.3, above=0.0)
    """Weight of the CoM's vertical velocity error; lower, so that a leg near its reach
    gives way in height rather than in balance."""
    waist_weight: float = number(0.05, least=0.0)
    """Weight of the pelvis' roll and pitch rates, s^2/rad^2."""
    waist_yaw_weight: float = number(0.01, least=0.0)
    """Weight of the pelvis' yaw rate, s^2/rad^2."""
    free_weight: float = number(0.2, least=0.0)
    """w_free of the free foot's velocity error (stair paper, Sec. 6.1)."""
    posture_weight: float = number(1e-3, least=0.0)
    """w_ref of the posture of the joints above the legs (stair paper, Sec. 6.1)."""
    leg_weight: float = number(1e-6, least=0.0)
    """The same for the legs, which the tasks determine but at singularities."""
    damping: float = number(1e-5, above=0.0)
    """Weight of every velocity; keeps near-straight knees tame."""
    gain: float = number(20.0, "1/s", above=0.0)
    """K: task and limit errors decay with this rate, 1/s."""
    posture_gain: float = number(2.0, "1/s", least=0.0)
    """Rate at which the posture is sought, 1/s."""
    speed_share: float = number(0.9, above=0.0, most=1.0)
    """Share of the joints' speed limits that is used."""
    position_margin: float = number(0.02, "rad", least=0.0)
    """Distance kept from the joints' position limits, rad."""


@dataclass(frozen=True)
class IkTarget:
    """What the whole body is to do now."""

    com: Vector
    """p_WCom, (3,), m."""
    com_velocity: Vector
    """(3,), m/s."""
    foot_poses: Vector
    """X_WF of left and right as (x, y, z, roll, pitch, yaw), (2, 6)."""
    foot_rates: Vector
    """Their rates, (2, 6)."""
    stance: Vector
    """Which feet are held, (2,), above 0.5."""
    waist: Vector
    """Pelvis (roll, pitch, yaw), (3,), rad."""
    waist_rate: Vector
    """Its rate, (3,), rad/s."""
    arms: float = 0.0
    """How far both shoulders pitch to the rear of their posture, rad."""
    arms_rate: float = 0.0
    """Its rate, rad/s."""


def rotation_error(wanted: Vector, R_WB: RotationMatrix) -> Vector:
    """Rotation vector in W that turns B to the wanted roll, pitch, yaw, (3,), rad."""
    R_WD = RollPitchYaw(wanted).ToRotationMatrix()
    turn = R_WD.multiply(R_WB.inverse()).ToAngleAxis()
    error: Vector = turn.angle() * turn.axis()
    return error


class WholeBodyIk:
    """The QP for one robot: what does not change from tick to tick.

    The solver works on a plant that holds the robot alone and on a context of the
    caller's; it keeps no state of its own.
    """

    def __init__(
        self, plant: MultibodyPlant, robot: RobotModel, params: IkParams
    ) -> None:
        """Gathers frames, limits, posture and weights.

        Args:
            plant: the robot alone, finalised, floating base first.
            robot: its names.
            params: weights.

        Raises:
            ValueError: a parameter is out of range.
        """
        params.validate()
        self._plant, self._params = plant, params
        self._feet = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
        self._pelvis = plant.GetBodyByName(robot.base_body)
        self._p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
        nv = plant.num_velocities()
        self._lower = plant.GetPositionLowerLimits()[7:] + params.position_margin
        self._upper = plant.GetPositionUpperLimits()[7:] - params.position_margin
        for name, (least, most) in robot.working_range.items():
            row = plant.GetJointByName(name).position_start() - 7
            self._lower[row] = max(self._lower[row], least)
            self._upper[row] = min(self._upper[row], most)
        self._speed = params.speed_share * plant.GetVelocityUpperLimits()[6:]
        self._posture_weight = np.full(nv, params.posture_weight)
        self._posture_weight[:6] = 0.0
        for leg in robot.leg_joints.values():
            for name in leg:
                index = plant.GetJointByName(name).velocity_start()
                self._posture_weight[index] = params.leg_weight
        self.posture = default_posture(plant, robot)
        swing = [plant.GetJointByName(name) for name in robot.swing_joints]
        self._swing = np.array([joint.velocity_start() for joint in swing], dtype=int)

    def solve(self, context: Context, target: IkTarget) -> tuple[Vector, bool]:
        """Solves for the generalised velocity of this tick.

        Args:
            context: of the plant, with the present reference positions.
            target: what is to be tracked.

        Returns:
            v, (nv,), and whether the feet could be held exactly; where they could not,
            their error is minimised with a high weight.
        """
        plant, params, gain = self._plant, self._params, self._params.gain
        world = plant.world_frame()
        kv = JacobianWrtVariable.kV
        q = plant.GetPositions(context)
        J_com = plant.CalcJacobianCenterOfMassTranslationalVelocity(
            context, kv, world, world
        )
        p_WCom = plant.CalcCenterOfMassPositionInWorld(context)
        origin: Vector = np.zeros(3)
        J_waist = plant.CalcJacobianSpatialVelocity(
            context, kv, self._pelvis.body_frame(), origin, world, world
        )[:3]
        R_WP = self._pelvis.EvalPoseInWorld(context).rotation()
        v_com = target.com_velocity + gain * (target.com - p_WCom)
        w_waist = spin_of(target.waist, target.waist_rate)
        w_waist = w_waist + 0.5 * gain * rotation_error(target.waist, R_WP)
        J_feet, v_feet = self._foot_tasks(context, target)
        nv = len(self._posture_weight)
        hessian = np.diag(self._posture_weight + params.damping)
        gradient = np.zeros(nv)
        sought = params.posture_gain * (self.posture[7:] - q[7:])
        sought[self._swing - 6] += target.arms_rate + params.posture_gain * target.arms
        gradient[6:] = -self._posture_weight[6:] * sought
        for J, v, weight in (
            (J_com, v_com, [params.com_weight] * 2 + [params.height_weight]),
            (
                J_waist,
                w_waist,
                [params.waist_weight] * 2 + [params.waist_yaw_weight],
            ),
        ):
            weighted = J.T * np.array(weight)
            hessian += weighted @ J
            gradient -= weighted @ v
        upper, lower = np.full(nv, 1e3), np.full(nv, -1e3)
        upper[6:] = np.minimum(self._speed, gain * (self._upper - q[7:]))
        lower[6:] = np.maximum(-self._speed, gain * (self._lower - q[7:]))
        # A joint beyond a limit may not be asked to return faster than it can.
        upper[6:] = np.maximum(upper[6:], -self._speed)
        lower[6:] = np.minimum(lower[6:], upper[6:])
        held = np.repeat(target.stance > 0.5, 6)
        free = ~held
        weighted = params.free_weight * J_feet[free].T
        hessian += weighted @ J_feet[free]
        gradient -= weighted @ v_feet[free]
        v, solved = _solve_qp(
            hessian, gradient, upper, lower, J_feet[held], v_feet[held]
        )
        if solved:
            return v, True
        weighted = 10.0 * params.com_weight * J_feet[held].T
        hessian += weighted @ J_feet[held]
        gradient -= weighted @ v_feet[held]
        v, solved = _solve_qp(hessian, gradient, upper, lower, J_feet[:0], v_feet[:0])
        if not solved:
            raise RuntimeError("the IK's QP has no solution within the joint limits")
        return v, False

    def _foot_tasks(self, context: Context, target: IkTarget) -> tuple[Vector, Vector]:
        """Jacobians of both soles, (12, nv), and the velocities wanted, (12,)."""
        plant, gain = self._plant, self._params.gain
        world = plant.world_frame()
        jacobians, velocities = [], []
        for body, pose, rate in zip(
            self._feet, target.foot_poses, target.foot_rates, strict=True
        ):
            jacobians.append(
                plant.CalcJacobianSpatialVelocity(
                    context,
                    JacobianWrtVariable.kV,
                    body.body_frame(),
                    self._p_BF,
                    world,
                    world,
                )
            )
            X_WB = body.EvalPoseInWorld(context)
            velocities += [
                spin_of(pose[3:], rate[3:])
                + gain * rotation_error(pose[3:], X_WB.rotation()),
                rate[:3] + gain * (pose[:3] - X_WB.multiply(self._p_BF)),
            ]
        return np.vstack(jacobians), np.concatenate(velocities)


def spin_of(rpy: Vector, rate: Vector) -> Vector:
    """Angular velocity in W of a frame at roll, pitch, yaw with these rates, (3,)."""
    spin: Vector = RollPitchYaw(rpy).CalcAngularVelocityInParentFromRpyDt(rate)
    return spin


def default_posture(plant: MultibodyPlant, robot: RobotModel) -> Vector:
    """Positions with the robot's posture and the base upright at the origin, (nq,)."""
    q: Vector = np.zeros(plant.num_positions())
    q[0] = 1.0
    for name, angle in robot.posture.items():
        q[plant.GetJointByName(name).position_start()] = angle
    return q


def integrate(
    plant: MultibodyPlant, context: Context, v: Vector, period: float
) -> Vector:
    """Positions after moving with v for a period, unit quaternion, (nq,)."""
    q = plant.GetPositions(context)
    rate: Vector = np.asarray(plant.MapVelocityToQDot(context, v))
    after: Vector = q + period * rate
    after[:4] /= np.linalg.norm(after[:4])
    return after


def solve_posture(
    ik: WholeBodyIk,
    plant: MultibodyPlant,
    target: IkTarget,
    period: float = 0.02,
    ticks: int = 400,
) -> Vector:
    """Positions at which the robot rests on a target, from its default posture.

    Args:
        ik: the QP.
        plant: the robot alone.
        target: with zero velocities.
        period: of a tick, s.
        ticks: how many.

    Returns:
        Positions, (nq,).
    """
    context = plant.CreateDefaultContext()
    q = ik.posture.copy()
    q[4:7] = target.com
    for _ in range(ticks):
        plant.SetPositions(context, q)
        v, _ = ik.solve(context, target)
        q = integrate(plant, context, v, period)
    return q


def _solve_qp(
    hessian: Vector,
    gradient: Vector,
    upper: Vector,
    lower: Vector,
    A: Vector,
    b: Vector,
) -> tuple[Vector, bool]:
    """Minimises within bounds, with A x = b."""
    sense = np.zeros(len(upper) + len(b), dtype=np.int32)
    sense[len(upper) :] = 5  # equality, in DAQP's code
    x, _, status, _ = daqp.solve(
        hessian,
        gradient,
        np.ascontiguousarray(A),
        np.concatenate([upper, b]),
        np.concatenate([lower, b]),
        sense,
    )
    return np.asarray(x, dtype=np.float64), status >= 1
