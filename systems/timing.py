"""How long each system's callbacks take: a stopwatch that a run can read out."""

import math
import threading
from collections.abc import Callable
from time import perf_counter
from typing import ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydrake.systems.framework import System

from footfall.systems.callbacks import weakly_bound

P = ParamSpec("P")
R = TypeVar("R")

SHORTEST, LONGEST = 1e-8, 1e4
"""Between these durations are told apart, s."""
RESOLUTION = 0.02
"""Relative width of a bin: a quantile is off by half of it at most."""
_PER_LOG = 1.0 / math.log1p(RESOLUTION)
_BINS = math.ceil(math.log(LONGEST / SHORTEST) * _PER_LOG)
_BATCH = 1024
"""Durations that are kept before they are counted."""


class _Running(threading.local):
    """The callbacks that run in a thread, and how long what each called has taken."""

    def __init__(self) -> None:
        self.nested: list[float] = []


_RUNNING = _Running()


class Stopwatch:
    """Durations of the callbacks of one system, each without what it called in turn.

    Evaluating an input port runs the callbacks upstream within this one; their time
    is theirs. Measuring is no part of the simulated state: it never changes a value.
    The durations are counted in bins of equal relative width, so that a stopwatch
    takes the same memory however long a run is.
    """

    def __init__(self) -> None:
        """Makes a stopwatch that has measured nothing."""
        self._counts: NDArray[np.int64] = np.zeros(_BINS, dtype=np.int64)
        self._total = 0.0
        self._new: list[float] = []
        """Not counted yet: many are counted as fast as one."""

    @property
    def count(self) -> int:
        """How many calls were measured."""
        return int(self._bins().sum())

    @property
    def total(self) -> float:
        """How long they took together, s."""
        self._bins()
        return self._total

    def quantile(self, share: float) -> float:
        """Computes the duration that this share of the calls did not exceed, s.

        Args:
            share: 0.5 for the median.

        Raises:
            ValueError: nothing was measured.
        """
        if self.count == 0:
            raise ValueError("nothing was measured")
        below = np.cumsum(self._bins())
        number = int(np.searchsorted(below, max(1.0, share * below[-1])))
        return SHORTEST * math.exp((number + 0.5) / _PER_LOG)

    def add(self, duration: float) -> None:
        """Counts one call, s."""
        self._new.append(duration)
        if len(self._new) >= _BATCH:
            self._bins()

    def _bins(self) -> NDArray[np.int64]:
        """Counts what is new and gives the calls in every bin."""
        if self._new:
            durations = np.array(self._new)
            self._new.clear()
            self._total += float(durations.sum())
            ratio = np.maximum(durations, SHORTEST) / SHORTEST
            numbers = (np.log(ratio) * _PER_LOG).astype(np.int64)
            numbers = np.minimum(numbers, _BINS - 1)
            self._counts += np.bincount(numbers, minlength=_BINS)
        return self._counts

    def wrap(self, callback: Callable[P, R]) -> Callable[P, R]:
        """Measures a callback."""
        new, count, running = self._new, self._bins, _RUNNING

        def measured(*args: P.args, **kwargs: P.kwargs) -> R:
            nested = running.nested
            nested.append(0.0)
            start = perf_counter()
            try:
                return callback(*args, **kwargs)
            finally:
                elapsed = perf_counter() - start
                new.append(elapsed - nested.pop())
                if len(new) >= _BATCH:
                    count()
                if nested:
                    nested[-1] += elapsed

        return measured


def stopwatch(system: System) -> Stopwatch | None:
    """Finds the system's stopwatch; None where none of its callbacks is timed."""
    watch = getattr(system, "_stopwatch", None)
    return watch if isinstance(watch, Stopwatch) else None


def timed(system: System, callback: Callable[P, R]) -> Callable[P, R]:
    """Measures a callback by the system's stopwatch (made at the first call).

    Like `weakly_bound`, it does not keep the system alive.
    """
    watch = stopwatch(system)
    if watch is None:
        watch = Stopwatch()
        system._stopwatch = watch  # type: ignore[attr-defined]
    return watch.wrap(weakly_bound(callback))
