"""What the robot believed of itself against what was true, pure."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from footfall.diagrams.closed_loop.estimation_signals import (
    BELIEVED_COM_SIGNAL,
    BELIEVED_VELOCITY_SIGNAL,
    DEVIATION_SIGNAL,
    ESTIMATE_SIGNAL,
    FAULTS_SIGNAL,
    TOUCHING_SIGNAL,
)
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.diagrams.signal_names import STATE_SIGNAL
from footfall.models.values.value import Json
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import GRAVITY

TOUCHED = 1.0
"""A foot that truly bears more than this, N, is on the ground."""
LEAST_WAY = 0.2
"""Over a shorter way, or climb, m, a drift in per cent says nothing."""


@dataclass(frozen=True)
class EstimateErrors:
    """Belief less truth at the ticks at which both were logged."""

    time: Vector
    """(n,), s."""
    position: Vector
    """Of the base, (n, 3), m."""
    turn: Vector
    """Of the base, about W's axes, (n, 3), rad."""
    velocity: Vector
    """Of the base, (n, 3), m/s."""
    way: Vector
    """True base, (n, 3), m."""
    deviation: Vector | None
    """What the estimator says of turn, velocity and position, (n, 9); None unknown."""


def estimate_errors(frames: Mapping[str, pd.DataFrame]) -> EstimateErrors | None:
    """Compares the logged estimate with the logged truth; None without an estimate.

    Row for row: what controllers acted on at a tick against the plant's state at it, so
    that the sensors' latency is part of the error.

    Args:
        frames: the signals, by name.
    """
    if ESTIMATE_SIGNAL not in frames or STATE_SIGNAL not in frames:
        return None
    true = frames[STATE_SIGNAL].to_numpy(dtype=np.float64)
    believed = frames[ESTIMATE_SIGNAL].to_numpy(dtype=np.float64)
    # The plant's state is logged at the ticks of the estimate, and one may be cut.
    time, rows, columns = np.intersect1d(
        true[:, 0], believed[:, 0], return_indices=True
    )
    if not len(time):
        return None
    true, believed = true[rows, 1:], believed[columns, 1:]
    deviation = None
    if DEVIATION_SIGNAL in frames:
        logged = frames[DEVIATION_SIGNAL].to_numpy(dtype=np.float64)
        deviation = logged[np.searchsorted(logged[:, 0], time), 1:]
    joints = (true.shape[1] - 13) // 2
    velocity = slice(7 + joints + 3, 7 + joints + 6)
    turns = [
        Rotation.from_quat(state[:, :4], scalar_first=True)
        for state in (believed, true)
    ]
    return EstimateErrors(
        time,
        believed[:, 4:7] - true[:, 4:7],
        (turns[0] * turns[1].inv()).as_rotvec(),
        believed[:, velocity] - true[:, velocity],
        true[:, 4:7],
        deviation,
    )


def estimate_summary(
    frames: Mapping[str, pd.DataFrame], motion: TrueMotion
) -> dict[str, Json] | None:
    """Summarises the errors; None where the robot ran on its true state.

    Args:
        frames: the signals, by name.
        motion: the true one.

    Returns:
        RMS and largest error of the base's position, m, yaw and tilt, deg, and
        velocity, m/s, of CoM, m, its velocity, m/s, and DCM, m; `drift_percent_of_way`
        and `drift_percent_of_climb`, the last error of the place over the way, of the
        height over the climb; `contact_misjudged_s`, for how long each foot was taken
        for on the ground while it was not, or the other way round; `squared_error`, the
        mean square of errors over their deviations (1 where those are true); `slips`,
        how often a foot was found to have moved; `imu_silent_s`. What was not logged is
        None.
    """
    errors = estimate_errors(frames)
    if errors is None:
        return None
    horizontal = np.linalg.norm(errors.turn[:, :2], axis=1)
    figures: dict[str, Json] = {}
    for name, values in (
        ("position_m", np.linalg.norm(errors.position, axis=1)),
        ("yaw_deg", np.degrees(np.abs(errors.turn[:, 2]))),
        ("tilt_deg", np.degrees(horizontal)),
        ("velocity_m_s", np.linalg.norm(errors.velocity, axis=1)),
        *_body_errors(frames, motion),
    ):
        figures[f"rms_{name}"] = _round(float(np.sqrt(np.mean(values**2))))
        figures[f"max_{name}"] = _round(float(values.max()))
    figures |= _drift(errors)
    figures["contact_misjudged_s"] = _misjudged(frames)
    figures["squared_error"] = _squared_error(errors)
    figures |= _faults(frames)
    return figures


