"""Climb a staircase that the robot has scanned (stair paper): its two stations."""

import numpy as np
from pydrake.systems.primitives import ConstantVectorSource

from footfall.diagrams.closed_loop.lidar_scanning import add_lidar
from footfall.diagrams.closed_loop.robot_station import RobotStation
from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.models.robots.collision_hulls import collision_hulls
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.plane_segmenter import PlaneSegmenter
from footfall.systems.perception.staircases.staircase_map import StaircaseMap
from footfall.systems.planning.executive.executive import Executive
from footfall.systems.planning.footsteps.footstep_planner import FootstepPlanner
from footfall.systems.planning.motion.motion_planner import MotionPlanner
from footfall.systems.planning.motion.motion_prediction import MotionPredictor
from footfall.systems.planning.motion.motion_task import Walker
from footfall.systems.planning.whole_body.whole_body_plan import planning_body
from footfall.systems.tracking.whole_body_ik import WholeBodyIk


def build_stair_perception(setup: Setup, true: RobotStation) -> Station:
    """Builds scan and segmentation: what the robot knows of the staircase.

    Takes `true_body_poses`, `body_poses` and `scan`; gives `staircase` and `sweep`, how
    many sweeps are in it. Clouds are in the world of the robot's estimate, whose z is
    along gravity as the estimate has it. Parts: `tilting_lidar`, `scan_assembler`,
    `viewpoint`, `gravity`, `plane_segmenter`, `staircase_map`.
    """
    params = setup.params
    down: Vector = np.array([0.0, 0.0, -1.0])
    station = StationBuilder("perception", setup.parts)
    by_surfaces = params.segmenter.method == "surfaces"
    cell = params.segmenter.voxel_size if by_surfaces else None
    add_lidar(station, setup, true, cell)
    station.add("gravity", lambda: ConstantVectorSource(down))
    station.add(
        "plane_segmenter", lambda: PlaneSegmenter(setup.robot.sole, params.segmenter)
    )
    station.add(
        "staircase_map",
        lambda: StaircaseMap(params.staircase_map, params.thinking.segmentation),
    )
    station.connect("scan_assembler.cloud", "plane_segmenter.cloud")
    if setup.parts.own("scan_assembler") is None:
        station.connect("scan_assembler.cut_cloud", "plane_segmenter.cut_cloud")
    station.connect("gravity.y0", "plane_segmenter.gravity")
    station.connect("viewpoint.position", "plane_segmenter.viewpoint")
    station.connect("plane_segmenter.segmentation", "staircase_map.segmentation")
    station.connect("scan_assembler.sweep", "staircase_map.sweep")
    station.give("staircase", "staircase_map.staircase")
    station.give("sweep", "staircase_map.sweep")
    station.log("staircase_map.staircase", "staircase_map.segmentation")
    return station.build()


def build_stair_planning(setup: Setup) -> Station:
    """Builds the planners of footsteps and motions, and what decides on them.

    Takes `staircase`, `sweep`, `foot_poses` and what is tracked now, `foot_references`
    and `com_reference`; gives `motion_plan`, `footstep_plan`, `scan` and `status`.
    Parts: `footstep_planner`, `motion_planner`, `executive`.
    """
    params, robot, model = setup.params, setup.robot, setup.model
    thinking = params.thinking
    station = StationBuilder("planning", setup.parts)
    station.add(
        "footstep_planner",
        lambda: FootstepPlanner(params.footstep_planner, robot.sole),
    )
    station.add(
        "motion_planner",
        lambda: MotionPlanner(
            Walker(
                params.motion_planner,
                params.zmp_preview,
                robot,
                planning_body(robot, model),
            ),
            setup.mode,
            MotionPredictor(
                model,
                robot,
                WholeBodyIk(model, robot, params.ik),
                params.stabilizer.distribution,
                collision_hulls(robot),
                SelfDistanceMeter(robot),
            ),
        ),
    )
    station.add(
        "executive",
        lambda: Executive(
            params.executive,
            setup.stand.plan,
            thinking.quasi_static_climb_planning
            if setup.mode == "quasi_static"
            else thinking.climb_planning,
        ),
    )
    station.connect(
        "footstep_planner.footstep_plan",
        "motion_planner.footstep_plan",
        "executive.footstep_plan",
    )
    station.connect("motion_planner.motion_plan", "executive.motion_plan")
    station.take("staircase", "footstep_planner.staircase", "motion_planner.staircase")
    station.take("sweep", "executive.sweep")
    station.take("foot_poses", "footstep_planner.foot_poses")
    for signal in ("foot_references", "com_reference"):
        station.take(signal, f"motion_planner.{signal}")
    for signal in ("motion_plan", "footstep_plan", "scan", "status"):
        station.give(signal, f"executive.{signal}")
    return station.build()
