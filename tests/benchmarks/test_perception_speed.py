"""How long the plane segmentation takes on a sweep, and on its part with the stairs."""

from typing import Any

import numpy as np
import pytest

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.perceived import PlaneSegmentation
from footfall.models.values.vector import Vector
from footfall.systems.open3d_loader import open3d as o3d
from footfall.systems.perception.planes.cut_sweep import (
    BLOCK,
    CutSweep,
    add_line,
    cut_cloud,
    empty_cut,
    finish_sweep,
)
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams

EYE = np.array([-0.6, 0.0, 1.5])


def box(size: tuple[float, ...], low: tuple[float, ...]) -> Any:
    """A box as Open3D casts at it."""
    mesh = o3d.geometry.TriangleMesh.create_box(*size).translate(low)
    return o3d.t.geometry.TriangleMesh.from_legacy(mesh)


def sweep() -> Vector:
    """The stair paper's first experiment: three steps in a room, 260,521 rays."""
    caster = o3d.t.geometry.RaycastingScene()
    caster.add_triangles(box((11.0, 7.0, 3.0), (-3.0, -3.5, 0.0)))
    for i in range(3):
        caster.add_triangles(box((0.27, 0.5, 0.2 * (i + 1)), (0.27 * i, -0.25, 0.0)))
    tilt = np.radians(np.linspace(30.0, 90.0, 241))[:, None]
    beam = np.radians(np.linspace(-135.0, 135.0, 1081))[None]
    directions = np.stack(
        np.broadcast_arrays(
            np.cos(beam) * np.cos(tilt), np.sin(beam), -np.cos(beam) * np.sin(tilt)
        ),
        axis=-1,
    ).reshape(-1, 3)
    rays = np.hstack([np.broadcast_to(EYE, directions.shape), directions])
    hit = caster.cast_rays(o3d.core.Tensor(rays.astype(np.float32)))
    t: Vector = hit["t_hit"].numpy().astype(np.float64)
    t += np.random.default_rng(0).normal(0.0, 0.005, len(t))
    cloud: Vector = EYE + t[:, None] * directions
    return cloud


GRAVITY = np.array([0.0, 0.0, -9.81])
WAYS = {
    "surfaces": PlaneSegmenterParams(),
    "supervoxels": PlaneSegmenterParams(method="supervoxels"),
    "published": PlaneSegmenterParams().published(),
}


def frame(part: str) -> Vector:
    """The sweep, every second line of it, its points in any order, or the stairs."""
    cloud = sweep()
    if part == "half":
        return cloud.reshape(-1, 1081, 3)[::2].reshape(-1, 3)
    if part == "shuffled":
        return np.random.default_rng(1).permutation(cloud)
    if part == "stairs":
        low, high = np.array([-0.4, -0.6, -0.1]), np.array([1.5, 0.6, 1.0])
        return cloud[np.all((cloud > low) & (cloud < high), axis=1)]
    return cloud


@pytest.mark.parametrize("part", ["whole", "half", "shuffled", "stairs"])
@pytest.mark.parametrize("way", WAYS)
def test_plane_segmentation(benchmark: Any, part: str, way: str) -> None:
    """Each way on 260,521 points, half of them, and about 30,000; stages beside it."""
    cloud = frame(part)
    found, _ = benchmark(segment_planes, cloud, GRAVITY, WAYS[way], JVRC1.sole, EYE)
    benchmark.extra_info["points"] = len(cloud)
    benchmark.extra_info["stages_ms"] = {
        stage: round(milliseconds, 1) for stage, milliseconds in found.times_ms
    }
    assert way == "published" or len(found.staircase.treads) == 3


def cut_lines(lines: Vector) -> CutSweep:
    """Lines, (n, k, 3), cut one after the other."""
    cell = WAYS["surfaces"].voxel_size
    swept = CutSweep(empty_cut(cell))
    for line in lines:
        swept = add_line(swept, cut_cloud(line, EYE[2], cell))
    return swept


def test_lines_as_they_come(benchmark: Any) -> None:
    """As many lines as are joined at once, in the middle of the sweep."""
    lines = sweep().reshape(-1, 1081, 3)
    before, cell = cut_lines(lines[: 6 * BLOCK]), WAYS["surfaces"].voxel_size

    def block() -> CutSweep:
        swept = before
        for line in lines[6 * BLOCK : 7 * BLOCK]:
            swept = add_line(swept, cut_cloud(line, EYE[2], cell))
        return swept

    assert not benchmark(block).lines
    benchmark.extra_info["lines"] = BLOCK


@pytest.mark.parametrize("waiting", [0, BLOCK - 1])
def test_after_the_last_line(benchmark: Any, waiting: int) -> None:
    """What is left when the last line comes, with so many lines that are not joined."""
    lines = sweep().reshape(-1, 1081, 3)
    lines = lines[: len(lines) // BLOCK * BLOCK - BLOCK + waiting + 1]
    before, params = cut_lines(lines[:-1]), WAYS["surfaces"]

    def last() -> PlaneSegmentation:
        line = cut_cloud(lines[-1], EYE[2], params.voxel_size)
        cut = finish_sweep(add_line(before, line))
        return segment_planes(cut.points, GRAVITY, params, JVRC1.sole, EYE, cut)[0]

    found = benchmark(last)
    benchmark.extra_info["stages_ms"] = {
        stage: round(milliseconds, 1) for stage, milliseconds in found.times_ms
    }
    assert len(found.staircase.treads) == 3


@pytest.mark.parametrize("part", ["whole", "half"])
@pytest.mark.parametrize("voxels", [True, False])
def test_patches_of_open3d(benchmark: Any, part: str, voxels: bool) -> None:
    """What Open3D needs for planes alone, with and without voxels of 2 cm."""
    cloud = frame(part)

    def patches() -> int:
        points = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(cloud))
        if voxels:
            points = points.voxel_down_sample(0.02)
        points.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(10))
        return len(points.detect_planar_patches())

    assert benchmark(patches) > 0
