"""The files of a run's signals: appended to while it runs, made whole at its end.

A vector signal grows as an Arrow stream, `SYSTEM.PORT.arrows`, that can be read up to
its last whole batch wherever it is cut, and becomes `SYSTEM.PORT.parquet` at the end.
An abstract signal grows as JSON lines, `SYSTEM.PORT.jsonl`, and stays them.
"""

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]

from footfall.models.values.value import Json, to_json
from footfall.models.values.vector import Vector
from footfall.systems.value_log_sink import LoggedValue

STREAM, PARQUET, LINES = ".arrows", ".parquet", ".jsonl"
"""What the files' names end with."""
PARTIAL = ".partial"
"""What is appended to the name of a file that is not whole yet."""
FRAME = b"frame"
"""Under which key a file's metadata holds the frame of its elements."""
UNIT, LOWER, UPPER = b"unit", b"lower_limit", b"upper_limit"
"""Under which keys a column's metadata holds its unit, and its limits if it has any."""
GROUP = 64
"""How many batches of a stream make a row group of a Parquet file."""


class RunError(ValueError):
    """A folder is not a run, or lacks what was asked of it."""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Gives a path to write to that becomes `path` when all is written.

    Where something is raised nothing is left of it, and what `path` held stays; an
    OSError names the file.
    """
    partial = path.with_name(path.name + PARTIAL)
    try:
        yield partial
        partial.replace(path)
    except BaseException as error:
        with suppress(OSError):
            partial.unlink(missing_ok=True)
        _name_file(error, path)
        raise


def append_whole(path: Path, content: bytes, size: int) -> None:
    """Appends to a file of `size` bytes all of `content`, or nothing of it.

    Args:
        path: of the file; with size 0 it is made.
        content: what is appended.
        size: what the file holds so far, bytes; what lies beyond is overwritten.

    Raises:
        OSError: the file is gone, or cannot be written to; it is as it was.
    """
    file = path.open("r+b" if size else "wb", buffering=0)
    try:
        with file:
            file.seek(size)
            rest = memoryview(content)
            while rest:
                rest = rest[file.write(rest) :]
    except BaseException as error:
        with suppress(OSError):
            if size:
                os.truncate(path, size)
            else:
                path.unlink()
        _name_file(error, path)
        raise


def _name_file(error: BaseException, path: Path) -> None:
    """Adds the file's name to an error of the system that does not say it."""
    if isinstance(error, OSError) and error.filename is None:
        error.filename = str(path)


def stream_start(
    columns: Sequence[str],
    units: Sequence[str],
    frame: str = "",
    limits: Mapping[str, tuple[float, float]] | None = None,
) -> bytes:
    """Writes the beginning of an Arrow stream: `time` [s], then a column an element.

    Args:
        columns: names of the elements.
        units: their units.
        frame: what they are expressed in, as `signal_frames` says it.
        limits: least and most that an element may have, by column.
    """
    schema = _schema(columns, units, limits or {}).with_metadata({FRAME: frame})
    return schema.serialize().to_pybytes()  # type: ignore[no-any-return]


def stream_batch(
    columns: Sequence[str], units: Sequence[str], samples: Vector
) -> bytes:
    """Writes one batch of an Arrow stream.

    Args:
        columns: names of the elements.
        units: their units.
        samples: time, s, and elements, (n, 1 + elements).
    """
    arrays = [pa.array(column) for column in np.ascontiguousarray(samples.T)]
    batch = pa.RecordBatch.from_arrays(arrays, schema=_schema(columns, units))
    return batch.serialize().to_pybytes()  # type: ignore[no-any-return]


def json_lines(entries: Sequence[LoggedValue]) -> bytes:
    """Values of an abstract signal, {"time": ..., "value": {...}} a line.

    Raises:
        TypeError: a value has no JSON form.
    """
    lines = [
        json.dumps({"time": entry.time, "value": to_json(entry.value)}, allow_nan=False)
        for entry in entries
    ]
    return "".join(line + "\n" for line in lines).encode()


