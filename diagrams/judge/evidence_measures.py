"""What a run's evidence amounts to: every figure of a judgement, None where unknown."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from footfall.diagrams.judge.crossing_judge import (
    measure_crossing,
    obstacles_crossed,
    planning_summary,
)
from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.evidence_signals import (
    fall,
    felt_forces,
    foot_loads,
    signal_at,
    task_treads,
    upward_force,
)
from footfall.diagrams.judge.ground import end_ground, stands_flat, tread_ground
from footfall.diagrams.judge.measures import (
    contact_intervals,
    foot_slip,
    nosings,
    swing_clearance,
    zmp_margins,
)
from footfall.diagrams.judge.rest import true_dcm
from footfall.diagrams.judge.static_margin import static_margins
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.geometry import wrap_angle
from footfall.models.values.vector import Vector
from footfall.systems.sensing.contact_monitor import LOADED
from footfall.systems.sensing.measured_zmp import measured_zmp

RESTED = 0.2
"""For so long on end, s, a sole is flat and loaded on a tread that it rests on."""


def goal_error(evidence: Evidence) -> tuple[float, float]:
    """Measures the distance to the goal, m, and the turn to its heading, rad."""
    assert evidence.goal is not None
    x, y, yaw = evidence.goal
    feet = np.array([evidence.motion.X_WF[foot][-1] for foot in FEET])
    distance = float(np.hypot(*(feet[:, :2, 3].mean(axis=0) - (x, y))))
    ahead = feet[:, :2, 0].mean(axis=0)
    turn = np.arctan2(ahead[1], ahead[0]) - yaw
    return distance, float(abs(wrap_angle(turn)))


def foot_contacts(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> dict[Foot, list[tuple[int, int]]] | None:
    """Finds when each foot stood, first sample and one after the last; None unknown."""
    if wrenches is None:
        return None
    return {
        foot: [
            (interval.start, interval.end)
            for interval in contact_intervals(
                upward_force(evidence, foot, wrench), evidence.limits.weight
            )
        ]
        for foot, wrench in wrenches.items()
    }


def footsteps(evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]]) -> int:
    """Counts the footsteps: a foot set down over 2 cm from where it was lifted."""
    count = 0
    for foot, intervals in contacts.items():
        p_WF = evidence.motion.X_WF[foot][:, :3, 3]
        for before, after in pairwise(intervals):
            moved = p_WF[after[0]] - p_WF[before[1] - 1]
            count += bool(np.linalg.norm(moved) > 0.02)
    return count


def steps_climbed(evidence: Evidence, loads: dict[Foot, Vector] | None) -> int | None:
    """Counts the treads up to the highest that both feet rested on before any fall.

    None where no stairs were to be climbed or the loads are not known.
    """
    treads = task_treads(evidence)
    if not treads or loads is None:
        return None
    fallen = fall(evidence)
    end = np.inf if fallen is None else fallen.time
    reached = []
    for foot in FEET:
        loaded = (loads[foot] > LOADED * evidence.limits.weight) & (
            evidence.motion.time < end
        )
        corners = evidence.motion.sole_corners[foot]
        reached.append(
            max(
                (
                    number
                    for number, tread in enumerate(treads, start=1)
                    if _longest(
                        evidence.motion.time,
                        loaded & stands_flat(corners, tread_ground(tread, tread.name)),
                    )
                    >= RESTED
                ),
                default=0,
            )
        )
    return min(reached)


def _longest(time: Vector, holds: np.ndarray[tuple[int], np.dtype]) -> float:
    """Measures for how long on end something held at the most, s."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]])))
    spans = [time[end - 1] - time[start] for start, end in edges.reshape(-1, 2)]
    return float(max(spans, default=0.0))


