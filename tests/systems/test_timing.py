"""The stopwatch: whose time is whose, and that measuring changes nothing."""

from threading import Thread
from time import perf_counter

import numpy as np
import pytest
from pydrake.systems.framework import BasicVector, Context, DiagramBuilder, LeafSystem

from footfall.systems import timing
from footfall.systems.timing import RESOLUTION, Stopwatch, stopwatch, timed


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
    assert stopwatch(slow).count == stopwatch(quick).count == 1
    assert stopwatch(slow).total >= 0.05
    assert stopwatch(quick).total < 0.05


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
    assert watch.count == 3
    assert watch.total >= 0.0
    assert timing._RUNNING.nested == []


def test_callbacks_of_a_system_share_its_stopwatch() -> None:
    """One stopwatch a system; a system without timed callbacks has none."""
    system = Stage(0.0, has_input=False)
    watch = stopwatch(system)
    timed(system, spin)(0.0)
    assert stopwatch(system) is watch
    assert watch.count == 1
    assert stopwatch(LeafSystem()) is None


def test_quantiles_are_those_of_all_durations() -> None:
    """Within the resolution, over six decades; in the memory of one."""
    rng = np.random.default_rng(0)
    durations = 10.0 ** rng.uniform(-6.0, 0.0, 20_001)
    watch = Stopwatch()
    size = len(watch._counts)
    for duration in durations:
        watch.add(duration)
    for share in (0.01, 0.5, 0.99):
        exact = np.quantile(durations, share, method="inverted_cdf")
        assert watch.quantile(share) == pytest.approx(exact, rel=RESOLUTION)
    assert watch.count == len(durations)
    assert watch.total == pytest.approx(durations.sum())
    assert len(watch._counts) == size
    assert len(watch._new) < 2000


def test_a_duration_out_of_range_counts_at_its_end() -> None:
    """A clock that stood still, and a machine that slept."""
    watch = Stopwatch()
    for duration in (0.0, -1e-9, 1e6):
        watch.add(duration)
    assert watch.count == 3
    assert watch.quantile(0.5) == pytest.approx(timing.SHORTEST, rel=RESOLUTION)
    assert watch.quantile(1.0) == pytest.approx(timing.LONGEST, rel=RESOLUTION)


def test_nothing_measured_has_no_quantile() -> None:
    """It is no zero."""
    with pytest.raises(ValueError, match="nothing was measured"):
        Stopwatch().quantile(0.5)


def test_threads_do_not_take_each_others_time() -> None:
    """Of two callbacks at once none runs within the other."""
    outer, inner = Stopwatch(), Stopwatch()
    other = Thread(target=inner.wrap(spin), args=(0.05,))

    def wait() -> None:
        other.start()
        other.join()

    outer.wrap(wait)()
    assert inner.total >= 0.05
    assert outer.total >= 0.05
