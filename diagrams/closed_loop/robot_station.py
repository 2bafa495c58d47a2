"""The robot in its scene: plant, joint servos, sensors and what pushes it."""

from dataclasses import dataclass
from typing import cast

import numpy as np
from pydrake.geometry import Meshcat, MeshcatVisualizer, SceneGraph
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.primitives import ZeroOrderHold

from footfall.diagrams.closed_loop.body_sensors import BODY_SIGNALS, add_body_sensors
from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.diagrams.scenario import ESTIMATED, Scenario
from footfall.models.robots.contact_geometry import ContactModel, is_sole
from footfall.models.robots.robot_alone import robot_weight
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.mover import add_movers
from footfall.models.scenes.solids import add_solids
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.disturbance.box_mover import BoxMotion, BoxMover
from footfall.systems.disturbance.pusher import Push, Pusher
from footfall.systems.sensing.contact_monitor import ContactMonitor
from footfall.systems.sensing.foot_wrench_sensor import FootWrenchSensor
from footfall.systems.sensing.kinematic_state import KinematicState
from footfall.systems.sensing.robot_contacts import watched_geometry
from footfall.systems.sensing.speed_monitor import SpeedMonitor
from footfall.systems.sensing.wanted_torque import WantedTorque

DRAKE_CONTACT_MODELS = {
    "hydroelastic": "hydroelastic_with_fallback",
    "point": "point",
}
"""What Drake calls the contact models; bodies that are no soles meet in points in both.
"""
JUDGED = (
    "plant",
    "scene_graph",
    "box_mover",
    "kinematic_state",
    "foot_wrench_sensor",
    "contact_monitor",
    "speed_monitor",
    "wanted_torque",
)
"""The parts by which a run is judged: a user's own would be his own judge."""


@dataclass(frozen=True)
class RobotStation:
    """The station of the robot, and the plant and scene in it."""

    station: Station
    """Takes `torque` (na,) and `joint_references`; gives `true_body_poses`, and what
    the body's sensors tell: `imu`, `joints` and `ankle_wrenches`, or in their place
    `true_state` and `true_wrenches`."""
    plant: MultibodyPlant
    scene_graph: SceneGraph
    instance: ModelInstanceIndex
    """The robot in the plant."""
    movers: ModelInstanceIndex
    """The boxes that move, in the plant."""


def build_robot_station(setup: Setup, meshcat: Meshcat | None = None) -> RobotStation:
    """Builds robot, scene, servos, the body's sensors, what watches the truth, pushes.

    Parts: `plant`, `scene_graph`, `torque_hold`, `kinematic_state`,
    `foot_wrench_sensor`, `wanted_torque`, `contact_monitor`, `speed_monitor`, the
    body's sensors (`body_sensors.py`) unless the true state is used, `pusher` where
    there are pushes, `box_mover` where there are boxes that move.

    Args:
        setup: scenario and robot.
        meshcat: where the run is to be shown live, if anywhere.

    Raises:
        PartError: a user's own part does not fit, or is one by which a run is judged.
    """
    scenario, robot, model = setup.scenario, setup.robot, setup.model
    for name in JUDGED:
        setup.parts.fix(name, "it is one of those by which a run is judged")
    station = StationBuilder("robot_station", setup.parts)
    simulation = scenario.simulation
    config = MultibodyPlantConfig(
        time_step=simulation.time_step,
        contact_model=DRAKE_CONTACT_MODELS[simulation.contact_model],
        discrete_contact_approximation=simulation.contact_approximation,
    )
    plant, scene_graph = AddMultibodyPlant(config, station.builder)
    plant.set_name("plant")
    scene_graph.set_name("scene_graph")
    contact_model = cast(ContactModel, simulation.contact_model)
    instance = add_robot(plant, scene_graph, robot, contact_model)
    add_solids(plant, scenario.scene.solids())
    movers = add_movers(plant, scenario.scene.movers)
    plant.Finalize()
    plant.SetDefaultPositions(instance, setup.stand.positions)
    if scenario.scene.movers:
        station.add("box_mover", lambda: BoxMover(_motions(scenario)))
        desired = plant.get_desired_state_input_port(movers).get_name()
        station.connect("box_mover.desired_state", f"plant.{desired}")
    if meshcat is not None:
        MeshcatVisualizer.AddToBuilder(station.builder, scene_graph, meshcat)

    step = simulation.time_step
    station.add(
        "torque_hold",
        lambda: ZeroOrderHold(
            setup.params.control_period, plant.num_actuators(instance)
        ),
    )
    station.add("kinematic_state", lambda: KinematicState(model, robot))
    station.add("foot_wrench_sensor", lambda: FootWrenchSensor(plant, instance, robot))
    station.add("wanted_torque", lambda: WantedTorque(plant, instance))
    station.add(
        "contact_monitor",
        lambda: ContactMonitor(
            watched_geometry(
                plant,
                scene_graph.model_inspector(),
                instance,
                tuple(robot.foot_bodies[foot] for foot in FEET),
                is_sole,
                scenario.scene.ground_names(),
            ),
            step,
            robot_weight(model),
        ),
    )
    station.add("speed_monitor", lambda: SpeedMonitor(plant, instance, step))
    if scenario.robot.state == ESTIMATED:
        add_body_sensors(station, setup, plant, instance)
    pushes = _pushes(scenario, robot.torso_body, plant, instance)
    if pushes:
        station.add("pusher", lambda: Pusher(pushes))
        station.connect("pusher.spatial_forces", "plant.applied_spatial_force")

    state = plant.get_state_output_port(instance).get_name()
    actuation = plant.get_actuation_input_port(instance).get_name()
    desired_state = plant.get_desired_state_input_port(instance).get_name()
    station.connect("torque_hold.y", f"plant.{actuation}", "wanted_torque.torque")
    station.connect(
        f"plant.{state}",
        "kinematic_state.state",
        "wanted_torque.state",
        "speed_monitor.state",
    )
    station.connect(
        "plant.contact_results",
        "foot_wrench_sensor.contact_results",
        "contact_monitor.contact_results",
    )
    station.connect("kinematic_state.foot_poses", "foot_wrench_sensor.foot_poses")

    station.take("torque", "torque_hold.u")
    station.take(
        "joint_references", f"plant.{desired_state}", "wanted_torque.desired_state"
    )
    station.give("true_body_poses", "plant.body_poses")
    if scenario.robot.state == ESTIMATED:
        for signal in BODY_SIGNALS:
            station.give(*signal)
    else:
        station.give("true_state", f"plant.{state}")
        station.give("true_wrenches", "foot_wrench_sensor.foot_wrenches")
    return RobotStation(station.build(), plant, scene_graph, instance, movers)


def _motions(scenario: Scenario) -> list[BoxMotion]:
    return [
        BoxMotion((box.x, box.y), (box.to_x, box.to_y), box.time, box.duration)
        for box in scenario.scene.movers
    ]


def _pushes(
    scenario: Scenario, torso: str, plant: MultibodyPlant, instance: ModelInstanceIndex
) -> list[Push]:
    pushes = []
    for push in scenario.task.pushes:
        body = plant.GetBodyByName(push.body or torso, instance)
        force: Vector = np.array(push.force)
        pushes.append(
            Push(body.index(), push.time, push.duration, force, body.default_com())
        )
    return pushes
