"""Reading clouds: every good kind, and every way a file can be bad."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from systems.open3d_loader import open3d as o3d
from systems.perception.cloud_files import CloudFileError, read_cloud
from systems.ports import Vector

POINTS = np.arange(30, dtype=np.float64).reshape(10, 3) / 8.0


def write_open3d(path: Path, *, ascii_: bool = False) -> None:
    """The points as Open3D writes them."""
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(POINTS))
    assert o3d.io.write_point_cloud(str(path), cloud, write_ascii=ascii_)


WRITERS: dict[str, Callable[[Path], object]] = {
    "binary.pcd": write_open3d,
    "ascii.pcd": lambda path: write_open3d(path, ascii_=True),
    "binary.ply": write_open3d,
    "ascii.PLY": lambda path: (
        write_open3d(path.with_name("a.ply"), ascii_=True),
        path.with_name("a.ply").rename(path),
    ),
    "blanks.xyz": lambda path: np.savetxt(path, POINTS),
    "commas.txt": lambda path: np.savetxt(path, POINTS, delimiter=", "),
    "more columns.xyz": lambda path: np.savetxt(path, np.hstack([POINTS, POINTS])),
    "comments.txt": lambda path: np.savetxt(path, POINTS, header="x y z"),
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
    "cloud.obj": (say("v 0 0 0"), "unknown kind of file"),
    "cloud": (say("0 0 0"), "unknown kind of file"),
    "words.pcd": (say("hello\nworld\n"), "is no .pcd file"),
    "words.ply": (say("hello\nworld\n"), "is no .ply file"),
    "words.xyz": (say("hello world again\n"), "is not a table of numbers"),
    "words.npz": (say("hello\n"), "is no .npz file"),
    "ragged.txt": (say("1 2 3\n4 5\n"), "is not a table of numbers"),
    "flat.txt": (say("1 2\n3 4\n"), "has 2 columns"),
    "blank.txt": (say("\n# nothing\n"), "has no points"),
    "bytes.xyz": (lambda path: path.write_bytes(b"\xff\xfe\x00\x80"), "is not text"),
    "nan.xyz": (say("nan nan nan\nnan 1 2\n"), "has no finite point"),
    "cut.pcd": (cut("binary.pcd", 0.9), "cut.pcd: "),
    "cut ascii.pcd": (cut("ascii.pcd", 0.9), "is cut short"),
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
