"""What every task shares: from a motion plan to torques, in balance."""

from dataclasses import dataclass

import numpy as np
from pydrake.math import RotationMatrix
from pydrake.systems.framework import DiagramBuilder, OutputPort, System

from footfall.diagrams.closed_loop.station import Station
from footfall.diagrams.closed_loop.wiring import add_system
from footfall.diagrams.scenario import Scenario
from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.com_reference import ComReference
from footfall.systems.balance.landing_adaptor import LandingAdaptor
from footfall.systems.balance.stabilizer import Stabilizer
from footfall.systems.balance.static_stability import StaticStability
from footfall.systems.balance.zmp_preview_controller import ZmpPreviewController
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_player import MotionPlayer
from footfall.systems.tracking.ik_tracker import IkTracker
from footfall.systems.tracking.whole_body_feedforward import WholeBodyFeedforward
from footfall.systems.tracking.whole_body_ik import IkTarget, WholeBodyIk, solve_posture

MAX_ACCELERATION = 150.0
"""Joint accelerations of the reference are clamped to this, rad/s^2."""


@dataclass(frozen=True)
class Stand:
    """Where the robot stands at the start."""

    foot_poses: Vector
    """Sole frames X_WF, (2, 6), left first."""
    com: Vector
    """p_WCom, (3,), m."""
    positions: Vector
    """q of the robot, (nq,)."""
    plan: MotionPlan
    """The motion that stays there."""


@dataclass(frozen=True)
class Walking:
    """The walking controllers, wired to each other.

    Subsystems: `motion_player`, `zmp_preview`, `com_reference`, `landing_adaptor`,
    `ik_tracker`, `feedforward`, `stabilizer`, `static_stability`.
    """

    player: MotionPlayer
    preview: ZmpPreviewController
    com_reference: OutputPort
    """p_WCom, v_WCom, a_WCom, (9,)."""
    landing: LandingAdaptor
    tracker: IkTracker
    feedforward: WholeBodyFeedforward
    stabilizer: Stabilizer
    stability: StaticStability


def initial_stand(scenario: Scenario, station: Station) -> Stand:
    """Both feet side by side under the start pose, knees bent."""
    start, params = scenario.robot, scenario.controllers()
    model, robot = station.model, station.robot
    turn: Vector = RotationMatrix.MakeZRotation(start.yaw).matrix()
    origin = np.array([start.x, start.y, 0.0])
    half = 0.5 * params.footstep_planner.stance_width
    feet: Vector = np.zeros((2, 6))
    for foot, side in zip(feet, (half, -half), strict=True):
        foot[:3] = origin + turn @ np.array([0.0, side, 0.0])
        foot[5] = start.yaw
    planner = params.motion_planner
    com: Vector = origin + turn @ np.array([planner.zmp_forward, 0.0, 0.0])
    com[2] = planner.com_height
    nothing: Vector = np.zeros(3)
    waist: Vector = np.array([0.0, 0.0, start.yaw])
    target = IkTarget(
        com=com,
        com_velocity=nothing,
        foot_poses=feet,
        foot_rates=np.zeros((2, 6)),
        stance=np.ones(2),
        waist=waist,
        waist_rate=nothing,
    )
    nowhere: Vector = np.zeros((0, 3))
    plan = plan_motion(feet, com, (), nowhere, planner, params.zmp_preview, robot)
    ik = WholeBodyIk(model, robot, params.ik)
    return Stand(feet, com, solve_posture(ik, model, target), plan)


