"""The values that motion planning hands on: what is planned, and for which robot."""

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from footfall.models.robots.robot import RobotModel
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.whole_body.whole_body_plan import WholeBody

Mode: TypeAlias = Literal["dynamic", "quasi_static"]
"""How a robot moves: balanced by its ZMP, or with the CoM always over its stance."""


@dataclass(frozen=True)
class MotionTask:
    """What a motion is to be planned for."""

    feet: Vector
    """Poses of both feet at the start, (2, 6), left first, level."""
    com: Vector
    """p_WCom at the start, (3,), at rest, m."""
    footsteps: tuple[Footstep, ...] = ()
    """Where the feet go, in order; none makes a motion that stands."""
    edges: Vector = field(default_factory=lambda: np.zeros((0, 3)))
    """A point of the front edge of each tread, (m, 3), m."""


@dataclass(frozen=True)
class Walker:
    """The robot that a motion is planned for, and how it is to move."""

    params: MotionPlannerParams
    """Timing and shape."""
    preview: ZmpPreviewParams
    """Weights of the ZMP tracking and the cart's height."""
    robot: RobotModel
    """Its soles and legs."""
    body: WholeBody | None = None
    """The whole robot, whose ZMP dynamic motions then keep on the reference (CWTG2);
    None to plan them with a single mass."""
