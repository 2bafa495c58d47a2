"""The forces under the feet tell where the CoM is; the model's masses do not."""

import numpy as np
from pydrake.math import RollPitchYaw
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.values.vector import Vector
from footfall.systems.estimation.com_observer import ComObserver, ComObserverParams
from footfall.systems.ports import eval_vector

COM = np.array([1.03, 2.01, 0.85])
FEET = np.array([[1.0, 2.1, 0.0, 0.0, 0.0, 0.3], [1.05, 1.9, 0.2, 0.0, 0.1, 0.1]])
WEIGHT = 600.0


def wrenches(com: Vector, share: float = 0.4) -> Vector:
    """What the ground does to a mass at rest at `com`, in the soles, (12,).

    The left foot bears its share where it is; the right one balances.
    """
    total = np.array([0.0, 0.0, WEIGHT])
    forces = np.array([share * total, (1.0 - share) * total])
    rest = np.cross(com, total) - sum(
        np.cross(p[:3], f) for p, f in zip(FEET, forces, strict=True)
    )
    parts = []
    for pose, force, moment in zip(FEET, forces, [np.zeros(3), rest], strict=True):
        R_WF = RollPitchYaw(*pose[3:]).ToRotationMatrix().matrix()
        parts += [R_WF.T @ force, R_WF.T @ moment]
    return np.concatenate(parts)


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
        ("foot_wrenches", wrenches(COM)),
    ):
        system.GetInputPort(name).FixValue(context, value)
    return system, context


def test_a_robot_that_stands_learns_its_offset() -> None:
    """In the heading of the feet; at first the model counts as well."""
    params = ComObserverParams()
    system, context = observing(params)
    simulator = Simulator(system, context)
    simulator.AdvanceTo(params.rest_time + params.trust + 0.001)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, [0.01, -0.005], rtol=0.05)
    simulator.AdvanceTo(20.0)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, [0.02, -0.01], atol=1e-6)
    com = eval_vector(system.GetOutputPort("com"), context)
    np.testing.assert_allclose(com, COM, atol=1e-6)


def test_an_error_that_is_put_in_is_taken_out() -> None:
    """That is what it is for."""
    system, context = observing(ComObserverParams(), (0.02, -0.01))
    Simulator(system, context).AdvanceTo(20.0)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, 0.0, atol=1e-6)


def test_while_it_moves_it_learns_nothing() -> None:
    """Nor just after, when what it was accelerated by still rings."""
    params = ComObserverParams()
    system, context = observing(params)
    simulator = Simulator(system, context)
    system.GetInputPort("com_velocity").FixValue(context, [0.3, 0.0, 0.0])
    simulator.AdvanceTo(0.996)
    system.GetInputPort("com_velocity").FixValue(context, [0.005, 0.0, 0.0])
    simulator.AdvanceTo(0.996 + params.rest_time - 0.01)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_array_equal(offset, 0.0)
    simulator.AdvanceTo(0.996 + params.rest_time + 0.02)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    assert offset[0] > 1e-4


def test_feet_that_do_not_bear_say_nothing() -> None:
    """In the air, or before the first sample."""
    system, context = observing(ComObserverParams())
    system.GetInputPort("foot_wrenches").FixValue(context, np.zeros(12))
    Simulator(system, context).AdvanceTo(1.0)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_array_equal(offset, 0.0)


def test_it_corrects_no_more_than_it_may() -> None:
    """What is farther off is no matter of masses."""
    system, context = observing(ComObserverParams(largest=0.005))
    Simulator(system, context).AdvanceTo(1.0)
    offset = eval_vector(system.GetOutputPort("offset"), context)
    np.testing.assert_allclose(offset, [0.005, -0.005])
