"""How well a planned crossing keeps what it is to keep."""

import dataclasses

import numpy as np

from footfall.models.robots.self_distance import SelfDistance
from footfall.models.values.feet import FEET
from footfall.models.values.planned import ContactPhase
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.crossing_problem import CrossingProblem
from footfall.systems.planning.crossing.feet import crossing_rows, section_of
from footfall.systems.planning.crossing.feet_adaptor import Repairs, leg_gaps
from footfall.systems.planning.crossing.quasi_static_check import (
    min_margin,
    worst_torque,
)
from footfall.systems.planning.crossing.report import (
    BodyCurves,
    CrossingReport,
    StaticBalance,
    refusal_of,
)
from footfall.systems.planning.crossing.single_support_torque import (
    single_support_torque,
)
from footfall.systems.planning.whole_body.whole_body_plan import BodyMotion

SELF_TICK = 0.03
"""Between the postures of a crossing in which the robot's own bodies are held against
each other, s."""
SELF_RANGE = 0.03
"""Bodies of the robot farther from each other than this are not looked at, m."""
TORQUE_TICK = 0.1
"""Between the postures of a crossing whose torques are looked at, s."""


def refused_even_if_balanced(
    problem: CrossingProblem,
    motion: BodyMotion,
    zmps: list[Vector],
    repairs: Repairs,
    contacts: Vector,
) -> bool:
    """Tells whether a motion would be refused even if its ZMP were followed exactly."""
    report = appraise(problem, motion, zmps, repairs, contacts)
    followed = dataclasses.replace(report, zmp_error_after=(0.0, 0.0))
    return bool(refusal_of(followed, problem.crossing))


def appraise(
    problem: CrossingProblem,
    motion: BodyMotion,
    zmps: list[Vector],
    repairs: Repairs,
    contacts: Vector,
) -> CrossingReport:
    """Evaluates a crossing motion: gaps, ZMP, limits, torques, self-distance."""
    time = problem.schedule.time[problem.rows]
    gaps = leg_gaps(
        problem.body.leg,
        motion.angles,
        problem.soles(repairs, time),
        problem.obstacles,
        tuple(section_of(obstacle) for obstacle in problem.obstacles),
        [0.0] * len(problem.obstacles),
        problem.ground,
    )
    torque, torque_joint = 0.0, ""
    if problem.mode == "dynamic":
        torque, torque_joint = _torque(problem, motion, contacts)
    limit, limit_joint = _limit(problem, motion)
    nearest = _self_distance(problem, motion)
    return CrossingReport(
        gap=float(gaps.min()) if gaps.size else float("inf"),
        short=float(motion.short.max()),
        zmp_error_before=_zmp_error(problem, zmps[0]),
        zmp_error_after=_zmp_error(problem, zmps[-1]),
        repairs=repairs,
        obstacles=problem.obstacles,
        keys=problem.keys,
        phases=tuple(
            (
                min(step.lift for step in problem.schedule.steps if step.obstacle == k),
                max(step.land for step in problem.schedule.steps if step.obstacle == k),
            )
            for k in range(len(problem.obstacles))
        ),
        torque_share=torque,
        torque_joint=torque_joint,
        limit_distance=limit,
        limit_joint=limit_joint,
        self_distance=nearest.distance,
        self_bodies=nearest.bodies,
        curves=BodyCurves(time, motion.waist, zmps[0], zmps[-1]),
    )


def _limit(problem: CrossingProblem, motion: BodyMotion) -> tuple[float, str]:
    """Computes the least distance of a leg joint to its limits, rad, and which."""
    window = crossing_rows(problem.schedule.time[problem.rows], problem.schedule.steps)
    if not window.any():
        return float("inf"), ""
    angles, leg = motion.angles[window], problem.body.leg
    least = np.minimum(angles - leg.lower, leg.upper - angles).min(axis=0)
    side, joint = np.unravel_index(int(least.argmin()), least.shape)
    names = problem.body.robot.leg_joints[FEET[int(side)]]
    return float(least[side, joint]), names[int(joint)]


def _self_distance(problem: CrossingProblem, motion: BodyMotion) -> SelfDistance:
    """Finds the two bodies of the robot that come nearest to each other."""
    window = crossing_rows(problem.schedule.time[problem.rows], problem.schedule.steps)
    looked = motion.q[window][:: max(1, round(SELF_TICK / problem.tick))]
    meter = problem.body.meter
    return min(
        (meter.nearest(q, SELF_RANGE) for q in looked),
        key=lambda found: found.distance,
        default=SelfDistance(float("inf"), ("", "")),
    )


def _torque(
    problem: CrossingProblem, motion: BodyMotion, contacts: Vector
) -> tuple[float, str]:
    """Computes the largest share of an effort limit in single support."""
    window = crossing_rows(problem.schedule.time[problem.rows], problem.schedule.steps)
    carrying = np.where(window[:, None], contacts[problem.rows], 0.0)
    share, joint, _ = single_support_torque(
        problem.body,
        problem.context,
        motion.q,
        problem.tick,
        carrying,
        max(1, round(TORQUE_TICK / problem.crossing.sampling)),
    )
    return share, joint


def static_balance(
    problem: CrossingProblem,
    motion: BodyMotion,
    com: Vector,
    poses: Vector,
    contacts: Vector,
    phases: tuple[ContactPhase, ...],
) -> StaticBalance:
    """Computes margin and torques of a quasi-static motion at rest."""
    quasi = problem.crossing.quasi_static
    looked = np.flatnonzero(
        crossing_rows(problem.schedule.time[problem.rows], problem.schedule.steps)
    )
    looked = looked[:: max(1, round(TORQUE_TICK / problem.crossing.sampling))]
    at = problem.rows[looked]
    share, joint, row = worst_torque(
        problem.body,
        problem.context,
        motion.q[looked],
        poses[at],
        contacts[at],
        quasi.friction,
    )
    margin = min_margin(
        phases,
        com,
        poses,
        problem.walking.period,
        problem.body.robot.sole,
        quasi.friction,
    )
    return StaticBalance(margin, share, joint, float(problem.schedule.time[at[row]]))


def _zmp_error(problem: CrossingProblem, p_MB: Vector) -> tuple[float, float]:
    """Computes the largest ZMP error from phase 1 to 3, x and y of W, m."""
    inside = crossing_rows(problem.schedule.time[problem.rows], problem.schedule.steps)
    if not inside.any():
        return 0.0, 0.0
    error = np.abs(problem.schedule.zmp[problem.rows, :2] - p_MB)[inside]
    return float(error[:, 0].max()), float(error[:, 1].max())
