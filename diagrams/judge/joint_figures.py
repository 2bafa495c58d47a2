"""What the joints of a run did: speeds, torques, and those that were wanted; pure."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from footfall.diagrams.judge.evidence import Evidence
from footfall.models.values.vector import Vector

AT_LIMIT = 1.0 - 1e-6
"""Share of its limit from which a torque counts as clipped."""


def joint_peaks(evidence: Evidence) -> dict[str, Vector] | None:
    """Reads every joint's largest speed of each control period, (m,) each, rad/s.

    None where the steps were not watched. What was logged of the state counts too: it
    goes on a little longer.
    """
    peaks = by_joint(evidence, "speed_monitor.peak_speeds")
    if not peaks:
        return None
    return {
        joint: np.concatenate([peak, np.abs(evidence.joint_velocities[joint])])
        for joint, peak in peaks.items()
    }


def sample_period(evidence: Evidence) -> float:
    """Between samples of the state, s; 0 where there is one alone."""
    steps = np.diff(evidence.motion.time)
    return float(np.median(steps)) if len(steps) else 0.0


def by_joint(evidence: Evidence, signal: str) -> dict[str, Vector]:
    """Reads a signal with a column an actuator, (n,) each; empty where not logged.

    Raises:
        ValueError: the log has another number of columns than there are actuators.
    """
    frame: pd.DataFrame | None = evidence.frames.get(signal)
    if frame is None:
        return {}
    values = frame.to_numpy(dtype=np.float64)[:, 1:]
    joints = list(evidence.limits.torque)
    if len(joints) != values.shape[1]:
        raise ValueError(
            f"{signal} has {values.shape[1]} columns, expected one for "
            f"each of {len(joints)} actuators"
        )
    return dict(zip(joints, values.T, strict=True))


def worst_fraction(
    values: Mapping[str, Vector] | None, limits: Mapping[str, float]
) -> tuple[float | None, str | None]:
    """Computes the largest share of its limit that a joint reached, and which joint.

    nan, where a value is not a number, is larger than any share.
    """
    fractions = {
        joint: float(np.abs(series).max() / limits[joint])
        for joint, series in (values or {}).items()
        if len(series)
    }
    if not fractions:
        return None, None
    joint = max(fractions, key=lambda name: np.nan_to_num(fractions[name], nan=np.inf))
    return fractions[joint], joint


def time_at_limit(
    torques: Mapping[str, Vector], limits: Mapping[str, float], period: float
) -> tuple[float | None, str | None]:
    """Measures how long any joint's torque was at its limit, s, and which most often.

    Args:
        torques: applied, (n,) each, Nm.
        limits: Nm.
        period: between samples, s.

    Returns:
        None for the time where no torque is known, for the joint where none was.
    """
    if not torques:
        return None, None
    clipped = {
        joint: np.abs(series) >= AT_LIMIT * limits[joint]
        for joint, series in torques.items()
    }
    joint = max(clipped, key=lambda name: int(clipped[name].sum()))
    together = np.any(list(clipped.values()), axis=0)
    return float(together.sum() * period), joint if clipped[joint].any() else None
