"""What a planned crossing says of itself."""

from dataclasses import dataclass

from systems.obstacle_values import KeyConfiguration, Obstacle
from systems.planning.feet_adaptor import Repairs
from systems.ports import Vector
from systems.values import MotionPlan, Value


@dataclass(frozen=True, eq=False)
class BodyCurves(Value):
    """The planned motion of the whole body over time, n rows (Figs. 8 and 9)."""

    time: Vector
    """(n,), s after the motion's start."""
    waist: Vector
    """Origin of the pelvis in W, (n, 3), m."""
    zmp_cwtg1: Vector
    """p_MB: the multibody ZMP of the motion that CWTG1 plans, x and y, (n, 2), m."""
    zmp_cwtg2: Vector
    """The same of the motion after CWTG2, (n, 2), m."""


@dataclass(frozen=True, eq=False)
class StaticBalance(Value):
    """What a quasi-static motion keeps and what standing in it takes."""

    margin: float
    """Least signed distance of the CoM to the edge of what it stands on, m."""
    torque_share: float
    """Largest share of a joint's effort limit, while the robot crosses."""
    joint: str
    """Which joint's."""
    time: float
    """When, s after the motion's start."""


@dataclass(frozen=True, eq=False)
class CrossingReport(Value):
    """How well a planned motion keeps what it is to keep."""

    gap: float
    """Least distance of the legs to the true size of the obstacles as they were seen,
    m; inf without obstacles."""
    short: float
    """Most that an ankle is out of reach, m."""
    zmp_error_before: tuple[float, float]
    """Largest distance of the multibody ZMP to its reference after CWTG1, along and
    across the heading, over the crossings, m."""
    zmp_error_after: tuple[float, float]
    """The same after CWTG2."""
    repairs: Repairs
    obstacles: tuple[Obstacle, ...] = ()
    """What is crossed."""
    keys: tuple[KeyConfiguration, ...] = ()
    """The key configuration of each."""
    phases: tuple[tuple[float, float], ...] = ()
    """When phase 1 begins and phase 3 ends over each, s after the motion's start."""
    planning_ms: tuple[tuple[str, float], ...] = ()
    """Wall time of FU and of FTG to FTA, ms."""
    torque_share: float = 0.0
    """Largest share of a joint's effort limit that a dynamic crossing takes while one
    foot carries; 0 of a quasi-static one."""
    torque_joint: str = ""
    """Which joint's."""
    balance: StaticBalance | None = None
    """Of a quasi-static motion; None of a dynamic one."""
    curves: BodyCurves | None = None
    """What the figures of a crossing show; None where nothing was planned."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossingMotion(MotionPlan):
    """A motion over obstacles and how well it does."""

    report: CrossingReport
