"""Reading .npy and .npz files: shapes that are clouds, and what headers may claim."""

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.array_file import read_npy, read_npz

POINTS = np.arange(30, dtype=np.float64).reshape(10, 3) / 8.0


def npy(array: object, claimed: tuple[int, ...] | None = None) -> bytes:
    """The bytes of a .npy file, with the header of another shape if one is given."""
    file = io.BytesIO()
    if claimed is None:
        np.save(file, np.asarray(array))
        return file.getvalue()
    array = np.asarray(array)
    header = {"descr": array.dtype.str, "fortran_order": False, "shape": claimed}
    np.lib.format.write_array_header_1_0(file, header)
    return file.getvalue() + array.tobytes()


def read(data: bytes, folder: Path) -> Vector:
    """Writes bytes to a file and reads it."""
    path = folder / "cloud.npy"
    path.write_bytes(data)
    return read_npy(path)


RECORDS = np.rec.fromarrays([np.ones(10), *POINTS.T], names="t,x,y,z")


@pytest.mark.parametrize(
    "array",
    [
        POINTS,
        np.asfortranarray(POINTS),
        POINTS.astype(">f4"),
        np.hstack([POINTS, POINTS]),
        POINTS.reshape(2, 5, 3),
        RECORDS,
        RECORDS.reshape(5, 2),
    ],
)
def test_arrays_that_are_clouds(array: Vector, tmp_path: Path) -> None:
    """Any order and type, further columns, an organised cloud, records."""
    found = read(npy(array), tmp_path)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, POINTS)


@settings(deadline=None, derandomize=True)
@given(
    points=npst.arrays(
        npst.floating_dtypes(sizes=(32, 64)) | npst.integer_dtypes(),
        st.tuples(st.integers(0, 2) | st.integers(4, 40), st.integers(3, 6)),
    )
)
def test_numbers_survive(
    points: Vector, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Every number of every type comes back as the double next to it."""
    folder = tmp_path_factory.mktemp("npy")
    wanted = points[:, :3].astype(np.float64)
    np.testing.assert_array_equal(read(npy(points), folder), wanted)
    for save in (np.savez, np.savez_compressed):
        save(folder / "cloud.npz", points)
        np.testing.assert_array_equal(read_npz(folder / "cloud.npz"), wanted)


@pytest.mark.parametrize(
    ("array", "reason"),
    [
        (POINTS.T, "transpose it"),
        (POINTS[0], r"of shape \(3,\)"),
        (np.float64(1.0), r"of shape \(\)"),
        (POINTS[:, :2], r"of shape \(10, 2\)"),
        (POINTS.reshape(10, 3, 1), r"of shape \(10, 3, 1\)"),
        (POINTS > 1.0, "must be numbers"),
        (POINTS * 1j, "must be numbers"),
        (POINTS.astype(str), "must be numbers"),
        (POINTS.astype(object), "Python objects"),
    ],
)
def test_arrays_that_are_no_clouds(array: Vector, reason: str, tmp_path: Path) -> None:
    """Each is refused by what it is."""
    with pytest.raises(ValueError, match=reason):
        read(npy(array), tmp_path)


CLAIMS = [(11, 3), (4_000_000_000, 3), (10**12, 10**12, 3)]


@pytest.mark.parametrize("claimed", CLAIMS)
def test_claims_are_checked_first(claimed: tuple[int, ...], tmp_path: Path) -> None:
    """A shape that the file cannot hold is refused before memory is taken for it."""
    with pytest.raises(ValueError, match=r"promises .* points"):
        read(npy(POINTS, claimed), tmp_path)


@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
@pytest.mark.parametrize("claimed", CLAIMS)
def test_claims_in_an_archive(
    claimed: tuple[int, ...], compression: int, tmp_path: Path
) -> None:
    """The same within a .npz file."""
    path = tmp_path / "cloud.npz"
    with zipfile.ZipFile(path, "w", compression) as archive:
        archive.writestr("points.npy", npy(POINTS, claimed))
    with pytest.raises(ValueError, match=r"promises .* points"):
        read_npz(path)


@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_the_directory_of_an_archive_is_a_claim(
    compression: int, tmp_path: Path
) -> None:
    """A member that is said to be larger than the archive could hold is refused."""
    path = tmp_path / "cloud.npz"
    data = npy(POINTS, (100_000_000, 3))
    with zipfile.ZipFile(path, "w", compression) as archive:
        archive.writestr("points.npy", data)
    size = len(data).to_bytes(4, "little")
    whole = path.read_bytes()
    assert size in whole
    path.write_bytes(whole.replace(size, (2_500_000_000).to_bytes(4, "little")))
    with pytest.raises(ValueError, match=r"promises 100,000,000 points"):
        read_npz(path)


@pytest.mark.parametrize("part", [0.0, 0.1, 0.5, 0.9])
def test_a_cut_file_is_refused(part: float, tmp_path: Path) -> None:
    """Wherever it is cut."""
    data = npy(POINTS)
    with pytest.raises(ValueError, match=r"cut short|is no \.npy file"):
        read(data[: int(part * len(data))], tmp_path)


@pytest.mark.parametrize("byte", [150, 180, 200])
def test_a_damaged_archive_is_refused(byte: int, tmp_path: Path) -> None:
    """A byte that is another one is noticed."""
    path = tmp_path / "cloud.npz"
    np.savez_compressed(path, points=np.random.default_rng(0).random((30, 3)))
    whole = bytearray(path.read_bytes())
    whole[byte] ^= 0x55
    path.write_bytes(whole)
    with pytest.raises(ValueError, match=r"is (no|a damaged) \.npz file"):
        read_npz(path)


def test_other_compressions_are_refused(tmp_path: Path) -> None:
    """NumPy writes none of them, and of their sizes nothing is known."""
    path = tmp_path / "cloud.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_BZIP2) as archive:
        archive.writestr("points.npy", npy(POINTS))
    with pytest.raises(ValueError, match="compression"):
        read_npz(path)
