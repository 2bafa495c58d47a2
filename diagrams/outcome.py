"""The judge: what became of a task, from what truly happened.

It sees the plant's true state, the true contacts and the true scene; of what the
controller believes it takes only that it stopped, and why.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from diagrams.evidence import Evidence
from diagrams.evidence_measures import (
    climb_time,
    com_error,
    crossing_figures,
    dcm_error,
    foot_contacts,
    foot_wrenches,
    footsteps,
    goal_error,
    joint_torques,
    largest_force,
    largest_slip,
    min_static_margin,
    min_zmp_margin,
    steps_climbed,
    worst_fraction,
)
from diagrams.measures import stands_on
from diagrams.true_motion import TrueMotion
from systems.ports import Vector
from systems.values import FEET, Json

Outcome: TypeAlias = Literal[
    "completed", "fell", "infeasible", "timed_out", "interrupted", "cut"
]
FALLEN_HEIGHT = 0.6
"""A robot has fallen when its base is lower above the lower foot than this share of
where it began."""
FALLEN_TILT = np.deg2rad(60.0)
"""A robot has fallen when its torso leans more than this, rad."""
FOOT_SLIP_TOLERANCE = 0.01
"""Slip that the reason mentions, m."""
GOAL_DISTANCE = 0.10
"""Within this the robot is at its goal, m."""
GOAL_TURN = np.deg2rad(10.0)
"""Within this it faces as it should there, rad."""


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """What became of the task; a figure that was not measured is None."""

    outcome: Outcome
    reason: str
    """In one line."""
    footsteps: int | None = None
    steps_climbed: int | None = None
    max_torque_fraction: float | None = None
    max_torque_joint: str | None = None
    max_speed_fraction: float | None = None
    max_speed_joint: str | None = None
    min_zmp_margin_m: float | None = None
    min_static_margin_m: float | None = None
    """Least signed distance of the true CoM to the edge of the static-stability polygon
    of the soles that stand; below zero while a dynamic motion passes over an edge."""
    max_dcm_error_m: float | None = None
    com_rms_error_m: float | None = None
    max_foot_slip_m: float | None = None
    max_impact_body_weights: float | None = None
    min_clearance_m: float | None = None
    goal_error_m: float | None = None
    """Horizontal distance of the feet's midpoint to the goal at the end."""
    goal_turn_rad: float | None = None
    """How far the feet's mean heading is from the goal's at the end."""
    climb_time_s: float | None = None
    """From the first motion until the last foot came to stand on the top tread,
    without the time spent scanning and planning."""
    obstacles_crossed: int | None = None
    crossing_time_s: float | None = None
    """Phases 1 to 3 over an obstacle, the longest: from the first foot's lift-off to
    the second's touch-down."""
    crossing_impact_body_weights: float | None = None
    """Largest force on a foot as it lands beyond an obstacle."""
    min_clearance_body: str | None = None
    """Which part of the robot came nearest to an obstacle."""
    crossing: Mapping[str, Json] | None = None
    """What the planner says of its crossings."""


def has_fallen(base_height: float, initial_height: float, torso_up: float) -> bool:
    """Whether the robot lies or is about to.

    Args:
        base_height: of the base above the lower foot, m.
        initial_height: the same at the start, m.
        torso_up: cosine of the torso's angle to the vertical.
    """
    low = base_height < FALLEN_HEIGHT * initial_height
    return low or torso_up < np.cos(FALLEN_TILT)


def base_height(motion: TrueMotion) -> Vector:
    """Height of the base above the lower foot, (n,), m."""
    feet = np.stack([motion.X_WF[foot][:, 2, 3] for foot in FEET])
    height: Vector = motion.base[:, 2] - feet.min(axis=0)
    return height


