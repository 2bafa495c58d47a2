"""Cross a cluttered room to a goal (room paper): the station that plans."""

import dataclasses

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.primitives import ConstantValueSource, ConstantVectorSource

from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.models.values.perceived import Staircase
from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.executive.path_executive import PathExecutive
from footfall.systems.planning.motion.motion_planner import MotionPlanner
from footfall.systems.planning.motion.motion_stop import stop_early
from footfall.systems.planning.motion.motion_task import Walker
from footfall.systems.planning.path.path_footstep_planner import PathFootstepPlanner
from footfall.systems.planning.path.path_planner import PathPlanner
from footfall.systems.planning.whole_body.whole_body_plan import planning_body


def build_room_planning(setup: Setup) -> Station:
    """Builds the planners of path, footsteps and motion, and what decides on them.

    Takes `environment`, `frame`, `foot_poses` and what is tracked now,
    `foot_references` and `com_reference`; gives `motion_plan`, `footstep_plan` and
    `status`. Parts: `goal`, `path_planner`, `footstep_planner`, `level_ground`,
    `motion_planner`, `executive`.
    """
    params, robot, task = setup.params, setup.robot, setup.scenario.task
    goal: Vector = np.array(task.goal, dtype=np.float64)
    walker = Walker(
        params.motion_planner,
        params.zmp_preview,
        robot,
        planning_body(robot, setup.model),
    )

    def stop(plan: MotionPlan, time: float) -> MotionPlan | None:
        return stop_early(plan, time, params.footstep_planner.stance_width, walker)

    thinking = params.thinking
    if task.environment is not None:
        # What a file says is known; nothing is perceived.
        thinking = dataclasses.replace(thinking, room_perception=0.0)

    station = StationBuilder("planning", setup.parts)
    station.add("goal", lambda: ConstantVectorSource(goal))
    station.add("path_planner", lambda: PathPlanner(params.path_planner))
    station.add(
        "footstep_planner",
        lambda: PathFootstepPlanner(params.footstep_planner, robot.sole),
    )
    station.add(
        "level_ground", lambda: ConstantValueSource(AbstractValue.Make(Staircase()))
    )
    station.add("motion_planner", lambda: MotionPlanner(walker))
    station.add(
        "executive",
        lambda: PathExecutive(
            params.path_executive, robot.sole, setup.stand.plan, stop, thinking
        ),
    )
    station.connect("goal.y0", "path_planner.goal")
    station.connect(
        "path_planner.path_plan", "footstep_planner.path_plan", "executive.path_plan"
    )
    station.connect(
        "footstep_planner.footstep_plan",
        "motion_planner.footstep_plan",
        "executive.footstep_plan",
    )
    station.connect("level_ground.y0", "motion_planner.staircase")
    station.connect("motion_planner.motion_plan", "executive.motion_plan")
    station.take(
        "environment",
        *(
            f"{part}.environment"
            for part in ("path_planner", "footstep_planner", "executive")
        ),
    )
    station.take("frame", "executive.frame")
    station.take("foot_poses", "path_planner.foot_poses", "footstep_planner.foot_poses")
    for signal in ("foot_references", "com_reference"):
        station.take(signal, f"motion_planner.{signal}")
    for signal in ("motion_plan", "footstep_plan", "status"):
        station.give(signal, f"executive.{signal}")
    station.log("executive.path_plan", "executive.environment")
    return station.build()
