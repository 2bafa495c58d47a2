"""Reading .pcd files of the Point Cloud Library: ascii, binary, binary_compressed."""

import io
import struct
from pathlib import Path
from typing import BinaryIO

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_claims import check_claim

LONGEST_HEADER = 65_536
"""Bytes in which the header of a file that is one has ended."""
MAX_COLUMNS = 4096
"""Numbers in a point; the longest descriptors have hundreds."""
LZF_LARGEST_RATIO = 88
"""Largest ratio of LZF: three bytes stand for at most 264."""
SIZES = struct.Struct("<II")
"""Before compressed data: its size and that of what it holds, bytes."""


def read_pcd(path: Path) -> Vector:
    """Reads the fields x, y and z of a .pcd file, (n, 3), as they are, in its frame.

    The viewpoint in the header is not applied.

    Raises:
        ValueError: the header or the data is not that of a .pcd file, or promises
            more than the file holds; the message says what of it.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        header = _read_header(file)
        return _read_data(header, file, size - file.tell())


def _read_header(file: BinaryIO) -> dict[str, list[str]]:
    """Reads header lines by their first word, up to the first byte of data."""
    header: dict[str, list[str]] = {}
    while "DATA" not in header:
        line = file.readline(LONGEST_HEADER)
        if not line.endswith(b"\n") or file.tell() > LONGEST_HEADER:
            raise ValueError("is no .pcd file: its header has no line DATA")
        words = line.decode("ascii", errors="replace").split()
        if words and not words[0].startswith("#"):
            header[words[0]] = words[1:]
    missing = {"FIELDS", "SIZE", "TYPE", "WIDTH"} - header.keys()
    if missing:
        raise ValueError(f"is no .pcd file: its header has no line {min(missing)}")
    return header


def _read_data(header: dict[str, list[str]], file: BinaryIO, held: int) -> Vector:
    # pypcd4 brings pydantic: half of the time that reading a small cloud takes.
    from pypcd4.pypcd4 import Encoding, MetaData, PointCloud

    fields = header["FIELDS"]
    if any(fields.count(axis) != 1 for axis in "xyz"):
        raise ValueError(f"has the fields {' '.join(fields)}, expected x, y and z")
    ascii_ = header["DATA"] == ["ascii"]
    lengths = {len(header.get(key, fields)) for key in ("SIZE", "TYPE", "COUNT")}
    if lengths != {len(fields)}:
        raise ValueError("has a .pcd header with a field too few or too many in a line")
    try:
        counts = [int(word) for word in header.get("COUNT", ["1"] * len(fields))]
        width, height = int(header["WIDTH"][0]), int(header.get("HEIGHT", ["1"])[0])
        points = int(header["POINTS"][0]) if "POINTS" in header else width * height
        if sum(counts) > MAX_COLUMNS:
            raise ValueError(f"{sum(counts)} numbers in a point")
        metadata = MetaData.model_validate(
            {
                # Fields of padding share one name.
                "fields": [n if n in "xyz" else f"{i}" for i, n in enumerate(fields)],
                # Text is read as it is written: a column of integers may hold nan.
                "type": ["F" if ascii_ else word for word in header["TYPE"]],
                "size": [8 if ascii_ else int(word) for word in header["SIZE"]],
                "count": counts,
                "points": points,
                "width": width,
                "height": height,
                "data": Encoding(*header["DATA"]),
            }
        )
        item = metadata.build_dtype().itemsize
    except (ValueError, KeyError, IndexError, TypeError) as error:
        raise ValueError("has a .pcd header that makes no sense") from error
    if any(counts[fields.index(axis)] != 1 for axis in "xyz"):
        raise ValueError("has more than one x, y or z in a point")
    if points != width * height:
        raise ValueError(f"has a header of {points} points in {height} rows of {width}")
    if ascii_:
        # A digit and a blank are the least that a number takes.
        check_claim(points, 2 * points * sum(counts) - 1, held)
        data = _plain_rows(file, points, sum(counts))
    elif metadata.data is Encoding.BINARY:
        check_claim(points, points * item, held)
        data = file.read(points * item)
    else:
        data = _compressed(file, points, points * item, held)
    whole = io.BytesIO(metadata.compose_header().encode() + data)
    try:
        cloud = PointCloud.from_fileobj(whole)  # type: ignore[arg-type]
        return np.asarray(cloud.numpy(tuple("xyz")), dtype=np.float64)
    except Exception as error:
        raise ValueError(f"is a damaged .pcd file ({error})") from error


def _plain_rows(file: BinaryIO, points: int, columns: int) -> bytes:
    """Reads the rows of an ascii file with one blank between numbers, for pypcd4."""
    rows = [b" ".join(row) for row in map(bytes.split, file) if row]
    whole = sum(row.count(b" ") == columns - 1 for row in rows)
    if not whole == len(rows) == points:
        raise ValueError(
            f"is cut short or damaged: its header promises {points:,} points, and "
            f"{whole:,} of its {len(rows):,} rows have {columns} numbers"
        )
    return b"\n".join(rows)


def _compressed(file: BinaryIO, points: int, needed: int, held: int) -> bytes:
    """Reads the compressed data and its two sizes, if they fit the file."""
    if points == 0:
        return b""
    sizes = file.read(SIZES.size)
    if len(sizes) < SIZES.size:
        check_claim(points, SIZES.size, len(sizes))
    compressed, plain = SIZES.unpack(sizes)
    held -= SIZES.size
    check_claim(points, needed, min(plain, LZF_LARGEST_RATIO * min(compressed, held)))
    check_claim(points, compressed, held)
    if plain != needed:
        raise ValueError(
            f"is damaged: its header promises {needed:,} bytes, its data {plain:,}"
        )
    return sizes + file.read(compressed)
