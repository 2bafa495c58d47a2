"""Reading clouds: every good kind, and every way a file can be bad."""

import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pypcd4 import Encoding, PointCloud

from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_files import CloudFileError, read_cloud

POINTS = np.arange(30, dtype=np.float64).reshape(10, 3) / 8.0


def write_pcd(path: Path, encoding: Encoding) -> None:
    """The points in double precision."""
    types = (np.float64,) * 3
    PointCloud.from_points(POINTS, ("x", "y", "z"), types).save(path, encoding)


def write_ply(path: Path, encoding: str) -> None:
    """The points as trimesh writes them."""
    path.write_bytes(trimesh.PointCloud(POINTS).export(None, "ply", encoding=encoding))


WRITERS: dict[str, Callable[[Path], object]] = {
    "binary.pcd": lambda path: write_pcd(path, Encoding.BINARY),
    "packed.pcd": lambda path: write_pcd(path, Encoding.BINARY_COMPRESSED),
    "ascii.pcd": lambda path: write_pcd(path, Encoding.ASCII),
    "binary.ply": lambda path: write_ply(path, "binary"),
    "ascii.PLY": lambda path: write_ply(path, "ascii"),
    "blanks.xyz": lambda path: np.savetxt(path, POINTS),
    "commas.txt": lambda path: np.savetxt(path, POINTS, delimiter=", "),
    "more columns.xyz": lambda path: np.savetxt(path, np.hstack([POINTS, POINTS])),
    "comments.txt": lambda path: np.savetxt(path, POINTS, header="x y z"),
    "names.csv": lambda path: np.savetxt(
        path, POINTS, delimiter=",", header="x,y,z", comments=""
    ),
    "array.npy": lambda path: np.save(path, POINTS),
    "named.npz": lambda path: np.savez(path, points=POINTS, other=np.zeros(2)),
    "lone.npz": lambda path: np.savez(path, cloud=POINTS.astype(np.float32)),
}


@pytest.mark.parametrize("name", WRITERS)
def test_points_come_back(name: str, tmp_path: Path) -> None:
    """Each kind of file gives the points that were written."""
    path = tmp_path / name
    WRITERS[name](path)
    points = read_cloud(path)
    assert points.dtype == np.float64
    np.testing.assert_allclose(points, POINTS, atol=1e-6)


def test_points_that_are_not_finite_are_left_out(tmp_path: Path) -> None:
    """A cloud with holes is a cloud."""
    holes: Vector = POINTS.copy()
    holes[2] = np.nan
    holes[5, 1] = np.inf
    np.savez(tmp_path / "holes.npz", points=holes)
    np.testing.assert_array_equal(
        read_cloud(tmp_path / "holes.npz"), np.delete(POINTS, [2, 5], axis=0)
    )


def cut(name: str, part: float) -> Callable[[Path], object]:
    """Writes only the first part of a good file."""

    def write(path: Path) -> None:
        WRITERS[name](path)
        whole = path.read_bytes()
        path.write_bytes(whole[: int(part * len(whole))])

    return write


def say(text: str) -> Callable[[Path], object]:
    """Writes text."""
    return lambda path: path.write_text(text)


