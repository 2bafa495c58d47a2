"""What every task shares: from a motion plan to torques, in balance."""

from collections.abc import Callable
from dataclasses import replace

from pydrake.systems.framework import System

from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.systems.balance.com_reference import ComReference
from footfall.systems.balance.landing_adaptor import LandingAdaptor
from footfall.systems.balance.stabilizer import Stabilizer
from footfall.systems.balance.static_stability import StaticStability
from footfall.systems.balance.zmp_preview import preview_gains
from footfall.systems.balance.zmp_preview_controller import ZmpPreviewController
from footfall.systems.planning.motion.motion_player import MotionPlayer
from footfall.systems.tracking.ik_tracker import IkTracker
from footfall.systems.tracking.whole_body_feedforward import WholeBodyFeedforward

MAX_ACCELERATION = 150.0
"""Joint accelerations of the reference are clamped to this, rad/s^2."""


def build_walking_control(setup: Setup) -> Station:
    """Builds the controllers that carry out motion plans.

    Takes `motion_plan`, and of the robot `foot_poses`, `com`, `com_velocity` and
    `touching`; gives `torque`, `joint_references`, what is tracked now,
    `foot_references` and `com_reference`, and `footholds`, where the feet are to stand.
    Parts: `motion_player`, `zmp_preview`, `com_reference`, `landing_adaptor`,
    `ik_tracker`, `feedforward`, `stabilizer`, `static_stability`.
    """
    station = StationBuilder("walking_control", setup.parts)
    for name, make in _makers(setup).items():
        station.add(name, make)
    for source, *targets in _WIRES:
        station.connect(source, *targets)
    station.take("motion_plan", "motion_player.motion_plan")
    station.take("touching", "landing_adaptor.touching")
    station.take(
        "foot_poses", "landing_adaptor.foot_poses", "static_stability.sole_poses"
    )
    station.take("com", "stabilizer.com", "static_stability.com")
    station.take("com_velocity", "stabilizer.com_velocity")
    station.give("footholds", "motion_player.footholds")
    station.give("torque", "feedforward.torque")
    station.give("joint_references", "ik_tracker.joint_references")
    station.give("foot_references", "landing_adaptor.foot_references")
    station.give("com_reference", "com_reference.com_reference")
    return station.build()


def _makers(setup: Setup) -> dict[str, Callable[[], System]]:
    """Says how each of the parts is made."""
    params, robot, model, stand = setup.params, setup.robot, setup.model, setup.stand
    sole = robot.sole
    horizon = preview_gains(params.zmp_preview).horizon
    landing = params.landing
    if landing.search_start is None and setup.mode == "quasi_static":
        # The plan waits for the foot: it may come down as gently as it can.
        landing = replace(landing, search_start=0.0)
    mass = model.CalcTotalMass(model.CreateDefaultContext())
    return {
        "zmp_preview": lambda: ZmpPreviewController(
            params.zmp_preview, (stand.com[0], stand.com[1])
        ),
        "motion_player": lambda: MotionPlayer(horizon),
        "com_reference": ComReference,
        "landing_adaptor": lambda: LandingAdaptor(landing, stand.foot_poses.ravel()),
        "ik_tracker": lambda: IkTracker(model, robot, params.ik, stand.positions),
        "feedforward": lambda: WholeBodyFeedforward(model, robot, MAX_ACCELERATION),
        "stabilizer": lambda: Stabilizer(
            params.stabilizer,
            sole,
            mass,
            sum(len(leg) for leg in robot.leg_joints.values()),
        ),
        "static_stability": lambda: StaticStability(
            sole.heel, sole.toe, sole.half_width, params.friction
        ),
    }


_WIRES = (
    ("motion_player.zmp_preview", "zmp_preview.zmp_preview"),
    ("zmp_preview.com", "com_reference.com"),
    ("zmp_preview.com_velocity", "com_reference.com_velocity"),
    ("zmp_preview.com_acceleration", "com_reference.com_acceleration"),
    ("motion_player.com_height", "com_reference.com_height"),
    ("motion_player.foot_references", "landing_adaptor.foot_references"),
    ("motion_player.contacts", "landing_adaptor.contacts"),
    ("motion_player.plan_start", "landing_adaptor.plan_start"),
    (
        "com_reference.com_reference",
        "ik_tracker.com_reference",
        "stabilizer.com_reference",
    ),
    (
        "landing_adaptor.foot_references",
        "ik_tracker.foot_references",
        "stabilizer.foot_references",
    ),
    (
        "landing_adaptor.contacts",
        "ik_tracker.contacts",
        "stabilizer.contacts",
        "static_stability.contacts",
    ),
    ("motion_player.waist", "ik_tracker.waist"),
    ("motion_player.arms", "ik_tracker.arms"),
    ("motion_player.zmp", "stabilizer.zmp"),
    ("ik_tracker.positions", "feedforward.positions"),
    ("ik_tracker.velocities", "feedforward.velocities"),
    ("ik_tracker.accelerations", "feedforward.accelerations"),
    ("feedforward.momentum_rate", "stabilizer.momentum_rate"),
    ("feedforward.leg_torque_map", "stabilizer.leg_torque_map"),
    ("stabilizer.foot_wrenches", "feedforward.foot_wrenches"),
)
"""Every wire inside the station: a source and what takes it."""
