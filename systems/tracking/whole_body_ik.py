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

_EQUALITY = 5
"""Of a constraint, in DAQP's code."""
_ORIGIN: Vector = np.zeros(3)


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
        posture = np.full(nv, params.posture_weight)
        posture[:6] = 0.0
        for leg in robot.leg_joints.values():
            for name in leg:
                posture[plant.GetJointByName(name).velocity_start()] = params.leg_weight
        self._posture_weight = posture[6:]
        self._base_hessian = np.diag(posture + params.damping)
        free = [params.free_weight] * 6
        self._soft_weights = np.array(
            [
                *([params.com_weight] * 2 + [params.height_weight]),
                *([params.waist_weight] * 2 + [params.waist_yaw_weight]),
                *(free * 2),
            ]
        )[:, None]
        self._senses = [
            np.array([0] * nv + [_EQUALITY] * rows, dtype=np.int32)
            for rows in (0, 6, 12)
        ]
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
        q = plant.GetPositions(context)
        joints = q[7:]
        feet = [row for row in (0, 1) if target.stance[row] <= 0.5]
        held = [row for row in (0, 1) if target.stance[row] > 0.5]
        # Rows of what is minimised: CoM, waist, free feet; below them the held feet.
        J, v = self._tasks(context, target, [*feet, *held])
        soft = 6 + 6 * len(feet)
        weighted = J[:soft] * self._soft_weights[:soft]
        hessian = self._base_hessian + weighted.T @ J[:soft]
        gradient = -(v[:soft] @ weighted)
        sought = params.posture_gain * (self.posture[7:] - joints)
        sought[self._swing - 6] += target.arms_rate + params.posture_gain * target.arms
        gradient[6:] -= self._posture_weight * sought
        nv, rows = len(gradient), len(v) - soft
        upper, lower = np.empty(nv + rows), np.empty(nv + rows)
        upper[:6], lower[:6] = 1e3, -1e3
        most, least = upper[6:nv], lower[6:nv]
        np.minimum(self._speed, gain * (self._upper - joints), out=most)
        np.maximum(-self._speed, gain * (self._lower - joints), out=least)
        # A joint beyond a limit may not be asked to return faster than it can.
        np.maximum(most, -self._speed, out=most)
        np.minimum(least, most, out=least)
        upper[nv:] = lower[nv:] = v[soft:]
        A = J[soft:]
        found, solved = self._solve_qp(hessian, gradient, A, upper, lower)
        if solved:
            return found, True
        weighted = 10.0 * params.com_weight * A
        hessian += weighted.T @ A
        gradient -= v[soft:] @ weighted
        found, solved = self._solve_qp(hessian, gradient, A[:0], upper[:nv], lower[:nv])
        if not solved:
            raise RuntimeError("the IK's QP has no solution within the joint limits")
        return found, False

    def _solve_qp(
        self, hessian: Vector, gradient: Vector, A: Vector, upper: Vector, lower: Vector
    ) -> tuple[Vector, bool]:
        """Minimises within bounds, the first of them of x, those after of A x."""
        sense = self._senses[len(A) // 6].copy()
        x, _, status, _ = daqp.solve(hessian, gradient, A, upper, lower, sense)
        return np.asarray(x, dtype=np.float64), status >= 1

    def _tasks(
        self, context: Context, target: IkTarget, feet: list[int]
    ) -> tuple[Vector, Vector]:
        """Computes Jacobians and wanted velocities of CoM, waist and feet in turn.

        Args:
            context: of the plant.
            target: what is to be tracked.
            feet: 0 for the left, 1 for the right, in the order of their rows.

        Returns:
            J, (18, nv), and the velocities, (18,).
        """
        plant, gain = self._plant, self._params.gain
        world, kv = plant.world_frame(), JacobianWrtVariable.kV
        J, v = np.empty((18, plant.num_velocities())), np.empty(18)
        J[:3] = plant.CalcJacobianCenterOfMassTranslationalVelocity(
            context, kv, world, world
        )
        p_WCom = plant.CalcCenterOfMassPositionInWorld(context)
        v[:3] = target.com_velocity + gain * (target.com - p_WCom)
        J[3:6] = plant.CalcJacobianSpatialVelocity(
            context, kv, self._pelvis.body_frame(), _ORIGIN, world, world
        )[:3]
        R_WP = self._pelvis.EvalPoseInWorld(context).rotation()
        error = rotation_error(target.waist, R_WP)
        v[3:6] = spin_of(target.waist, target.waist_rate) + 0.5 * gain * error
        for row, i in zip((6, 12), feet, strict=True):
            body, pose, rate = self._feet[i], target.foot_poses[i], target.foot_rates[i]
            J[row : row + 6] = plant.CalcJacobianSpatialVelocity(
                context, kv, body.body_frame(), self._p_BF, world, world
            )
            X_WB = body.EvalPoseInWorld(context)
            turn = rotation_error(pose[3:], X_WB.rotation())
            v[row : row + 3] = spin_of(pose[3:], rate[3:]) + gain * turn
            v[row + 3 : row + 6] = rate[:3] + gain * (
                pose[:3] - X_WB.multiply(self._p_BF)
            )
        return J, v


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
