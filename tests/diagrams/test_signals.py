"""Signals: recorded, written, and read back as they were."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest
from pydrake.common.value import Value
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import (
    ConstantValueSource,
    Sine,
)

from footfall.diagrams.scenario import Scenario, save_scenario
from footfall.diagrams.signal_files import (
    make_parquet,
    stream_batch,
    stream_start,
)
from footfall.diagrams.signals import RunError, SignalRecorder, load_run
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.planned import TaskStatus


def recorded() -> tuple[SignalRecorder, Simulator]:
    """A sine and a status, recorded for a second."""
    builder = DiagramBuilder()
    sine = builder.AddNamedSystem(
        "sine", Sine(np.array([1.0, 2.0]), np.array([6.0, 3.0]), np.zeros(2))
    )
    source = builder.AddNamedSystem(
        "executive", ConstantValueSource(Value[object](TaskStatus(activity="move")))
    )
    recorder = SignalRecorder(builder)
    port = sine.get_output_port(0)
    recorder.add_vector("sine.y", port, ("knee", "hip"), ("rad", "Nm"), 0.005)
    recorder.add_value("executive.status", source.get_output_port(), 0.1)
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(1.0)
    return recorder, simulator


def write_run(folder):
    """A run folder of it."""
    recorder, simulator = recorded()
    folder.mkdir()
    recorder.write(simulator.get_context(), folder / "signals")
    scenario = Scenario(name="s", scene=SceneParams(staircase=StaircaseParams()))
    save_scenario(scenario, folder / "scenario.yaml")
    (folder / "summary.json").write_text(json.dumps({"outcome": "completed"}))
    return scenario


def test_run_comes_back_as_it_was(tmp_path) -> None:
    """Every sample to the last bit, with names and units."""
    scenario = write_run(tmp_path / "run")
    run = load_run(str(tmp_path / "run"))
    frame = run.signals["sine.y"]
    assert list(frame.columns) == ["time", "knee", "hip"]
    assert frame.attrs["units"] == {"time": "s", "knee": "rad", "hip": "Nm"}
    assert len(frame) == 200
    np.testing.assert_allclose(frame["hip"], 2.0 * np.sin(3.0 * frame["time"]))
    np.testing.assert_allclose(np.diff(frame["time"]), 0.005)
    assert run.values("executive.status") == [
        (0.0, {"state": "running", "activity": "move", "reason": ""})
    ]
    assert run.value_names == ("executive.status",)
    assert list(run.signals) == ["sine.y"]
    assert run.summary == {"outcome": "completed"}
    assert run.scenario == scenario


def test_units_lie_in_the_columns_metadata(tmp_path) -> None:
    """For whoever reads the file without footfall."""
    write_run(tmp_path / "run")
    schema = pq.read_schema(tmp_path / "run" / "signals" / "sine.y.parquet")
    assert [item.name for item in schema] == ["time", "knee", "hip"]
    assert [item.metadata[b"unit"] for item in schema] == [b"s", b"rad", b"Nm"]


def test_the_frame_lies_in_the_files_metadata(tmp_path) -> None:
    """And in the data frame's attributes; a signal of the user's own has none."""
    write_run(tmp_path / "run")
    assert load_run(tmp_path / "run").signals["sine.y"].attrs["frame"] == ""
    limits = {"x": (-0.5, 0.25)}
    start = stream_start(("x",), ("m",), "W, true", limits)
    batch = stream_batch(("x",), ("m",), np.zeros((1, 2)))
    (tmp_path / "run" / "signals" / "a.b.arrows").write_bytes(start + batch)
    frame = load_run(tmp_path / "run").signals["a.b"]
    units = {"time": "s", "x": "m"}
    assert frame.attrs == {"units": units, "limits": limits, "frame": "W, true"}
    make_parquet(tmp_path / "run" / "signals" / "a.b.arrows")
    schema = pq.read_schema(tmp_path / "run" / "signals" / "a.b.parquet")
    assert schema.metadata[b"frame"] == b"W, true"


def test_signal_that_was_not_logged_is_named(tmp_path) -> None:
    """With those that were."""
    write_run(tmp_path / "run")
    run = load_run(tmp_path / "run")
    with pytest.raises(KeyError, match=r"no signal 'nope'.*it has: sine\.y"):
        run.signals["nope"]
    with pytest.raises(KeyError, match=r"no values 'nope'.*executive\.status"):
        run.values("nope")
    assert "nope" not in run.signals


@pytest.mark.parametrize("missing", ["signals", "scenario.yaml"])
def test_what_is_no_run_is_refused(tmp_path, missing) -> None:
    """The error names the folder and what it lacks."""
    write_run(tmp_path / "run")
    (tmp_path / "run" / missing).rename(tmp_path / "elsewhere")
    with pytest.raises(RunError, match=f"run: not a run folder, it has no {missing}"):
        load_run(tmp_path / "run")


def test_a_run_without_summary_was_cut(tmp_path) -> None:
    """It says when, and gives what it logged; a torn last line is left out."""
    write_run(tmp_path / "run")
    (tmp_path / "run" / "summary.json").unlink()
    lines = tmp_path / "run" / "signals" / "executive.status.jsonl"
    with lines.open("ab") as file:
        file.write(b'{"time": 0.5, "val')
    run = load_run(tmp_path / "run")
    assert run.summary["outcome"] == "cut"
    assert "the last that it logged was at 0.99 s" in run.summary["reason"]
    assert run.summary["scenario"] == run.scenario.name
    assert run.summary["seed"] == 0
    assert run.summary["simulated_time_s"] == pytest.approx(0.995)
    assert len(run.values("executive.status")) == 1


def test_a_run_that_was_cut_at_once_has_logged_nothing(tmp_path) -> None:
    """And says so."""
    scenario = Scenario(name="s", scene=SceneParams(staircase=StaircaseParams()))
    save_scenario(scenario, tmp_path / "scenario.yaml")
    (tmp_path / "signals").mkdir()
    run = load_run(tmp_path)
    assert "was at 0.00 s" in run.summary["reason"]
    assert list(run.signals) == []


def test_missing_folder_is_refused(tmp_path) -> None:
    """By its name."""
    with pytest.raises(RunError, match="nowhere: no such folder"):
        load_run(tmp_path / "nowhere")


@pytest.mark.parametrize(
    ("name", "damage"),
    [
        ("summary.json", b""),
        ("summary.json", b"[1]"),
        ("signals/source.y0.parquet", b"PAR1"),
        ("signals/source.y0.arrows", b"PAR1"),
        ("signals/source.value.jsonl", b'{"time": 0.0, "val'),
        ("signals/source.value.jsonl", b"3\n"),
    ],
)
def test_a_damaged_file_is_named(tmp_path, name, damage) -> None:
    """In one line, wherever in the run folder it lies."""
    (tmp_path / "signals").mkdir()
    (tmp_path / "summary.json").write_text("{}")
    (tmp_path / "scenario.yaml").write_text("")
    (tmp_path / name).write_bytes(damage)
    run = load_run(tmp_path)

    def read_all() -> None:
        assert run.summary == {}
        assert [run.signals[signal] for signal in run.signals] == []
        assert [run.values(value) for value in run.value_names] == []

    with pytest.raises(RunError) as caught:
        read_all()
    assert str(caught.value).startswith(str(tmp_path / name))
