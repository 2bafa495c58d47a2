"""The tracker's shell: what it integrates, publishes and keeps in its state."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.tracking.ik_tracker import IkTracker
from footfall.systems.tracking.whole_body_ik import IkParams, WholeBodyIk, integrate

PORTS = ("positions", "velocities", "accelerations", "joint_references")


def make(standing, com_velocity=(0.0, 0.0, 0.0)) -> tuple[IkTracker, Context]:
    """The tracker on the target at which the robot stands, with a CoM that moves."""
    target = standing.target
    system = IkTracker(standing.plant, JVRC1, IkParams(), standing.q)
    context = system.CreateDefaultContext()
    inputs = {
        "com_reference": np.concatenate([target.com, com_velocity, np.zeros(3)]),
        "foot_references": np.concatenate([target.foot_poses.ravel(), np.zeros(12)]),
        "contacts": [1.0, 1.0, 0.225, 0.225],
        "waist": np.concatenate([target.waist, np.zeros(3)]),
    }
    for name, value in inputs.items():
        system.GetInputPort(name).FixValue(context, value)
    return system, context


def outputs(system: IkTracker, context: Context) -> dict[str, Vector]:
    """Every port's value."""
    return {name: eval_vector(system.GetOutputPort(name), context) for name in PORTS}


def test_starts_at_rest_where_it_is_told(standing) -> None:
    """Before the first tick."""
    values = outputs(*make(standing))
    np.testing.assert_array_equal(values["positions"], standing.q)
    assert not values["velocities"].any()
    assert not values["accelerations"].any()


def test_a_tick_is_the_core_s(standing) -> None:
    """Solve, integrate, differentiate; twice."""
    system, context = make(standing, com_velocity=(0.05, 0.0, 0.0))
    simulator = Simulator(system, context)
    ik = WholeBodyIk(standing.plant, JVRC1, IkParams())
    plant_context, q = standing.context(), standing.q
    target = replace(standing.target, com_velocity=np.array([0.05, 0.0, 0.0]))
    before = np.zeros(standing.plant.num_velocities())
    for tick in range(2):
        simulator.AdvanceTo(0.005 * tick + 0.001)
        standing.plant.SetPositions(plant_context, q)
        v, _ = ik.solve(plant_context, target)
        q = integrate(standing.plant, plant_context, v, 0.005)
        values = outputs(system, context)
        np.testing.assert_allclose(values["positions"], q, atol=1e-12)
        np.testing.assert_allclose(values["velocities"], v, atol=1e-12)
        np.testing.assert_allclose(
            values["accelerations"], (v - before) / 0.005, atol=1e-9
        )
        before = v


def test_joint_references_are_in_the_order_of_the_actuators(standing) -> None:
    """Positions, then velocities: what the plant's desired state takes."""
    system, context = make(standing, com_velocity=(0.1, 0.05, 0.02))
    Simulator(system, context).AdvanceTo(0.02)
    values = outputs(system, context)
    plant = standing.plant
    joints = [
        plant.get_joint_actuator(index).joint()
        for index in plant.GetJointActuatorIndices()
    ]
    at = plant.CreateDefaultContext()
    plant.SetPositions(at, values["positions"])
    plant.SetVelocities(at, values["velocities"])
    want = [joint.GetOnePosition(at) for joint in joints]
    want += [joint.GetOneVelocity(at) for joint in joints]
    np.testing.assert_array_equal(values["joint_references"], want)
    assert np.abs(values["joint_references"][len(joints) :]).max() > 0.01


def test_the_shoulders_pitch_to_the_rear_with_the_arms_reference(standing) -> None:
    """By rate and by where they are wanted; the CoM stays."""
    system, context = make(standing)
    shoulder = standing.plant.GetJointByName(JVRC1.swing_joints[0]).position_start()
    simulator = Simulator(system, context)
    for tick in range(200):
        pitch = 0.3 * min(0.01 * tick, 1.0)
        rate = 0.6 if tick < 100 else 0.0
        system.GetInputPort("arms").FixValue(context, [pitch, rate])
        simulator.AdvanceTo(0.005 * tick + 0.001)
    q = outputs(system, context)["positions"]
    assert q[shoulder] == pytest.approx(standing.q[shoulder] + 0.3, abs=0.03)
    at = standing.context()
    standing.plant.SetPositions(at, q)
    com = standing.plant.CalcCenterOfMassPositionInWorld(at)
    np.testing.assert_allclose(com, standing.target.com, atol=1e-3)


@pytest.mark.parametrize("stance", [(0.0, 1.0), (1.0, 0.0), (1.0, 1.0)])
def test_contacts_say_which_feet_are_held(standing, stance) -> None:
    """And the feet follow their rates."""
    system, context = make(standing)
    feet = standing.target.foot_poses.ravel()
    rates = np.array([0.1, 0, 0.2, 0, 0, 0, 0, 0.1, 0.1, 0, 0.2, 0.0])
    system.GetInputPort("contacts").FixValue(context, [*stance, 0.225, 0.225])
    system.GetInputPort("foot_references").FixValue(
        context, np.concatenate([feet, rates])
    )
    Simulator(system, context).AdvanceTo(0.001)
    target = replace(standing.target, foot_rates=rates.reshape(2, 6))
    ik = WholeBodyIk(standing.plant, JVRC1, IkParams())
    found = eval_vector(system.GetOutputPort("velocities"), context)
    for other in ((0.0, 1.0), (1.0, 0.0), (1.0, 1.0)):
        v, _ = ik.solve(standing.context(), replace(target, stance=np.array(other)))
        difference = np.abs(found - v).max()
        assert (difference < 1e-9) == (other == stance)
        assert difference < 1e-9 or difference > 1e-4


def test_positions_of_another_robot_are_refused(standing) -> None:
    """With what was expected and what came."""
    with pytest.raises(ValueError, match=r"positions must be \(39,\), got \(38,\)"):
        IkTracker(standing.plant, JVRC1, IkParams(), standing.q[1:])


def test_a_wrong_parameter_is_refused(standing) -> None:
    """When the system is made."""
    with pytest.raises(ValueError, match=r"^period: "):
        IkTracker(standing.plant, JVRC1, IkParams(period=-1.0), standing.q)
