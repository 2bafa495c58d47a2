"""Reading .pcd files: every encoding and number type, and what a header may claim."""

import struct
from pathlib import Path

import lzf
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.pcd_file import read_pcd

POINTS = np.arange(30, dtype=np.float64).reshape(10, 3) / 8.0 - 1.0
ENCODINGS = ("ascii", "binary", "binary_compressed")


def pcd(records: np.ndarray, encoding: str, **header: object) -> bytes:
    """The bytes of a .pcd file of records, by the format's description alone.

    Args:
        records: structured array, (n,); a field of several numbers has a COUNT.
        encoding: the line DATA.
        header: lines that are to say something else; None for no such line.
    """
    kinds = {"f": "F", "i": "I", "u": "U"}
    columns = [(name, records.dtype[name]) for name in records.dtype.names or ()]
    lines: dict[str, object] = {
        "VERSION": "0.7",
        "FIELDS": " ".join(name.strip("0123456789") for name, _ in columns),
        "SIZE": " ".join(str(column.base.itemsize) for _, column in columns),
        "TYPE": " ".join(kinds[column.base.kind] for _, column in columns),
        "COUNT": " ".join(str(int(np.prod(column.shape))) for _, column in columns),
        "WIDTH": len(records),
        "HEIGHT": 1,
        "VIEWPOINT": "0 0 0 1 0 0 0",
        "POINTS": len(records),
        "DATA": encoding,
    }
    said = "".join(
        f"{key} {value}\n"
        for key, value in (lines | header).items()
        if value is not None
    )
    start = f"# .PCD v.7 - Point Cloud Data file format\n{said}".encode()
    if encoding == "ascii":
        rows = (" ".join(_words(record)) for record in records)
        return start + "".join(f"{row}\n" for row in rows).encode()
    if encoding == "binary":
        return start + records.tobytes()
    plain = b"".join(records[name].tobytes() for name, _ in columns)
    packed = lzf.compress(plain, 2 * len(plain) + 64)
    return start + struct.pack("<II", len(packed), len(plain)) + packed


def _words(record: np.void) -> list[str]:
    return [repr(number) for cell in record for number in np.ravel(cell).tolist()]


def xyz(points: Vector, dtype: object = "<f4") -> np.ndarray:
    """The points as records."""
    records = np.zeros(len(points), dtype=[(axis, dtype) for axis in "xyz"])
    for axis, column in zip("xyz", points.T, strict=True):
        records[axis] = column
    return records


def read(data: bytes, folder: Path) -> Vector:
    """Writes bytes to a file and reads it."""
    path = folder / "cloud.pcd"
    path.write_bytes(data)
    return read_pcd(path)


@pytest.mark.parametrize("dtype", ["<f4", "<f8", "<i2", "<i4", "<i8", "<u1", "<u8"])
@pytest.mark.parametrize("encoding", ENCODINGS)
def test_points_of_every_type(encoding: str, dtype: str, tmp_path: Path) -> None:
    """Doubles and integers come back as exactly as single precision does."""
    points = POINTS if dtype[1] == "f" else np.arange(30.0).reshape(10, 3)
    found = read(pcd(xyz(points, dtype), encoding), tmp_path)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, points)


