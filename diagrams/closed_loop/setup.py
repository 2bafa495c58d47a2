"""What the stations of a task are built from: scenario, robot, and where it stands."""

from dataclasses import dataclass

import numpy as np
from pydrake.math import RotationMatrix
from pydrake.multibody.plant import MultibodyPlant

from footfall.diagrams.closed_loop.parts import Parts
from footfall.diagrams.controller_params import ControllerParams
from footfall.diagrams.scenario import Scenario
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_task import Mode, MotionTask, Walker
from footfall.systems.tracking.whole_body_ik import IkTarget, WholeBodyIk, solve_posture


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
class Setup:
    """What the stations of a task are built from."""

    scenario: Scenario
    params: ControllerParams
    """The scenario's, shared ones in place."""
    robot: RobotModel
    model: MultibodyPlant
    """The robot alone, for the controllers' kinematics and dynamics."""
    stand: Stand
    parts: Parts
    """What the user has put in the places of ours."""

    @property
    def mode(self) -> Mode:
        """How the robot is to move."""
        slow = self.scenario.task.mode == "quasi_static"
        return "quasi_static" if slow else "dynamic"


def set_up(scenario: Scenario, parts: Parts) -> Setup:
    """Loads the robot of a scenario and solves for the posture it begins in.

    Args:
        scenario: what is to be built.
        parts: the user's own.
    """
    robot = scenario.robot.model()
    model = robot_alone(robot)
    stand = initial_stand(scenario, robot, model)
    return Setup(scenario, scenario.controllers(), robot, model, stand, parts)


def initial_stand(
    scenario: Scenario, robot: RobotModel, model: MultibodyPlant
) -> Stand:
    """Solves for both feet side by side under the start pose, knees bent."""
    start, params = scenario.robot, scenario.controllers()
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
    walker = Walker(planner, params.zmp_preview, robot)
    plan = plan_motion(MotionTask(feet, com), walker)
    ik = WholeBodyIk(model, robot, params.ik)
    return Stand(feet, com, solve_posture(ik, model, target), plan)
