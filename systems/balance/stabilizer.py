"""Balance feedback: from the error of the DCM to wrenches under the feet."""

from dataclasses import dataclass, field

import numpy as np
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.robots.robot import Sole
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.balance.wrench_distribution import (
    DistributionParams,
    TorqueMap,
    distribute_wrench,
)
from footfall.systems.balance.zmp_preview import GRAVITY
from footfall.systems.cached import declare_cached
from footfall.systems.ports import eval_vector, set_vector
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class StabilizerParams(Parameters):
    """Gains of the feedback."""

    dcm_gain: float = number(1.0, least=0.0)
    """k: the ZMP answers a DCM error e with (1 + k) e, so that it decays as
    exp(-k omega t); 3 falls (the feet have no such reach)."""
    height_stiffness: float = number(100.0, "1/s^2", least=0.0)
    """Acceleration per height error of the CoM, 1/s^2."""
    height_damping: float = number(20.0, "1/s", least=0.0)
    """Acceleration per vertical velocity error of the CoM, 1/s."""
    distribution: DistributionParams = field(default_factory=DistributionParams)
    """How the wrench that the feedback wants is shared between the feet."""


@dataclass(frozen=True)
class BalanceCommand:
    """What the feedback wants."""

    com_acceleration: Vector
    """(3,), m/s^2."""
    dcm: Vector
    """Measured, horizontal, (2,), m."""
    dcm_reference: Vector
    """(2,), m."""
    zmp: Vector
    """Commanded, horizontal, (2,), m."""


def dcm_feedback(
    com: Vector,
    com_velocity: Vector,
    reference: Vector,
    velocity_reference: Vector,
    acceleration_reference: Vector,
    zmp_height: float,
    params: StabilizerParams,
) -> BalanceCommand:
    """CoM acceleration that brings the divergent component of motion back.

    With omega^2 = (g + zdd) / (z - z_zmp) and xi = c + cdot / omega, the linearised
    pendulum's error obeys edot = omega (e - dp); the ZMP correction
    dp = (1 + k) e makes it decay as exp(-k omega t).

    Args:
        com: measured p_WCom, (3,), m.
        com_velocity: measured, (3,), m/s.
        reference: p_WCom wanted, (3,), m.
        velocity_reference: (3,), m/s.
        acceleration_reference: (3,), m/s^2.
        zmp_height: height of the ground under the ZMP, m.
        params: gains.

    Returns:
        The command.
    """
    height = max(reference[2] - zmp_height, 0.1)
    lift = max(GRAVITY + acceleration_reference[2], 0.1 * GRAVITY)
    omega = np.sqrt(lift / height)
    error = com - reference
    rate = com_velocity - velocity_reference
    dcm = com[:2] + com_velocity[:2] / omega
    dcm_reference = reference[:2] + velocity_reference[:2] / omega
    shift = (1.0 + params.dcm_gain) * (dcm - dcm_reference)
    acceleration = acceleration_reference.copy()
    acceleration[:2] += omega**2 * (error[:2] - shift)
    acceleration[2] -= (
        params.height_stiffness * error[2] + params.height_damping * rate[2]
    )
    zmp = reference[:2] - acceleration_reference[:2] / omega**2 + shift
    return BalanceCommand(acceleration, dcm, dcm_reference, zmp)


