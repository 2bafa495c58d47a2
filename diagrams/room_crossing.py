"""Cross a cluttered room that a ceiling camera sees (room paper, closed loop)."""

import dataclasses

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.geometry import Meshcat, MeshcatVisualizer
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantValueSource, ConstantVectorSource

from diagrams.scenario import ROBOTS, Scenario
from diagrams.station import add_station, mover_meshes
from diagrams.task_diagram import TaskDiagram
from diagrams.walking import add_walking, initial_stand
from diagrams.walking_signals import VALUE_PERIOD, record_walking
from diagrams.wiring import add_system
from models.robot_loader import body_meshes
from models.solids import triangle_mesh
from systems.perception.depth_cloud import DepthCloud
from systems.perception.environment_exchange import EnvironmentExchange
from systems.perception.floor_extractor import FloorExtractor
from systems.perception.obstacle_clusterer import ObstacleClusterer
from systems.perception.scan_assembler import box_around
from systems.planning.motion import plan_motion
from systems.planning.motion_planner import MotionPlanner
from systems.planning.motion_stop import stop_early
from systems.planning.path_executive import PathExecutive
from systems.planning.path_footstep_planner import PathFootstepPlanner
from systems.planning.path_planner import PathPlanner
from systems.ports import Vector
from systems.sensing.depth_camera import DepthCamera
from systems.sensing.ray_caster import BodyMesh
from systems.tracking.whole_body_ik import WholeBodyIk
from systems.values import MotionPlan, Staircase

FORBIDDEN = ("box/", "room/wall", "room/ceiling")
"""What the robot must not touch, with its soles neither."""


