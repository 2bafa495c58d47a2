"""Cross a cluttered room that a ceiling camera sees (room paper, closed loop)."""

import dataclasses

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.geometry import Meshcat
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantValueSource, ConstantVectorSource

from footfall.diagrams.closed_loop.room_perception import add_perception
from footfall.diagrams.closed_loop.station import add_station
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram, build_diagram
from footfall.diagrams.closed_loop.walking import add_walking, initial_stand
from footfall.diagrams.closed_loop.walking_signals import (
    SIGNAL_PERIOD,
    VALUE_PERIOD,
    record_walking,
)
from footfall.diagrams.closed_loop.wiring import add_system
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.signal_names import MOVERS_SIGNAL
from footfall.models.values.perceived import Staircase
from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.executive.path_executive import PathExecutive
from footfall.systems.planning.motion.motion_planner import MotionPlanner
from footfall.systems.planning.motion.motion_stop import stop_early
from footfall.systems.planning.path.path_footstep_planner import PathFootstepPlanner
from footfall.systems.planning.path.path_planner import PathPlanner
from footfall.systems.planning.whole_body.whole_body_plan import planning_body


def build_room_crossing(
    scenario: Scenario, meshcat: Meshcat | None = None
) -> TaskDiagram:
    """Builds the closed loop: camera, environment, path, footsteps, walk, look again.

    Args:
        scenario: what to build.
        meshcat: where the run is to be shown live, if anywhere.

    Returns:
        The diagram, its default context where the robot starts.

    Raises:
        EnvironmentFileError: the scenario's environment cannot be read.
    """
    params = scenario.controllers()
    robot = scenario.robot.model()
    builder = DiagramBuilder()

    station = add_station(builder, scenario, robot, params.control_period)
    frame, environment = add_perception(builder, scenario, station)

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
    body = planning_body(robot, station.model)
    motion = add_system(
        builder,
        "motion_planner",
        MotionPlanner(params.motion_planner, params.zmp_preview, robot, body=body),
    )
    builder.Connect(
        footsteps.GetOutputPort("footstep_plan"), motion.GetInputPort("footstep_plan")
    )
    level = add_system(
        builder, "level_ground", ConstantValueSource(AbstractValue.Make(Staircase()))
    )
    builder.Connect(level.get_output_port(), motion.GetInputPort("staircase"))

    stand = initial_stand(scenario, station)

    def stop(plan: MotionPlan, time: float) -> MotionPlan | None:
        return stop_early(
            plan,
            time,
            params.footstep_planner.stance_width,
            params.motion_planner,
            params.zmp_preview,
            robot,
            body,
        )

    thinking = params.thinking
    if scenario.task.environment is not None:
        # What a file says is known; nothing is perceived.
        thinking = dataclasses.replace(thinking, room_perception=0.0)
    executive = add_system(
        builder,
        "executive",
        PathExecutive(params.path_executive, robot.sole, stand.plan, stop, thinking),
    )
    builder.Connect(frame, executive.GetInputPort("frame"))
    builder.Connect(environment, executive.GetInputPort("environment"))
    for source, port in (
        (path, "path_plan"),
        (footsteps, "footstep_plan"),
        (motion, "motion_plan"),
    ):
        builder.Connect(source.GetOutputPort(port), executive.GetInputPort(port))

    walking = add_walking(builder, scenario, station, stand, executive, motion)
    recorder = record_walking(builder, station, walking, executive)
    for port in ("path_plan", "environment"):
        recorder.add_value(
            f"executive.{port}", executive.GetOutputPort(port), VALUE_PERIOD
        )

    if scenario.scene.movers:
        names = station.plant.GetStateNames(station.movers, False)
        half = len(names) // 2
        recorder.add_vector(
            MOVERS_SIGNAL,
            station.plant.get_state_output_port(station.movers),
            tuple(names),
            ("m",) * half + ("m/s",) * half,
            SIGNAL_PERIOD,
        )

    return build_diagram(
        builder,
        scenario,
        station,
        stand,
        executive,
        recorder,
        goal=goal,
        meshcat=meshcat,
    )
