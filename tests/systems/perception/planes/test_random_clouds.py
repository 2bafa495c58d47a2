"""Clouds of any kind: never an exception, never a tread that is none."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from footfall.models.robots.jvrc1 import JVRC1
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams

SOLE = JVRC1.sole
PARAMS = PlaneSegmenterParams(threads=1)
VOXEL = PARAMS.voxel_size


@st.composite
def clouds(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Sheets, stairs, walls, lines and dust, gravity, and a viewpoint or none."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    parts = []
    for _ in range(draw(st.integers(0, 7))):
        kind = draw(st.sampled_from(["sheet", "steps", "wall", "line", "dust", "same"]))
        count = draw(st.integers(1, 4000))
        size = rng.uniform(0.02, 2.0, 3)
        points = rng.uniform(-0.5, 0.5, (count, 3)) * size
        if kind == "sheet":
            points[:, 2] = points[:, :2] @ rng.uniform(-0.3, 0.3, 2)
        elif kind == "steps":
            run, rise = rng.uniform(0.05, 0.6), rng.uniform(0.02, 0.4)
            points = rng.uniform(-0.5, 0.5, (10 * count, 3))
            points *= [run * rng.integers(1, 6), rng.uniform(0.1, 2.0), 1.0]
            points[:, 2] = rise * np.floor(points[:, 0] / run)
            points[::3, 0] = run * np.round(points[::3, 0] / run)
            points[::3, 2] += rise * rng.uniform(-1.0, 0.0, len(points[::3]))
        elif kind == "wall":
            points[:, 0] = 0.0
        elif kind == "line":
            points[:, 1:] = 0.0
        elif kind == "same":
            points[:] = 0.0
        points += rng.normal(
            0.0, draw(st.sampled_from([0.0, 0.003, 0.02])), points.shape
        )
        parts.append(points + rng.uniform(-1.5, 1.5, 3))
    cloud = np.concatenate([np.zeros((0, 3)), *parts])
    if len(cloud) and draw(st.booleans()):
        lost = rng.integers(0, len(cloud), len(cloud) // 10)
        cloud[lost, rng.integers(0, 3)] = draw(st.sampled_from([np.nan, np.inf]))
    gravity = np.array([0.0, 0.0, -9.81])
    if draw(st.booleans()):
        gravity = gravity + rng.uniform(-0.5, 0.5, 3)
    eye = rng.uniform([-1.5, -1.5, 0.5], [1.5, 1.5, 2.0])
    return cloud, gravity, eye if draw(st.booleans()) else None


@pytest.mark.parametrize("method", ["surfaces", "supervoxels"])
@settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
@given(clouds())
def test_any_cloud_is_segmented(
    method: str, case: tuple[np.ndarray, np.ndarray, np.ndarray | None]
) -> None:
    """Of each tread half is over points at its height, and a sole fits on it."""
    cloud, gravity, eye = case
    params = PlaneSegmenterParams(threads=1, method=method)
    found, _ = segment_planes(cloud, gravity, params, SOLE, eye)
    points = cloud[np.all(np.isfinite(cloud), axis=1)]
    for flight in found.flights:
        for tread in flight.treads:
            local = np.array(tread.X_WR.inverse().multiply(points.T)).T.reshape(-1, 3)
            half = tread.size / 2.0
            on = np.all(np.abs(local[:, :2]) <= half, axis=1)
            on &= np.abs(local[:, 2]) <= 0.06
            counts = np.ceil(tread.size / VOXEL).astype(int)
            cells = np.floor((local[on, :2] + half) / VOXEL).astype(int)
            occupied = len(np.unique(cells[:, 0] * (counts[1] + 1) + cells[:, 1]))
            assert occupied >= 0.5 * np.prod(tread.size) / VOXEL**2
            shorter, longer = np.sort(tread.size)
            edges = tread.edges
            hidden = edges is not None and not (edges.back and edges.front)
            assert longer >= SOLE.length
            assert shorter >= (
                PARAMS.stairs.min_depth if hidden else 2.0 * SOLE.half_width
            )
