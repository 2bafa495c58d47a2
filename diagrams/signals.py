"""What a run leaves behind, read back.

A signal is named "SYSTEM.PORT". Vector signals lie in `signals/SYSTEM.PORT.parquet`
(column `time` [s], then one named column an element with its unit in the column's
metadata, and the frame of all in the file's), abstract ones in
`signals/SYSTEM.PORT.jsonl` (one {"time": ..., "value": {...}} a line, one each time the
value changed). While a run goes on, and where it was cut, the vector signals are Arrow
streams, `signals/SYSTEM.PORT.arrows`.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.diagrams.signal_files import LINES, RunError, SignalFrames, parse_json
from footfall.diagrams.signal_recorder import SignalRecorder
from footfall.models.values.value import Json

__all__ = [
    "SCENARIO_FILE",
    "SIGNALS_FOLDER",
    "SUMMARY_FILE",
    "Run",
    "RunError",
    "SignalFrames",
    "SignalRecorder",
    "load_run",
]

SIGNALS_FOLDER = "signals"
SUMMARY_FILE = "summary.json"
SCENARIO_FILE = "scenario.yaml"


@dataclass(frozen=True)
class Run:
    """A run folder, read back."""

    folder: Path

    @cached_property
    def summary(self) -> dict[str, Json]:
        """What `summary.json` says; of a run without one that it was cut, and when.

        Raises:
            RunError: it is damaged.
        """
        path = self.folder / SUMMARY_FILE
        if not path.exists():
            return self._cut_summary()
        data = parse_json(path, path.read_bytes())
        if not isinstance(data, dict):
            raise RunError(f"{path}: must hold the fields of a summary")
        return data

    def _cut_summary(self) -> dict[str, Json]:
        """Says what there is to say of a run that was killed, or still goes on."""
        ends = [float(frame["time"].iloc[-1]) for frame in self.signals.values()]
        end = max(ends, default=0.0)
        return {
            "scenario": self.scenario.name,
            "outcome": "cut",
            "reason": "the run was killed or still goes on: it has no "
            f"{SUMMARY_FILE}; the last that it logged was at {end:.2f} s",
            "seed": self.scenario.simulation.seed,
            "simulated_time_s": end,
        }

    @cached_property
    def scenario(self) -> Scenario:
        """The scenario as it was run, every field resolved."""
        return load_scenario(self.folder / SCENARIO_FILE)

    @cached_property
    def signals(self) -> SignalFrames:
        """The vector signals by name, as data frames with a `time` [s] column."""
        return SignalFrames(self.folder / SIGNALS_FOLDER)

    @property
    def value_names(self) -> tuple[str, ...]:
        """The names of the abstract signals."""
        paths = sorted((self.folder / SIGNALS_FOLDER).glob("*" + LINES))
        return tuple(path.stem for path in paths)

    def values(self, name: str) -> list[tuple[float, dict[str, Json]]]:
        """Reads an abstract signal: (time s, value as JSON data) each time it changed.

        Raises:
            KeyError: the run did not log this signal.
            RunError: its file is damaged.
        """
        if name not in self.value_names:
            known = ", ".join(self.value_names) or "none"
            raise KeyError(f"no values {name!r} in this run; it has: {known}")
        path = self.folder / SIGNALS_FOLDER / f"{name}{LINES}"
        lines = path.read_bytes().splitlines(keepends=True)
        cut = not (self.folder / SUMMARY_FILE).exists()
        if cut and lines and not lines[-1].endswith(b"\n"):
            lines.pop()
        entries: list[Any] = [parse_json(path, line) for line in lines]
        try:
            return [(entry["time"], entry["value"]) for entry in entries]
        except (KeyError, TypeError) as error:
            raise RunError(f"{path}: a line holds no time and value") from error


def load_run(folder: Path | str) -> Run:
    """Gives a run back: `.summary`, `.scenario`, `.signals[NAME]`, `.values(NAME)`.

    A run that was killed, or still goes on, has all but its last second at most, and a
    summary whose outcome is "cut".

    Raises:
        RunError: the folder holds no run.
    """
    path = Path(folder)
    if not path.is_dir():
        raise RunError(f"{path}: no such folder")
    for name in (SCENARIO_FILE, SIGNALS_FOLDER):
        if not (path / name).exists():
            raise RunError(f"{path}: not a run folder, it has no {name}")
    return Run(path)
