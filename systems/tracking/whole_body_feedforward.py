"""Joint torques that a reference motion needs, given the wrenches under the feet."""

from typing import NamedTuple

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import JacobianWrtVariable, MultibodyForces, RigidBody
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.cached import declare_cached
from footfall.systems.plant_cache import declare_scratch_context
from footfall.systems.ports import eval_vector, set_vector
from footfall.systems.timing import timed


def needed_forces(
    plant: MultibodyPlant, context: Context, acceleration: Vector
) -> Vector:
    """Generalised forces of a motion without contacts, M vdot + C v - g, (nv,)."""
    gravity = MultibodyForces(plant)
    plant.CalcForceElementsContribution(context, gravity)
    forces: Vector = plant.CalcInverseDynamics(context, acceleration, gravity)
    return forces


def momentum_rate(plant: MultibodyPlant, context: Context, forces: Vector) -> Vector:
    """Rate of angular momentum about the CoM that a motion needs, in W, (3,), Nm.

    Args:
        plant: the robot alone; its first six velocities are the floating base's spin
            and translation in W.
        context: at the motion's positions and velocities.
        forces: what `needed_forces` gives.
    """
    p_WBase = plant.GetPositions(context)[4:7]
    p_WCom = plant.CalcCenterOfMassPositionInWorld(context)
    x, y, z = (p_WBase - p_WCom).tolist()
    f_x, f_y, f_z = forces[3:6].tolist()
    lever = (y * f_z - z * f_y, z * f_x - x * f_z, x * f_y - y * f_x)
    rate: Vector = forces[:3] + np.array(lever)
    return rate


def foot_torque_matrix(
    plant: MultibodyPlant, context: Context, feet: list[RigidBody], p_BF: Vector
) -> Vector:
    """Generalised forces that foot wrenches exert: J_F^T, (nv, 12).

    Args:
        plant: the robot alone.
        context: at the motion's positions.
        feet: left, then right.
        p_BF: origin of the sole frame in the foot's body, (3,), m.

    Returns:
        The matrix; its columns are force, then moment about F, in W, of the left foot
        and then of the right one.
    """
    world = plant.world_frame()
    columns = []
    for body in feet:
        J = plant.CalcJacobianSpatialVelocity(
            context, JacobianWrtVariable.kV, body.body_frame(), p_BF, world, world
        )
        columns += [J[3:].T, J[:3].T]
    return np.hstack(columns)


class _Dynamics(NamedTuple):
    """What a motion needs at a tick."""

    forces: Vector
    """See `needed_forces`."""
    momentum_rate: Vector
    foot_torques: Vector
    """See `foot_torque_matrix`."""


class WholeBodyFeedforward(LeafSystem):
    """Torques of the reference motion under the wrenches that the stabiliser wants.

    tau = M vdot + C v - g - sum J_F^T w_F, the actuated rows.

    .. pydrake_system::

        name: WholeBodyFeedforward
        input_ports:
        - positions
        - velocities
        - accelerations
        - foot_wrenches
        output_ports:
        - torque
        - momentum_rate
        - leg_torque_map

    - `positions`: q of the reference motion, (nq,).
    - `velocities`: v, (nv,).
    - `accelerations`: vdot, (nv,).
    - `foot_wrenches`: of the ground on the left and the right foot, each force then
      moment about F, in W, (12,), N and Nm.
    - `torque`: in the order of the actuators, within their effort limits, (na,), Nm.
    - `momentum_rate`: rate of angular momentum about the CoM of the reference motion,
      in W, (3,), Nm.
    - `leg_torque_map`: torques of the leg joints without foot wrenches, (12,), Nm,
      then, row by row, the matrix (12, 12) by which foot wrenches lessen them, (156,).
    """

    def __init__(
        self, plant: MultibodyPlant, robot: RobotModel, max_acceleration: float
    ) -> None:
        """Declares the ports.

        Args:
            plant: the robot alone, finalised.
            robot: its names.
            max_acceleration: accelerations are clamped to this, rad/s^2: a tick in
                which the reference velocity jumps is no reason for a torque spike.
        """
        super().__init__()
        self._plant = plant
        self._largest = max_acceleration
        self._feet = [plant.GetBodyByName(robot.foot_bodies[foot]) for foot in FEET]
        self._p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
        actuators = [
            plant.get_joint_actuator(index) for index in plant.GetJointActuatorIndices()
        ]
        self._rows = np.array([item.joint().velocity_start() for item in actuators])
        self._effort = np.array([item.effort_limit() for item in actuators])
        legs = {name for leg in robot.leg_joints.values() for name in leg}
        self._leg_rows = np.array(
            [
                item.joint().velocity_start()
                for item in actuators
                if item.joint().name() in legs
            ]
        )
        nq, nv = plant.num_positions(), plant.num_velocities()
        self._q = self.DeclareVectorInputPort("positions", nq)
        self._v = self.DeclareVectorInputPort("velocities", nv)
        self._vdot = self.DeclareVectorInputPort("accelerations", nv)
        self._wrenches = self.DeclareVectorInputPort("foot_wrenches", 12)
        self._scratch = declare_scratch_context(self, plant)
        motion = {port.ticket() for port in (self._q, self._v, self._vdot)}
        self._dynamics = declare_cached(
            self, "dynamics of the motion", self._calc_dynamics, motion
        )
        self.DeclareVectorOutputPort(
            "torque",
            len(actuators),
            timed(self, self._calc_torque),
            prerequisites_of_calc=motion | {self._wrenches.ticket()},
        )
        self.DeclareVectorOutputPort(
            "momentum_rate",
            3,
            timed(self, self._calc_momentum_rate),
            prerequisites_of_calc=motion,
        )

        self.DeclareVectorOutputPort(
            "leg_torque_map",
            13 * len(self._leg_rows),
            timed(self, self._calc_leg_torque_map),
            prerequisites_of_calc=motion,
        )

    def _calc_dynamics(self, context: Context) -> "_Dynamics":
        scratch = self._scratch(context)
        self._plant.SetPositions(scratch, eval_vector(self._q, context))
        self._plant.SetVelocities(scratch, eval_vector(self._v, context))
        acceleration: Vector = np.minimum(
            np.maximum(eval_vector(self._vdot, context), -self._largest), self._largest
        )
        forces = needed_forces(self._plant, scratch, acceleration)
        return _Dynamics(
            forces,
            momentum_rate(self._plant, scratch, forces),
            foot_torque_matrix(self._plant, scratch, self._feet, self._p_BF),
        )

    def _calc_torque(self, context: Context, output: BasicVector) -> None:
        dynamics = self._dynamics(context)
        wrenches = eval_vector(self._wrenches, context)
        forces = dynamics.forces - dynamics.foot_torques @ wrenches
        torque = np.minimum(forces[self._rows], self._effort)
        set_vector(output, np.maximum(torque, -self._effort))

    def _calc_momentum_rate(self, context: Context, output: BasicVector) -> None:
        set_vector(output, self._dynamics(context).momentum_rate)

    def _calc_leg_torque_map(self, context: Context, output: BasicVector) -> None:
        dynamics, rows = self._dynamics(context), self._leg_rows
        legs = [dynamics.forces[rows], dynamics.foot_torques[rows].ravel()]
        set_vector(output, np.concatenate(legs))
