"""The recorder: what may be declared, and that streaming loses and repeats nothing."""

import numpy as np
import pytest
from pydrake.common.value import Value
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder, LeafSystem
from pydrake.systems.primitives import ConstantVectorSource, Sine

from footfall.diagrams.signal_recorder import SignalRecorder
from footfall.diagrams.signals import load_run
from footfall.models.values.planned import TaskStatus


class Counter(LeafSystem):
    """Says another status every tenth of a second; by the way 2 m/s times the time."""

    def __init__(self) -> None:
        super().__init__()
        self.DeclareAbstractOutputPort(
            "status",
            lambda: Value[object](TaskStatus()),
            lambda context, output: output.set_value(
                TaskStatus(activity=str(round(10.0 * context.get_time())))
            ),
        )
        self.DeclareVectorOutputPort(
            "ramp", 1, lambda context, y: y.SetAtIndex(0, 2.0 * context.get_time())
        )


def logging() -> tuple[SignalRecorder, Simulator]:
    """Two signals of one period, one of another, and a status logged both ways."""
    builder = DiagramBuilder()
    sine = builder.AddSystem(Sine(np.array([1.0, 2.0]), np.ones(2), np.zeros(2)))
    counter = builder.AddSystem(Counter())
    recorder, ramp = SignalRecorder(builder), counter.GetOutputPort("ramp")
    recorder.add_vector("ramp.y", ramp, ("y",), "m", 0.01)
    recorder.add_vector("ramp.slow", ramp, ("y",), "m", 0.05)
    recorder.add_vector("sine.y", sine.get_output_port(0), ("a", "b"), "m", 0.01)
    status = counter.GetOutputPort("status")
    recorder.add_value("kept.status", status, 0.1)
    recorder.add_value("sent.status", status, 0.1, keep=False)
    return recorder, Simulator(builder.Build())


@pytest.mark.parametrize(
    ("name", "columns", "units", "message"),
    [
        ("y", ("a", "b"), "m", "named SYSTEM.PORT, got 'y'"),
        ("../x.y", ("a", "b"), "m", "named SYSTEM.PORT"),
        ("s.y", ("a",), "m", "2 elements, got 1 columns and 1 units"),
        ("s.y", ("a", "b"), ("m",), "2 elements, got 2 columns and 1 units"),
        ("s.y", ("a", "a"), "m", "columns must be unique"),
        ("s.y", ("a", "time"), "m", "columns must be unique"),
        ("taken.y", ("a", "b"), "m", "taken.y: logged twice"),
    ],
)
def test_ill_declared_signals_are_refused(name, columns, units, message) -> None:
    """Where they are declared, not when the run is written."""
    builder = DiagramBuilder()
    source = builder.AddNamedSystem("source", ConstantVectorSource(np.zeros(2)))
    recorder = SignalRecorder(builder)
    recorder.add_vector("taken.y", source.get_output_port(), ("a", "b"), "m", 0.1)
    with pytest.raises(ValueError, match=message):
        recorder.add_vector(name, source.get_output_port(), columns, units, 0.1)


def test_signals_of_several_periods_are_told_apart() -> None:
    """Each has its columns and its times."""
    recorder, simulator = logging()
    simulator.AdvanceTo(0.5)
    frames = recorder.frames(simulator.get_context())
    assert {name: frame.shape for name, frame in frames.items()} == {
        "ramp.y": (50, 2),
        "ramp.slow": (10, 2),
        "sine.y": (50, 3),
    }
    for name in ("ramp.y", "ramp.slow"):
        np.testing.assert_allclose(frames[name]["y"], 2.0 * frames[name]["time"])
    np.testing.assert_allclose(frames["sine.y"]["b"], 2.0 * frames["sine.y"]["a"])