def max_slip(evidence: Evidence, wrenches: dict[Foot, Vector] | None) -> float | None:
    """Farthest that a loaded foot slid, m."""
    slips = [
        foot_slip(
            evidence.motion.sole_corners[foot],
            upward_force(evidence, foot, wrench),
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
    zmp = zmp_of_feet(motion, wrenches, weight)
    corners, left, right = motion.sole_corners, wrenches["left"], wrenches["right"]
    margins = zmp_margins(
        zmp, (corners["left"], corners["right"]), (left[:, 2], right[:, 2]), weight
    )
    finite = margins[np.isfinite(margins)]
    return float(finite.min()) if len(finite) else None


def zmp_of_feet(
    motion: TrueMotion, wrenches: Mapping[Foot, Vector], weight: float
) -> Vector:
    """Computes the measured ZMP, (n, 2), m; nan while the feet bear less than a fifth.

    Args:
        motion: n samples.
        wrenches: on each foot, in its F, (n, 6), N and Nm.
        weight: of the robot, N.
    """
    poses = np.stack([motion.X_WF[foot] for foot in FEET], axis=1)
    both = np.stack([wrenches[foot] for foot in FEET], axis=1)
    return measured_zmp(poses, both, LOADED * weight)[:, :2]


def min_static_margin(
    evidence: Evidence, loads: dict[Foot, Vector] | None
) -> float | None:
    """Least distance of the true CoM to the edge of the static-stability polygon, m."""
    if loads is None:
        return None
    margins = static_margins(
        evidence.motion, loads, evidence.limits.weight, evidence.friction
    )
    finite = margins[np.isfinite(margins)]
    return float(finite.min()) if len(finite) else None


def _largest(evidence: Evidence, signal: str) -> float | None:
    """Computes the largest value of a signal; None where it was not logged."""
    frame = evidence.frames.get(signal)
    if frame is None or not len(frame):
        return None
    return float(frame.to_numpy(dtype=np.float64)[:, 1:].max())


def max_impact(evidence: Evidence) -> float | None:
    """Computes the largest mean upward force on one foot, in body weights."""
    force = _largest(evidence, "contact_monitor.impact")
    return None if force is None else force / evidence.limits.weight


def max_friction_ratio(evidence: Evidence) -> float | None:
    """Computes the largest mean horizontal over mean upward force of a loaded foot."""
    return _largest(evidence, "contact_monitor.friction_ratio")


def min_clearance(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> float | None:
    """Least distance of a swinging sole to the edge of a tread, m."""
    edges = nosings(task_treads(evidence))
    clearances = [
        swing_clearance(
            evidence.motion.sole_corners[foot],
            upward_force(evidence, foot, wrench),
            evidence.limits.weight,
            edges,
        )
        for foot, wrench in (wrenches or {}).items()
    ]
    return min((value for value in clearances if value is not None), default=None)


def crossing_figures(
    evidence: Evidence, wrenches: dict[Foot, Vector] | None
) -> dict[str, Any]:
    """Computes the fields of a judgement that an obstacle crossing adds."""
    crossing = evidence.crossing
    if crossing is None:
        return {"min_clearance_m": min_clearance(evidence, wrenches)}
    loads = foot_loads(evidence)
    felt = felt_forces(evidence)
    measured = [
        found
        for box in crossing.boxes
        if loads is not None
        and (
            found := measure_crossing(
                evidence.motion, loads, felt, evidence.limits.weight, box
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
            (item.impact for item in measured if item.impact is not None),
            default=None,
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
    wanted = signal_at(evidence.motion.time, frame)[:, :3]
    distances = np.linalg.norm(evidence.motion.com - wanted, axis=1)
    return float(np.sqrt(np.mean(distances**2)))


def dcm_error(evidence: Evidence) -> float | None:
    """Largest horizontal distance of the true DCM to that of the reference."""
    frame = _reference(evidence, "com")
    if frame is None or frame.shape[1] < 1 + 6:
        return None
    return float(dcm_distances(evidence.motion, frame).max())


def dcm_distances(motion: TrueMotion, reference: pd.DataFrame) -> Vector:
    """Computes the horizontal distance of the true DCM to the reference's, (n,), m.

    Args:
        motion: of the robot, n samples.
        reference: time, s, then place, m, velocity, m/s, and acceleration of the CoM
            that was wanted, as `reference.com` logs it.
    """
    wanted = signal_at(motion.time, reference)
    moved = replace(
        motion,
        com=np.column_stack([wanted[:, :2], motion.com[:, 2]]),
        com_velocity=wanted[:, 3:6],
    )
    distances: Vector = np.linalg.norm(true_dcm(motion) - true_dcm(moved), axis=1)
    return distances


def climb_time(
    evidence: Evidence, contacts: dict[Foot, list[tuple[int, int]]] | None
) -> float | None:
    """Time spent moving, not scanning or thinking, until the last touch-down on top."""
    treads = task_treads(evidence)
    if contacts is None or evidence.activities is None or not treads:
        return None
    top = end_ground(treads)
    arrivals = []
    for foot, intervals in contacts.items():
        corners = evidence.motion.sole_corners[foot]
        if not intervals or not stands_flat(corners[-1:], top)[0]:
            return None
        arrivals.append(float(evidence.motion.time[intervals[-1][0]]))
    starts = [time for time, _ in evidence.activities]
    ends = [*starts[1:], np.inf]
    return sum(
        max(0.0, min(end, max(arrivals)) - start)
        for (start, activity), end in zip(evidence.activities, ends, strict=True)
        if activity == "move"
    )
