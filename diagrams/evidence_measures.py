"""What a run's evidence amounts to: every figure of a judgement, None where unknown."""

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

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
from systems.ports import Vector
from systems.values import FEET, Foot


def goal_error(evidence: Evidence) -> tuple[float, float]:
    """Distance to the goal, m, and turn to its heading, rad, at the end."""
    assert evidence.goal is not None
    x, y, yaw = evidence.goal
    feet = np.array([evidence.motion.X_WF[foot][-1] for foot in FEET])
    distance = float(np.hypot(*(feet[:, :2, 3].mean(axis=0) - (x, y))))
    ahead = feet[:, :2, 0].mean(axis=0)
    turn = np.arctan2(ahead[1], ahead[0]) - yaw
    return distance, float(abs((turn + np.pi) % (2.0 * np.pi) - np.pi))


def foot_wrenches(evidence: Evidence) -> dict[Foot, Vector] | None:
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


def foot_contacts(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> dict[Foot, list[tuple[int, int]]] | None:
    """When each foot stood, first sample and the one after the last; None unknown."""
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


def footsteps(evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]]) -> int:
    """How often a foot was set down elsewhere than it was lifted (by over 2 cm)."""
    count = 0
    for foot, intervals in contacts.items():
        p_WF = evidence.motion.X_WF[foot][:, :3, 3]
        for before, after in pairwise(intervals):
            moved = p_WF[after[0]] - p_WF[before[1] - 1]
            count += bool(np.linalg.norm(moved) > 0.02)
    return count


def steps_climbed(
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


def joint_torques(evidence: Evidence) -> dict[str, Vector]:
    """Applied torques by joint, (n,) each, Nm; empty where they were not logged.

    Raises:
        ValueError: the log has another number of columns than there are actuators.
    """
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


def worst_fraction(
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


def largest_slip(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> float | None:
    """Farthest that a loaded foot slid, m."""
    slips = [
        foot_slip(
            evidence.motion.sole_corners[foot],
            _normal_force(evidence, foot, wrench),
            evidence.limits.weight,
        )
        for foot, wrench in (wrenches or {}).items()
    ]
    return max((slip for slip in slips if slip is not None), default=None)


def min_zmp_margin(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> float | None:
    """Least distance of the true ZMP to the edge of the support polygon, m."""
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


def min_static_margin(evidence: Evidence) -> float | None:
    """Least distance of the true CoM to the edge of the static-stability polygon, m."""
    frame = evidence.frames.get("static_stability.margin")
    if frame is None:
        return None
    margins = frame.to_numpy(dtype=np.float64)[:, 1]
    finite = margins[np.isfinite(margins)]
    return float(finite.min()) if len(finite) else None


def largest_force(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> float | None:
    """The largest force on one foot, in body weights."""
    if wrenches is None:
        return None
    forces = [np.linalg.norm(wrench[:, :3], axis=1) for wrench in wrenches.values()]
    return float(np.max(forces) / evidence.limits.weight)


def least_clearance(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> float | None:
    """Least distance of a swinging sole to the edge of a tread, m."""
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


def crossing_figures(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> dict[str, Any]:
    """The fields of a judgement that an obstacle crossing adds."""
    crossing = evidence.crossing
    if crossing is None:
        return {"min_clearance_m": least_clearance(evidence, wrenches)}
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


def com_error(evidence: Evidence) -> float | None:
    """RMS distance of the true CoM to its reference."""
    frame = _reference(evidence, "com")
    if frame is None:
        return None
    wanted = _at(evidence.motion.time, frame)[:, :3]
    distances = np.linalg.norm(evidence.motion.com - wanted, axis=1)
    return float(np.sqrt(np.mean(distances**2)))


def dcm_error(evidence: Evidence) -> float | None:
    """Largest horizontal distance of the measured DCM to its reference."""
    measured = evidence.frames.get("balance_state.dcm")
    wanted = _reference(evidence, "dcm")
    if measured is None or wanted is None:
        return None
    time = evidence.motion.time
    difference = _at(time, measured)[:, :2] - _at(time, wanted)[:, :2]
    return float(np.linalg.norm(difference, axis=1).max())


def climb_time(
    evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]] | None
) -> float | None:
    """Time spent moving, not scanning or thinking, until the last touch-down on top."""
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