def test_streamed_signals_are_those_that_memory_would_hold(tmp_path) -> None:
    """To the last bit, before the files are made whole and after."""
    recorder, simulator = logging()
    again, in_memory = logging()
    stream = recorder.stream(simulator.get_context(), tmp_path / "signals")
    for time in (0.3, 0.31, 0.310001, 0.8):
        simulator.AdvanceTo(time)
        in_memory.AdvanceTo(time)
        stream.flush()
    expected = again.frames(in_memory.get_context())
    (tmp_path / "scenario.yaml").touch()
    for finish in (lambda: None, stream.finish):
        finish()
        frames = recorder.frames(simulator.get_context())
        assert set(frames) == set(expected)
        for name, frame in expected.items():
            np.testing.assert_array_equal(frames[name], frame, name)
    said = [str(number) for number in range(9)]
    run = load_run(tmp_path)
    for name in ("kept.status", "sent.status"):
        assert [value["activity"] for _, value in run.values(name)] == said
    assert {path.suffix for path in stream.folder.iterdir()} == {".parquet", ".jsonl"}


def test_what_is_on_disk_leaves_memory(tmp_path) -> None:
    """But for values that are to be kept."""
    recorder, simulator = logging()
    context = simulator.get_context()
    stream = recorder.stream(context, tmp_path)
    simulator.AdvanceTo(0.55)
    stream.flush()
    assert all(len(samples) == 0 for samples in recorder.samples(context).values())
    logged = recorder.logged_values(context)
    assert len(logged["kept.status"]) == 6
    assert len(logged["sent.status"]) == 1


def test_a_flush_that_is_broken_off_is_made_good(tmp_path, monkeypatch) -> None:
    """By the next one: nothing is missing, nothing there twice."""
    recorder, simulator = logging()
    stream = recorder.stream(simulator.get_context(), tmp_path)
    append, calls = stream._append, []

    def breaks_off(*arguments: object) -> None:
        calls.append(arguments)
        if len(calls) == 2:
            raise KeyboardInterrupt
        append(*arguments)

    monkeypatch.setattr(stream, "_append", breaks_off)
    for time in (0.2, 0.4):
        simulator.AdvanceTo(time)
        calls.clear()
        with pytest.raises(KeyboardInterrupt):
            stream.flush()
        simulator.AdvanceTo(time + 0.05)
        stream.flush()
    for name, frame in recorder.frames(simulator.get_context()).items():
        period = 0.05 if name == "ramp.slow" else 0.01
        np.testing.assert_allclose(frame["time"], period * np.arange(0.45 / period))


def test_what_was_written_but_not_forgotten_is_not_written_again(
    tmp_path, monkeypatch
) -> None:
    """As after Ctrl-C between the two."""
    recorder, simulator = logging()
    stream = recorder.stream(simulator.get_context(), tmp_path)
    monkeypatch.setattr(recorder, "forget", lambda _: None)
    for time in (0.2, 0.4):
        simulator.AdvanceTo(time)
        stream.flush()
    frame = recorder.frames(simulator.get_context())["ramp.y"]
    np.testing.assert_allclose(frame["time"], 0.01 * np.arange(40))


def test_another_context_of_the_same_diagram_is_in_memory(tmp_path) -> None:
    """A recorder may serve several simulations."""
    recorder, simulator = logging()
    stream = recorder.stream(simulator.get_context(), tmp_path)
    simulator.AdvanceTo(0.3)
    stream.flush()
    other = Simulator(simulator.get_system())
    other.AdvanceTo(0.1)
    assert len(recorder.frames(other.get_context())["ramp.y"]) == 10
    assert len(recorder.frames(simulator.get_context())["ramp.y"]) == 30


def test_what_is_written_at_the_end_is_read_back(tmp_path) -> None:
    """Without a stream from the start."""
    recorder, simulator = logging()
    simulator.AdvanceTo(0.3)
    before = dict(recorder.frames(simulator.get_context()))
    recorder.write(simulator.get_context(), tmp_path / "signals")
    for name, frame in recorder.frames(simulator.get_context()).items():
        np.testing.assert_array_equal(frame, before[name])
