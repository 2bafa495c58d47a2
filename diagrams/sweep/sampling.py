"""The samples of a sweep: on a grid, drawn, or drawn as a Latin hypercube; pure."""

import itertools
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import qmc

from footfall.diagrams.sweep.definition import (
    MOST_RUNS,
    Range,
    Sweep,
    SweepError,
    Values,
)
from footfall.models.values.vector import Vector

DIGITS = 6
"""Drawn numbers are rounded to so many digits, so that a command can be read."""


@dataclass(frozen=True)
class Job:
    """One run of a sweep."""

    number: int
    """Its place in the sweep, from 0."""
    values: tuple[tuple[str, Any], ...]
    """By path of each varied field its value, in the sweep's order."""
    seed: int
    """`simulation.seed`."""
    case: str = ""
    """Which of the sweep's cases it is; empty where it has none."""

    def changes(self, sweep: Sweep) -> list[str]:
        """Lists all that differs from the scenario, "KEY=VALUE" each, but the seed."""
        own = (f"{key}={_yaml(value)}" for key, value in self.values)
        return [*sweep.changes, *dict(sweep.cases).get(self.case, ()), *own]


def jobs_of(sweep: Sweep) -> list[Job]:
    """Lists the runs of a sweep, the same for the same definition.

    Raises:
        SweepError: they are too many.
    """
    names = [name for name, _ in sweep.fields]
    samples = _samples(sweep)
    cases = [name for name, _ in sweep.cases] or [""]
    count = len(cases) * len(samples) * len(sweep.seeds)
    if count > MOST_RUNS:
        raise SweepError(f"{sweep.name}: {count} runs are more than {MOST_RUNS}")
    runs = itertools.product(cases, samples, sweep.seeds)
    return [
        Job(number, tuple(zip(names, sample, strict=True)), seed, case)
        for number, (case, sample, seed) in enumerate(runs)
    ]


def _samples(sweep: Sweep) -> list[tuple[Any, ...]]:
    values = [value for _, value in sweep.fields]
    if sweep.sampling == "grid":
        return list(itertools.product(*(_levels(value) for value in values)))
    rng = np.random.default_rng(sweep.draw_seed)
    shape = (sweep.count, len(values))
    if sweep.sampling == "random" or not values:
        units: Vector = rng.random(shape)
    else:
        units = qmc.LatinHypercube(len(values), rng=rng).random(sweep.count)
    return [
        tuple(_at(value, unit) for value, unit in zip(values, row, strict=True))
        for row in units.tolist()
    ]


def _levels(values: Values) -> Sequence[Any]:
    if not isinstance(values, Range):
        return values
    if values.levels is None:
        return range(int(values.low), int(values.high) + 1)
    levels = np.linspace(values.low, values.high, values.levels).tolist()
    return [_rounded(level, values.whole) for level in levels]


def _at(values: Values, unit: float) -> Any:
    """Gives the value at a share of what a field takes, [0, 1)."""
    if not isinstance(values, Range):
        return values[min(int(unit * len(values)), len(values) - 1)]
    if values.whole:
        return int(values.low + unit * (values.high - values.low + 1))
    return _rounded(values.low + unit * (values.high - values.low), False)


def _rounded(value: float, whole: bool) -> float | int:
    return round(value) if whole else float(f"{value:.{DIGITS}g}")


def _yaml(value: Any) -> str:
    """Writes plain data as JSON, which is YAML on one line."""
    return json.dumps(value)
