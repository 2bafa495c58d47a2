"""How well a planned crossing keeps what it is to keep."""

import dataclasses

import numpy as np

from footfall.models.robots.self_distance import SelfDistance
from footfall.models.values.feet import FEET
from footfall.models.values.planned import ContactPhase
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.course import Course
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


def hopeless(
    course: Course,
    motion: BodyMotion,
    zmps: list[Vector],
    repairs: Repairs,
    contacts: Vector,
) -> bool:
    """Whether the motion would be refused however well its ZMP were followed."""
    report = appraise(course, motion, zmps, repairs, contacts)
    followed = dataclasses.replace(report, zmp_error_after=(0.0, 0.0))
    return bool(refusal_of(followed, course.crossing))


def appraise(
    course: Course,
    motion: BodyMotion,
    zmps: list[Vector],
    repairs: Repairs,
    contacts: Vector,
) -> CrossingReport:
    """How well the motion does, from its joints at `rows`."""
    time = course.time[course.rows]
    gaps = leg_gaps(
        course.body.leg,
        motion.angles,
        course.soles(repairs, time),
        course.obstacles,
        tuple(section_of(obstacle) for obstacle in course.obstacles),
        [0.0] * len(course.obstacles),
        course.ground,
    )
    torque, torque_joint = 0.0, ""
    if course.mode == "dynamic":
        torque, torque_joint = _torque(course, motion, contacts)
    limit, limit_joint = _limit(course, motion)
    nearest = _self_distance(course, motion)
    return CrossingReport(
        gap=float(gaps.min()) if gaps.size else float("inf"),
        short=float(motion.short.max()),
        zmp_error_before=_zmp_error(course, zmps[0]),
        zmp_error_after=_zmp_error(course, zmps[-1]),
        repairs=repairs,
        obstacles=course.obstacles,
        keys=course.keys,
        phases=tuple(
            (
                min(step.lift for step in course.steps if step.obstacle == k),
                max(step.land for step in course.steps if step.obstacle == k),
            )
            for k in range(len(course.obstacles))
        ),
        torque_share=torque,
        torque_joint=torque_joint,
        limit_distance=limit,
        limit_joint=limit_joint,
        self_distance=nearest.distance,
        self_bodies=nearest.bodies,
        curves=BodyCurves(time, motion.waist, zmps[0], zmps[-1]),
    )


def _limit(course: Course, motion: BodyMotion) -> tuple[float, str]:
    """How near a leg's joint comes to its limits in a crossing, rad, and which."""
    window = crossing_rows(course.time[course.rows], course.steps)
    if not window.any():
        return float("inf"), ""
    angles, leg = motion.angles[window], course.body.leg
    least = np.minimum(angles - leg.lower, leg.upper - angles).min(axis=0)
    side, joint = np.unravel_index(int(least.argmin()), least.shape)
    names = course.body.robot.leg_joints[FEET[int(side)]]
    return float(least[side, joint]), names[int(joint)]


def _self_distance(course: Course, motion: BodyMotion) -> SelfDistance:
    """The two bodies of the robot that come nearest to each other in a crossing."""
    window = crossing_rows(course.time[course.rows], course.steps)
    looked = motion.q[window][:: max(1, round(SELF_TICK / course.tick))]
    meter = course.body.meter
    return min(
        (meter.nearest(q, SELF_RANGE) for q in looked),
        key=lambda found: found.distance,
        default=SelfDistance(float("inf"), ("", "")),
    )


def _torque(course: Course, motion: BodyMotion, contacts: Vector) -> tuple[float, str]:
    """Largest share of an effort limit while one foot carries in a crossing."""
    window = crossing_rows(course.time[course.rows], course.steps)
    carrying = np.where(window[:, None], contacts[course.rows], 0.0)
    share, joint, _ = single_support_torque(
        course.body,
        course.context,
        motion.q,
        course.tick,
        carrying,
        max(1, round(TORQUE_TICK / course.crossing.sampling)),
    )
    return share, joint


def static_balance(
    course: Course,
    motion: BodyMotion,
    com: Vector,
    poses: Vector,
    contacts: Vector,
    phases: tuple[ContactPhase, ...],
) -> StaticBalance:
    """What a slow motion keeps; torques at a few moments of the crossings."""
    quasi = course.crossing.quasi_static
    looked = np.flatnonzero(crossing_rows(course.time[course.rows], course.steps))
    looked = looked[:: max(1, round(TORQUE_TICK / course.crossing.sampling))]
    at = course.rows[looked]
    share, joint, row = worst_torque(
        course.body,
        course.context,
        motion.q[looked],
        poses[at],
        contacts[at],
        quasi.friction,
    )
    margin = min_margin(
        phases,
        com,
        poses,
        course.walking.period,
        course.body.robot.sole,
        quasi.friction,
    )
    return StaticBalance(margin, share, joint, float(course.time[at[row]]))


def _zmp_error(course: Course, p_MB: Vector) -> tuple[float, float]:
    """Largest ZMP error from phase 1 to 3 of any crossing, x and y of W, m."""
    inside = crossing_rows(course.time[course.rows], course.steps)
    if not inside.any():
        return 0.0, 0.0
    error = np.abs(course.zmp[course.rows, :2] - p_MB)[inside]
    return float(error[:, 0].max()), float(error[:, 1].max())
