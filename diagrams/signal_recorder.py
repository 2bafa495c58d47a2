"""The signals of a run: chosen while a diagram is built, kept in memory or streamed."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from pydrake.systems.framework import Context, DiagramBuilder, OutputPort

from footfall.diagrams.signal_files import (
    LINES,
    STREAM,
    SignalFrames,
    append_whole,
    json_lines,
    make_parquet,
    stream_batch,
    stream_start,
)
from footfall.diagrams.signal_frames import frame_of
from footfall.models.values.vector import Vector
from footfall.systems.signal_log import SignalLog
from footfall.systems.value_log_sink import LoggedValue, ValueLogSink

_NAME = re.compile(r"[A-Za-z0-9_-]+\.[A-Za-z0-9_-]+")


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
    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Least and most that an element may have, by column, where it has limits."""


@dataclass(frozen=True)
class ValueSignal:
    """An abstract port that is logged whenever its value changes."""

    name: str
    """"SYSTEM.PORT", the name of its file."""
    port: OutputPort
    period: float
    """Time between two looks at the port, s."""
    keep: bool
    """Whether its values stay in memory when they are streamed."""


class SignalRecorder:
    """Adds logs to a diagram that is being built, and gives what they hold."""

    def __init__(self, builder: DiagramBuilder) -> None:
        """Makes a recorder of the ports of systems that `builder` holds directly."""
        self._builder = builder
        self._vectors: dict[str, VectorSignal] = {}
        self._logs: dict[float, SignalLog] = {}
        self._values: dict[str, tuple[ValueSignal, ValueLogSink]] = {}
        self._streams: list[SignalStream] = []

    def add_vector(
        self,
        name: str,
        port: OutputPort,
        columns: tuple[str, ...],
        units: tuple[str, ...] | str,
        period: float,
        limits: Mapping[str, tuple[float, float]] | None = None,
    ) -> None:
        """Logs a vector port from now on; call before the diagram is built.

        Args:
            name: "SYSTEM.PORT".
            port: the port.
            columns: a name for each element, all different, none of them "time".
            units: the unit of each element, or one for all.
            period: time between samples, s; see `SignalLog` for what a sample holds.
            limits: least and most that an element may have, by column.

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
        self._vectors[name] = VectorSignal(
            name, port, columns, every, period, limits or {}
        )

    def add_value(
        self, name: str, port: OutputPort, period: float, keep: bool = True
    ) -> None:
        """Logs an abstract port from now on; call before the diagram is built.

        Args:
            name: "SYSTEM.PORT".
            port: the port; its values need a JSON form
                (`footfall.models.values.value.to_json`).
            period: time between two looks, s.
            keep: whether `logged_values` has all of them even while they are streamed;
                False for what changes all the time and is only read from the file.

        Raises:
            ValueError: the name is taken or ill-formed.
        """
        self._check_name(name)
        sink = ValueLogSink(port.Allocate(), period)
        self._builder.AddNamedSystem(f"log({name})", sink)
        self._builder.Connect(port, sink.GetInputPort("value"))
        self._values[name] = (ValueSignal(name, port, period, keep), sink)

    @property
    def vectors(self) -> tuple[VectorSignal, ...]:
        """The vector ports that are logged, in the order they were added."""
        return tuple(self._vectors.values())

    @property
    def values(self) -> tuple[ValueSignal, ...]:
        """The abstract ports that are logged, in the order they were added."""
        return tuple(signal for signal, _ in self._values.values())

    def frames(self, root_context: Context) -> Mapping[str, pd.DataFrame]:
        """Reads the log of every vector port: `time` [s] and a column an element.

        Of a context whose signals are streamed they are read from the files, each when
        it is asked for, and hold what was flushed.
        """
        for stream in self._streams:
            if stream.context is root_context:
                return SignalFrames(stream.folder)
        return {
            name: pd.DataFrame(samples, columns=["time", *self._vectors[name].columns])
            for name, samples in self.samples(root_context).items()
        }

    def logged_values(
        self, root_context: Context
    ) -> dict[str, tuple[LoggedValue, ...]]:
        """Reads the log of every abstract port.

        Of a context whose signals are streamed, a signal that was added with
        `keep=False` has what was not yet flushed, and the value before.
        """
        return {
            name: sink.find_log(root_context)
            for name, (_, sink) in self._values.items()
        }

    def samples(self, root_context: Context) -> dict[str, Vector]:
        """Gives what memory has of every vector signal: time and value, (n, 1 + k)."""
        logs = {
            period: log.find_log(root_context) for period, log in self._logs.items()
        }
        first = dict.fromkeys(logs, 1)
        samples = {}
        for name, signal in self._vectors.items():
            log, begin = logs[signal.period], first[signal.period]
            end = begin + len(signal.columns)
            samples[name] = np.column_stack([log[:, 0], log[:, begin:end]])
            first[signal.period] = end
        return samples

    def forget(self, root_context: Context) -> None:
        """Drops from memory what a stream has written."""
        for log in self._logs.values():
            log.clear_log(root_context)
        for signal, sink in self._values.values():
            if not signal.keep:
                sink.forget_log(root_context)

    def stream(self, root_context: Context, folder: Path) -> "SignalStream":
        """Sends what the diagram's context logs to files from now on.

        Args:
            root_context: of the diagram.
            folder: where the files go; made if missing.
        """
        folder.mkdir(parents=True, exist_ok=True)
        stream = SignalStream(self, root_context, folder)
        self._streams.append(stream)
        return stream

    def write(self, root_context: Context, folder: Path) -> None:
        """Writes all that was logged into `folder`, where `frames` reads it from then.

        Raises:
            OSError: the folder cannot be written to.
            TypeError: a logged value has no JSON form.
        """
        stream = self.stream(root_context, folder)
        stream.flush()
        stream.finish()

    def _check_name(self, name: str) -> None:
        if not _NAME.fullmatch(name):
            raise ValueError(f"a signal is named SYSTEM.PORT, got {name!r}")
        if name in self._vectors or name in self._values:
            raise ValueError(f"signal {name}: logged twice")


class _Written(NamedTuple):
    """How far a stream has come."""

    sizes: dict[str, int]
    """Of each signal's file, bytes."""
    times: dict[str, float]
    """Of each signal's last sample in it, s."""