class Stabilizer(LeafSystem):
    """Keeps the CoM on its reference with wrenches under the feet.

    .. pydrake_system::

        name: Stabilizer
        input_ports:
        - com
        - com_velocity
        - com_reference
        - zmp
        - contacts
        - foot_references
        - momentum_rate
        - leg_torque_map
        output_ports:
        - foot_wrenches
        - dcm
        - dcm_reference
        - zmp_command

    - `com`: measured p_WCom, (3,), m.
    - `com_velocity`: measured v_WCom, (3,), m/s.
    - `com_reference`: p_WCom, v_WCom and a_WCom wanted, (9,), m, m/s, m/s^2.
    - `zmp`: planned p_WZmp, (3,), m; its height is used.
    - `contacts`: feet on the ground, left and right, 0 or 1, then the length of each
      sole that carries, (4,), -, -, m, m.
    - `foot_references`: sole frames X_WF, left then right, then their rates, (24,).
    - `momentum_rate`: rate of angular momentum about the CoM of the planned
      whole-body motion, in W, (3,), Nm.
    - `leg_torque_map`: torques of k leg joints without foot wrenches, (k,), Nm, then,
      row by row, the matrix (k, 12) by which foot wrenches lessen them, (13 k,). Where
      it is not connected no joint torque is kept small.
    - `foot_wrenches`: wrench of the ground wanted on left and right foot, each force
      then moment about F, in W, (12,), N and Nm.
    - `dcm`: measured horizontal DCM, (2,), m.
    - `dcm_reference`: the DCM wanted, (2,), m.
    - `zmp_command`: ZMP that the feedback asks for, (2,), m.
    """

    def __init__(
        self, params: StabilizerParams, sole: Sole, mass: float, leg_joints: int = 12
    ) -> None:
        """Declares the ports.

        Args:
            params: gains.
            sole: of both feet.
            mass: of the robot, kg.
            leg_joints: k, how many joints `leg_torque_map` is about.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate()
        self._params, self._sole, self._mass = params, sole, mass
        self._com = self.DeclareVectorInputPort("com", 3)
        self._velocity = self.DeclareVectorInputPort("com_velocity", 3)
        self._reference = self.DeclareVectorInputPort("com_reference", 9)
        self._zmp = self.DeclareVectorInputPort("zmp", 3)
        self._contacts = self.DeclareVectorInputPort("contacts", 4)
        self._feet = self.DeclareVectorInputPort("foot_references", 24)
        self._momentum_rate = self.DeclareVectorInputPort("momentum_rate", 3)
        self._torque_map = self.DeclareVectorInputPort(
            "leg_torque_map", 13 * leg_joints
        )
        feedback = {
            port.ticket()
            for port in (self._com, self._velocity, self._reference, self._zmp)
        }
        self._command = declare_cached(
            self, "balance command", self._calc_command, feedback
        )
        self.DeclareVectorOutputPort(
            "foot_wrenches",
            12,
            timed(self, self._calc_wrenches),
            prerequisites_of_calc=feedback
            | {
                port.ticket()
                for port in (
                    self._contacts,
                    self._feet,
                    self._momentum_rate,
                    self._torque_map,
                )
            },
        )
        for name, calc in (
            ("dcm", self._calc_dcm),
            ("dcm_reference", self._calc_dcm_reference),
            ("zmp_command", self._calc_zmp_command),
        ):
            self.DeclareVectorOutputPort(
                name, 2, timed(self, calc), prerequisites_of_calc=feedback
            )

    def _calc_command(self, context: Context) -> BalanceCommand:
        reference = eval_vector(self._reference, context)
        return dcm_feedback(
            eval_vector(self._com, context),
            eval_vector(self._velocity, context),
            reference[:3],
            reference[3:6],
            reference[6:],
            eval_vector(self._zmp, context)[2],
            self._params,
        )

    def _calc_wrenches(self, context: Context, output: BasicVector) -> None:
        acceleration = self._command(context).com_acceleration
        force = self._mass * (acceleration + np.array([0.0, 0.0, GRAVITY]))
        contacts = eval_vector(self._contacts, context)
        wrenches, solved = distribute_wrench(
            np.concatenate([force, eval_vector(self._momentum_rate, context)]),
            eval_vector(self._com, context),
            eval_vector(self._feet, context)[:12].reshape(2, 6),
            contacts[:2],
            contacts[2:],
            self._sole,
            self._params.distribution,
            self._leg_torques(context),
        )
        if not solved:
            raise RuntimeError(
                f"no foot wrenches near {np.round(force)} N within the contact cones"
            )
        set_vector(output, wrenches.ravel())

    def _leg_torques(self, context: Context) -> TorqueMap | None:
        costs = self._params.distribution.torque_cost > 0.0
        if not (costs and self._torque_map.HasValue(context)):
            return None
        values = eval_vector(self._torque_map, context)
        joints = len(values) // 13
        return TorqueMap(values[:joints], values[joints:].reshape(joints, 12))

    def _calc_dcm(self, context: Context, output: BasicVector) -> None:
        set_vector(output, self._command(context).dcm)

    def _calc_dcm_reference(self, context: Context, output: BasicVector) -> None:
        set_vector(output, self._command(context).dcm_reference)

    def _calc_zmp_command(self, context: Context, output: BasicVector) -> None:
        set_vector(output, self._command(context).zmp)
