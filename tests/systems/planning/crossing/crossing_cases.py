"""The robot, obstacles and footsteps that several tests of crossings plan with."""

from functools import cache

import numpy as np
from pydrake.math import RigidTransform
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.values.feet import Foot
from footfall.models.values.obstacle import Feasibility, KeyConfiguration, Obstacle
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.crossing.feasibility_unit import feasibility_unit
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.crossing.motion import plan_crossing
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.crossing.quasi_static_check import balance_of
from footfall.systems.planning.crossing.quasi_static_unit import quasi_static_unit
from footfall.systems.planning.crossing.report import CrossingMotion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    planning_body,
)

WAIST = 0.79
"""Height of the hips in walking, m."""


@cache
def body() -> WholeBody:
    """JVRC-1 as plans are made with it."""
    return planning_body(JVRC1, robot_alone(JVRC1))


def scratch() -> Context:
    """A context of the body's plant."""
    return body().plant.CreateDefaultContext()


def feasibility(section: Section, params: CrossingParams, mode: Mode) -> Feasibility:
    """FU's answer."""
    leg, margins = body().leg, params.feasibility
    if mode == "dynamic":
        return feasibility_unit(section, WAIST, leg, margins)
    quasi = params.quasi_static
    balance = balance_of(body(), scratch(), quasi)
    return quasi_static_unit(section, WAIST, leg, margins, quasi, balance)


def key_of(
    section: Section, params: CrossingParams, mode: Mode = "dynamic"
) -> KeyConfiguration:
    """The key configuration of an obstacle that can be straddled."""
    answer = feasibility(section, params, mode)
    assert answer.key is not None, answer.constraint
    return answer.key


def footstep(foot: Foot, x: float, plane: int = -1) -> Footstep:
    """A level footstep beside the x axis."""
    p: Vector = np.array([x, 0.095 if foot == "left" else -0.095, 0.0])
    return Footstep(foot=foot, X_WF=RigidTransform(p), plane=plane)


def planned(
    width: float,
    height: float,
    params: CrossingParams | None = None,
    mode: Mode = "dynamic",
) -> tuple[CrossingMotion, Obstacle]:
    """A motion of five steps over an obstacle, and the obstacle."""
    params = params or CrossingParams()
    key = key_of(Section(width, height), params, mode)
    centre: Vector = np.array([0.2 + key.front + width / 2.0, 0.0])
    obstacle = Obstacle(centre, 0.0, width, height, 1.0)
    beyond = 0.2 + key.X_ads
    steps = (
        footstep("left", 0.2),
        footstep("right", 0.2),
        footstep("left", beyond, 0),
        footstep("right", beyond, 0),
        footstep("left", beyond + 0.1),
        footstep("right", beyond + 0.1),
    )
    feet: Vector = np.zeros((2, 6))
    feet[:, 1] = [0.095, -0.095]
    com: Vector = np.array([0.035, 0.0, 0.83])
    motion = plan_crossing(
        feet,
        com,
        steps,
        (obstacle,),
        (key,),
        MotionPlannerParams(com_height=0.83),
        params,
        ZmpPreviewParams(com_height=0.85),
        body(),
        scratch(),
        mode,
    )
    return motion, obstacle