def judge(evidence: Evidence) -> Judgement:
    """Measures the run and says what became of the task.

    "completed": the executive finished, both soles rest on the top tread (where there
    is a staircase), the robot stands, no joint went faster than its limit and nothing
    but soles touched the staircase. "fell": see `has_fallen`. "infeasible": the
    executive gave up, or finished without all of the above. "timed_out": the time was
    up, or the solver gave up on a robot that stood. "interrupted": a signal ended the
    run. "cut" is what `load_run` calls a run that was never judged.
    """
    wrenches = foot_wrenches(evidence)
    contacts = foot_contacts(evidence, wrenches)
    torque = worst_fraction(joint_torques(evidence), evidence.limits.torque)
    speed = worst_fraction(evidence.joint_velocities, evidence.limits.speed)
    slip = largest_slip(evidence, wrenches)
    outcome, reason = _verdict(evidence, speed, slip)
    return Judgement(
        outcome=outcome,
        reason=reason,
        footsteps=None if contacts is None else footsteps(evidence, contacts),
        steps_climbed=steps_climbed(evidence, contacts),
        max_torque_fraction=torque[0],
        max_torque_joint=torque[1],
        max_speed_fraction=speed[0],
        max_speed_joint=speed[1],
        min_zmp_margin_m=min_zmp_margin(evidence, wrenches),
        min_static_margin_m=min_static_margin(evidence),
        max_dcm_error_m=dcm_error(evidence),
        com_rms_error_m=com_error(evidence),
        max_foot_slip_m=slip,
        max_impact_body_weights=largest_force(evidence, wrenches),
        **crossing_figures(evidence, wrenches),
        goal_error_m=None if evidence.goal is None else goal_error(evidence)[0],
        goal_turn_rad=None if evidence.goal is None else goal_error(evidence)[1],
        climb_time_s=climb_time(evidence, contacts),
    )


def _verdict(
    evidence: Evidence, speed: tuple[float | None, str | None], slip: float | None
) -> tuple[Outcome, str]:
    height = base_height(evidence.motion)
    if evidence.stop == "fell" or has_fallen(
        height[-1], height[0], evidence.motion.torso_up[-1]
    ):
        when = f"at {evidence.motion.time[-1]:.2f} s"
        return "fell", evidence.stop_reason if evidence.stop == "fell" else (
            f"the robot fell {when}; {evidence.stop_reason}".rstrip("; ")
        )
    if evidence.stop == "infeasible":
        return "infeasible", evidence.stop_reason
    if evidence.stop == "interrupted":
        return "interrupted", evidence.stop_reason
    if evidence.stop != "finished":
        return "timed_out", evidence.stop_reason
    faults = _faults(evidence, speed)
    if faults:
        return "infeasible", "; ".join(faults)
    done = "the robot stands"
    if evidence.treads:
        done = f"both feet rest on the top tread, number {len(evidence.treads)}"
    if evidence.goal is not None:
        done = (
            f"the robot stands {100.0 * goal_error(evidence)[0]:.1f} cm from the goal"
        )
    if slip is not None and slip > FOOT_SLIP_TOLERANCE:
        done += f"; a loaded foot slid by {1e3 * slip:.0f} mm"
    return "completed", done


def _faults(evidence: Evidence, speed: tuple[float | None, str | None]) -> list[str]:
    """What speaks against a task that the executive calls finished."""
    faults = []
    if evidence.treads:
        faults += [
            f"the {foot} sole is not on the top tread"
            for foot in FEET
            if not stands_on(
                evidence.motion.sole_corners[foot][-1], evidence.treads[-1]
            )
        ]
    if evidence.goal is not None:
        distance, turn = goal_error(evidence)
        if distance > GOAL_DISTANCE:
            faults.append(f"the robot stands {distance:.2f} m from the goal")
        if turn > GOAL_TURN:
            faults.append(f"the robot faces {np.degrees(turn):.0f} deg off the goal's")
    fraction, joint = speed
    if fraction is not None and fraction > 1.0:
        faults.append(f"{joint} went at {fraction:.2f} times its speed limit")
    for touch in evidence.touches or ():
        faults.append(
            f"{touch.body} touched {touch.solid} "
            f"({1e3 * touch.duration:.0f} ms, up to {touch.peak_force:.0f} N)"
        )
    return faults