def build_room_crossing(
    scenario: Scenario, meshcat: Meshcat | None = None
) -> TaskDiagram:
    """Builds the closed loop: camera, environment, path, footsteps, walk, look again.

    Args:
        scenario: what to build.
        meshcat: where the run is to be shown live, if anywhere.

    Returns:
        The diagram, its default context where the robot starts.
    """
    params = scenario.parameters
    robot = ROBOTS[scenario.robot.name]
    builder = DiagramBuilder()

    station = add_station(
        builder, scenario, robot, params.ik.period, FORBIDDEN, soles_allowed=False
    )
    plant = station.plant
    meshes = [
        BodyMesh(
            int(plant.GetBodyByName(mesh.body, station.instance).index()),
            mesh.vertices,
            mesh.triangles.astype(np.int64),
        )
        for mesh in body_meshes(robot)
    ]
    lens = scenario.sensors.camera
    camera = add_system(
        builder,
        "depth_camera",
        DepthCamera(
            dataclasses.replace(lens, seed=lens.seed + scenario.simulation.seed),
            scene=triangle_mesh(scenario.scene.solids()),
            body_meshes=[*meshes, *mover_meshes(scenario, plant)],
        ),
    )
    builder.Connect(
        plant.get_body_poses_output_port(),  # type: ignore[no-untyped-call]
        camera.GetInputPort("body_poses"),
    )
    cloud = add_system(
        builder,
        "depth_cloud",
        DepthCloud(
            params.depth_cloud,
            [box_around(mesh.body_index, mesh.vertices) for mesh in meshes],
        ),
    )
    builder.Connect(
        camera.GetOutputPort("depth_image"), cloud.GetInputPort("depth_image")
    )
    builder.Connect(
        camera.GetOutputPort("frame_body_poses"), cloud.GetInputPort("body_poses")
    )
    floor = add_system(builder, "floor_extractor", FloorExtractor(params.floor))
    clusters = add_system(
        builder, "obstacle_clusterer", ObstacleClusterer(params.obstacles)
    )
    for port in ("cloud", "viewpoint"):
        builder.Connect(cloud.GetOutputPort(port), floor.GetInputPort(port))
    builder.Connect(
        cloud.GetOutputPort("viewpoint"), clusters.GetInputPort("viewpoint")
    )
    for port in ("floor", "obstacles"):
        builder.Connect(floor.GetOutputPort(port), clusters.GetInputPort(port))
    exchange = add_system(builder, "environment_exchange", EnvironmentExchange())
    builder.Connect(
        clusters.GetOutputPort("environment"), exchange.GetInputPort("environment")
    )
    environment = exchange.GetOutputPort("environment")

    goal: Vector = np.array(scenario.task.goal, dtype=np.float64)
    goal_source = add_system(builder, "goal", ConstantVectorSource(goal))
    path = add_system(builder, "path_planner", PathPlanner(params.path_planner))
    builder.Connect(environment, path.GetInputPort("environment"))
    builder.Connect(goal_source.get_output_port(), path.GetInputPort("goal"))
    footsteps = add_system(
        builder,
        "footstep_planner",
        PathFootstepPlanner(params.footstep_planner, robot.sole),
    )
    builder.Connect(
        path.GetOutputPort("path_plan"), footsteps.GetInputPort("path_plan")
    )
    builder.Connect(environment, footsteps.GetInputPort("environment"))
    for planner in (path, footsteps):
        builder.Connect(
            station.kinematics.GetOutputPort("foot_poses"),
            planner.GetInputPort("foot_poses"),
        )
    motion = add_system(
        builder,
        "motion_planner",
        MotionPlanner(params.motion_planner, params.zmp_preview, robot),
    )
    builder.Connect(
        footsteps.GetOutputPort("footstep_plan"), motion.GetInputPort("footstep_plan")
    )
    level = add_system(
        builder, "level_ground", ConstantValueSource(AbstractValue.Make(Staircase()))
    )
    builder.Connect(level.get_output_port(), motion.GetInputPort("staircase"))

    ik = WholeBodyIk(station.model, robot, params.ik)
    stand = initial_stand(scenario, robot, ik, station)
    nowhere: Vector = np.zeros((0, 3))
    standing = plan_motion(
        stand.foot_poses,
        stand.com,
        (),
        nowhere,
        params.motion_planner,
        params.zmp_preview,
        robot,
    )

    def stop(plan: MotionPlan, time: float) -> MotionPlan | None:
        return stop_early(
            plan,
            time,
            params.footstep_planner.stance_width,
            params.motion_planner,
            params.zmp_preview,
            robot,
        )

    executive = add_system(
        builder,
        "executive",
        PathExecutive(params.path_executive, robot.sole, standing, stop),
    )
    builder.Connect(camera.GetOutputPort("frame"), executive.GetInputPort("frame"))
    builder.Connect(environment, executive.GetInputPort("environment"))
    for source, port in (
        (path, "path_plan"),
        (footsteps, "footstep_plan"),
        (motion, "motion_plan"),
    ):
        builder.Connect(source.GetOutputPort(port), executive.GetInputPort(port))

    walking = add_walking(
        builder, scenario, station, stand, executive.GetOutputPort("motion_plan")
    )
    builder.Connect(
        walking.landing.GetOutputPort("foot_references"),
        motion.GetInputPort("foot_references"),
    )
    builder.Connect(walking.com_reference, motion.GetInputPort("com_reference"))

    recorder = record_walking(builder, station, walking)
    for port in ("status", "footstep_plan", "path_plan", "environment"):
        recorder.add_value(
            f"executive.{port}", executive.GetOutputPort(port), VALUE_PERIOD
        )

    if meshcat is not None:
        MeshcatVisualizer.AddToBuilder(builder, station.scene_graph, meshcat)
    plant.SetDefaultPositions(station.instance, stand.positions)
    diagram = builder.Build()
    diagram.set_name("room_crossing")
    return TaskDiagram(
        diagram=diagram,
        plant=plant,
        robot_instance=station.instance,
        robot=robot,
        scene=scenario.scene,
        signals=recorder,
        status=executive.GetOutputPort("status"),
        goal=(goal[0], goal[1], goal[2]),
        meshcat=meshcat,
    )