class SignalStream:
    """Sends the signals that a context logs to files, and frees the memory they took.

    A flush that is broken off, by Ctrl-C or a full disk, leaves files that can be read
    and loses nothing: the next one writes all that this one should have.
    """

    def __init__(
        self, recorder: SignalRecorder, root_context: Context, folder: Path
    ) -> None:
        """Opens a stream that has written nothing.

        Args:
            recorder: of the diagram.
            root_context: of the diagram.
            folder: where the files go.
        """
        self.context, self.folder = root_context, folder
        self._recorder = recorder
        self._written = _Written({}, {})

    def flush(self) -> None:
        """Writes what was logged since the last time.

        Raises:
            OSError: the folder cannot be written to; the error names the file.
            TypeError: a logged value has no JSON form.
        """
        sizes, times = dict(self._written.sizes), dict(self._written.times)
        samples = self._recorder.samples(self.context)
        for signal in self._recorder.vectors:
            name, rows = signal.name, samples[signal.name]
            rows = rows[rows[:, 0] > times.get(name, -math.inf)]
            if not len(rows):
                continue
            content = stream_batch(signal.columns, signal.units, rows)
            if name not in sizes:
                content = (
                    stream_start(
                        signal.columns, signal.units, frame_of(name), signal.limits
                    )
                    + content
                )
            self._append(name + STREAM, content, sizes, name)
            times[name] = float(rows[-1, 0])
        for name, log in self._recorder.logged_values(self.context).items():
            entries = [e for e in log if e.time > times.get(name, -math.inf)]
            if not entries:
                continue
            self._append(name + LINES, json_lines(entries), sizes, name)
            times[name] = entries[-1].time
        self._written = _Written(sizes, times)
        self._recorder.forget(self.context)

    def finish(self) -> None:
        """Makes Parquet files of the vector signals, once all is flushed.

        Raises:
            OSError: there is no room; what was not made stays a stream.
        """
        for signal in self._recorder.vectors:
            if signal.name in self._written.sizes:
                make_parquet(self.folder / (signal.name + STREAM))

    def _append(
        self, file: str, content: bytes, sizes: dict[str, int], name: str
    ) -> None:
        append_whole(self.folder / file, content, sizes.get(name, 0))
        sizes[name] = sizes.get(name, 0) + len(content)
