"""Six-axis force sensors in the ankles: what the legs bear, seen from the soles."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.multibody.math import SpatialForce
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import Context, DiscreteValues, LeafSystem

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.validation import MAX_SEED, Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.ports import (
    declare_state,
    declare_state_output,
    read_state,
    set_state,
)
from footfall.systems.sensing.sampling import NoiseSource, latency_steps, shifted
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class AnkleForceParams(Parameters):
    """Noise and offsets of the sensors; those of a 1 kN class of strain gauges."""

    force_noise: float = number(2.0, "N", least=0.0)
    """White noise of a sample of a force, N."""
    moment_noise: float = number(0.05, "N m", least=0.0)
    """The same of a moment, Nm."""
    force_offset: float = number(2.0, "N", least=0.0)
    """Deviation of the offset that a start draws for each force, N."""
    moment_offset: float = number(0.1, "N m", least=0.0)
    """The same for each moment, Nm."""
    latency: float = number(0.0025, "s", least=0.0, most=0.1)
    """How late a sample arrives, s; at least a step of the plant."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Of noise and offsets; `simulation.seed` is added."""


class _Ankle(NamedTuple):
    """Of one foot."""

    joint: int
    """Whose reaction forces the sensor feels; index in the plant's list of them."""
    R_FJ: Vector
    """The joint's frame on the foot in the sole frame, (3, 3)."""
    p_FJ: Vector
    """(3,), m."""
    weight: Vector
    """Wrench of the foot's own weight while the sole is level, about F, (6,)."""


class AnkleForceSensors(LeafSystem):
    """Feels the force between shank and foot, and tells it as the ground's on the sole.

    What the ankle joint bears is the ground's wrench less the foot's weight and
    inertia. The weight of a level foot is taken off; its inertia in the swing, and what
    a tilt changes, remain, as on the robot.

    .. pydrake_system::

        name: AnkleForceSensors
        input_ports:
        - reaction_forces
        output_ports:
        - foot_wrenches

    - `reaction_forces`: of a MultibodyPlant, list[SpatialForce].
    - `foot_wrenches`: measured, of the ground on the left and the right foot, each
      force then moment about F, in F, (12,), N and Nm.
    """

    def __init__(
        self,
        params: AnkleForceParams,
        period: float,
        plant: MultibodyPlant,
        instance: ModelInstanceIndex,
        robot: RobotModel,
    ) -> None:
        """Declares ports, state and the update.

        Args:
            params: noise.
            period: the plant's time step, s.
            plant: robot and scene, finalised.
            instance: the robot in it.
            robot: its names.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._ankles = [
            _ankle(plant, instance, robot.foot_bodies[foot], robot.sole.ankle_height)
            for foot in FEET
        ]
        scale = np.repeat([params.force_noise, params.moment_noise], 3)
        self._noise: Vector = np.tile(scale, 2)
        scale = np.repeat([params.force_offset, params.moment_offset], 3)
        offsets = NoiseSource(params.seed, "ankle offsets", 12).at(0)
        self._offsets: Vector = np.tile(scale, 2) * offsets
        self._white = NoiseSource(params.seed, "ankles", 12)
        self._steps = latency_steps(params.latency, period)
        self._clock = declare_state(self, np.zeros(1))
        waiting: Vector = np.zeros(12 * self._steps)
        self._waiting = declare_state(self, waiting)
        self._output = declare_state_output(self, "foot_wrenches", np.zeros(12))
        self._forces = self.DeclareAbstractInputPort(
            "reaction_forces", AbstractValue.Make([SpatialForce.Zero()])
        )
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))

    def _update(self, context: Context, state: DiscreteValues) -> None:
        step = read_state(context, self._clock)[0]
        waiting = read_state(context, self._waiting)
        forces = self._forces.Eval(context)
        felt = np.concatenate(
            [_sole_wrench(ankle, forces[ankle.joint]) for ankle in self._ankles]  # type: ignore[index]
        )
        felt += self._offsets + self._noise * self._white.at(int(step))
        waiting = shifted(waiting.reshape(self._steps, 12), felt)
        set_state(state, self._clock, np.array([step + 1.0]))
        set_state(state, self._waiting, waiting.ravel())
        set_state(state, self._output, waiting[0])


def _ankle(
    plant: MultibodyPlant, instance: ModelInstanceIndex, foot: str, height: float
) -> _Ankle:
    body = plant.GetBodyByName(foot, instance)
    joint = next(
        plant.get_joint(index)
        for index in plant.GetJointIndices(instance)
        if plant.get_joint(index).child_body().index() == body.index()
    )
    p_FB: Vector = np.array([0.0, 0.0, height])
    X_FJ = RigidTransform(p_FB).multiply(
        joint.frame_on_child().GetFixedPoseInBodyFrame()
    )
    gravity = float(np.linalg.norm(plant.gravity_field().gravity_vector()))
    pull: Vector = np.array([0.0, 0.0, -body.default_mass() * gravity])
    p_FCom: Vector = p_FB + body.default_com()
    return _Ankle(
        int(joint.index()),
        X_FJ.rotation().matrix(),
        X_FJ.translation(),
        np.concatenate([pull, np.cross(p_FCom, pull)]),
    )


def _sole_wrench(ankle: _Ankle, reaction: SpatialForce) -> Vector:
    """The ground's wrench about F in F, (6,), of the joint's reaction on the foot."""
    force = ankle.R_FJ @ reaction.translational()
    moment = ankle.R_FJ @ reaction.rotational()
    (x, y, z), (f_x, f_y, f_z) = ankle.p_FJ.tolist(), force.tolist()
    lever = (y * f_z - z * f_y, z * f_x - x * f_z, x * f_y - y * f_x)
    return -np.concatenate([force, moment + np.array(lever)]) - ankle.weight
