"""Reading the vertices of .ply files that are clouds: ascii, binary of either order."""

import warnings
from pathlib import Path
from typing import BinaryIO

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_claims import check_claim

LONGEST_HEADER = 65_536
"""Bytes in which the header of a file that is one has ended."""
FORMATS = [
    [name, "1.0"] for name in ("ascii", "binary_little_endian", "binary_big_endian")
]
IS_A_MESH = (
    "is a mesh, whose vertices are no cloud: sample its surface first, for instance "
    "with trimesh.sample.sample_surface"
)


def read_ply(path: Path) -> Vector:
    """Reads x, y and z of the vertices of a .ply file, (n, 3), as they are.

    Raises:
        ValueError: it is a mesh, or no .ply file, or promises more than it holds.
    """
    # Trimesh brings much of SciPy: not for those who read another kind of file.
    from trimesh.exchange.ply import load_ply

    size = path.stat().st_size
    with path.open("rb") as file:
        elements = _count_elements(file)
        for name, count in elements.items():
            if count and name not in ("vertex", "camera"):
                if name in ("face", "tristrips"):
                    raise ValueError(f"{IS_A_MESH} ({count:,} of element {name})")
                raise ValueError(f"has elements {name}, expected vertex alone")
        points = elements.get("vertex", 0)
        # A byte an element is the least, and bounds what trimesh asks for.
        check_claim(points, sum(elements.values()), size - file.tell())
        if points == 0:
            return np.zeros((0, 3))
        file.seek(0)
        try:
            with warnings.catch_warnings():
                # NumPy before 2.3 only warns of text that is no number.
                warnings.simplefilter("error")
                found = load_ply(file, skip_materials=True)
            vertices = np.asarray(found["vertices"], dtype=np.float64)
        except KeyError as error:
            raise ValueError(f"has no {error.args[0]} of its vertices") from error
        except Exception as error:
            raise ValueError(
                f"is cut short or damaged: its header promises {points:,} points "
                f"({error})"
            ) from error
    if vertices.shape != (points, 3):
        raise ValueError(
            f"is cut short or damaged: its header promises {points:,} points, and "
            f"{len(vertices):,} are there"
        )
    return vertices


def _count_elements(file: BinaryIO) -> dict[str, int]:
    """Counts each element the header promises; the file is left behind it."""
    counts: dict[str, int] = {}
    first = True
    while True:
        line = file.readline(LONGEST_HEADER)
        words = line.decode("ascii", errors="replace").split()
        if not line.endswith(b"\n") or file.tell() > LONGEST_HEADER:
            raise ValueError("is no .ply file: its header has no end")
        if first and words != ["ply"]:
            raise ValueError("is no .ply file: its first line is not ply")
        first = False
        if words[:1] == ["format"] and words[1:] not in FORMATS:
            raise ValueError(f"has the unknown format {' '.join(words[1:])}")
        if words[:1] == ["end_header"]:
            return counts
        if words[:1] == ["element"]:
            if len(words) != 3 or not words[2].isdecimal():
                raise ValueError(f"is no .ply file: its header says {' '.join(words)}")
            counts[words[1]] = int(words[2])
