"""The robot in its scene: plant, joint servos, sensors and what pushes it."""

import dataclasses
from dataclasses import dataclass
from typing import cast

import numpy as np
from pydrake.geometry import SceneGraph
from pydrake.math import RigidTransform
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import DiagramBuilder, OutputPort
from pydrake.systems.primitives import ZeroOrderHold

from footfall.diagrams.closed_loop.wiring import add_system
from footfall.diagrams.scenario import Scenario
from footfall.models.robots.contact_geometry import ContactModel, is_sole
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_errors import RobotError
from footfall.models.robots.robot_loader import add_robot, body_meshes
from footfall.models.scenes.mover import add_movers
from footfall.models.scenes.solid_names import is_ground
from footfall.models.scenes.solids import add_solids, triangle_mesh
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.disturbance.box_mover import BoxMotion, BoxMover
from footfall.systems.disturbance.pusher import Push, Pusher
from footfall.systems.perception.scan_assembler import ScanAssembler, box_around
from footfall.systems.sensing.contact_monitor import ContactMonitor
from footfall.systems.sensing.foot_wrench_sensor import FootWrenchSensor
from footfall.systems.sensing.kinematic_state import KinematicState
from footfall.systems.sensing.ray_caster import BodyMesh
from footfall.systems.sensing.robot_contacts import watched_geometry
from footfall.systems.sensing.speed_monitor import SpeedMonitor
from footfall.systems.sensing.tilting_lidar import TiltingLidar
from footfall.systems.sensing.wanted_torque import WantedTorque

DRAKE_CONTACT_MODELS = {
    "hydroelastic": "hydroelastic_with_fallback",
    "point": "point",
}
"""What Drake calls the contact models; bodies that are no soles meet in points in both.
"""


@dataclass(frozen=True)
class Station:
    """The plant and the ports around it.

    Subsystems: `plant`, `scene_graph`, `torque_hold`, `kinematic_state`,
    `foot_wrench_sensor`, `wanted_torque`, `contact_monitor`, `speed_monitor`, `pusher`.
    """

    plant: MultibodyPlant
    scene_graph: SceneGraph
    robot: RobotModel
    instance: ModelInstanceIndex
    model: MultibodyPlant
    """The robot alone, for the controllers' kinematics and dynamics."""
    torque: ZeroOrderHold
    """Takes the feed-forward torque; holds it for a control period."""
    joint_state: OutputPort
    """Measured positions and velocities, base first."""
    kinematics: KinematicState
    wrench_sensor: FootWrenchSensor
    wanted_torque: WantedTorque
    contact_monitor: ContactMonitor
    speed_monitor: SpeedMonitor
    movers: ModelInstanceIndex
    """The boxes that move, in the plant."""


def robot_alone(robot: RobotModel) -> MultibodyPlant:
    """The robot without a scene, finalised, as the controllers know it."""
    model = MultibodyPlant(0.0)
    scene_graph = SceneGraph()
    model.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(model, scene_graph, robot)
    model.Finalize()
    return model


def robot_weight(model: MultibodyPlant) -> float:
    """The weight of the robot alone, N."""
    gravity = float(np.linalg.norm(model.gravity_field().gravity_vector()))
    return model.CalcTotalMass(model.CreateDefaultContext()) * gravity


