"""Climb a staircase that the robot has scanned (stair paper, closed loop)."""

import dataclasses

import numpy as np
from pydrake.geometry import Meshcat, MeshcatVisualizer
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantVectorSource

from diagrams.scenario import ROBOTS, Scenario
from diagrams.station import Station, add_lidar, add_station
from diagrams.task_diagram import TaskDiagram
from diagrams.walking import Stand, add_walking, initial_stand
from diagrams.walking_signals import VALUE_PERIOD, record_walking
from diagrams.wiring import add_system
from models.collision_hulls import collision_hulls
from systems.perception.plane_segmenter import PlaneSegmenter
from systems.perception.staircase_map import StaircaseMap
from systems.planning.executive import Executive
from systems.planning.footstep_planner import FootstepPlanner
from systems.planning.motion_planner import MotionPlanner
from systems.planning.motion_prediction import MotionPredictor
from systems.ports import Vector
from systems.tracking.whole_body_ik import WholeBodyIk


def build_stair_climbing(
    scenario: Scenario, meshcat: Meshcat | None = None
) -> TaskDiagram:
    """Builds the closed loop: scan, segment, plan footsteps and motion, climb.

    Args:
        scenario: what to build.
        meshcat: where the run is to be shown live, if anywhere.

    Returns:
        The diagram, its default context where the robot starts.
    """
    params = scenario.parameters
    robot = ROBOTS[scenario.robot.name]
    builder = DiagramBuilder()

    station = add_station(builder, scenario, robot, params.ik.period)
    lidar, assembler = add_lidar(builder, scenario, station)

    segmenter = add_system(builder, "plane_segmenter", PlaneSegmenter(params.segmenter))
    down: Vector = np.array([0.0, 0.0, -1.0])
    gravity = add_system(builder, "gravity", ConstantVectorSource(down))
    builder.Connect(assembler.GetOutputPort("cloud"), segmenter.GetInputPort("cloud"))
    builder.Connect(gravity.get_output_port(), segmenter.GetInputPort("gravity"))
    builder.Connect(
        lidar.GetOutputPort("viewpoint"), segmenter.GetInputPort("viewpoint")
    )

    staircase = add_system(builder, "staircase_map", StaircaseMap(params.staircase_map))
    builder.Connect(
        segmenter.GetOutputPort("segmentation"), staircase.GetInputPort("segmentation")
    )
    builder.Connect(assembler.GetOutputPort("sweep"), staircase.GetInputPort("sweep"))

    footsteps = add_system(
        builder,
        "footstep_planner",
        FootstepPlanner(
            dataclasses.replace(
                params.footstep_planner,
                steps_between_scans=scenario.task.steps_between_scans,
            ),
            robot.sole,
        ),
    )
    ik = WholeBodyIk(station.model, robot, params.ik)
    motion = add_system(
        builder,
        "motion_planner",
        MotionPlanner(
            params.motion_planner,
            params.zmp_preview,
            robot,
            "quasi_static" if scenario.task.mode == "quasi_static" else "dynamic",
            MotionPredictor(
                station.model,
                robot,
                ik,
                params.stabilizer.distribution,
                collision_hulls(robot),
            ),
        ),
    )
    for planner in (footsteps, motion):
        builder.Connect(
            staircase.GetOutputPort("staircase"), planner.GetInputPort("staircase")
        )
    builder.Connect(
        station.kinematics.GetOutputPort("foot_poses"),
        footsteps.GetInputPort("foot_poses"),
    )

    stand = initial_stand(scenario, robot, ik, station)
    executive = add_system(
        builder, "executive", Executive(params.executive, stand.plan)
    )
    builder.Connect(staircase.GetOutputPort("sweep"), executive.GetInputPort("sweep"))
    builder.Connect(executive.GetOutputPort("scan"), lidar.GetInputPort("enable"))
    for target in (motion, executive):
        builder.Connect(
            footsteps.GetOutputPort("footstep_plan"),
            target.GetInputPort("footstep_plan"),
        )
    builder.Connect(
        motion.GetOutputPort("motion_plan"), executive.GetInputPort("motion_plan")
    )

    walking = add_walking(
        builder, scenario, station, stand, executive.GetOutputPort("motion_plan")
    )
    builder.Connect(
        walking.landing.GetOutputPort("foot_references"),
        motion.GetInputPort("foot_references"),
    )
    builder.Connect(walking.com_reference, motion.GetInputPort("com_reference"))

    recorder = record_walking(builder, station, walking)
    for name, port in (
        ("executive.status", executive.GetOutputPort("status")),
        ("executive.footstep_plan", executive.GetOutputPort("footstep_plan")),
        ("staircase_map.staircase", staircase.GetOutputPort("staircase")),
        ("staircase_map.segmentation", staircase.GetOutputPort("segmentation")),
    ):
        recorder.add_value(name, port, VALUE_PERIOD)

    if meshcat is not None:
        MeshcatVisualizer.AddToBuilder(builder, station.scene_graph, meshcat)
    _start_at(station, stand)
    diagram = builder.Build()
    diagram.set_name("stair_climbing")
    return TaskDiagram(
        diagram=diagram,
        plant=station.plant,
        robot_instance=station.instance,
        robot=robot,
        scene=scenario.scene,
        signals=recorder,
        status=executive.GetOutputPort("status"),
        meshcat=meshcat,
    )


def _start_at(station: Station, stand: Stand) -> None:
    """Makes the stand the plant's default configuration."""
    station.plant.SetDefaultPositions(station.instance, stand.positions)
