"""Runs side by side."""

import json

import numpy as np
import pytest

from footfall.diagrams.analysis import compare_runs, load_run, load_sweep
from footfall.diagrams.scenario import load_scenario, save_scenario
from footfall.diagrams.signal_files import stream_batch, stream_start
from footfall.diagrams.signals import RunError
from footfall.diagrams.sweep.definition import SweepError


def write_run(folder, rise, times, **figures):
    """A run folder with one signal, x = 10 t, and these figures."""
    (folder / "signals").mkdir(parents=True)
    changes = [f"scene.staircase.rise={rise}"]
    save_scenario(load_scenario("stairs-exp1", changes), folder / "scenario.yaml")
    (folder / "summary.json").write_text(json.dumps(figures))
    samples = np.column_stack([times, 10.0 * np.array(times)])
    (folder / "signals" / "a.b.arrows").write_bytes(
        stream_start(("x",), ("m",), "W") + stream_batch(("x",), ("m",), samples)
    )
    return folder


@pytest.fixture
def runs(tmp_path):
    """Two runs that differ in the rise of the steps."""
    return (
        write_run(tmp_path / "low", 0.1, [0.0, 0.5], outcome="completed", e={"a": 1}),
        write_run(tmp_path / "high", 0.2, [0.5, 1.0], outcome="fell", max_x=2.0),
    )


def test_figures_stand_side_by_side(runs) -> None:
    """By dotted path, None where one has no such figure."""
    figures = compare_runs(*runs).figures
    assert list(figures.columns) == ["low", "high"]
    assert figures.loc["outcome"].tolist() == ["completed", "fell"]
    assert figures.loc["e.a"].tolist() == [1, None]
    assert figures.loc["max_x"].tolist() == [None, 2.0]
    assert list(figures.index) == ["outcome", "e.a", "max_x"]


def test_fields_that_differ_are_listed(runs) -> None:
    """No others."""
    fields = compare_runs(load_run(runs[0]), str(runs[1])).fields
    assert list(fields.index) == ["scene.staircase.rise"]
    assert fields.loc["scene.staircase.rise"].tolist() == [0.1, 0.2]


def test_a_signal_is_joined_by_time(runs) -> None:
    """With its unit and frame."""
    joined = compare_runs(*runs).signal("a.b")
    assert list(joined.index) == [0.0, 0.5, 1.0]
    assert list(joined.columns) == [("low", "x"), ("high", "x")]
    np.testing.assert_array_equal(joined["low", "x"], [0.0, 5.0, np.nan])
    np.testing.assert_array_equal(joined["high", "x"], [np.nan, 5.0, 10.0])
    units = {"time": "s", "x": "m"}
    assert joined.attrs == {"units": units, "limits": {}, "frame": "W"}
    with pytest.raises(KeyError, match=r"it has: a\.b"):
        compare_runs(*runs).signal("nope")


def test_folders_of_one_name_go_by_their_paths(runs, tmp_path) -> None:
    """A sweep's run and another's, say."""
    other = write_run(tmp_path / "other" / "low", 0.1, [0.0], outcome="completed")
    assert list(compare_runs(runs[0], other).runs) == [str(runs[0]), str(other)]
    with pytest.raises(ValueError, match="a run is given twice"):
        compare_runs(runs[0], runs[0])


def test_what_cannot_be_compared_is_told(runs, tmp_path) -> None:
    """One run, no run, no sweep."""
    with pytest.raises(ValueError, match="takes at least two runs, got 1"):
        compare_runs(runs[0])
    with pytest.raises(RunError, match="no such folder"):
        compare_runs(runs[0], tmp_path / "nowhere")
    with pytest.raises(SweepError, match=r"has no table\.parquet"):
        load_sweep(runs[0])