BAD: dict[str, tuple[Callable[[Path], object], str]] = {
    "missing.pcd": (lambda path: None, "does not exist"),
    "folder.pcd": (Path.mkdir, "is a directory"),
    "empty.pcd": (Path.touch, "is empty"),
    "empty.xyz": (Path.touch, "is empty"),
    "device.xyz": (
        lambda path: path.symlink_to("/dev/null"),
        "is not a regular file",
    ),
    "box.obj": (say("v 0 0 0"), "is a mesh"),
    "box.STL": (
        lambda path: path.write_bytes(trimesh.creation.box().export(None, "stl")),
        "is a mesh",
    ),
    "box.ply": (
        lambda path: path.write_bytes(trimesh.creation.box().export(None, "ply")),
        "is a mesh",
    ),
    "cloud.las": (say("LASF"), "unknown kind of file"),
    "cloud": (say("0 0 0"), "unknown kind of file"),
    "words.pcd": (say("hello\nworld\n"), "is no .pcd file"),
    "words.ply": (say("hello\nworld\n"), "is no .ply file"),
    "words.xyz": (say("hello world again\n"), "is not a table of numbers"),
    "words.npz": (say("hello\n"), "is no .npz file"),
    "ragged.txt": (say("1 2 3\n4 5\n"), "is not a table of numbers"),
    "flat.txt": (say("1 2\n3 4\n"), "has 2 columns"),
    "blank.txt": (say("\n# nothing\n"), "has no points"),
    "bytes.xyz": (lambda path: path.write_bytes(b"\xff\x80\x00\x80"), "is not text"),
    "nan.xyz": (say("nan nan nan\nnan 1 2\n"), "has no finite point"),
    "cut.pcd": (cut("binary.pcd", 0.9), "cut.pcd: "),
    "cut ascii.pcd": (cut("ascii.pcd", 0.9), "is cut short"),
    "cut.npy": (cut("array.npy", 0.9), "is cut short"),
    "words.npy": (say("hello\n"), "is no .npy file"),
    "words.csv": (say("hello,world\n"), "is not a table of numbers"),
    "decimals.csv": (say("1,5,2,5,3,5\n"), "may be decimal commas"),
    "not npz.npz": (say("\x93NUMPY"), "is no .npz file"),
    "not ply.ply": (WRITERS["binary.pcd"], "is no .ply file"),
    "not pcd.pcd": (WRITERS["binary.ply"], "is no .pcd file"),
    "cut header.pcd": (cut("binary.pcd", 0.2), "is no .pcd file"),
    "cut.ply": (cut("binary.ply", 0.9), "cut.ply: "),
    "cut.npz": (cut("named.npz", 0.6), "is no .npz file"),
    "none.npz": (lambda path: np.savez(path), "holds nothing"),
    "two.npz": (lambda path: np.savez(path, a=POINTS, b=POINTS), "holds a, b"),
    "shape.npz": (lambda path: np.savez(path, points=POINTS[0]), "of shape (3,)"),
    "words in.npz": (
        lambda path: np.savez(path, points=np.array([["a", "b", "c"]])),
        "must be numbers",
    ),
    "objects.npz": (
        lambda path: np.savez(path, points=np.array([[{}, 1, 2]], dtype=object)),
        "is no .npz file",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_are_named(
    name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """One exception, one line, the file's name in it, and nothing printed."""
    write, reason = BAD[name]
    path = tmp_path / name
    write(path)
    capfd.readouterr()
    with pytest.raises(CloudFileError) as caught:
        read_cloud(path)
    message = str(caught.value)
    assert name in message
    assert reason in message
    assert "\n" not in message
    printed = capfd.readouterr()
    assert printed.out == ""
    assert printed.err == ""


def test_a_cloud_without_points(tmp_path: Path) -> None:
    """A header that promises no point is a bad cloud, not an empty result."""
    header = "ply\nformat ascii 1.0\nelement vertex 0\n"
    header += "property float x\nproperty float y\nproperty float z\nend_header\n"
    (tmp_path / "none.ply").write_text(header)
    with pytest.raises(CloudFileError, match="has no points"):
        read_cloud(tmp_path / "none.ply")


def test_an_unreadable_file_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the system refuses is one line, too."""
    path = tmp_path / "locked.xyz"
    path.write_text("0 0 0\n")

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(CloudFileError, match=r"locked\.xyz: cannot be read \(Permiss"):
        read_cloud(path)


@pytest.mark.parametrize("kind", ["pcd", "ply", "npy"])
def test_a_claim_takes_no_memory(kind: str, tmp_path: Path) -> None:
    """Four thousand million points over three bytes are refused at little cost."""
    many = 4_000_000_000
    shape = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({many}, 3), }}"
    said = {
        "pcd": "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {many}\nHEIGHT 1\nPOINTS {many}\nDATA binary\n",
        "ply": f"ply\nformat binary_little_endian 1.0\nelement vertex {many}\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n",
        "npy": f"\x93NUMPY\x01\x00\x76\x00{shape:<117}\n",
    }
    path = tmp_path / f"claim.{kind}"
    path.write_bytes(said[kind].encode("latin-1") + b"abc")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(CloudFileError, match="promises 4,000,000,000 points"):
        read_cloud(path)
    taken = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert taken < 100_000


def test_more_points_than_can_be_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file that does hold too many is refused as well, of whatever kind it is."""
    monkeypatch.setattr("footfall.systems.perception.clouds.cloud_claims.MAX_POINTS", 9)
    monkeypatch.setattr("footfall.systems.perception.clouds.text_file.MAX_POINTS", 9)
    for name, write in WRITERS.items():
        write(tmp_path / name)
        with pytest.raises(CloudFileError, match=r"more than the 9"):
            read_cloud(tmp_path / name)


def test_reading_needs_no_open3d() -> None:
    """Its import takes longer than most clouds do to be segmented."""
    code = (
        "import sys; import footfall.diagrams.segmenting; "
        "import footfall.systems.perception.clouds.cloud_files; "
        "sys.exit('open3d' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
