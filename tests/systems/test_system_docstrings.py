"""Every System's docstring names its ports, exactly and in order.

A new System joins by an entry in `FACTORIES`; one without an entry fails here.
"""

import inspect
import re
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from pydrake.common.value import Value
from pydrake.geometry import SceneGraph
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import LeafSystem

from footfall.diagrams.reference.system_docs import documented_ports, find_systems
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.planned import MotionPlan
from footfall.systems.balance.com_reference import ComReference
from footfall.systems.balance.landing_adaptor import LandingAdaptor, LandingParams
from footfall.systems.balance.stabilizer import Stabilizer, StabilizerParams
from footfall.systems.balance.static_stability import StaticStability
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.balance.zmp_preview_controller import ZmpPreviewController
from footfall.systems.disturbance.box_mover import BoxMover
from footfall.systems.disturbance.pusher import Pusher
from footfall.systems.estimation.base_estimator import BaseEstimator
from footfall.systems.estimation.com_observer import ComObserver, ComObserverParams
from footfall.systems.estimation.contact_detector import (
    ContactDetector,
    ContactParams,
    SoleSize,
)
from footfall.systems.estimation.filter_params import FilterParams
from footfall.systems.perception.depth_cloud import DepthCloud, DepthCloudParams
from footfall.systems.perception.obstacles.obstacle_clusterer import ObstacleClusterer
from footfall.systems.perception.obstacles.obstacle_finder import ObstacleFinder
from footfall.systems.perception.planes.plane_segmenter import PlaneSegmenter
from footfall.systems.perception.room.environment_exchange import EnvironmentExchange
from footfall.systems.perception.room.floor_extractor import FloorExtractor
from footfall.systems.perception.scan_assembler import (
    ScanAssembler,
    ScanAssemblerParams,
)
from footfall.systems.perception.staircases.staircase_map import StaircaseMap
from footfall.systems.planning.crossing.crossing_planner import CrossingPlanner
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.executive.executive import Executive, ExecutiveParams
from footfall.systems.planning.executive.path_executive import (
    PathExecutive,
    PathExecutiveParams,
)
from footfall.systems.planning.executive.stand_executive import StandExecutive
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import FootstepPlanner
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_planner import MotionPlanner
from footfall.systems.planning.motion.motion_player import MotionPlayer
from footfall.systems.planning.motion.motion_task import Walker
from footfall.systems.planning.path.path_footstep_planner import PathFootstepPlanner
from footfall.systems.planning.path.path_planner import PathPlanner
from footfall.systems.planning.whole_body.whole_body_plan import planning_body
from footfall.systems.sensing.ankle_force_sensors import (
    AnkleForceParams,
    AnkleForceSensors,
)
from footfall.systems.sensing.body_poses import BodyPoses
from footfall.systems.sensing.contact_monitor import ContactMonitor
from footfall.systems.sensing.depth_camera import DepthCamera, DepthCameraParams
from footfall.systems.sensing.foot_wrench_sensor import FootWrenchSensor
from footfall.systems.sensing.imu import Imu, ImuParams
from footfall.systems.sensing.joint_encoders import JointEncoderParams, JointEncoders
from footfall.systems.sensing.kinematic_state import KinematicState
from footfall.systems.sensing.mounted_point import MountedPoint
from footfall.systems.sensing.robot_contacts import WatchedGeometry
from footfall.systems.sensing.speed_monitor import SpeedMonitor
from footfall.systems.sensing.tilting_lidar import TiltingLidar, TiltingLidarParams
from footfall.systems.sensing.wanted_torque import WantedTorque
from footfall.systems.signal_log import SignalLog
from footfall.systems.signal_playback import SignalPlayback
from footfall.systems.tracking.ik_tracker import IkTracker
from footfall.systems.tracking.whole_body_feedforward import WholeBodyFeedforward
from footfall.systems.tracking.whole_body_ik import IkParams
from footfall.systems.value_log_sink import ValueLogSink