def add_station(
    builder: DiagramBuilder,
    scenario: Scenario,
    robot: RobotModel,
    period: float,
) -> Station:
    """Adds robot, scene, servos, proprioception, what watches the truth, and pushes.

    Args:
        builder: of the diagram.
        scenario: what stands where, and the simulation's settings.
        robot: which robot.
        period: of the controllers, s.

    Returns:
        What the rest of a diagram connects to.
    """
    simulation = scenario.simulation
    config = MultibodyPlantConfig(
        time_step=simulation.time_step,
        contact_model=DRAKE_CONTACT_MODELS[simulation.contact_model],
        discrete_contact_approximation=simulation.contact_approximation,
    )
    plant, scene_graph = AddMultibodyPlant(config, builder)
    plant.set_name("plant")
    scene_graph.set_name("scene_graph")
    contact_model = cast(ContactModel, simulation.contact_model)
    instance = add_robot(plant, scene_graph, robot, contact_model)
    add_solids(plant, scenario.scene.solids())
    movers = add_movers(plant, scenario.scene.movers)
    plant.Finalize()
    if scenario.scene.movers:
        mover = add_system(builder, "box_mover", BoxMover(_motions(scenario)))
        builder.Connect(
            mover.GetOutputPort("desired_state"),
            plant.get_desired_state_input_port(movers),
        )

    torque = add_system(
        builder, "torque_hold", ZeroOrderHold(period, plant.num_actuators(instance))
    )
    builder.Connect(torque.get_output_port(), plant.get_actuation_input_port(instance))
    joint_state = plant.get_state_output_port(instance)

    model = robot_alone(robot)
    kinematics = add_system(builder, "kinematic_state", KinematicState(model, robot))
    builder.Connect(joint_state, kinematics.GetInputPort("state"))

    wrench_sensor = add_system(
        builder, "foot_wrench_sensor", FootWrenchSensor(plant, instance, robot)
    )
    wanted = add_system(builder, "wanted_torque", WantedTorque(plant, instance))
    builder.Connect(joint_state, wanted.GetInputPort("state"))
    builder.Connect(torque.get_output_port(), wanted.GetInputPort("torque"))
    step = scenario.simulation.time_step
    contact_monitor = add_system(
        builder,
        "contact_monitor",
        ContactMonitor(
            watched_geometry(
                plant,
                scene_graph.model_inspector(),
                instance,
                tuple(robot.foot_bodies[foot] for foot in FEET),
                is_sole,
                is_ground,
            ),
            step,
            robot_weight(model),
        ),
    )
    speed_monitor = add_system(
        builder, "speed_monitor", SpeedMonitor(plant, instance, step)
    )
    builder.Connect(joint_state, speed_monitor.GetInputPort("state"))
    contact_results = plant.get_contact_results_output_port()
    for sensor in (wrench_sensor, contact_monitor):
        builder.Connect(contact_results, sensor.GetInputPort("contact_results"))
    builder.Connect(
        plant.get_body_poses_output_port(), wrench_sensor.GetInputPort("body_poses")
    )

    pushes = []
    for push in scenario.task.pushes:
        body = plant.GetBodyByName(push.body or robot.torso_body, instance)
        force: Vector = np.array(push.force)
        pushes.append(
            Push(body.index(), push.time, push.duration, force, body.default_com())
        )
    pusher = add_system(builder, "pusher", Pusher(pushes))
    builder.Connect(
        pusher.GetOutputPort("spatial_forces"),
        plant.get_applied_spatial_force_input_port(),
    )
    return Station(
        plant,
        scene_graph,
        robot,
        instance,
        model,
        torque,
        joint_state,
        kinematics,
        wrench_sensor,
        wanted,
        contact_monitor,
        speed_monitor,
        movers,
    )


def _motions(scenario: Scenario) -> list[BoxMotion]:
    return [
        BoxMotion((box.x, box.y), (box.to_x, box.to_y), box.time, box.duration)
        for box in scenario.scene.movers
    ]


def mover_meshes(scenario: Scenario, plant: MultibodyPlant) -> list[BodyMesh]:
    """What a camera sees of the boxes that move."""
    meshes = []
    for box in scenario.scene.movers:
        still = dataclasses.replace(box, x=0.0, y=0.0)
        mesh = triangle_mesh([still.solid()])
        body = plant.GetBodyByName(f"mover_{box.name}")
        meshes.append(BodyMesh(int(body.index()), mesh.vertices, mesh.triangles))
    return meshes


def add_lidar(
    builder: DiagramBuilder, scenario: Scenario, station: Station
) -> tuple[TiltingLidar, ScanAssembler]:
    """Adds the scanner on the robot's head and what makes a cloud of its lines.

    Raises:
        RobotError: the robot has no head.
    """
    plant, robot = station.plant, station.robot
    if robot.head_body is None:
        problem = f"head_body: must be given, the scanner's, for {scenario.task.kind}"
        raise RobotError(robot.name, [problem])
    head = plant.GetBodyByName(robot.head_body, station.instance).index()
    p_HM: Vector = np.array(robot.lidar_position)
    X_HM = RigidTransform(p_HM)
    meshes = [
        BodyMesh(
            int(plant.GetBodyByName(mesh.body, station.instance).index()),
            mesh.vertices,
            mesh.triangles.astype(np.int64),
        )
        for mesh in body_meshes(robot)
        if mesh.body != robot.head_body
    ]
    params = scenario.lidar()
    lidar = add_system(
        builder,
        "tilting_lidar",
        TiltingLidar(
            params,
            mount_body=int(head),
            X_BM=X_HM,
            scene=triangle_mesh(scenario.scene.solids()),
            body_meshes=meshes,
        ),
    )
    assembler = add_system(
        builder,
        "scan_assembler",
        ScanAssembler(
            scenario.controllers().scan_assembler,
            beam_angles=params.angles(),
            mount_body=int(head),
            X_BM=X_HM,
            own_boxes=[box_around(mesh.body_index, mesh.vertices) for mesh in meshes],
        ),
    )
    body_poses = plant.get_body_poses_output_port()  # type: ignore[no-untyped-call]
    builder.Connect(body_poses, lidar.GetInputPort("body_poses"))
    builder.Connect(body_poses, assembler.GetInputPort("body_poses"))
    for port in ("scan", "sweep"):
        builder.Connect(lidar.GetOutputPort(port), assembler.GetInputPort(port))
    return lidar, assembler
