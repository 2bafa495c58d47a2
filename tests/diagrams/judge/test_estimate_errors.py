"""Errors of an estimate that is off by what we say."""

import numpy as np
import pandas as pd
import pytest
from pydrake.math import RollPitchYaw

from footfall.diagrams.judge.estimate_errors import estimate_errors, estimate_summary
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.values.vector import Vector

COUNT = 401
TIME = 0.005 * np.arange(COUNT)


def frame(values: Vector) -> pd.DataFrame:
    """A signal at the ticks."""
    names = [f"c{i}" for i in range(values.shape[1])]
    return pd.DataFrame(np.column_stack([TIME, values]), columns=["time", *names])


def state(x: Vector, z: Vector, rpy: Vector, speed: float) -> Vector:
    """Base and one joint: q (8), v (7)."""
    rows = np.zeros((COUNT, 15))
    rows[:, :4] = [
        RollPitchYaw(*row).ToQuaternion().wxyz()
        for row in np.broadcast_to(rpy, (COUNT, 3))
    ]
    rows[:, 4], rows[:, 6] = x, z
    rows[:, 11] = speed
    return rows


def motion(com: Vector, velocity: Vector) -> TrueMotion:
    """The CoM 0.8 m over level soles."""
    poses = np.broadcast_to(np.eye(4), (COUNT, 4, 4))
    return TrueMotion(
        time=TIME,
        com=com,
        com_velocity=velocity,
        base=com,
        torso_up=np.ones(COUNT),
        sole_corners={},
        X_WF={"left": poses, "right": poses},
    )


@pytest.fixture
def frames() -> dict[str, pd.DataFrame]:
    """A metre ahead and half a metre up; at the end 1 cm and 5 mm off."""
    way = np.linspace(0.0, 1.0, COUNT)
    true = state(way, 0.5 * way, np.zeros(3), 0.5)
    off = state(1.01 * way, 0.495 * way, np.radians([0.3, -0.4, 2.0]), 0.53)
    com = np.broadcast_to([0.0, 0.0, 0.8], (COUNT, 3))
    touching = np.ones((COUNT, 2))
    forces = np.full((COUNT, 6), 300.0)
    forces[:100, 5] = 0.0
    faults = np.zeros((COUNT, 3))
    faults[-1] = 2, 0, 0.25
    return {
        "plant.state": frame(true),
        "base_estimator.state": frame(off),
        "base_estimator.deviation": frame(np.full((COUNT, 9), 0.1)),
        "base_estimator.faults": frame(faults),
        "com_observer.com": frame(com + np.array([0.003, 0.004, 0.0])),
        "believed_state.com_velocity": frame(np.zeros((COUNT, 3))),
        "contact_detector.touching": frame(touching),
        "contact_monitor.foot_forces": frame(forces),
    }


def test_figures(frames: dict[str, pd.DataFrame]) -> None:
    """Each by hand."""
    com = np.broadcast_to([0.0, 0.0, 0.8], (COUNT, 3))
    told = estimate_summary(frames, motion(com, np.zeros((COUNT, 3))))
    assert told is not None
    assert told["max_position_m"] == pytest.approx(np.hypot(0.01, 0.005), rel=1e-3)
    assert told["max_yaw_deg"] == pytest.approx(2.0, rel=1e-2)
    assert told["rms_tilt_deg"] == pytest.approx(0.5, rel=1e-2)
    assert told["rms_velocity_m_s"] == pytest.approx(0.03, rel=1e-3)
    assert told["rms_com_m"] == pytest.approx(0.005, rel=1e-3)
    assert told["max_dcm_m"] == pytest.approx(0.005, rel=1e-3)
    assert told["drift_percent_of_way"] == pytest.approx(1.0, rel=1e-3)
    assert told["drift_percent_of_climb"] == pytest.approx(1.0, rel=1e-3)
    assert told["contact_misjudged_s"] == pytest.approx([0.0, 0.5])
    assert told["slips"] == [2, 0]
    assert told["imu_silent_s"] == 0.25
    assert 0.0 < told["squared_error"] < 1.0  # type: ignore[operator]


def test_what_was_not_logged_is_null(frames: dict[str, pd.DataFrame]) -> None:
    """Each figure alone; without an estimate there is nothing."""
    com = np.broadcast_to([0.0, 0.0, 0.8], (COUNT, 3))
    true = motion(com, np.zeros((COUNT, 3)))
    for name, figure in (
        ("base_estimator.deviation", "squared_error"),
        ("base_estimator.faults", "slips"),
        ("contact_detector.touching", "contact_misjudged_s"),
    ):
        left = {key: value for key, value in frames.items() if key != name}
        told = estimate_summary(left, true)
        assert told is not None
        assert told[figure] is None
    without = {k: v for k, v in frames.items() if k != "base_estimator.state"}
    assert estimate_summary(without, true) is None
    assert estimate_errors(without) is None