@settings(deadline=None, derandomize=True)
@given(
    points=npst.arrays(
        np.float64,
        st.tuples(st.integers(1, 40), st.just(3)),
        elements=st.floats(allow_infinity=False, width=64),
    ),
    encoding=st.sampled_from(ENCODINGS),
)
def test_doubles_survive(
    points: Vector, encoding: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Every double in every encoding, nan among them."""
    found = read(pcd(xyz(points, "<f8"), encoding), tmp_path_factory.mktemp("pcd"))
    np.testing.assert_array_equal(found, points)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_other_fields_are_passed_over(encoding: str, tmp_path: Path) -> None:
    """Padding of one name, histograms, mixed types, and x, y, z in any order."""
    records = np.zeros(
        10,
        dtype=[
            ("intensity", "<u2"),
            *[("z", "<f8"), ("_1", "<u1", (3,)), ("y", "<f4"), ("_2", "<u1", (2,))],
            *[("histogram", "<f4", (5,)), ("x", "<f4")],
        ],
    )
    for axis, column in zip("xyz", POINTS.T, strict=True):
        records[axis] = column
    records["histogram"] = np.pi
    records["intensity"] = 40_000
    found = read(pcd(records, encoding), tmp_path)
    np.testing.assert_array_equal(found, POINTS)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_organised_clouds_keep_their_holes(encoding: str, tmp_path: Path) -> None:
    """Rows and columns come as one list; a hole is nan."""
    holes = POINTS.copy()
    holes[3] = np.nan
    found = read(pcd(xyz(holes), encoding, WIDTH=5, HEIGHT=2), tmp_path)
    np.testing.assert_array_equal(found, holes)


@pytest.mark.parametrize(
    "header",
    [
        {"COUNT": None},
        {"VERSION": ".6", "COUNT": None},
        {"VIEWPOINT": None, "HEIGHT": None, "POINTS": None},
    ],
)
def test_lines_that_may_be_missing(header: dict[str, object], tmp_path: Path) -> None:
    """What older writers leave out has its usual value."""
    found = read(pcd(xyz(POINTS), "binary", **header), tmp_path)
    np.testing.assert_array_equal(found, POINTS)


def test_lines_of_windows_and_spare_blanks(tmp_path: Path) -> None:
    """An ascii file that has been through an editor."""
    data = pcd(xyz(POINTS), "ascii").replace(b"\n", b" \r\n").replace(b"-", b"\t -")
    np.testing.assert_array_equal(read(data, tmp_path), POINTS)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("claimed", [11, 4_000_000_000, 10**30])
def test_claims_are_checked_first(encoding: str, claimed: int, tmp_path: Path) -> None:
    """Points that a file cannot hold are refused before memory is taken for them."""
    data = pcd(xyz(POINTS), encoding, WIDTH=claimed, POINTS=claimed)
    with pytest.raises(ValueError, match=f"promises {claimed:,} points"):
        read(data, tmp_path)


@pytest.mark.parametrize("plain", [120, 4_000_000_000])
@pytest.mark.parametrize("packed", [8, 4_000_000_000])
def test_compressed_sizes_are_claims(plain: int, packed: int, tmp_path: Path) -> None:
    """No size of compressed data exceeds what the other, or the file, allows."""
    points = plain // 12
    data = pcd(xyz(POINTS), "binary_compressed", WIDTH=points, POINTS=points)
    start = data.index(b"compressed\n") + len(b"compressed\n")
    data = data[:start] + struct.pack("<II", packed, plain) + b"\xff" * 8
    with pytest.raises(ValueError, match=r"is (a|cut short or) damaged"):
        read(data, tmp_path)


def test_compressed_data_is_that_of_the_points(tmp_path: Path) -> None:
    """Data of more points than the header has is that of another cloud."""
    data = pcd(xyz(POINTS), "binary_compressed", WIDTH=9, POINTS=9)
    with pytest.raises(ValueError, match="promises 108 bytes, its data 120"):
        read(data, tmp_path)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_a_cut_file_is_refused(encoding: str, tmp_path: Path) -> None:
    """Wherever it is cut, but for the last line break of text."""
    data = pcd(xyz(POINTS), encoding)
    end = data.index(encoding.encode())
    for length in (20, end, end + len(encoding) + 4, len(data) - 8):
        with pytest.raises(ValueError, match=r"cut short|is no \.pcd file"):
            read(data[:length], tmp_path)


@pytest.mark.parametrize(
    ("header", "reason"),
    [
        ({"FIELDS": "x y w"}, "expected x, y and z"),
        ({"FIELDS": "x y z x"}, "expected x, y and z"),
        ({"TYPE": "F F"}, "too few or too many"),
        ({"SIZE": "4 4 4 4"}, "too few or too many"),
        ({"TYPE": "F F G"}, "makes no sense"),
        ({"SIZE": "4 4 3"}, "makes no sense"),
        ({"SIZE": "4 four 4"}, "makes no sense"),
        ({"COUNT": "1 1 5000"}, "makes no sense"),
        ({"COUNT": "1 1 2"}, "more than one x, y or z"),
        ({"COUNT": "1 1 -1"}, "makes no sense"),
        ({"POINTS": -1}, "makes no sense"),
        ({"WIDTH": 3}, "10 points in 1 rows of 3"),
        ({"WIDTH": None}, "no line WIDTH"),
        ({"DATA": "binary_zipped"}, "makes no sense"),
        ({"DATA": ""}, "makes no sense"),
    ],
)
def test_headers_that_make_no_sense(
    header: dict[str, object], reason: str, tmp_path: Path
) -> None:
    """Each is refused with what is wrong."""
    with pytest.raises(ValueError, match=reason):
        read(pcd(xyz(POINTS), "binary", **header), tmp_path)


@pytest.mark.parametrize("row", [b"1 2", b"1 2 3 4", b"1 two 3", b"1,5 2,0 3,0"])
def test_rows_that_make_no_sense(row: bytes, tmp_path: Path) -> None:
    """A row of text has as many numbers as there are fields."""
    data = pcd(xyz(POINTS), "ascii")
    last = data.rindex(b"\n", 0, -1) + 1
    with pytest.raises(ValueError, match="damaged"):
        read(data[:last] + row + b"\n", tmp_path)


@settings(deadline=None, derandomize=True)
@given(data=st.binary(max_size=200), keep=st.integers(0, 160))
def test_garbage_is_refused(
    data: bytes, keep: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Nothing but a ValueError comes of bytes behind any part of a header."""
    start = pcd(xyz(POINTS), "binary_compressed")[:keep]
    with pytest.raises(ValueError, match=r"is|has"):
        read(start + data, tmp_path_factory.mktemp("pcd"))
