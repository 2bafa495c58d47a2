"""What servos want, against what the plant then applies."""

import numpy as np
from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.wanted_torque import WantedTorque, servo_torque


def test_the_law_of_a_servo() -> None:
    """Kp (q* - q) + kd (v* - v) + tau, joint by joint."""
    torque = servo_torque(
        np.array([100.0, 200.0]),
        np.array([1.0, 2.0]),
        np.array([0.1, -0.1]),
        np.array([3.0, 4.0]),
        np.array([5.0, 6.0]),
    )
    np.testing.assert_allclose(torque, [10.0 + 3.0 + 5.0, -20.0 + 8.0 + 6.0])


def test_the_plant_applies_what_is_wanted_up_to_its_limits() -> None:
    """A robot in the air, pulled away from its posture: some joints are clipped."""
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(
        MultibodyPlantConfig(time_step=0.0025, discrete_contact_approximation="lagged"),
        builder,
    )
    instance = add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    wanted = builder.AddNamedSystem("wanted", WantedTorque(plant, instance))
    builder.Connect(plant.get_state_output_port(instance), wanted.GetInputPort("state"))
    simulator = Simulator(builder.Build())
    root = simulator.get_mutable_context()
    rng = np.random.default_rng(3)
    count = plant.num_actuators(instance)
    desired: Vector = np.concatenate([rng.normal(0, 0.05, count), np.zeros(count)])
    ahead: Vector = rng.normal(0.0, 20.0, count)
    at_plant, at_wanted = (
        system.GetMyContextFromRoot(root) for system in (plant, wanted)
    )
    plant.get_desired_state_input_port(instance).FixValue(at_plant, desired)
    plant.get_actuation_input_port(instance).FixValue(at_plant, ahead)
    wanted.GetInputPort("desired_state").FixValue(at_wanted, desired)
    wanted.GetInputPort("torque").FixValue(at_wanted, ahead)
    over = 0
    for step in range(1, 5):
        simulator.AdvanceTo((step - 0.5) * 0.0025)
        asked = eval_vector(wanted.GetOutputPort("torque_wanted"), at_wanted)
        applied = eval_vector(plant.get_net_actuation_output_port(instance), at_plant)
        over += int((np.abs(asked) > 100.0).sum())
        np.testing.assert_allclose(np.clip(asked, -100.0, 100.0), applied, atol=1e-6)
    assert over > 0
