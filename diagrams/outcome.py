"""The judge: what became of a task, from what truly happened.

It sees the plant's true state, the true contacts and the true scene; of what the
controller believes it takes only that it stopped, and why.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, TypeAlias

import numpy as np
import pandas as pd

from diagrams.crossing_judge import (
    measure_crossing,
    obstacles_crossed,
    planning_summary,
)
from diagrams.evidence import Evidence
from diagrams.measures import (
    contact_intervals,
    foot_slip,
    measured_zmp,
    nosings,
    stands_on,
    swing_clearance,
    zmp_margins,
)
from diagrams.true_motion import TrueMotion
from systems.ports import Vector
from systems.values import FEET, Foot, Json

Outcome: TypeAlias = Literal["completed", "fell", "infeasible", "timed_out"]
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
    up, or the run was interrupted, or the solver gave up on a robot that stood.
    """
    wrenches = _wrenches(evidence)
    contacts = _contacts(evidence, wrenches)
    torque = _worst_fraction(_torques(evidence), evidence.limits.torque)
    speed = _worst_fraction(evidence.joint_velocities, evidence.limits.speed)
    slip = _foot_slip(evidence, wrenches)
    outcome, reason = _verdict(evidence, speed, slip)
    return Judgement(
        outcome=outcome,
        reason=reason,
        footsteps=None if contacts is None else _footsteps(evidence, contacts),
        steps_climbed=_steps_climbed(evidence, contacts),
        max_torque_fraction=torque[0],
        max_torque_joint=torque[1],
        max_speed_fraction=speed[0],
        max_speed_joint=speed[1],
        min_zmp_margin_m=_min_zmp_margin(evidence, wrenches),
        min_static_margin_m=_min_static_margin(evidence),
        max_dcm_error_m=_dcm_error(evidence),
        com_rms_error_m=_com_error(evidence),
        max_foot_slip_m=slip,
        max_impact_body_weights=_impact(evidence, wrenches),
        **_crossing_figures(evidence, wrenches),
        goal_error_m=None if evidence.goal is None else _goal_error(evidence)[0],
        goal_turn_rad=None if evidence.goal is None else _goal_error(evidence)[1],
        climb_time_s=_climb_time(evidence, contacts),
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
            f"the robot stands {100.0 * _goal_error(evidence)[0]:.1f} cm from the goal"
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
        distance, turn = _goal_error(evidence)
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


def _goal_error(evidence: Evidence) -> tuple[float, float]:
    """Distance to the goal, m, and turn to its heading, rad, at the end."""
    assert evidence.goal is not None
    x, y, yaw = evidence.goal
    feet = np.array([evidence.motion.X_WF[foot][-1] for foot in FEET])
    distance = float(np.hypot(*(feet[:, :2, 3].mean(axis=0) - (x, y))))
    ahead = feet[:, :2, 0].mean(axis=0)
    turn = np.arctan2(ahead[1], ahead[0]) - yaw
    return distance, float(abs((turn + np.pi) % (2.0 * np.pi) - np.pi))


def _wrenches(evidence: Evidence) -> dict[Foot, Vector] | None:
    """Each foot's true contact wrench at `motion.time`, (n, 6)."""
    frame = evidence.frames.get("station.foot_wrenches")
    if frame is None:
        return None
    both = _at(evidence.motion.time, frame)
    return {"left": both[:, :6], "right": both[:, 6:12]}


def _at(time: Vector, frame: pd.DataFrame) -> Vector:
    """A signal's columns at other times, (n, columns)."""
    samples = frame.to_numpy(dtype=np.float64)
    columns = [np.interp(time, samples[:, 0], column) for column in samples[:, 1:].T]
    return np.stack(columns, axis=1)


def _normal_force(evidence: Evidence, foot: Foot, wrench: Vector) -> Vector:
    """Upward part of the force on a foot, (n,), N."""
    R_WF = evidence.motion.X_WF[foot][:, :3, :3]
    upward: Vector = np.einsum("nj,nj->n", R_WF[:, 2, :], wrench[:, :3])
    return upward


def _contacts(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> dict[Foot, list[tuple[int, int]]] | None:
    if wrenches is None:
        return None
    return {
        foot: [
            (interval.start, interval.end)
            for interval in contact_intervals(
                _normal_force(evidence, foot, wrench), evidence.limits.weight
            )
        ]
        for foot, wrench in wrenches.items()
    }


def _footsteps(evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]]) -> int:
    """How often a foot was set down elsewhere than it was lifted (by over 2 cm)."""
    count = 0
    for foot, intervals in contacts.items():
        p_WF = evidence.motion.X_WF[foot][:, :3, 3]
        for before, after in pairwise(intervals):
            moved = p_WF[after[0]] - p_WF[before[1] - 1]
            count += bool(np.linalg.norm(moved) > 0.02)
    return count


def _steps_climbed(
    evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]] | None
) -> int | None:
    """The highest tread that both feet have come to stand on or above."""
    if not evidence.treads or contacts is None:
        return None
    reached = []
    for foot, intervals in contacts.items():
        # The end of a contact may be a lifted heel, its start an impact.
        samples = {index for start, end in intervals for index in range(start, end, 5)}
        samples |= {end - 1 for _, end in intervals}
        corners = evidence.motion.sole_corners[foot]
        reached.append(
            max(
                (
                    number
                    for number, tread in enumerate(evidence.treads, start=1)
                    if any(stands_on(corners[index], tread) for index in samples)
                ),
                default=0,
            )
        )
    return min(reached)


