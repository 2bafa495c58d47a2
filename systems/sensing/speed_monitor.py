"""The fastest that every joint has ever been."""

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import (
    Context,
    DiscreteValues,
    LeafSystem,
)

from footfall.models.values.vector import Vector
from footfall.systems.ports import declare_state_output
from footfall.systems.timing import timed


def actuated_velocities(
    plant: MultibodyPlant, instance: ModelInstanceIndex
) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """Finds the actuated joints' velocities in the state, (n,).

    Args:
        plant: the finalised plant.
        instance: the model whose state, positions then velocities, is meant.

    Returns:
        Indices in the order of the actuators.
    """
    names = list(plant.GetVelocityNames(instance, False, False))
    joints = [
        plant.get_joint_actuator(index).joint().name()
        for index in plant.GetJointActuatorIndices(instance)
    ]
    first = plant.num_positions(instance)
    return np.array([first + names.index(joint) for joint in joints], dtype=np.int64)


class SpeedMonitor(LeafSystem):
    """Remembers every joint's largest speed, looking at every step of the plant.

    .. pydrake_system::

        name: SpeedMonitor
        input_ports:
        - state
        output_ports:
        - peak_speeds

    - `state`: positions and velocities of the robot, (nq + nv,).
    - `peak_speeds`: largest magnitude of each actuated joint's velocity since the
      start, in the order of the actuators, (n,), rad/s; nan once a velocity was.
    """

    def __init__(
        self, plant: MultibodyPlant, instance: ModelInstanceIndex, period: float
    ) -> None:
        """Declares ports, state and the update.

        Args:
            plant: the finalised plant.
            instance: the robot in it.
            period: the plant's time step, s.

        Raises:
            ValueError: the period is not positive.
        """
        super().__init__()
        if not period > 0.0:
            raise ValueError(f"period: must be positive, got {period} s")
        self._columns = actuated_velocities(plant, instance)
        self._state = self.DeclareVectorInputPort(
            "state", plant.num_multibody_states(instance)
        )
        still: Vector = np.zeros(len(self._columns))
        self._peaks = declare_state_output(self, "peak_speeds", still)
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))

    def _update(self, context: Context, state: DiscreteValues) -> None:
        velocities: Vector = self._state.Eval(context)[self._columns]  # type: ignore[index]
        peaks = state.get_mutable_value(self._peaks)
        peaks[:] = np.maximum(peaks, np.abs(velocities))
