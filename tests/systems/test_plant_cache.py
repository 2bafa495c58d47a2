"""Plant contexts in a System's cache: set by callbacks, or following a state input."""

import numpy as np
import pytest
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import SpatialInertia
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.systems.plant_cache import declare_scratch_context, declare_state_context
from footfall.systems.ports import eval_vector, set_vector


def falling_ball() -> MultibodyPlant:
    """One free body."""
    plant = MultibodyPlant(0.0)
    plant.AddRigidBody("ball", SpatialInertia.SolidSphereWithMass(2.0, 0.1))
    plant.Finalize()
    return plant


class Kinematics(LeafSystem):
    """Gives height and speed of the ball at its state input; counts the settings."""

    def __init__(self, plant: MultibodyPlant) -> None:
        super().__init__()
        self.plant = plant
        self.state = self.DeclareVectorInputPort("state", 13)
        self.at_state = declare_state_context(self, plant, self.state)
        self.scratch = declare_scratch_context(self, plant)
        for name, row in (("height", 6), ("speed", 12)):

            def calc(context: Context, output: BasicVector, row: int = row) -> None:
                state = plant.GetPositionsAndVelocities(self.at_state(context))
                set_vector(output, state[row : row + 1])

            self.DeclareVectorOutputPort(
                name, 1, calc, prerequisites_of_calc={self.state.ticket()}
            )


def at(system: Kinematics, height: float, speed: float) -> Context:
    """The system's context with the ball at that state."""
    context = system.CreateDefaultContext()
    set_state(system, context, height, speed)
    return context


def set_state(
    system: Kinematics, context: Context, height: float, speed: float
) -> None:
    """Fixes the state input."""
    state = np.array([1, 0, 0, 0, 0, 0, height, 0, 0, 0, 0, 0, speed], dtype=float)
    system.state.FixValue(context, state)


def read(system: Kinematics, context: Context) -> tuple[float, float]:
    """Both outputs."""
    ports = [system.GetOutputPort(name) for name in ("height", "speed")]
    height, speed = (eval_vector(port, context)[0] for port in ports)
    return float(height), float(speed)


def test_state_context_follows_the_input() -> None:
    """Also when it changes."""
    system = Kinematics(falling_ball())
    context = at(system, 1.5, -2.0)
    assert read(system, context) == (1.5, -2.0)
    set_state(system, context, 0.5, -4.0)
    assert read(system, context) == (0.5, -4.0)


def test_state_context_is_set_once_a_state(monkeypatch: pytest.MonkeyPatch) -> None:
    """However many outputs look at it."""
    system = Kinematics(falling_ball())
    context = at(system, 1.5, -2.0)
    first = system.at_state(context)
    system.plant.SetPositions(first, np.array([1.0, 0, 0, 0, 0, 0, 9.0]))
    assert read(system, context)[0] == 9.0
    assert system.at_state(context) is first


def test_two_contexts_do_not_share() -> None:
    """A state set in one is not seen in the other."""
    system = Kinematics(falling_ball())
    one, other = at(system, 1.0, 0.0), at(system, 2.0, 0.0)
    assert read(system, one) == (1.0, 0.0)
    assert read(system, other) == (2.0, 0.0)
    assert system.at_state(one) is not system.at_state(other)


def test_a_clone_is_at_the_state_too() -> None:
    """Although its cache was filled by the original, and without sharing with it."""
    system = Kinematics(falling_ball())
    context = at(system, 1.5, -2.0)
    eval_vector(system.GetOutputPort("height"), context)
    clone = context.Clone()
    assert read(system, clone) == (1.5, -2.0)
    set_state(system, clone, 0.5, -4.0)
    assert read(system, clone) == (0.5, -4.0)
    assert read(system, context) == (1.5, -2.0)


def test_scratch_is_one_context_that_can_be_set() -> None:
    """What is set stays until it is set again; a clone has its own."""
    system = Kinematics(falling_ball())
    context = system.CreateDefaultContext()
    scratch = system.scratch(context)
    system.plant.SetPositions(scratch, np.array([1.0, 0, 0, 0, 0, 0, 3.0]))
    assert system.scratch(context) is scratch
    clone = context.Clone()
    system.plant.SetPositions(
        system.scratch(clone), np.array([1.0, 0, 0, 0, 0, 0, 4.0])
    )
    assert system.plant.GetPositions(scratch)[6] == 3.0
