"""Reading clouds from files: .pcd, .ply, .xyz, .txt, .csv, .npy and .npz."""

import stat
from collections.abc import Callable
from pathlib import Path

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.array_file import read_npy, read_npz
from footfall.systems.perception.clouds.pcd_file import read_pcd
from footfall.systems.perception.clouds.ply_file import IS_A_MESH, read_ply
from footfall.systems.perception.clouds.text_file import read_table

READERS: dict[str, Callable[[Path], Vector]] = {
    ".pcd": read_pcd,
    ".ply": read_ply,
    ".xyz": read_table,
    ".txt": read_table,
    ".csv": read_table,
    ".npy": read_npy,
    ".npz": read_npz,
}
"""Reader of each kind of file; a ValueError says what is wrong with the file."""
MESH_SUFFIXES = (".stl", ".obj", ".off", ".dae", ".glb", ".gltf", ".3mf")


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
    """Reads the points of a file, (n, 3), m, those that are not finite left out.

    What a file claims to hold is checked against its size before memory is taken.
    The kinds: `.pcd` (ascii, binary, compressed; any number type) and `.ply` that is
    no mesh; `.xyz`, `.txt` and `.csv` as `read_table` reads them; `.npy`, and `.npz`
    with one array or one called `points`, of shape (n, 3 or more) or (h, w, 3), or
    of records with x, y and z.

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
    if suffix in MESH_SUFFIXES:
        raise CloudFileError(path, IS_A_MESH)
    if suffix not in READERS:
        kinds = ", ".join(READERS)
        raise CloudFileError(path, f"unknown kind of file, expected one of {kinds}")
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            raise CloudFileError(path, "is not a regular file")
        if status.st_size == 0:
            raise CloudFileError(path, "is empty")
        points = READERS[suffix](path)
    except OSError as error:
        raise CloudFileError(path, f"cannot be read ({error.strerror})") from error
    except ValueError as error:
        raise CloudFileError(path, str(error)) from error
    except MemoryError as error:
        raise CloudFileError(path, "is too large for this machine's memory") from error
    if not len(points):
        raise CloudFileError(path, "has no points")
    finite = points[np.all(np.isfinite(points), axis=1)]
    if not len(finite):
        raise CloudFileError(path, "has no finite point")
    return np.ascontiguousarray(finite, dtype=np.float64)
