"""What a planned crossing says of itself."""

from dataclasses import dataclass

from footfall.models.values.obstacle import KeyConfiguration, Obstacle
from footfall.models.values.planned import MotionPlan
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import Repairs
from footfall.systems.planning.crossing.params import CrossingParams


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
    way: int = 0
    """Which of `ways_of_crossing` it goes."""
    planning_ms: tuple[tuple[str, float], ...] = ()
    """Wall time of FU and of FTG to FTA, ms."""
    torque_share: float = 0.0
    """Largest share of a joint's effort limit that a dynamic crossing takes while one
    foot carries; 0 of a quasi-static one."""
    torque_joint: str = ""
    """Which joint's."""
    limit_distance: float = float("inf")
    """Least distance of a leg's joint to its limits while the robot crosses, rad."""
    limit_joint: str = ""
    """Which joint's."""
    self_distance: float = float("inf")
    """Least distance of two bodies of the robot while it crosses, m."""
    self_bodies: tuple[str, str] = ("", "")
    """Which two."""
    balance: StaticBalance | None = None
    """Of a quasi-static motion; None of a dynamic one."""
    curves: BodyCurves | None = None
    """What the figures of a crossing show; None where nothing was planned."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossingMotion(MotionPlan):
    """A motion over obstacles and how well it does."""

    report: CrossingReport


def refusal_of(report: CrossingReport, crossing: CrossingParams) -> str:
    """Why a motion is not to be carried out; empty where it is.

    Args:
        report: how well it does.
        crossing: what it has to keep.
    """
    if not report.obstacles:
        return ""
    highest = max(obstacle.height for obstacle in report.obstacles)
    what = f"the obstacle of {highest:.2f} m cannot be crossed"
    if report.gap < crossing.min_gap:
        return (
            f"{what}: a leg comes within {1e3 * report.gap:.0f} mm of it, less "
            f"than {1e3 * crossing.min_gap:.0f} mm, after all repairs"
        )
    if report.short > crossing.max_foot_shortfall:
        return f"{what}: a leg is {1e3 * report.short:.0f} mm too short"
    if report.limit_distance < crossing.min_limit_distance:
        return (
            f"{what}: {report.limit_joint} comes within {report.limit_distance:.2f} "
            f"rad of its limit, less than {crossing.min_limit_distance:.2f} rad"
        )
    if report.torque_share > crossing.max_torque:
        return (
            f"{what}: {report.torque_joint} takes {report.torque_share:.2f} of its "
            f"effort limit, more than {crossing.max_torque:.2f}"
        )
    if report.self_distance < crossing.min_self_distance:
        return (
            f"{what}: {' and '.join(report.self_bodies)} come within "
            f"{1e3 * report.self_distance:.0f} mm of each other, less than "
            f"{1e3 * crossing.min_self_distance:.0f} mm"
        )
    error = max(report.zmp_error_after)
    if error > crossing.max_zmp_error:
        return (
            f"{what}: Eq. 20: the ZMP leaves its reference by {1e3 * error:.0f} mm, "
            f"more than {1e3 * crossing.max_zmp_error:.0f} mm"
        )
    balance, quasi = report.balance, crossing.quasi_static
    if balance is None:
        return ""
    if balance.margin < 0.5 * quasi.margin:
        return (
            f"{what}: Eq. 7: the CoM comes within {1e3 * balance.margin:.0f} mm of "
            f"the support's edge, less than {500.0 * quasi.margin:.0f} mm"
        )
    if balance.torque_share > quasi.torque_share:
        return (
            f"{what}: {balance.joint} takes {balance.torque_share:.2f} of its "
            f"effort limit, more than {quasi.torque_share:.2f}"
        )
    return ""