@cache
def robot_alone() -> tuple[MultibodyPlant, ModelInstanceIndex]:
    """The robot in an empty world, finalised, kept for all factories."""
    plant, scene_graph = MultibodyPlant(time_step=0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    instance = add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    return plant, instance


def _plant() -> MultibodyPlant:
    return robot_alone()[0]


def standing_plan() -> MotionPlan:
    """A plan of one row: both feet on the ground."""
    row = np.zeros((1, 3))
    return MotionPlan(
        start_time=0.0,
        period=0.005,
        footsteps=(),
        phases=(),
        contacts=np.ones((1, 2)),
        foot_poses=np.zeros((1, 2, 6)),
        contact_lengths=np.full((1, 2), JVRC1.sole.length),
        com=row,
        com_velocity=row,
        com_acceleration=row,
        zmp=row,
        cart_zmp=np.zeros((1, 2)),
        waist=row,
    )


FACTORIES: dict[type[LeafSystem], Callable[[], LeafSystem]] = {
    AnkleForceSensors: lambda: AnkleForceSensors(
        AnkleForceParams(), 0.0025, *robot_alone(), JVRC1
    ),
    BaseEstimator: lambda: BaseEstimator(
        _plant(),
        JVRC1,
        FilterParams(),
        _plant().GetPositions(_plant().CreateDefaultContext()),
        0.005,
    ),
    BodyPoses: lambda: BodyPoses(_plant()),
    BoxMover: lambda: BoxMover([]),
    ComObserver: lambda: ComObserver(ComObserverParams()),
    ComReference: ComReference,
    ContactDetector: lambda: ContactDetector(
        ContactParams(), SoleSize(0.075, 0.15, 0.042)
    ),
    ContactMonitor: lambda: ContactMonitor(
        WatchedGeometry((), (), (), frozenset(), {}, {}), 0.002, 600.0
    ),
    Executive: lambda: Executive(ExecutiveParams(), standing_plan()),
    CrossingPlanner: lambda: CrossingPlanner(
        FootstepPlannerParams(),
        MotionPlannerParams(),
        CrossingParams(),
        ZmpPreviewParams(),
        planning_body(JVRC1, _plant()),
        standing_plan(),
    ),
    DepthCamera: lambda: DepthCamera(DepthCameraParams(), scene=triangle_mesh([])),
    DepthCloud: lambda: DepthCloud(DepthCloudParams()),
    EnvironmentExchange: EnvironmentExchange,
    FloorExtractor: FloorExtractor,
    FootWrenchSensor: lambda: FootWrenchSensor(*robot_alone(), JVRC1),
    FootstepPlanner: lambda: FootstepPlanner(FootstepPlannerParams(), JVRC1.sole),
    Imu: lambda: Imu(ImuParams(), 0.0025),
    IkTracker: lambda: IkTracker(
        _plant(), JVRC1, IkParams(), np.zeros(_plant().num_positions())
    ),
    JointEncoders: lambda: JointEncoders(
        JointEncoderParams(), 0.0025, ["knee"], np.zeros(1), 15
    ),
    KinematicState: lambda: KinematicState(_plant(), JVRC1),
    LandingAdaptor: lambda: LandingAdaptor(LandingParams(), np.zeros(12)),
    MotionPlanner: lambda: MotionPlanner(
        Walker(MotionPlannerParams(), ZmpPreviewParams(), JVRC1)
    ),
    MountedPoint: lambda: MountedPoint(1, np.zeros(3)),
    MotionPlayer: lambda: MotionPlayer(320),
    ObstacleClusterer: ObstacleClusterer,
    ObstacleFinder: ObstacleFinder,
    PathExecutive: lambda: PathExecutive(
        PathExecutiveParams(), JVRC1.sole, standing_plan(), lambda plan, time: None
    ),
    PathFootstepPlanner: lambda: PathFootstepPlanner(
        FootstepPlannerParams(), JVRC1.sole
    ),
    PathPlanner: PathPlanner,
    PlaneSegmenter: lambda: PlaneSegmenter(JVRC1.sole),
    Pusher: lambda: Pusher([]),
    ScanAssembler: lambda: ScanAssembler(
        ScanAssemblerParams(),
        beam_angles=np.zeros(3),
        mount_body=1,
        X_BM=RigidTransform(),
    ),
    SignalLog: lambda: SignalLog(0.1),
    SignalPlayback: lambda: SignalPlayback(np.zeros(1), np.zeros((1, 3))),
    SpeedMonitor: lambda: SpeedMonitor(*robot_alone(), 0.0025),
    Stabilizer: lambda: Stabilizer(StabilizerParams(), JVRC1.sole, 62.4),
    StaircaseMap: StaircaseMap,
    StandExecutive: lambda: StandExecutive(standing_plan(), 1.0),
    StaticStability: lambda: StaticStability(0.1, 0.1, 0.05, 0.7),
    TiltingLidar: lambda: TiltingLidar(
        TiltingLidarParams(),
        mount_body=1,
        X_BM=RigidTransform(),
        scene=triangle_mesh([]),
    ),
    ValueLogSink: lambda: ValueLogSink(Value(""), 0.1),
    WantedTorque: lambda: WantedTorque(*robot_alone()),
    WholeBodyFeedforward: lambda: WholeBodyFeedforward(_plant(), JVRC1, 100.0),
    ZmpPreviewController: ZmpPreviewController,
}


@pytest.mark.parametrize("system", find_systems(), ids=lambda s: s.__qualname__)
def test_docstring_names_the_ports(system: type[LeafSystem]) -> None:
    """The block has the class's name and the real ports in their order."""
    assert system in FACTORIES, f"{system.__qualname__} has no entry in FACTORIES"
    instance = FACTORIES[system]()
    real = {
        "name": system.__qualname__,
        "input_ports": [
            instance.get_input_port(index).get_name()
            for index in range(instance.num_input_ports())
        ],
        "output_ports": [
            instance.get_output_port(index).get_name()
            for index in range(instance.num_output_ports())
        ],
    }
    assert documented_ports(system) == real


@pytest.mark.parametrize("system", find_systems(), ids=lambda s: s.__qualname__)
def test_docstring_tells_of_every_port(system: type[LeafSystem]) -> None:
    """Below the block every port has its own line: quantity, frame, shape, unit."""
    text = inspect.getdoc(system) or ""
    block = documented_ports(system)
    for port in {*block["input_ports"], *block["output_ports"]}:
        assert re.search(rf"^\s*- .*`{re.escape(port)}`.*:", text, re.M), port


@pytest.mark.parametrize("system", find_systems(), ids=lambda s: s.__qualname__)
def test_file_is_named_after_its_system(system: type[LeafSystem]) -> None:
    """One public System a file, named after it."""
    snake = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", system.__qualname__).lower()
    assert system.__module__.rpartition(".")[2] == snake


def test_registry_holds_systems_that_exist() -> None:
    """An entry for a System that is gone is a leftover."""
    assert set(FACTORIES) <= set(find_systems())
