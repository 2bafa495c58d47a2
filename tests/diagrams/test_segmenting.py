"""A cloud in a file to planes as JSON and as a picture."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread
from pypcd4 import Encoding, PointCloud

from footfall.diagrams.figures.colors import PLANE_KINDS
from footfall.diagrams.segmenting import segment_file
from footfall.models.values.value import to_json
from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_files import CloudFileError
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams

GRAVITY = np.array([0.0, 0.0, -9.81])


def steps() -> Vector:
    """A dense cloud of three steps, risers and floor, (n, 3), m."""
    rng = np.random.default_rng(0)
    parts = [rng.uniform([-1.0, -1.0, 0.0], [0.0, 1.0, 0.0], (8000, 3))]
    for i in range(3):
        x, z = 0.3 * i, 0.15 * (i + 1)
        parts.append(rng.uniform([x, -0.4, z], [x + 0.3, 0.4, z], (3000, 3)))
        parts.append(rng.uniform([x, -0.4, z - 0.15], [x, 0.4, z], (1500, 3)))
    cloud: Vector = np.concatenate(parts)
    return cloud + rng.normal(0.0, 0.002, cloud.shape)


def test_json_and_picture_of_a_staircase(tmp_path: Path) -> None:
    """Both files are whole and say what the function returns; nothing else is left."""
    np.savez(tmp_path / "steps.npz", points=steps())
    out = tmp_path / "new" / "folder"
    result = segment_file(tmp_path / "steps.npz", GRAVITY, out)
    assert sorted(path.name for path in out.iterdir()) == ["planes.json", "planes.png"]
    assert len(result.segmentation.staircase.treads) == 3
    document: Any = json.loads(result.planes_json.read_text(encoding="utf-8"))
    assert document["cloud"] == "steps.npz"
    assert document["points"] == result.points == 21500
    assert document["planes"] == to_json(result.segmentation.planes)
    assert document["doubts"] == []
    assert len(document["staircase"]["treads"]) == 3
    sizes = [tread["size"] for tread in document["staircase"]["treads"]]
    np.testing.assert_allclose(sizes, [[0.3, 0.8]] * 3, atol=0.015)
    assert list(document["times_ms"]) == [
        "read",
        "cloud",
        "clusters",
        "planes",
        "boundaries",
        "staircase",
    ]
    picture = imread(result.planes_png)
    assert picture.shape[0] > 400
    assert picture.shape[1] > 800
    # Treads are drawn: some pixels are of their colour.
    color = np.array(to_rgb(PLANE_KINDS["tread"]))
    orange = np.abs(picture[:, :, :3] - color).max(axis=2) < 0.02
    assert np.count_nonzero(orange) > 500


def test_the_published_way_and_a_viewpoint_find_the_same_treads(
    tmp_path: Path,
) -> None:
    """Supervoxels in the paper's order; edges between rays from where it was seen."""
    np.savez(tmp_path / "steps.npz", points=steps())
    params = PlaneSegmenterParams().published()
    eye = np.array([-0.8, 0.0, 1.4])
    for given, seen_from in ((params, None), (None, eye)):
        result = segment_file(
            tmp_path / "steps.npz", GRAVITY, tmp_path, given, viewpoint=seen_from
        )
        treads = result.segmentation.staircase.treads
        heights = [tread.X_WR.translation()[2] for tread in treads]
        np.testing.assert_allclose(heights, [0.15, 0.30, 0.45], atol=0.005)


def test_cloud_without_planes(tmp_path: Path) -> None:
    """A cloud of noise is no error: no planes, and a picture all the same."""
    cloud = np.random.default_rng(1).uniform(-1.0, 1.0, (500, 3))
    np.savetxt(tmp_path / "noise.xyz", cloud)
    result = segment_file(tmp_path / "noise.xyz", GRAVITY, tmp_path)
    assert result.segmentation.planes == ()
    document: Any = json.loads(result.planes_json.read_text(encoding="utf-8"))
    assert document["planes"] == []
    saw, doubt = document["doubts"]
    assert saw.startswith("500 points in 2 x 1.99 x 1.99 m, typically 0.14 m")
    assert doubt.startswith("its points are farther apart")
    assert result.doubts == (saw, doubt)
    assert result.planes_png.stat().st_size > 1000


def test_a_cloud_of_doubles_has_its_planes(tmp_path: Path) -> None:
    """As a binary .pcd file in double precision: the same treads."""
    cloud = PointCloud.from_points(steps(), ("x", "y", "z"), (np.float64,) * 3)
    cloud.save(tmp_path / "steps.pcd", Encoding.BINARY)
    result = segment_file(tmp_path / "steps.pcd", GRAVITY, tmp_path)
    assert len(result.segmentation.staircase.treads) == 3


@pytest.mark.parametrize("down", [[0.0, -1.0, 0.0], [1.0, 1.0, 0.2]])
def test_gravity_may_point_anywhere(down: list[float], tmp_path: Path) -> None:
    """A cloud in a camera's frame, with its gravity: the same three treads."""
    g = np.array(down) / np.linalg.norm(down)
    across = np.cross(g, [0.3, 0.2, 1.0])
    across /= np.linalg.norm(across)
    axes = np.column_stack([np.cross(g, across), across, -g])
    np.savez(tmp_path / "steps.npz", points=steps() @ axes.T)
    result = segment_file(tmp_path / "steps.npz", 9.81 * g, tmp_path)
    assert len(result.segmentation.staircase.treads) == 3


def test_bad_input_leaves_nothing_behind(tmp_path: Path) -> None:
    """No result, not half a one, where the input is wrong."""
    (tmp_path / "bad.xyz").write_text("no cloud\n")
    np.savez(tmp_path / "good.npz", points=steps())
    out = tmp_path / "out"
    with pytest.raises(CloudFileError, match=r"bad\.xyz"):
        segment_file(tmp_path / "bad.xyz", GRAVITY, out)
    with pytest.raises(ValueError, match="gravity"):
        segment_file(tmp_path / "good.npz", np.zeros(3), out)
    params = PlaneSegmenterParams(voxel_size=0.0)
    with pytest.raises(ValueError, match="voxel_size"):
        segment_file(tmp_path / "good.npz", GRAVITY, out, params)
    assert not out.exists()


def test_a_failed_write_keeps_the_former_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where writing breaks off, what was there stays and no scrap is left."""
    np.savez(tmp_path / "steps.npz", points=steps())
    out = tmp_path / "out"
    out.mkdir()
    (out / "planes.json").write_text("former")

    def break_off(path: Path, text: str, encoding: str) -> None:
        with path.open("w", encoding=encoding) as file:
            file.write(text[:100])
        raise OSError("disk full")

    monkeypatch.setattr(Path, "write_text", break_off)
    with pytest.raises(OSError, match="disk full"):
        segment_file(tmp_path / "steps.npz", GRAVITY, out)
    assert (out / "planes.json").read_text(encoding="utf-8") == "former"
    names = sorted(path.name for path in out.iterdir())
    assert names == ["planes.json", "planes.png"]
