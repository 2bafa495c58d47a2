"""What is read of a run's evidence."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.evidence_signals import (
    fall,
    felt_forces,
    foot_loads,
    last_ground,
    signal_at,
    task_treads,
)
from footfall.diagrams.judge.ground import FLOOR
from tests.diagrams.judge.climb_evidence import SAMPLES, WEIGHT, frame


def test_a_signal_is_known_where_it_was_logged_alone() -> None:
    """Between its samples; nan before and after, but for the length of a sample."""
    signal = pd.DataFrame({"time": [1.0, 2.0], "x": [0.0, 4.0]})
    at = signal_at(np.array([0.9, 0.99, 1.25, 2.01, 2.1]), signal)[:, 0]
    np.testing.assert_allclose(at, [np.nan, 0.0, 1.0, 4.0, np.nan])
    assert np.isnan(signal_at(np.array([1.0]), signal.iloc[:0])).all()


def test_the_task_says_where_it_ends(climb: Evidence) -> None:
    """On the top tread, or on the floor of a room with stairs in it."""
    assert last_ground(climb).name == "the top tread"
    assert last_ground(climb).X_WR.translation()[2] == pytest.approx(0.4)
    room = replace(climb, kind="room_crossing")
    assert (last_ground(room), task_treads(room)) == (FLOOR, ())


def test_loads_are_upward_forces(climb: Evidence) -> None:
    """Of the contact wrenches, and of the means that impacts are read from."""
    loads = foot_loads(climb)
    assert loads is not None
    assert loads["left"][450] == pytest.approx(WEIGHT)
    assert felt_forces(climb) is None
    forces: np.ndarray = np.tile([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], (SAMPLES, 1))
    frames = {**climb.frames, "contact_monitor.foot_forces": frame(forces)}
    felt = felt_forces(replace(climb, frames=frames))
    assert felt is not None
    assert (felt["left"][0], felt["right"][0]) == (3.0, 6.0)


def test_a_fall_is_seen_with_and_without_the_monitor(climb: Evidence) -> None:
    """Its share of the weight counts; without it the pose alone."""
    support = np.zeros((SAMPLES, 1))
    support[200] = 0.2 * WEIGHT
    frames = {**climb.frames, "contact_monitor.other_support": frame(support)}
    found = fall(replace(climb, frames=frames))
    assert found is not None
    assert found.time == pytest.approx(2.0)
    assert fall(replace(climb, frames={})) is None
