"""Step over what lies in the way without stopping (obstacle paper, closed loop)."""

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
from footfall.diagrams.signal_names import OBSTACLE_SIGNAL, PLAN_SIGNAL
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.obstacle_finder import ObstacleFinder
from footfall.systems.planning.crossing.crossing_planner import CrossingPlanner
from footfall.systems.planning.executive.executive import Executive
from footfall.systems.planning.whole_body.whole_body_plan import planning_body


def build_obstacle_crossing(
    scenario: Scenario, meshcat: Meshcat | None = None
) -> TaskDiagram:
    """Builds the closed loop: scan, find obstacles, plan, walk and cross, look again.

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
    finder = add_system(
        builder,
        "obstacle_finder",
        ObstacleFinder(params.obstacle_finder, params.thinking.obstacle_finding),
    )
    for port in ("cloud", "sweep"):
        builder.Connect(assembler.GetOutputPort(port), finder.GetInputPort(port))
    builder.Connect(lidar.GetOutputPort("viewpoint"), finder.GetInputPort("viewpoint"))

    stand = initial_stand(scenario, station)
    goal: Vector = np.array(scenario.task.goal, dtype=np.float64)
    goal_source = add_system(builder, "goal", ConstantVectorSource(goal))
    planner = add_system(
        builder,
        "crossing_planner",
        CrossingPlanner(
            params.footstep_planner,
            params.motion_planner,
            params.crossing,
            params.zmp_preview,
            planning_body(robot, station.model),
            stand.plan,
            "quasi_static" if scenario.task.mode == "quasi_static" else "dynamic",
        ),
    )
    builder.Connect(
        finder.GetOutputPort("obstacle_map"), planner.GetInputPort("obstacle_map")
    )
    builder.Connect(goal_source.get_output_port(), planner.GetInputPort("goal"))

    executive = add_system(
        builder,
        "executive",
        Executive(
            params.executive,
            stand.plan,
            params.thinking.quasi_static_crossing_planning
            if scenario.task.mode == "quasi_static"
            else params.thinking.crossing_planning,
        ),
    )
    builder.Connect(finder.GetOutputPort("sweep"), executive.GetInputPort("sweep"))
    builder.Connect(executive.GetOutputPort("scan"), lidar.GetInputPort("enable"))
    for port in ("footstep_plan", "motion_plan"):
        builder.Connect(planner.GetOutputPort(port), executive.GetInputPort(port))

    walking = add_walking(builder, scenario, station, stand, executive, planner)
    recorder = record_walking(builder, station, walking, executive)
    for name, output in (
        (PLAN_SIGNAL, executive.GetOutputPort("motion_plan")),
        (OBSTACLE_SIGNAL, finder.GetOutputPort("obstacle_map")),
    ):
        recorder.add_value(name, output, VALUE_PERIOD)

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