def add_walking(
    builder: DiagramBuilder,
    scenario: Scenario,
    station: Station,
    stand: Stand,
    executive: System,
    planner: System | None,
) -> Walking:
    """Adds the controllers that carry out motion plans.

    Args:
        builder: of the diagram.
        scenario: its parameters.
        station: robot and scene.
        stand: where the robot stands at the start.
        executive: its `motion_plan` is what is carried out.
        planner: of motions; it goes on from the `foot_references` and the
            `com_reference` that are tracked now. None where nothing is planned.

    Returns:
        The controllers, wired to the station.
    """
    params = scenario.controllers()
    model, robot = station.model, station.robot

    preview = add_system(
        builder,
        "zmp_preview",
        ZmpPreviewController(params.zmp_preview, (stand.com[0], stand.com[1])),
    )
    player = add_system(builder, "motion_player", MotionPlayer(preview.gains.horizon))
    builder.Connect(
        executive.GetOutputPort("motion_plan"), player.GetInputPort("motion_plan")
    )
    builder.Connect(
        player.GetOutputPort("zmp_preview"), preview.GetInputPort("zmp_preview")
    )
    joined = add_system(builder, "com_reference", ComReference())
    for port in ("com", "com_velocity", "com_acceleration"):
        builder.Connect(preview.GetOutputPort(port), joined.GetInputPort(port))
    builder.Connect(
        player.GetOutputPort("com_height"), joined.GetInputPort("com_height")
    )
    com_reference = joined.GetOutputPort("com_reference")

    landing = add_system(
        builder,
        "landing_adaptor",
        LandingAdaptor(params.landing, stand.foot_poses.ravel()),
    )
    for port in ("foot_references", "contacts", "plan_start"):
        builder.Connect(player.GetOutputPort(port), landing.GetInputPort(port))
    builder.Connect(
        station.wrench_sensor.GetOutputPort("foot_wrenches"),
        landing.GetInputPort("foot_wrenches"),
    )
    builder.Connect(
        station.kinematics.GetOutputPort("foot_poses"),
        landing.GetInputPort("foot_poses"),
    )
    if planner is not None:
        builder.Connect(
            landing.GetOutputPort("foot_references"),
            planner.GetInputPort("foot_references"),
        )
        builder.Connect(com_reference, planner.GetInputPort("com_reference"))

    tracker = add_system(
        builder, "ik_tracker", IkTracker(model, robot, params.ik, stand.positions)
    )
    builder.Connect(com_reference, tracker.GetInputPort("com_reference"))
    for port in ("foot_references", "contacts"):
        builder.Connect(landing.GetOutputPort(port), tracker.GetInputPort(port))
    for port in ("waist", "arms"):
        builder.Connect(player.GetOutputPort(port), tracker.GetInputPort(port))
    builder.Connect(
        tracker.GetOutputPort("joint_references"),
        station.plant.get_desired_state_input_port(station.instance),
    )
    builder.Connect(
        tracker.GetOutputPort("joint_references"),
        station.wanted_torque.GetInputPort("desired_state"),
    )

    feedforward = add_system(
        builder, "feedforward", WholeBodyFeedforward(model, robot, MAX_ACCELERATION)
    )
    for port in ("positions", "velocities", "accelerations"):
        builder.Connect(tracker.GetOutputPort(port), feedforward.GetInputPort(port))

    stabilizer = add_system(
        builder,
        "stabilizer",
        Stabilizer(
            params.stabilizer,
            robot.sole,
            model.CalcTotalMass(model.CreateDefaultContext()),
            sum(len(leg) for leg in robot.leg_joints.values()),
        ),
    )
    for port in ("com", "com_velocity"):
        builder.Connect(
            station.kinematics.GetOutputPort(port), stabilizer.GetInputPort(port)
        )
    builder.Connect(com_reference, stabilizer.GetInputPort("com_reference"))
    builder.Connect(player.GetOutputPort("zmp"), stabilizer.GetInputPort("zmp"))
    for port in ("foot_references", "contacts"):
        builder.Connect(landing.GetOutputPort(port), stabilizer.GetInputPort(port))
    for port in ("momentum_rate", "leg_torque_map"):
        builder.Connect(feedforward.GetOutputPort(port), stabilizer.GetInputPort(port))
    builder.Connect(
        stabilizer.GetOutputPort("foot_wrenches"),
        feedforward.GetInputPort("foot_wrenches"),
    )
    builder.Connect(
        feedforward.GetOutputPort("torque"), station.torque.get_input_port()
    )

    sole = robot.sole
    stability = add_system(
        builder,
        "static_stability",
        StaticStability(
            sole.heel,
            sole.toe,
            sole.half_width,
            params.friction,
        ),
    )
    for source, port, target in (
        (station.kinematics, "foot_poses", "sole_poses"),
        (station.kinematics, "com", "com"),
        (landing, "contacts", "contacts"),
    ):
        builder.Connect(source.GetOutputPort(port), stability.GetInputPort(target))
    return Walking(
        player,
        preview,
        com_reference,
        landing,
        tracker,
        feedforward,
        stabilizer,
        stability,
    )
