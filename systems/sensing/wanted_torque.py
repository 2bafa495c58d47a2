"""The torque that the joints' servos want, before it is clipped at the limits."""

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector, set_vector
from footfall.systems.timing import timed


def servo_torque(
    stiffness: Vector, damping: Vector, error: Vector, rate_error: Vector, ahead: Vector
) -> Vector:
    """Computes a servo's torque kp (q* - q) + kd (v* - v) + tau, (n,), Nm.

    Args:
        stiffness: kp, (n,), Nm/rad.
        damping: kd, (n,), Nm s/rad.
        error: q* - q, (n,), rad.
        rate_error: v* - v, (n,), rad/s.
        ahead: feed-forward torque tau, (n,), Nm.
    """
    wanted: Vector = stiffness * error + damping * rate_error + ahead
    return wanted


class WantedTorque(LeafSystem):
    """Says what torque the servos of a plant want; the plant clips it at its limits.

    .. pydrake_system::

        name: WantedTorque
        input_ports:
        - state
        - desired_state
        - torque
        output_ports:
        - torque_wanted

    - `state`: positions and velocities of the robot, (nq + nv,).
    - `desired_state`: q* of every actuator, then v*, (2 n,), rad and rad/s.
    - `torque`: feed-forward, (n,), Nm.
    - `torque_wanted`: before clipping, in the order of the actuators, (n,), Nm.
    """

    def __init__(self, plant: MultibodyPlant, instance: ModelInstanceIndex) -> None:
        """Declares the ports.

        Args:
            plant: the finalised plant.
            instance: the robot in it; its actuators have servos.
        """
        super().__init__()
        actuators = [
            plant.get_joint_actuator(index)
            for index in plant.GetJointActuatorIndices(instance)
        ]
        gains = [actuator.get_controller_gains() for actuator in actuators]
        self._stiffness: Vector = np.array([gain.p for gain in gains])
        self._damping: Vector = np.array([gain.d for gain in gains])
        positions = list(plant.GetPositionNames(instance, False, False))
        velocities = list(plant.GetVelocityNames(instance, False, False))
        names = [actuator.joint().name() for actuator in actuators]
        self._positions = [positions.index(name) for name in names]
        first = plant.num_positions(instance)
        self._velocities = [first + velocities.index(name) for name in names]
        count = len(names)
        self._state = self.DeclareVectorInputPort(
            "state", plant.num_multibody_states(instance)
        )
        self._desired = self.DeclareVectorInputPort("desired_state", 2 * count)
        self._torque = self.DeclareVectorInputPort("torque", count)
        self.DeclareVectorOutputPort(
            "torque_wanted",
            count,
            timed(self, self._calc),
            prerequisites_of_calc={self.all_input_ports_ticket()},
        )

    def _calc(self, context: Context, output: BasicVector) -> None:
        state = eval_vector(self._state, context)
        desired = eval_vector(self._desired, context)
        count = len(self._positions)
        set_vector(
            output,
            servo_torque(
                self._stiffness,
                self._damping,
                desired[:count] - state[self._positions],
                desired[count:] - state[self._velocities],
                eval_vector(self._torque, context),
            ),
        )
