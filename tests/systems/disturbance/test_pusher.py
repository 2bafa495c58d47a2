"""Pushes: when they act, on what, and what they do to a plant."""

import numpy as np
import pytest
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    ExternallyAppliedSpatialForce,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import BodyIndex, SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.systems.disturbance.pusher import Push, Pusher

FORCE = np.array([30.0, -20.0, 10.0])
STEP = 2.0**-10
POINT = np.array([0.1, 0.2, 0.3])


def acting(pushes: list[Push], time: float) -> list[ExternallyAppliedSpatialForce]:
    """What the port says at a time."""
    system = Pusher(pushes)
    context = system.CreateDefaultContext()
    context.SetTime(time)
    forces = system.GetOutputPort("spatial_forces").Eval(context)
    assert isinstance(forces, list)
    return forces


@pytest.mark.parametrize(
    ("time", "count"),
    [(0.0, 0), (0.99, 0), (1.0, 1), (1.09, 1), (1.1, 0), (2.0, 0)],
)
def test_a_push_acts_for_its_duration(time: float, count: int) -> None:
    """From its time on, until that plus its duration."""
    push = Push(BodyIndex(3), 1.0, 0.1, FORCE, POINT)
    assert len(acting([push], time)) == count


def test_pushes_may_overlap() -> None:
    """Each with its own body, point and force, and no moment."""
    pushes = [
        Push(BodyIndex(3), 1.0, 1.0, FORCE, POINT),
        Push(BodyIndex(5), 1.5, 1.0, -FORCE, 2.0 * POINT),
    ]
    one, other = acting(pushes, 1.7)
    assert [int(one.body_index), int(other.body_index)] == [3, 5]
    np.testing.assert_array_equal(one.F_Bq_W.translational(), FORCE)
    np.testing.assert_array_equal(other.F_Bq_W.translational(), -FORCE)
    np.testing.assert_array_equal(one.F_Bq_W.rotational(), np.zeros(3))
    np.testing.assert_array_equal(other.p_BoBq_B, 2.0 * POINT)


def test_a_push_at_the_com_gives_its_impulse_and_no_spin() -> None:
    """Of a free body in plain translation: mass times velocity, less gravity's."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(MultibodyPlantConfig(time_step=STEP), builder)
    inertia = SpatialInertia.SolidBoxWithMass(2.0, 0.1, 0.2, 0.3).Shift(-POINT)
    body = plant.AddRigidBody("block", inertia)
    plant.Finalize()
    pusher = builder.AddSystem(
        Pusher([Push(body.index(), 0.0625, 0.125, FORCE, body.default_com())])
    )
    builder.Connect(
        pusher.GetOutputPort("spatial_forces"),
        plant.get_applied_spatial_force_input_port(),
    )
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(0.25)
    context = plant.GetMyContextFromRoot(simulator.get_context())
    velocity = plant.CalcCenterOfMassTranslationalVelocityInWorld(context)
    fallen = np.array([0.0, 0.0, -9.81 * 0.25])
    np.testing.assert_allclose(velocity, 0.125 * FORCE / 2.0 + fallen, atol=1e-9)
    spin = plant.EvalBodySpatialVelocityInWorld(context, body).rotational()
    np.testing.assert_allclose(spin, np.zeros(3), atol=1e-9)
