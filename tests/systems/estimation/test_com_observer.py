"""The forces under the feet tell where the CoM is; the model's masses do not."""

import numpy as np
import pytest
from pydrake.math import RollPitchYaw
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.values.vector import Vector
from footfall.systems.estimation.com_observer import (
    ComObserver,
    ComObserverParams,
    com_of_wrenches,
)
from footfall.systems.ports import eval_vector

MASS, G = 62.0, 9.81
COM = np.array([1.03, 2.01, 0.85])
FEET = np.array([[1.0, 2.1, 0.0, 0.0, 0.0, 0.3], [1.05, 1.9, 0.2, 0.0, 0.1, 0.1]])


def wrenches(com: Vector, acceleration: Vector, share: float = 0.4) -> Vector:
    """What the ground does to a point mass at `com`, in the soles, (12,).

    The left foot bears its share where it is; the right one balances.
    """
    total = MASS * (acceleration + np.array([0.0, 0.0, G]))
    forces = np.array([share * total, (1.0 - share) * total])
    rest = np.cross(com, total) - sum(
        np.cross(p[:3], f) for p, f in zip(FEET, forces, strict=True)
    )
    moments = [np.zeros(3), rest]
    parts = []
    for pose, force, moment in zip(FEET, forces, moments, strict=True):
        R_WF = RollPitchYaw(*pose[3:]).ToRotationMatrix().matrix()
        parts += [R_WF.T @ force, R_WF.T @ moment]
    return np.concatenate(parts)


@pytest.mark.parametrize("acceleration", [[0.0, 0.0, 0.0], [1.5, -0.8, 0.6]])
def test_a_mass_that_does_not_turn_is_found(acceleration: list[float]) -> None:
    """On feet of any height and tilt, however it is accelerated."""
    felt = wrenches(COM, np.array(acceleration))
    found = com_of_wrenches(COM[2], FEET.ravel(), felt)
    assert found is not None
    np.testing.assert_allclose(found, COM[:2], atol=1e-12)


def test_feet_that_do_not_bear_say_nothing() -> None:
    """In the air, or before the first sample."""
    assert com_of_wrenches(0.85, FEET.ravel(), np.zeros(12)) is None


def observing(
    params: ComObserverParams, error: tuple[float, float] = (0.0, 0.0)
) -> tuple[ComObserver, Context]:
    """An observer whose model has the CoM 2 cm too far back and 1 cm to the left."""
    system = ComObserver(params, error)
    context = system.CreateDefaultContext()
    yaw = 0.2
    off = [-0.02 * np.cos(yaw) - 0.01 * np.sin(yaw)]
    off += [-0.02 * np.sin(yaw) + 0.01 * np.cos(yaw), 0.0]
    for name, value in (
        ("com", COM + np.array(off)),
        ("com_velocity", np.zeros(3)),
        ("foot_poses", FEET.ravel()),
        ("foot_wrenches", wrenches(COM, np.zeros(3))),
    ):
        system.GetInputPort(name).FixValue(context, value)
    return system, context


def test_a_robot_that_stands_learns_its_offset() -> None:
    """At once what the first samples say, in the heading of the feet."""
    system, context = observing(ComObserverParams())
    Simulator(system, context).AdvanceTo(0.011)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, [0.02, -0.01], atol=1e-9)
    com = eval_vector(system.GetOutputPort("com"), context)
    np.testing.assert_allclose(com, COM, atol=1e-9)


def test_an_error_that_is_put_in_is_taken_out() -> None:
    """That is what it is for."""
    system, context = observing(ComObserverParams(), (0.02, -0.01))
    Simulator(system, context).AdvanceTo(0.011)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, 0.0, atol=1e-9)


def test_while_it_moves_it_learns_slowly() -> None:
    """A stride's turning about the CoM is no offset."""
    params = ComObserverParams(moving_time=10.0)
    system, context = observing(params)
    system.GetInputPort("com_velocity").FixValue(context, [0.3, 0.0, 0.0])
    Simulator(system, context).AdvanceTo(0.996)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    share = 1.0 - np.exp(-0.1)
    np.testing.assert_allclose(offset, share * np.array([0.02, -0.01]), rtol=1e-2)


def test_it_corrects_no_more_than_it_may() -> None:
    """What is farther off is no matter of masses."""
    system, context = observing(ComObserverParams(largest=0.005))
    Simulator(system, context).AdvanceTo(0.1)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, [0.005, -0.005])
