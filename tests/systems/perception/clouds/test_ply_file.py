"""Reading .ply files: clouds of any type come back, meshes are refused."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.ply_file import read_ply

POINTS = np.arange(30, dtype=np.float64).reshape(10, 3) / 8.0 - 1.0
FORMATS = {
    "ascii": "=",
    "binary_little_endian": "<",
    "binary_big_endian": ">",
}


def ply(
    points: Vector,
    format_: str,
    type_: str = "double",
    code: str = "f8",
    count: int | None = None,
) -> bytes:
    """The bytes of a .ply file by the format's description alone, with a colour."""
    header = (
        f"ply\nformat {format_} 1.0\ncomment made by a test\n"
        f"element vertex {len(points) if count is None else count}\n"
        f"property uchar red\nproperty {type_} x\nproperty {type_} y\n"
        f"property {type_} z\nend_header\n"
    )
    if format_ == "ascii":
        rows = (" ".join(["255", *map(repr, row)]) for row in points.tolist())
        return (header + "".join(f"{row}\n" for row in rows)).encode()
    code = FORMATS[format_] + code
    records = np.zeros(len(points), [("red", "u1"), *((axis, code) for axis in "xyz")])
    for axis, column in zip("xyz", points.T, strict=True):
        records[axis] = column
    return header.encode() + records.tobytes()


def read(data: bytes, folder: Path) -> Vector:
    """Writes bytes to a file and reads it."""
    path = folder / "cloud.ply"
    path.write_bytes(data)
    return read_ply(path)


@pytest.mark.parametrize(("type_", "code"), [("float", "f4"), ("double", "f8")])
@pytest.mark.parametrize("format_", FORMATS)
def test_points_of_every_type(
    format_: str, type_: str, code: str, tmp_path: Path
) -> None:
    """Text and both byte orders, single and double precision, beside a colour."""
    found = read(ply(POINTS, format_, type_, code), tmp_path)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, POINTS)


@settings(deadline=None, derandomize=True)
@given(
    points=npst.arrays(
        np.float64,
        st.tuples(st.integers(1, 40), st.just(3)),
        elements=st.floats(-1e9, 1e9),
    ),
    format_=st.sampled_from(sorted(FORMATS)),
)
def test_doubles_survive(
    points: Vector, format_: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Every double in every format."""
    found = read(ply(points, format_), tmp_path_factory.mktemp("ply"))
    np.testing.assert_array_equal(found, points)


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_a_mesh_is_no_cloud(encoding: str, tmp_path: Path) -> None:
    """Its few vertices are refused, with what to do instead."""
    mesh = trimesh.creation.box((1.0, 1.0, 1.0))
    data = trimesh.exchange.ply.export_ply(mesh, encoding=encoding)
    with pytest.raises(ValueError, match=r"is a mesh.*sample.*12 of element face"):
        read(data, tmp_path)


def test_a_cloud_may_have_no_faces(tmp_path: Path) -> None:
    """As some write it: an element face of none."""
    data = ply(POINTS, "binary_little_endian").replace(
        b"end_header",
        b"element face 0\nproperty list uchar int vertex_indices\nend_header",
    )
    np.testing.assert_array_equal(read(data, tmp_path), POINTS)


def test_elements_of_another_kind_are_refused(tmp_path: Path) -> None:
    """What is neither point nor face is named."""
    data = ply(POINTS, "ascii").replace(
        b"end_header", b"element edge 1\nproperty int vertex1\nend_header"
    )
    with pytest.raises(ValueError, match="elements edge"):
        read(data + b"3\n", tmp_path)


@pytest.mark.parametrize("format_", FORMATS)
@pytest.mark.parametrize("claimed", [11, 4_000_000_000, 10**30])
def test_claims_are_checked_first(format_: str, claimed: int, tmp_path: Path) -> None:
    """Points that a file cannot hold are refused before memory is taken for them."""
    with pytest.raises(ValueError, match=f"promises {claimed:,} points"):
        read(ply(POINTS, format_, count=claimed), tmp_path)


@pytest.mark.parametrize("format_", FORMATS)
def test_a_cut_file_is_refused(format_: str, tmp_path: Path) -> None:
    """Wherever it is cut."""
    data = ply(POINTS, format_)
    end = data.index(b"end_header")
    for length in (2, 40, end + 4, end + 15, len(data) - 9):
        with pytest.raises(ValueError, match=r"cut short|is no \.ply file"):
            read(data[:length], tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (b"ply\n", b"plx\n", "first line"),
        (b"ascii 1.0", b"ascii 2.0", "unknown format"),
        (b"ascii", b"base64", "unknown format"),
        (b"double y", b"double w", "no y of its vertices"),
        (b"double y", b"octuple y", "has no octuple"),
        (b"vertex 10", b"vertex ten", "element vertex ten"),
        (b"vertex 10", b"vertex -1", "element vertex -1"),
        (b"255 -1.0 ", b"255 -1,0 ", "damaged"),
        (b" -1.0 -0.875 -0.75\n", b" -1.0 -0.875 -0,75\n", "damaged"),
        (b"255 -1.0 ", b"255 one ", "damaged"),
        (b"255 -1.0 ", b"255 ", "damaged"),
    ],
)
def test_files_that_make_no_sense(
    old: bytes, new: bytes, reason: str, tmp_path: Path
) -> None:
    """Each is refused with what is wrong."""
    data = ply(POINTS, "ascii")
    assert old in data
    with pytest.raises(ValueError, match=reason):
        read(data.replace(old, new, 1), tmp_path)


@settings(deadline=None, derandomize=True)
@given(data=st.binary(max_size=200), keep=st.integers(0, 120))
def test_garbage_is_refused(
    data: bytes, keep: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Nothing but a ValueError comes of bytes behind any part of a header."""
    start = ply(POINTS, "binary_little_endian")[:keep]
    with pytest.raises(ValueError, match=r"is|has"):
        read(start + data, tmp_path_factory.mktemp("ply"))
