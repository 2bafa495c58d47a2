"""What an analysis begins with: a run read back, runs side by side, a sweep.

    from footfall.diagrams.analysis import compare_runs, load_run, load_sweep

`load_run` gives a run's summary, scenario and signals, `load_sweep` a sweep's table.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from footfall.diagrams.fields.flat_fields import flat_fields
from footfall.diagrams.signals import Run, RunError, load_run
from footfall.diagrams.sweep.sweep_folder import SweepFolder, load_sweep
from footfall.models.values.value import Json

__all__ = [
    "Run",
    "RunComparison",
    "RunError",
    "SweepFolder",
    "compare_runs",
    "load_run",
    "load_sweep",
]


@dataclass(frozen=True)
class RunComparison:
    """Runs side by side."""

    runs: Mapping[str, Run]
    """By the name of the folder, or by its path where names are the same."""

    @cached_property
    def figures(self) -> pd.DataFrame:
        """The summaries' figures, a row each, by dotted path; a column a run.

        None where a run did not measure it.
        """
        return _side_by_side({n: _flat(run.summary) for n, run in self.runs.items()})

    @cached_property
    def fields(self) -> pd.DataFrame:
        """The scenarios' fields that are not the same in all runs; a column a run.

        None too where a run's scenario does not have the field.
        """
        table = _side_by_side(
            {name: flat_fields(run.scenario) for name, run in self.runs.items()}
        )
        first = table.iloc[:, 0]
        same = [
            all(value == first.iloc[row] for value in table.iloc[row])
            for row in range(len(table))
        ]
        return table.loc[[not one for one in same]]

    def signal(self, name: str) -> pd.DataFrame:
        """Puts one vector signal of all runs side by side, by time, s.

        Args:
            name: "SYSTEM.PORT".

        Returns:
            Columns (run, element), nan where a run has no sample at a time;
            `attrs["units"]` and `attrs["frame"]` as of the first run.

        Raises:
            KeyError: a run did not log it.
            RunError: a file is damaged.
        """
        frames = {run_name: run.signals[name] for run_name, run in self.runs.items()}
        joined = pd.concat(
            {run_name: frame.set_index("time") for run_name, frame in frames.items()},
            axis=1,
            names=["run", "element"],
        ).sort_index()
        joined.attrs = dict(next(iter(frames.values())).attrs)
        return joined


def compare_runs(*runs: Run | Path | str) -> RunComparison:
    """Puts runs side by side: `.figures`, the `.fields` that differ, `.signal(NAME)`.

    Args:
        runs: at least two, each a folder or what `load_run` gave of it.

    Raises:
        ValueError: there are fewer than two, or one is given twice.
        RunError: a folder holds no run.
    """
    loaded = [run if isinstance(run, Run) else load_run(run) for run in runs]
    if len(loaded) < 2:
        raise ValueError(f"compare_runs: takes at least two runs, got {len(loaded)}")
    names = [run.folder.resolve().name for run in loaded]
    if len(set(names)) < len(names):
        names = [str(run.folder) for run in loaded]
    if len(set(names)) < len(names):
        raise ValueError("compare_runs: a run is given twice")
    return RunComparison(dict(zip(names, loaded, strict=True)))


def _side_by_side(columns: Mapping[str, Mapping[str, Any]]) -> pd.DataFrame:
    """Makes a table of a column each, its rows in the order they first come in."""
    rows = list(dict.fromkeys(key for column in columns.values() for key in column))
    data = {
        name: pd.Series([column.get(row) for row in rows], index=rows, dtype=object)
        for name, column in columns.items()
    }
    return pd.DataFrame(data, index=rows)


def _flat(data: Mapping[str, Json], prefix: str = "") -> dict[str, Json]:
    """Gives nested figures by dotted path."""
    flat: dict[str, Json] = {}
    for name, value in data.items():
        if isinstance(value, dict) and value:
            flat |= _flat(value, f"{prefix}{name}.")
        else:
            flat[f"{prefix}{name}"] = value
    return flat
