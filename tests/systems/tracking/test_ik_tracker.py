"""The tracker's shell: what it integrates, publishes and keeps in its state."""

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from models.jvrc1 import JVRC1
from systems.ports import Vector, eval_vector
from systems.tracking.ik_tracker import IkTracker
from systems.tracking.whole_body_ik import IkParams, WholeBodyIk, integrate

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
    target = standing.target.__class__(
        **{
            **standing.target.__dict__,
            "com_velocity": np.array([0.05, 0.0, 0.0]),
        }
    )
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


def test_contacts_say_which_feet_are_held(standing) -> None:
    """A left foot in the air follows its rates while the right one stays."""
    system, context = make(standing)
    rates = np.zeros(12)
    rates[2] = 0.2
    feet = standing.target.foot_poses.ravel()
    system.GetInputPort("contacts").FixValue(context, [0.0, 1.0, 0.225, 0.225])
    system.GetInputPort("foot_references").FixValue(
        context, np.concatenate([feet, rates])
    )
    Simulator(system, context).AdvanceTo(0.011)
    at = standing.context(eval_vector(system.GetOutputPort("positions"), context))
    heights = [
        standing.plant.EvalBodyPoseInWorld(
            at, standing.plant.GetBodyByName(JVRC1.foot_bodies[foot])
        ).translation()[2]
        for foot in ("left", "right")
    ]
    moved = np.array(heights) - JVRC1.sole.ankle_height - [feet[2], feet[8]]
    assert moved[0] > 1e-3
    assert abs(moved[1]) < 1e-5


def test_positions_of_another_robot_are_refused(standing) -> None:
    """With what was expected and what came."""
    with pytest.raises(ValueError, match=r"positions must be \(39,\), got \(38,\)"):
        IkTracker(standing.plant, JVRC1, IkParams(), standing.q[1:])


def test_a_wrong_parameter_is_refused(standing) -> None:
    """When the system is made."""
    with pytest.raises(ValueError, match=r"^period: "):
        IkTracker(standing.plant, JVRC1, IkParams(period=-1.0), standing.q)