def make_parquet(stream: Path) -> None:
    """Makes a Parquet file of an Arrow stream beside it, which is then removed.

    Raises:
        OSError: the file cannot be written; the stream stays.
    """
    with (
        pa.OSFile(str(stream)) as file,
        whole_file(stream.with_suffix(PARQUET)) as path,
    ):
        reader = pa.ipc.open_stream(file)
        batches = _whole_batches(reader)
        with pq.ParquetWriter(path, reader.schema, compression="zstd") as writer:
            while group := list(islice(batches, GROUP)):
                writer.write_table(pa.Table.from_batches(group).combine_chunks())
    stream.unlink()


def read_table(path: Path) -> pa.Table:
    """Reads a vector signal of either kind, of a stream that was cut what is whole.

    Raises:
        RunError: it is neither, or was cut before its first batch.
    """
    try:
        if path.suffix == PARQUET:
            return pq.read_table(path)
        with pa.OSFile(str(path)) as file:
            reader = pa.ipc.open_stream(file)
            return pa.Table.from_batches(_whole_batches(reader), reader.schema)
    except (pa.ArrowException, OSError) as error:
        kind = "Parquet file" if path.suffix == PARQUET else "Arrow stream"
        raise RunError(f"{path}: not a {kind}: {error}") from error


def _schema(
    columns: Sequence[str],
    units: Sequence[str],
    limits: Mapping[str, tuple[float, float]] | None = None,
) -> pa.Schema:
    fields = []
    for column, unit in zip(("time", *columns), ("s", *units), strict=True):
        about = {UNIT: unit}
        if limits and column in limits:
            low, high = limits[column]
            about |= {LOWER: repr(float(low)), UPPER: repr(float(high))}
        fields.append(pa.field(column, pa.float64(), metadata=about))
    return pa.schema(fields)


def _whole_batches(reader: pa.RecordBatchReader) -> Iterator[pa.RecordBatch]:
    while True:
        try:
            yield reader.read_next_batch()
        except (StopIteration, pa.ArrowException, OSError):
            return


def signal_attrs(schema: pa.Schema) -> dict[str, Any]:
    """Reads what a signal's file says of it.

    Returns:
        `units` and `limits` by column, the latter least and most of those that have
        limits, and `frame`, what the elements are expressed in.
    """
    columns = {item.name: item.metadata or {} for item in schema}
    return {
        "units": {
            name: about.get(UNIT, b"").decode() for name, about in columns.items()
        },
        "limits": {
            name: (float(about[LOWER]), float(about[UPPER]))
            for name, about in columns.items()
            if LOWER in about
        },
        "frame": (schema.metadata or {}).get(FRAME, b"").decode(),
    }


class SignalFrames(Mapping[str, pd.DataFrame]):
    """The vector signals of a run by name; each file is read when it is asked for."""

    def __init__(self, folder: Path) -> None:
        """Lists the signals that lie in `folder`; each is read when it is asked for."""
        # A Parquet file is made of a stream: where both are, it is whole already.
        paths = [*folder.glob("*" + STREAM), *folder.glob("*" + PARQUET)]
        self._paths = dict(sorted((path.stem, path) for path in paths))
        self._frames: dict[str, pd.DataFrame] = {}

    def __getitem__(self, name: str) -> pd.DataFrame:
        """Reads a signal's data frame, a column an element after `time` [s].

        `frame.attrs["units"]` has the unit by column, `frame.attrs["limits"]` least and
        most of those columns that have limits, `frame.attrs["frame"]` what the elements
        are expressed in, "" where that is not known.

        Raises:
            KeyError: the run did not log this signal.
            RunError: its file is damaged.
        """
        if name not in self._paths:
            known = ", ".join(self._paths) or "none"
            raise KeyError(f"no signal {name!r} in this run; it has: {known}")
        if name not in self._frames:
            table = read_table(self._paths[name])
            frame: pd.DataFrame = table.to_pandas()
            frame.attrs.update(signal_attrs(table.schema))
            self._frames[name] = frame
        return self._frames[name]

    def __iter__(self) -> Iterator[str]:
        """Iterates over the names, sorted."""
        return iter(self._paths)

    def __len__(self) -> int:
        """Counts the signals."""
        return len(self._paths)


def parse_json(path: Path, text: bytes) -> Json:
    """Parses a JSON file, or a line of one.

    Raises:
        RunError: it is not JSON.
    """
    try:
        data: Json = json.loads(text)
    except ValueError as error:
        raise RunError(f"{path}: not JSON: {error}") from error
    return data
