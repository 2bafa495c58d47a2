"""How long each system's callbacks take: a stopwatch that a run can read out."""

from collections.abc import Callable
from time import perf_counter
from typing import ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydrake.systems.framework import System

from systems.callbacks import weakly_bound

P = ParamSpec("P")
R = TypeVar("R")


class Stopwatch:
    """Durations of the callbacks of one system, each without what it called in turn.

    Evaluating an input port runs the callbacks upstream within this one; their time
    is theirs. Measuring is no part of the simulated state: it never changes a value.
    """

    _nested: list[float] = []  # noqa: RUF012  (the stack of running callbacks)

    def __init__(self) -> None:
        """A stopwatch that has measured nothing."""
        self._durations: list[float] = []

    def durations(self) -> NDArray[np.float64]:
        """Every duration so far, (n,), s."""
        return np.array(self._durations, dtype=np.float64)

    def wrap(self, callback: Callable[P, R]) -> Callable[P, R]:
        """The callback, measured."""
        nested, durations = Stopwatch._nested, self._durations

        def measured(*args: P.args, **kwargs: P.kwargs) -> R:
            nested.append(0.0)
            start = perf_counter()
            try:
                return callback(*args, **kwargs)
            finally:
                elapsed = perf_counter() - start
                durations.append(elapsed - nested.pop())
                if nested:
                    nested[-1] += elapsed

        return measured


def stopwatch(system: System) -> Stopwatch | None:
    """The system's stopwatch; None where none of its callbacks is timed."""
    watch = getattr(system, "_stopwatch", None)
    return watch if isinstance(watch, Stopwatch) else None


def timed(system: System, callback: Callable[P, R]) -> Callable[P, R]:
    """The callback, measured by the system's stopwatch (made at the first call).

    Like `weakly_bound`, it does not keep the system alive.
    """
    watch = stopwatch(system)
    if watch is None:
        watch = Stopwatch()
        system._stopwatch = watch  # type: ignore[attr-defined]
    return watch.wrap(weakly_bound(callback))
