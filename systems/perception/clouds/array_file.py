"""Reading clouds from NumPy's files: .npy and .npz."""

import math
import zipfile
import zlib
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_claims import check_claim

DEFLATE_LARGEST_RATIO = 1032
"""Largest ratio of deflate: no byte of compressed data stands for more."""
HEADERS = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}


def read_npy(path: Path) -> Vector:
    """Reads the points of a .npy file, (n, 3), as they are.

    Raises:
        ValueError: it is no such file, promises more than it holds, or is no cloud.
    """
    with path.open("rb") as file:
        try:
            array = _read_array(file, path.stat().st_size)
        except _NoArrayError as error:
            raise ValueError(f"is no .npy file ({error})") from error
    return _points_of("its array", array)


def read_npz(path: Path) -> Vector:
    """Reads the points of a .npz file, (n, 3): its only array or the one `points`.

    Raises:
        ValueError: it is no such file, promises more than it holds, or is no cloud.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            names = [name.removesuffix(".npy") for name in archive.namelist()]
            name = names[0] if len(names) == 1 else "points"
            if name not in names:
                held = ", ".join(names) or "nothing"
                raise ValueError(f"holds {held}, expected points")
            member = archive.infolist()[names.index(name)]
            stored = member.compress_type == zipfile.ZIP_STORED
            if not stored and member.compress_type != zipfile.ZIP_DEFLATED:
                raise _NoArrayError("its compression is not NumPy's")
            # The directory of an archive is a claim, too.
            most = path.stat().st_size * (1 if stored else DEFLATE_LARGEST_RATIO)
            with archive.open(member) as file:
                array = _read_array(file, min(member.file_size, most))
    except (zipfile.BadZipFile, _NoArrayError, NotImplementedError) as error:
        raise ValueError(f"is no .npz file ({error})") from error
    except (RuntimeError, EOFError, zlib.error) as error:
        raise ValueError(f"is a damaged .npz file ({error})") from error
    return _points_of(name, array)


class _NoArrayError(Exception):
    """The bytes are not those of an array."""


def _read_array(file: IO[bytes], size: int) -> NDArray[Any]:
    """Reads the array in the `size` bytes of a file, its header before its data."""
    try:
        version = npy.read_magic(file)
        if version not in HEADERS:
            raise ValueError(f"version {version[0]}.{version[1]}")
        shape, fortran, dtype = HEADERS[version](file)
    except Exception as error:
        raise _NoArrayError(str(error)) from error
    if dtype.hasobject:
        raise _NoArrayError("it holds Python objects, not numbers")
    if any(length < 0 for length in shape):
        raise _NoArrayError(f"its shape is {shape}")
    count = math.prod(shape)
    points = math.prod(shape[:-1])
    check_claim(points, count * dtype.itemsize, size - file.tell())
    data = file.read(count * dtype.itemsize)
    check_claim(points, count * dtype.itemsize, len(data))
    array = np.frombuffer(data, dtype=dtype, count=count)
    return array.reshape(shape, order="F" if fortran else "C")


def _points_of(name: str, array: NDArray[Any]) -> Vector:
    """Reads the points of an array (n, 3 or more), (h, w, 3), or of x, y, z records."""
    fields = array.dtype.names
    if fields is not None and set("xyz") <= set(fields):
        array = np.stack([array[axis] for axis in "xyz"], axis=-1)
    shape = array.shape
    if len(shape) == 2 and shape[0] == 3 and shape[1] > 3:
        raise ValueError(f"{name} has shape {shape}, expected (n, 3): transpose it")
    many = len(shape) == 2 and shape[1] >= 3
    organised = len(shape) == 3 and shape[2] == 3
    if not (many or organised) or array.dtype.kind not in "fiu":
        raise ValueError(
            f"{name} must be numbers of shape (n, 3), got {array.dtype} of shape "
            f"{shape}"
        )
    return np.asarray(array[..., :3].reshape(-1, 3), dtype=np.float64)
