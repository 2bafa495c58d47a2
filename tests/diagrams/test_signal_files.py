"""The files of signals: whole wherever they are cut, and nothing half of anything."""

import resource
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pyarrow.parquet as pq
import pytest

from footfall.diagrams.signal_files import (
    RunError,
    SignalFrames,
    append_whole,
    make_parquet,
    read_table,
    stream_batch,
    stream_start,
    whole_file,
)

COLUMNS, UNITS = ("knee", "hip"), ("rad", "Nm")


@contextmanager
def room_for(size: int) -> Iterator[None]:
    """Files cannot grow beyond `size` bytes, as on a disk that fills up."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def samples(batch: int) -> np.ndarray:
    """Four rows, different for each batch."""
    return np.arange(12.0).reshape(4, 3) + 12.0 * batch


def a_stream(batches: int) -> list[bytes]:
    """Beginning and batches of a stream."""
    start = stream_start(COLUMNS, UNITS)
    return [start] + [
        stream_batch(COLUMNS, UNITS, samples(batch)) for batch in range(batches)
    ]


def test_a_stream_is_read_up_to_its_last_whole_batch_wherever_it_is_cut(
    tmp_path,
) -> None:
    """Byte by byte; before the first column's name there is nothing to read."""
    parts = a_stream(2)
    start, first, second = np.cumsum([len(part) for part in parts])
    path = tmp_path / "s.y.arrows"
    for size in range(second + 1):
        path.write_bytes(b"".join(parts)[:size])
        if size < start:
            with pytest.raises(RunError, match=r"s\.y\.arrows: not an? Arrow stream"):
                read_table(path)
            continue
        whole = int(size >= first) + int(size >= second)
        assert read_table(path).num_rows == 4 * whole, size
    expected = np.concatenate([samples(0), samples(1)])
    np.testing.assert_array_equal(SignalFrames(tmp_path)["s.y"].to_numpy(), expected)


def test_parquet_is_made_of_a_stream(tmp_path, monkeypatch) -> None:
    """With all its rows and its units; the stream is gone then."""
    monkeypatch.setattr("footfall.diagrams.signal_files.GROUP", 2)
    path = tmp_path / "s.y.arrows"
    path.write_bytes(b"".join(a_stream(5)) + b"torn")
    make_parquet(path)
    assert [each.name for each in tmp_path.iterdir()] == ["s.y.parquet"]
    frame = SignalFrames(tmp_path)["s.y"]
    np.testing.assert_array_equal(
        frame.to_numpy(), np.concatenate([samples(batch) for batch in range(5)])
    )
    assert frame.attrs["units"] == {"time": "s", "knee": "rad", "hip": "Nm"}
    assert pq.ParquetFile(tmp_path / "s.y.parquet").num_row_groups == 3


def test_without_room_for_parquet_the_stream_stays(tmp_path) -> None:
    """And nothing of the other."""
    path = tmp_path / "s.y.arrows"
    path.write_bytes(b"".join(a_stream(3)))
    with room_for(100), pytest.raises(OSError, match=r"s\.y\.parquet"):
        make_parquet(path)
    assert [each.name for each in tmp_path.iterdir()] == ["s.y.arrows"]
    assert read_table(path).num_rows == 12


def test_where_both_are_parquet_is_read(tmp_path) -> None:
    """It was whole when it took its name."""
    stream = tmp_path / "s.y.arrows"
    stream.write_bytes(b"".join(a_stream(1)))
    make_parquet(stream)
    stream.write_bytes(b"")
    assert list(SignalFrames(tmp_path)) == ["s.y"]
    assert len(SignalFrames(tmp_path)["s.y"]) == 4


def test_what_does_not_fit_is_not_appended_at_all(tmp_path) -> None:
    """The error names the file; a new one is not left empty."""
    path = tmp_path / "file"
    append_whole(path, b"0123456789", 0)
    with room_for(15), pytest.raises(OSError, match="file") as caught:
        append_whole(path, b"abcdefghij", 10)
    assert caught.value.filename == str(path)
    assert path.read_bytes() == b"0123456789"
    append_whole(path, b"abc", 10)
    assert path.read_bytes() == b"0123456789abc"
    with room_for(5), pytest.raises(OSError, match="new"):
        append_whole(tmp_path / "new", b"0123456789", 0)
    assert not (tmp_path / "new").exists()


def test_a_file_that_is_gone_is_not_begun_in_the_middle(tmp_path) -> None:
    """What was appended would have no beginning."""
    with pytest.raises(FileNotFoundError):
        append_whole(tmp_path / "file", b"abc", 10)
    assert not (tmp_path / "file").exists()


def test_appending_again_overwrites_what_was_not_counted(tmp_path) -> None:
    """As after Ctrl-C between writing and counting."""
    path = tmp_path / "file"
    append_whole(path, b"0123", 0)
    append_whole(path, b"abc", 4)
    append_whole(path, b"abcdef", 4)
    assert path.read_bytes() == b"0123abcdef"


@pytest.mark.parametrize("error", [ValueError("no"), KeyboardInterrupt()])
def test_a_file_is_whole_or_not_there(tmp_path, error) -> None:
    """Whatever breaks its making off; the one before it stays."""
    target = tmp_path / "picture.png"

    def fail() -> None:
        with whole_file(target) as path:
            path.write_text("half")
            raise error

    with pytest.raises(type(error)):
        fail()
    assert list(tmp_path.iterdir()) == []
    with whole_file(target) as path:
        path.write_text("whole")
    with pytest.raises(type(error)):
        fail()
    assert [each.name for each in tmp_path.iterdir()] == ["picture.png"]
    assert target.read_text() == "whole"