def _torques(evidence: Evidence) -> dict[str, Vector]:
    frame = evidence.frames.get("plant.net_actuation")
    if frame is None:
        return {}
    torques = frame.to_numpy(dtype=np.float64)[:, 1:]
    joints = list(evidence.limits.torque)
    if len(joints) != torques.shape[1]:
        raise ValueError(
            f"plant.net_actuation has {torques.shape[1]} columns, expected one for "
            f"each of {len(joints)} actuators"
        )
    return dict(zip(joints, torques.T, strict=True))


def _worst_fraction(
    values: Mapping[str, Vector], limits: Mapping[str, float]
) -> tuple[float | None, str | None]:
    """The largest share of its limit that a joint reached, and which joint."""
    fractions = {
        joint: float(np.abs(series).max() / limits[joint])
        for joint, series in values.items()
        if len(series)
    }
    if not fractions:
        return None, None
    joint = max(fractions, key=fractions.__getitem__)
    return fractions[joint], joint


def _foot_slip(evidence: Evidence, wrenches: dict[Foot, Vector] | None) -> float | None:
    slips = [
        foot_slip(
            evidence.motion.sole_corners[foot],
            _normal_force(evidence, foot, wrench),
            evidence.limits.weight,
        )
        for foot, wrench in (wrenches or {}).items()
    ]
    return max((slip for slip in slips if slip is not None), default=None)


def _min_zmp_margin(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> float | None:
    if wrenches is None:
        return None
    motion, weight = evidence.motion, evidence.limits.weight
    left, right = wrenches["left"], wrenches["right"]
    zmp = measured_zmp(
        (motion.X_WF["left"], motion.X_WF["right"]), (left, right), weight
    )
    margins = zmp_margins(
        zmp,
        (motion.sole_corners["left"], motion.sole_corners["right"]),
        (left[:, 2], right[:, 2]),
        weight,
    )
    finite = margins[np.isfinite(margins)]
    return float(finite.min()) if len(finite) else None


def _min_static_margin(evidence: Evidence) -> float | None:
    frame = evidence.frames.get("static_stability.margin")
    if frame is None:
        return None
    margins = frame.to_numpy(dtype=np.float64)[:, 1]
    finite = margins[np.isfinite(margins)]
    return float(finite.min()) if len(finite) else None


def _impact(evidence: Evidence, wrenches: dict[Foot, Vector] | None) -> float | None:
    """The largest force on one foot, in body weights."""
    if wrenches is None:
        return None
    forces = [np.linalg.norm(wrench[:, :3], axis=1) for wrench in wrenches.values()]
    return float(np.max(forces) / evidence.limits.weight)


def _clearance(evidence: Evidence, wrenches: dict[Foot, Vector] | None) -> float | None:
    edges = nosings(evidence.treads)
    clearances = [
        swing_clearance(
            evidence.motion.sole_corners[foot],
            _normal_force(evidence, foot, wrench),
            evidence.limits.weight,
            edges,
        )
        for foot, wrench in (wrenches or {}).items()
    ]
    return min((value for value in clearances if value is not None), default=None)


def _crossing_figures(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> dict[str, Any]:
    """The fields of a judgement that an obstacle crossing adds."""
    crossing = evidence.crossing
    if crossing is None:
        return {"min_clearance_m": _clearance(evidence, wrenches)}
    forces = {
        foot: np.linalg.norm(wrench[:, :3], axis=1)
        for foot, wrench in (wrenches or {}).items()
    }
    measured = [
        found
        for box in crossing.boxes
        if forces
        and (
            found := measure_crossing(
                evidence.motion, forces, evidence.limits.weight, box
            )
        )
    ]
    nearest = min(crossing.clearances, key=lambda item: item.distance, default=None)
    return {
        "min_clearance_m": nearest.distance if nearest else None,
        "min_clearance_body": nearest.body if nearest else None,
        "obstacles_crossed": obstacles_crossed(evidence.motion, crossing.boxes),
        "crossing_time_s": max((item.time for item in measured), default=None),
        "crossing_impact_body_weights": max(
            (item.impact for item in measured), default=None
        ),
        "crossing": planning_summary(crossing.reports),
    }


def _reference(evidence: Evidence, port: str) -> pd.DataFrame | None:
    for system in ("reference", "stabilizer"):
        frame = evidence.frames.get(f"{system}.{port}")
        if frame is not None:
            return frame
    return None


def _com_error(evidence: Evidence) -> float | None:
    """RMS distance of the true CoM to its reference."""
    frame = _reference(evidence, "com")
    if frame is None:
        return None
    wanted = _at(evidence.motion.time, frame)[:, :3]
    distances = np.linalg.norm(evidence.motion.com - wanted, axis=1)
    return float(np.sqrt(np.mean(distances**2)))


def _dcm_error(evidence: Evidence) -> float | None:
    """Largest horizontal distance of the measured DCM to its reference."""
    measured = evidence.frames.get("balance_state.dcm")
    wanted = _reference(evidence, "dcm")
    if measured is None or wanted is None:
        return None
    time = evidence.motion.time
    difference = _at(time, measured)[:, :2] - _at(time, wanted)[:, :2]
    return float(np.linalg.norm(difference, axis=1).max())


def _climb_time(
    evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]] | None
) -> float | None:
    """Time spent moving until the last touch-down on the top tread."""
    if contacts is None or evidence.activities is None or not evidence.treads:
        return None
    arrivals = []
    for foot, intervals in contacts.items():
        corners = evidence.motion.sole_corners[foot]
        if not intervals or not stands_on(corners[-1], evidence.treads[-1]):
            return None
        arrivals.append(float(evidence.motion.time[intervals[-1][0]]))
    starts = [time for time, _ in evidence.activities]
    ends = [*starts[1:], np.inf]
    return sum(
        max(0.0, min(end, max(arrivals)) - start)
        for (start, activity), end in zip(evidence.activities, ends, strict=True)
        if activity == "move"
    )
