"""What is said of the joints of a run."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.joint_figures import (
    by_joint,
    joint_peaks,
    time_at_limit,
    worst_fraction,
)
from tests.diagrams.judge.climb_evidence import SAMPLES, frame


def test_the_worst_fraction_names_its_joint() -> None:
    """Whatever its sign; None without any samples."""
    values = {"HIP": np.array([1.0, -3.0]), "KNEE": np.array([2.0, 2.0])}
    assert worst_fraction(values, {"HIP": 6.0, "KNEE": 10.0}) == (0.5, "HIP")
    assert worst_fraction({"HIP": np.zeros(0)}, {"HIP": 1.0}) == (None, None)
    assert worst_fraction(None, {"HIP": 1.0}) == (None, None)


def test_what_is_not_a_number_is_the_worst() -> None:
    """It must not hide behind a joint that moved."""
    values = {"HIP": np.array([5.0]), "KNEE": np.array([1.0, np.nan])}
    fraction, joint = worst_fraction(values, {"HIP": 6.0, "KNEE": 10.0})
    assert joint == "KNEE"
    assert np.isnan(fraction)


def test_peaks_are_those_of_every_step_and_of_the_log(climb: Evidence) -> None:
    """Whichever is larger; none where the steps were not watched."""
    peaks = joint_peaks(climb)
    assert peaks is not None
    assert peaks["KNEE"].max() == 6.5
    faster = {**climb.joint_velocities, "KNEE": np.full(SAMPLES, -7.0)}
    peaks = joint_peaks(replace(climb, joint_velocities=faster))
    assert peaks is not None
    assert peaks["KNEE"].max() == 7.0
    assert joint_peaks(replace(climb, frames={})) is None


def test_time_at_a_limit_is_that_of_any_joint() -> None:
    """Two at once count once; the joint that is there longest is named."""
    torques = {"HIP": np.array([6.0, 6.0, 0.0]), "KNEE": np.array([0.0, -9.0, 1.0])}
    limits = {"HIP": 6.0, "KNEE": 9.0}
    assert time_at_limit(torques, limits, 0.005) == (pytest.approx(0.01), "HIP")
    assert time_at_limit({"HIP": np.array([5.9])}, limits, 0.005) == (0.0, None)
    assert time_at_limit({}, limits, 0.005) == (None, None)


def test_torques_of_another_number_of_joints_are_refused(climb: Evidence) -> None:
    """A column too many would be given another joint's name."""
    frames = {**climb.frames, "plant.net_actuation": frame(np.zeros((SAMPLES, 3)))}
    with pytest.raises(ValueError, match="has 3 columns, expected one for each of 2"):
        by_joint(replace(climb, frames=frames), "plant.net_actuation")
