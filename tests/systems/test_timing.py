"""The stopwatch: whose time is whose, and that measuring changes nothing."""

from time import perf_counter

import numpy as np
import pytest
from pydrake.systems.framework import BasicVector, Context, DiagramBuilder, LeafSystem

from systems.timing import Stopwatch, stopwatch, timed


def spin(seconds: float) -> None:
    """Keeps the processor busy."""
    end = perf_counter() + seconds
    while perf_counter() < end:
        pass


class Stage(LeafSystem):
    """Adds one to its input, slowly."""

    def __init__(self, seconds: float, has_input: bool) -> None:
        super().__init__()
        self._seconds = seconds
        self._input = self.DeclareVectorInputPort("u", 1) if has_input else None
        self.DeclareVectorOutputPort("y", 1, timed(self, self._calc))

    def _calc(self, context: Context, output: BasicVector) -> None:
        spin(self._seconds)
        value = self._input.Eval(context)[0] if self._input else 0.0
        output.SetAtIndex(0, value + 1.0)


def test_upstream_time_is_not_counted_downstream() -> None:
    """A quick system that waits for a slow one upstream stays quick."""
    builder = DiagramBuilder()
    slow = builder.AddNamedSystem("slow", Stage(0.05, has_input=False))
    quick = builder.AddNamedSystem("quick", Stage(0.0, has_input=True))
    builder.Connect(slow.GetOutputPort("y"), quick.GetInputPort("u"))
    builder.ExportOutput(quick.GetOutputPort("y"), "y")
    diagram = builder.Build()
    value = diagram.GetOutputPort("y").Eval(diagram.CreateDefaultContext())
    assert value[0] == 2.0
    (slow_time,), (quick_time,) = (
        stopwatch(system).durations() for system in (slow, quick)
    )
    assert slow_time >= 0.05
    assert quick_time < 0.05


def test_result_arguments_and_exceptions_pass_through() -> None:
    """The wrapper is transparent, and its stack is sound after an exception."""
    watch = Stopwatch()

    def callback(a: int, *, b: int) -> int:
        if b < 0:
            raise KeyError(b)
        return a + b

    wrapped = watch.wrap(callback)
    assert wrapped(1, b=2) == 3
    with pytest.raises(KeyError):
        wrapped(1, b=-1)
    assert wrapped(2, b=2) == 4
    assert watch.durations().shape == (3,)
    assert np.all(watch.durations() >= 0.0)
    assert Stopwatch._nested == []


def test_callbacks_of_a_system_share_its_stopwatch() -> None:
    """One stopwatch a system; a system without timed callbacks has none."""
    system = Stage(0.0, has_input=False)
    watch = stopwatch(system)
    timed(system, spin)(0.0)
    assert stopwatch(system) is watch
    assert len(watch.durations()) == 1
    assert stopwatch(LeafSystem()) is None
