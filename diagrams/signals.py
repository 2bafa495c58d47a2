"""The signals of a run: chosen while a diagram is built, written, read back.

A signal is named "SYSTEM.PORT". Vector signals become
`signals/SYSTEM.PORT.parquet` (column `time` [s], then one named column an element with
its unit in the column's metadata), abstract ones `signals/SYSTEM.PORT.jsonl` (one
{"time": ..., "value": {...}} a line, one each time the value changed).
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]
from pydrake.systems.framework import Context, DiagramBuilder, OutputPort

from diagrams.scenario import Scenario, load_scenario
from systems.ports import Vector
from systems.signal_log import SignalLog
from systems.value_log_sink import LoggedValue, ValueLogSink
from systems.values import Json, to_json

SIGNALS_FOLDER = "signals"
SUMMARY_FILE = "summary.json"
SCENARIO_FILE = "scenario.yaml"
_NAME = re.compile(r"[A-Za-z0-9_-]+\.[A-Za-z0-9_-]+")


class RunError(ValueError):
    """A folder is not a run, or lacks what was asked of it."""


@dataclass(frozen=True)
class VectorSignal:
    """A vector port that is logged."""

    name: str
    """"SYSTEM.PORT", the name of its file."""
    port: OutputPort
    columns: tuple[str, ...]
    """What each element is called."""
    units: tuple[str, ...]
    """Unit of each element, e.g. "m", "Nm"; "1" where it has none."""
    period: float
    """Time between samples, s."""


@dataclass(frozen=True)
class ValueSignal:
    """An abstract port that is logged whenever its value changes."""

    name: str
    """"SYSTEM.PORT", the name of its file."""
    port: OutputPort
    period: float
    """Time between two looks at the port, s."""


class SignalRecorder:
    """Adds log sinks to a diagram that is being built, and writes what they hold."""

    def __init__(self, builder: DiagramBuilder) -> None:
        """A recorder of the ports of systems that `builder` holds directly."""
        self._builder = builder
        self._vectors: dict[str, VectorSignal] = {}
        self._logs: dict[float, SignalLog] = {}
        self._values: dict[str, tuple[ValueSignal, ValueLogSink]] = {}

    def add_vector(
        self,
        name: str,
        port: OutputPort,
        columns: tuple[str, ...],
        units: tuple[str, ...] | str,
        period: float,
    ) -> None:
        """Logs a vector port from now on; call before the diagram is built.

        Args:
            name: "SYSTEM.PORT".
            port: the port.
            columns: a name for each element, all different, none of them "time".
            units: the unit of each element, or one for all.
            period: time between samples, s; see `SignalLog` for what a sample holds.

        Raises:
            ValueError: the name is taken or ill-formed, or the numbers do not match.
        """
        self._check_name(name)
        every = (units,) * len(columns) if isinstance(units, str) else units
        if not len(columns) == len(every) == port.size():
            raise ValueError(
                f"signal {name}: the port has {port.size()} elements, got "
                f"{len(columns)} columns and {len(every)} units"
            )
        if len({*columns, "time"}) != len(columns) + 1:
            raise ValueError(f"signal {name}: columns must be unique, got {columns}")
        if period not in self._logs:
            log = SignalLog(period)
            self._logs[period] = log
            self._builder.AddNamedSystem(f"signal_log({period:g} s)", log)
        log = self._logs[period]
        self._builder.Connect(port, log.declare_signal(name, port.size()))
        self._vectors[name] = VectorSignal(name, port, columns, every, period)

    def add_value(self, name: str, port: OutputPort, period: float) -> None:
        """Logs an abstract port from now on; call before the diagram is built.

        Args:
            name: "SYSTEM.PORT".
            port: the port; its values need a JSON form (`systems.values.to_json`).
            period: time between two looks, s.

        Raises:
            ValueError: the name is taken or ill-formed.
        """
        self._check_name(name)
        sink = ValueLogSink(port.Allocate(), period)
        self._builder.AddNamedSystem(f"log({name})", sink)
        self._builder.Connect(port, sink.GetInputPort("value"))
        self._values[name] = (ValueSignal(name, port, period), sink)

    @property
    def vectors(self) -> tuple[VectorSignal, ...]:
        """The vector ports that are logged, in the order they were added."""
        return tuple(self._vectors.values())

    @property
    def values(self) -> tuple[ValueSignal, ...]:
        """The abstract ports that are logged, in the order they were added."""
        return tuple(signal for signal, _ in self._values.values())

    def frames(self, root_context: Context) -> dict[str, pd.DataFrame]:
        """What was logged of every vector port: `time` [s] and a column an element."""
        return {
            name: pd.DataFrame(samples, columns=["time", *self._vectors[name].columns])
            for name, samples in self._samples(root_context).items()
        }

    def logged_values(
        self, root_context: Context
    ) -> dict[str, tuple[LoggedValue, ...]]:
        """What was logged of every abstract port."""
        return {
            name: sink.find_log(root_context)
            for name, (_, sink) in self._values.items()
        }

    def write(self, root_context: Context, folder: Path) -> None:
        """Writes every log of the diagram's context into `folder`, made if missing.

        Raises:
            TypeError: a logged value has no JSON form.
        """
        folder.mkdir(parents=True, exist_ok=True)
        for name, frame in self.frames(root_context).items():
            units = ("s", *self._vectors[name].units)
            _write_parquet(frame, units, folder / f"{name}.parquet")
        for name, entries in self.logged_values(root_context).items():
            with (folder / f"{name}.jsonl").open("w", encoding="utf-8") as file:
                for entry in entries:
                    line = {"time": entry.time, "value": to_json(entry.value)}
                    file.write(json.dumps(line, allow_nan=False) + "\n")

    def _samples(self, root_context: Context) -> dict[str, Vector]:
        """Time, s, and value of every vector signal, (n, 1 + elements) each."""
        logs = {p: log.find_log(root_context) for p, log in self._logs.items()}
        first = dict.fromkeys(logs, 1)
        samples = {}
        for name, signal in self._vectors.items():
            log, begin = logs[signal.period], first[signal.period]
            end = begin + len(signal.columns)
            samples[name] = np.column_stack([log[:, 0], log[:, begin:end]])
            first[signal.period] = end
        return samples

    def _check_name(self, name: str) -> None:
        if not _NAME.fullmatch(name):
            raise ValueError(f"a signal is named SYSTEM.PORT, got {name!r}")
        if name in self._vectors or name in self._values:
            raise ValueError(f"signal {name}: logged twice")


def _write_parquet(frame: pd.DataFrame, units: tuple[str, ...], path: Path) -> None:
    fields = [
        pa.field(str(column), pa.float64(), metadata={"unit": unit})
        for column, unit in zip(frame.columns, units, strict=True)
    ]
    arrays = [pa.array(frame[column].to_numpy()) for column in frame.columns]
    table = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
    pq.write_table(table, path, compression="zstd")


class SignalFrames(Mapping[str, pd.DataFrame]):
    """The vector signals of a run by name; each file is read when it is asked for."""

    def __init__(self, folder: Path) -> None:
        """The signals that lie in `folder`."""
        self._paths = {path.stem: path for path in sorted(folder.glob("*.parquet"))}
        self._frames: dict[str, pd.DataFrame] = {}

    def __getitem__(self, name: str) -> pd.DataFrame:
        """The signal's data frame; `frame.attrs["units"]` has the unit by column.

        Raises:
            KeyError: the run did not log this signal.
            RunError: its file is damaged.
        """
        if name not in self._paths:
            known = ", ".join(self._paths) or "none"
            raise KeyError(f"no signal {name!r} in this run; it has: {known}")
        if name not in self._frames:
            path = self._paths[name]
            try:
                table = pq.read_table(path)
            except (pa.ArrowException, OSError) as error:
                raise RunError(f"{path}: not a Parquet file: {error}") from error
            frame = table.to_pandas()
            frame.attrs["units"] = {
                item.name: (item.metadata or {}).get(b"unit", b"").decode()
                for item in table.schema
            }
            self._frames[name] = frame
        return self._frames[name]

    def __iter__(self) -> Iterator[str]:
        """The names, sorted."""
        return iter(self._paths)

    def __len__(self) -> int:
        """How many there are."""
        return len(self._paths)


@dataclass(frozen=True)
class Run:
    """A run folder, read back."""

    folder: Path

    @cached_property
    def summary(self) -> dict[str, Json]:
        """What `summary.json` says.

        Raises:
            RunError: it is damaged.
        """
        path = self.folder / SUMMARY_FILE
        data = _parse_json(path, path.read_bytes())
        if not isinstance(data, dict):
            raise RunError(f"{path}: must hold the fields of a summary")
        return data

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
        paths = sorted((self.folder / SIGNALS_FOLDER).glob("*.jsonl"))
        return tuple(path.stem for path in paths)

    def values(self, name: str) -> list[tuple[float, dict[str, Json]]]:
        """An abstract signal: (time s, value as JSON data) each time it changed.

        Raises:
            KeyError: the run did not log this signal.
            RunError: its file is damaged.
        """
        if name not in self.value_names:
            known = ", ".join(self.value_names) or "none"
            raise KeyError(f"no values {name!r} in this run; it has: {known}")
        path = self.folder / SIGNALS_FOLDER / f"{name}.jsonl"
        entries = (_parse_json(path, line) for line in path.read_bytes().splitlines())
        try:
            return [(entry["time"], entry["value"]) for entry in entries]
        except (KeyError, TypeError) as error:
            raise RunError(f"{path}: a line holds no time and value") from error


def _parse_json(path: Path, text: bytes) -> Any:
    try:
        return json.loads(text)
    except ValueError as error:
        raise RunError(f"{path}: not JSON: {error}") from error


def load_run(folder: Path | str) -> Run:
    """Gives a run back: `.summary`, `.scenario`, `.signals[NAME]`, `.values(NAME)`.

    Raises:
        RunError: the folder holds no finished run.
    """
    path = Path(folder)
    if not path.is_dir():
        raise RunError(f"{path}: no such folder")
    for name in (SUMMARY_FILE, SCENARIO_FILE, SIGNALS_FOLDER):
        if not (path / name).exists():
            raise RunError(f"{path}: not a run folder, it has no {name}")
    return Run(path)
