"""Climb a staircase that the robot has scanned (stair paper, closed loop)."""

import numpy as np
from pydrake.geometry import Meshcat
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantVectorSource

from footfall.diagrams.closed_loop.station import add_lidar, add_station
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram, build_diagram
from footfall.diagrams.closed_loop.walking import add_walking, initial_stand
from footfall.diagrams.closed_loop.walking_signals import VALUE_PERIOD, record_walking
from footfall.diagrams.closed_loop.wiring import add_system
from footfall.diagrams.scenario import Scenario
from footfall.models.robots.collision_hulls import collision_hulls
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.plane_segmenter import PlaneSegmenter
from footfall.systems.perception.planes.staircase_map import StaircaseMap
from footfall.systems.planning.executive.executive import Executive
from footfall.systems.planning.footsteps.footstep_planner import FootstepPlanner
from footfall.systems.planning.motion.motion_planner import MotionPlanner
from footfall.systems.planning.motion.motion_prediction import MotionPredictor
from footfall.systems.planning.whole_body.whole_body_plan import planning_body
from footfall.systems.tracking.whole_body_ik import WholeBodyIk


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
    params = scenario.controllers()
    robot = scenario.robot.model()
    builder = DiagramBuilder()

    station = add_station(builder, scenario, robot, params.control_period)
    lidar, assembler = add_lidar(builder, scenario, station)

    segmenter = add_system(
        builder, "plane_segmenter", PlaneSegmenter(robot.sole, params.segmenter)
    )
    down: Vector = np.array([0.0, 0.0, -1.0])
    gravity = add_system(builder, "gravity", ConstantVectorSource(down))
    builder.Connect(assembler.GetOutputPort("cloud"), segmenter.GetInputPort("cloud"))
    builder.Connect(gravity.get_output_port(), segmenter.GetInputPort("gravity"))
    builder.Connect(
        lidar.GetOutputPort("viewpoint"), segmenter.GetInputPort("viewpoint")
    )

    staircase = add_system(
        builder,
        "staircase_map",
        StaircaseMap(params.staircase_map, params.thinking.segmentation),
    )
    builder.Connect(
        segmenter.GetOutputPort("segmentation"), staircase.GetInputPort("segmentation")
    )
    builder.Connect(assembler.GetOutputPort("sweep"), staircase.GetInputPort("sweep"))

    footsteps = add_system(
        builder,
        "footstep_planner",
        FootstepPlanner(params.footstep_planner, robot.sole),
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
                SelfDistanceMeter(robot),
            ),
            planning_body(robot, station.model),
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

    stand = initial_stand(scenario, station)
    executive = add_system(
        builder,
        "executive",
        Executive(
            params.executive,
            stand.plan,
            params.thinking.quasi_static_climb_planning
            if scenario.task.mode == "quasi_static"
            else params.thinking.climb_planning,
        ),
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

    walking = add_walking(builder, scenario, station, stand, executive, motion)
    recorder = record_walking(builder, station, walking, executive)
    for port in ("staircase", "segmentation"):
        recorder.add_value(
            f"staircase_map.{port}", staircase.GetOutputPort(port), VALUE_PERIOD
        )

    return build_diagram(
        builder,
        scenario,
        station,
        stand,
        executive,
        recorder,
        meshcat=meshcat,
    )