def _body_errors(
    frames: Mapping[str, pd.DataFrame], motion: TrueMotion
) -> list[tuple[str, Vector]]:
    """Errors of CoM, its velocity and DCM, (n,) each, where they were logged."""
    signals = (BELIEVED_COM_SIGNAL, BELIEVED_VELOCITY_SIGNAL)
    if any(name not in frames for name in signals):
        return []
    com, velocity = (frames[name].to_numpy(dtype=np.float64) for name in signals)
    time, rows, columns = np.intersect1d(motion.time, com[:, 0], return_indices=True)
    if not len(time):
        return []
    com_error = com[columns, 1:] - motion.com[rows]
    rate_error = velocity[columns, 1:] - motion.com_velocity[rows]
    soles = np.mean([X_WF[rows, 2, 3] for X_WF in motion.X_WF.values()], axis=0)
    height = np.maximum(motion.com[rows, 2] - soles, 1e-6)
    dcm = com_error[:, :2] + rate_error[:, :2] * np.sqrt(height / GRAVITY)[:, None]
    return [
        ("com_m", np.linalg.norm(com_error, axis=1)),
        ("com_velocity_m_s", np.linalg.norm(rate_error, axis=1)),
        ("dcm_m", np.linalg.norm(dcm, axis=1)),
    ]


def _drift(errors: EstimateErrors) -> dict[str, Json]:
    """Error of the last place over the way, and of the height over the climb, %."""
    steps = np.linalg.norm(np.diff(errors.way[:, :2], axis=0), axis=1)
    way, climb = float(steps.sum()), float(np.ptp(errors.way[:, 2]))
    place = float(np.linalg.norm(errors.position[-1, :2]))
    height = abs(float(errors.position[-1, 2]))
    return {
        "way_m": _round(way),
        "drift_percent_of_way": _round(100 * place / way) if way > LEAST_WAY else None,
        "drift_percent_of_climb": (
            _round(100 * height / climb) if climb > LEAST_WAY else None
        ),
    }


def _misjudged(frames: Mapping[str, pd.DataFrame]) -> Json:
    """How long each foot's contact was wrong, left and right, s."""
    signals = (TOUCHING_SIGNAL, "contact_monitor.foot_forces")
    if any(name not in frames for name in signals):
        return None
    believed, forces = (frames[name].to_numpy(dtype=np.float64) for name in signals)
    time, rows, columns = np.intersect1d(
        believed[:, 0], forces[:, 0], return_indices=True
    )
    if len(time) < 2:
        return None
    touching = believed[rows, 1:] > 0.5
    true = forces[columns][:, [3, 6]] > TOUCHED
    period = float(np.median(np.diff(time)))
    return [_round(float(wrong.sum()) * period) for wrong in (touching != true).T]


def _squared_error(errors: EstimateErrors) -> Json:
    if errors.deviation is None:
        return None
    both = np.hstack([errors.turn, errors.velocity, errors.position])
    known = np.maximum(errors.deviation, 1e-9)
    # At the start the place is known by definition: its deviation says nothing.
    later = errors.time > errors.time[0] + 1.0
    if not later.any():
        return None
    return _round(float(np.mean((both[later] / known[later]) ** 2)))


def _faults(frames: Mapping[str, pd.DataFrame]) -> dict[str, Json]:
    frame = frames.get(FAULTS_SIGNAL)
    if frame is None or not len(frame):
        return {"slips": None, "imu_silent_s": None}
    left, right, silent = frame.to_numpy(dtype=np.float64)[-1, 1:].tolist()
    return {"slips": [int(left), int(right)], "imu_silent_s": _round(silent)}


def _round(value: float) -> float:
    return float(f"{value:.4g}")
