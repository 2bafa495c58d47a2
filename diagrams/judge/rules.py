"""The rules that no task may break, whatever else becomes of it; pure."""

import numpy as np

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.evidence_measures import goal_error
from footfall.diagrams.judge.evidence_signals import CLIMBING
from footfall.diagrams.judge.rest import LONGEST_GAP
from footfall.diagrams.task_params import TASKS

GOAL_DISTANCE = 0.10
"""Within this the robot is at its goal, m."""
GOAL_TURN = np.deg2rad(10.0)
"""Within this it faces as it should there, rad."""
SLIP_MENTIONED = 0.01
"""Slip that the reason mentions, m."""
SLIP_ALLOWED = 0.03
"""A loaded foot slides no farther than this, m."""


def broken_rules(
    evidence: Evidence, speed: tuple[float | None, str | None], slip: float | None
) -> list[str]:
    """Lists the rules that a run broke, one line each.

    No joint is faster than its limit, no loaded foot slides by more than
    `SLIP_ALLOWED`, nothing is touched that must not be; in a task that is finished the
    goal is reached.

    Args:
        evidence: of the run.
        speed: the largest share of a joint's speed limit, and which joint; None where
            it was not watched.
        slip: the farthest that a loaded foot slid, m; None where it was not measured.
    """
    rules = _goal_faults(evidence) if evidence.stop == "finished" else []
    fraction, joint = speed
    if fraction is not None and not fraction <= 1.0:
        rules.append(f"{joint} went at {fraction:.2f} times its speed limit")
    if slip is not None and not slip <= SLIP_ALLOWED:
        rules.append(f"a loaded foot slid by {1e3 * slip:.0f} mm")
    for touch in evidence.touches or ():
        rules.append(
            f"{touch.body} touched {touch.solid} "
            f"({1e3 * touch.duration:.0f} ms, up to {touch.peak_force:.0f} N)"
        )
    return rules


def missing_evidence(
    evidence: Evidence, speed: float | None, slip: float | None
) -> list[str]:
    """Lists what of a run was not watched, so that its rules may have been broken.

    Args:
        evidence: of the run.
        speed: the largest share of a joint's speed limit.
        slip: the farthest that a loaded foot slid, m.
    """
    known = (
        (
            speed is not None and _covers(evidence, "speed_monitor.peak_speeds"),
            "the joints' speeds were not watched",
        ),
        (slip is not None, "the feet's slip was not measured"),
        (
            _covers(evidence, "contact_monitor.other_support"),
            "what others than the soles bore was not watched",
        ),
        (evidence.touches is not None, "what the robot touched was not watched"),
    )
    return [missing for there, missing in known if not there]


def _covers(evidence: Evidence, signal: str) -> bool:
    """Tells whether a signal was logged, in numbers, from a run's start to its end."""
    frame = evidence.frames.get(signal)
    if frame is None or not len(frame):
        return False
    samples = frame.to_numpy(dtype=np.float64)
    time = np.concatenate([evidence.motion.time[:1], samples[:, 0]])
    ends = evidence.motion.time[-1] - samples[-1, 0] <= LONGEST_GAP
    gaps = np.diff(time).max(initial=0.0) <= LONGEST_GAP
    return bool(ends and gaps and np.isfinite(samples).all())


def _goal_faults(evidence: Evidence) -> list[str]:
    """Says how a task that the executive calls finished missed its goal."""
    if evidence.kind == CLIMBING:
        return [] if evidence.treads else ["there is no staircase to climb"]
    if evidence.goal is None:
        return ["its goal is not known"] if evidence.kind in TASKS else []
    faults = []
    distance, turn = goal_error(evidence)
    if not distance <= GOAL_DISTANCE:
        faults.append(f"the robot stands {distance:.2f} m from the goal")
    if not turn <= GOAL_TURN:
        faults.append(f"the robot faces {np.degrees(turn):.0f} deg off the goal's")
    return faults
