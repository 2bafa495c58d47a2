"""Where the robot's bodies are, of the state that it believes in."""

from collections.abc import Callable

from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex
from pydrake.systems.framework import Context, LeafSystem

from footfall.systems.plant_cache import declare_state_context
from footfall.systems.timing import timed


class BodyPoses(LeafSystem):
    """Forward kinematics of every body, computed when someone asks.

    .. pydrake_system::

        name: BodyPoses
        input_ports:
        - state
        output_ports:
        - body_poses

    - `state`: positions and velocities of the robot, (nq + nv,).
    - `body_poses`: X_WB of every body, by their indices in the plant of the robot
      alone, list[RigidTransform].
    """

    def __init__(self, plant: MultibodyPlant) -> None:
        """Declares the ports.

        Args:
            plant: the robot alone, finalised.
        """
        super().__init__()
        self._bodies = [
            plant.get_body(BodyIndex(index)) for index in range(plant.num_bodies())
        ]
        state = self.DeclareVectorInputPort("state", plant.num_multibody_states())
        self._at_state = declare_state_context(self, plant, state)
        calc: Callable[..., None] = timed(self, self._calc)
        self.DeclareAbstractOutputPort(
            "body_poses",
            lambda: AbstractValue.Make([RigidTransform()]),
            calc,
            prerequisites_of_calc={state.ticket()},
        )

    def _calc(self, context: Context, poses: AbstractValue) -> None:
        at = self._at_state(context)
        poses.set_value([body.EvalPoseInWorld(at) for body in self._bodies])
