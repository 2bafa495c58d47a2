"""Step over what lies in the way (obstacle paper): its two stations."""

import numpy as np
from pydrake.systems.primitives import ConstantVectorSource

from footfall.diagrams.closed_loop.lidar_scanning import add_lidar
from footfall.diagrams.closed_loop.robot_station import RobotStation
from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.diagrams.signal_names import OBSTACLE_SIGNAL, PLAN_SIGNAL
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.obstacle_finder import ObstacleFinder
from footfall.systems.planning.crossing.crossing_planner import CrossingPlanner
from footfall.systems.planning.executive.executive import Executive
from footfall.systems.planning.whole_body.whole_body_plan import planning_body


def build_obstacle_perception(setup: Setup, true: RobotStation) -> Station:
    """Builds scan and detection: what the robot knows of the obstacles.

    Takes `true_body_poses`, `body_poses` and `scan`; gives `obstacle_map` and `sweep`,
    how many sweeps are in it. Parts: `tilting_lidar`, `scan_assembler`, `viewpoint`,
    `obstacle_finder`.
    """
    params = setup.params
    station = StationBuilder("perception", setup.parts)
    add_lidar(station, setup, true)
    station.add(
        "obstacle_finder",
        lambda: ObstacleFinder(
            params.obstacle_finder, params.thinking.obstacle_finding
        ),
    )
    for port in ("cloud", "sweep"):
        station.connect(f"scan_assembler.{port}", f"obstacle_finder.{port}")
    station.connect("viewpoint.position", "obstacle_finder.viewpoint")
    for signal in ("obstacle_map", "sweep"):
        station.give(signal, f"obstacle_finder.{signal}")
    station.log(OBSTACLE_SIGNAL)
    return station.build()


def build_obstacle_planning(setup: Setup) -> Station:
    """Builds the planner of crossings, and what decides on its plans.

    Takes `obstacle_map`, `sweep` and what is tracked now, `foot_references` and
    `com_reference`; gives `motion_plan`, `footstep_plan`, `scan` and `status`. Parts:
    `goal`, `crossing_planner`, `executive`.
    """
    params = setup.params
    thinking = params.thinking
    goal: Vector = np.array(setup.scenario.task.goal, dtype=np.float64)
    station = StationBuilder("planning", setup.parts)
    station.add("goal", lambda: ConstantVectorSource(goal))
    station.add(
        "crossing_planner",
        lambda: CrossingPlanner(
            params.footstep_planner,
            params.motion_planner,
            params.crossing,
            params.zmp_preview,
            planning_body(setup.robot, setup.model),
            setup.stand.plan,
            setup.mode,
        ),
    )
    station.add(
        "executive",
        lambda: Executive(
            params.executive,
            setup.stand.plan,
            thinking.quasi_static_crossing_planning
            if setup.mode == "quasi_static"
            else thinking.crossing_planning,
        ),
    )
    station.connect("goal.y0", "crossing_planner.goal")
    for port in ("footstep_plan", "motion_plan"):
        station.connect(f"crossing_planner.{port}", f"executive.{port}")
    for signal in ("obstacle_map", "foot_references", "com_reference"):
        station.take(signal, f"crossing_planner.{signal}")
    station.take("sweep", "executive.sweep")
    for signal in ("motion_plan", "footstep_plan", "scan", "status"):
        station.give(signal, f"executive.{signal}")
    station.log(PLAN_SIGNAL)
    return station.build()
