"""Reading clouds from files: .pcd, .ply, .xyz, .txt and .npz."""

import contextlib
import io
import os
import sys
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from systems.ports import Vector

OPEN3D_SUFFIXES = (".pcd", ".ply")
TEXT_SUFFIXES = (".xyz", ".txt")
SUFFIXES = (*OPEN3D_SUFFIXES, *TEXT_SUFFIXES, ".npz")


class CloudFileError(Exception):
    """A file is no cloud; the message is one line with its name and the reason."""

    def __init__(self, path: Path, reason: str) -> None:
        """Makes the message.

        Args:
            path: the file.
            reason: what is wrong with it.
        """
        line = " ".join(f"{path}: {reason}".split())
        super().__init__(line)


def read_cloud(path: Path) -> Vector:
    """The points of a file, (n, 3), m, those that are not finite left out.

    `.pcd` and `.ply` are read by Open3D; `.xyz` and `.txt` hold a point a line, three
    or more columns between blanks or commas, `#` before comments; `.npz` holds an
    array (n, 3 or more), the only one or the one called `points`.

    Args:
        path: the file.

    Raises:
        CloudFileError: it is missing, unreadable, of another kind, or has no point.
    """
    suffix = path.suffix.lower()
    if path.is_dir():
        raise CloudFileError(path, "is a directory, not a cloud")
    if not path.exists():
        raise CloudFileError(path, "does not exist")
    if suffix not in SUFFIXES:
        kinds = ", ".join(SUFFIXES)
        raise CloudFileError(path, f"unknown kind of file, expected one of {kinds}")
    try:
        size = path.stat().st_size
        with path.open("rb"):
            pass
    except OSError as error:
        raise CloudFileError(path, f"cannot be read ({error.strerror})") from error
    if size == 0:
        raise CloudFileError(path, "is empty")
    if suffix in OPEN3D_SUFFIXES:
        points = _read_open3d(path)
    elif suffix in TEXT_SUFFIXES:
        points = _read_text(path)
    else:
        points = _read_npz(path)
    if not len(points):
        raise CloudFileError(path, "has no points")
    finite = points[np.all(np.isfinite(points), axis=1)]
    if not len(finite):
        raise CloudFileError(path, "has no finite point")
    return np.ascontiguousarray(finite, dtype=np.float64)


def _read_open3d(path: Path) -> Vector:
    from systems.open3d_loader import open3d

    declared = _declared_points(path)
    if declared is None:
        raise CloudFileError(path, f"is no {path.suffix.lower()} file")
    with _captured() as printed:
        cloud = open3d.io.read_point_cloud(path, remove_nan_points=False)
        points = np.array(cloud.points, dtype=np.float64)
    if declared == 0:
        return points
    # A broken file is only printed about; of a cut .ply even made-up points come.
    said = printed.getvalue()
    complete = len(points) == declared and _ascii_rows(path) in (None, declared)
    if not complete or "failed" in said or "rror" in said:
        raise CloudFileError(
            path, f"is cut short or damaged: its header promises {declared} points"
        )
    return points


def _declared_points(path: Path) -> int | None:
    """How many points the header of a .pcd or .ply file promises."""
    pcd = path.suffix.lower() == ".pcd"
    last, first = (b"DATA", b"POINTS") if pcd else (b"end_header", b"element vertex")
    declared: int | None = None
    with path.open("rb") as file:
        for _ in range(1000):
            line = file.readline(1000)
            if not line:
                return None
            if line.startswith(first):
                with contextlib.suppress(ValueError):
                    declared = int(line[len(first) :])
            if line.startswith(last):
                return declared
    return None


def _ascii_rows(path: Path) -> int | None:
    """How many rows an ASCII .pcd file holds; None for other files.

    Open3D puts the missing points of one that was cut short at the origin.
    """
    if path.suffix.lower() != ".pcd":
        return None
    columns = 0
    with path.open("rb") as file:
        for line in file:
            if line.startswith(b"FIELDS"):
                columns = len(line.split()) - 1
            if line.startswith(b"DATA"):
                break
        if b"ascii" not in line:
            return None
        return sum(len(row.split()) >= columns for row in file if row.strip())


def _read_text(path: Path) -> Vector:
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise CloudFileError(path, "is not text") from error
    lines = text.replace(",", " ").splitlines()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            table = np.loadtxt(lines, dtype=np.float64, comments="#", ndmin=2)
    except ValueError as error:
        raise CloudFileError(path, f"is not a table of numbers ({error})") from error
    if table.size and table.shape[1] < 3:
        raise CloudFileError(path, f"has {table.shape[1]} columns, expected 3 or more")
    return np.asarray(table[:, :3] if table.size else np.zeros((0, 3)))


def _read_npz(path: Path) -> Vector:
    try:
        # Opened here, for np.load does not close what it cannot read.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            names = list(archive.files)
            name = names[0] if len(names) == 1 else "points"
            if name not in names:
                raise CloudFileError(
                    path, f"holds {', '.join(names) or 'nothing'}, expected points"
                )
            array = archive[name]
    except CloudFileError:
        raise
    except Exception as error:
        raise CloudFileError(path, f"is no .npz file ({error})") from error
    if array.ndim != 2 or array.shape[1] < 3 or array.dtype.kind not in "fiu":
        raise CloudFileError(
            path,
            f"{name} must be numbers of shape (n, 3), got {array.dtype} "
            f"of shape {array.shape}",
        )
    return np.asarray(array[:, :3], dtype=np.float64)


@contextlib.contextmanager
def _captured() -> Iterator[io.StringIO]:
    """Catches what is printed: Open3D through Python, what it uses straight to 1, 2."""
    printed = io.StringIO()
    sys.stdout.flush()
    sys.stderr.flush()
    saved = os.dup(1), os.dup(2)
    with tempfile.TemporaryFile() as sink:
        os.dup2(sink.fileno(), 1)
        os.dup2(sink.fileno(), 2)
        try:
            with (
                contextlib.redirect_stdout(printed),
                contextlib.redirect_stderr(printed),
            ):
                yield printed
        finally:
            for target, copy in zip((1, 2), saved, strict=True):
                os.dup2(copy, target)
                os.close(copy)
            sink.seek(0)
            printed.write(sink.read().decode(errors="replace"))
