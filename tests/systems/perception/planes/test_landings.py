"""Landings within a flight and floors above it, and what only looks like one."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from footfall.models.robots.jvrc1 import JVRC1
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from tests.systems.perception.planes.tread_checks import Scan, check_treads

GRAVITY = np.array([0.0, 0.0, -9.81])
PARAMS = PlaneSegmenterParams(threads=1)
SOLE = JVRC1.sole


def test_landing_goes_on_with_the_flight(scan: Scan, stair_scene: Any) -> None:
    """The last of the flight, though it is deeper, once enough of it is seen."""
    scene = stair_scene(steps=2, rise=0.17, run=0.30, width=1.0, landing=1.2)
    eye = scene.sensor()
    cloud = scan(scene, eye, tilt=(20.0, 80.0))
    found, _ = segment_planes(cloud, GRAVITY, PARAMS, SOLE, eye)
    *treads, landing = found.staircase.treads
    staircase = replace(found.staircase, treads=tuple(treads))
    check_treads(replace(found, staircase=staircase), scene, [0, 1])
    corners = landing.corners() @ scene.rotation()
    assert np.abs(corners[:, 2] - 0.51).max() < 0.005
    back = scene.tread_corners(1)[2] @ scene.rotation()
    assert np.abs(corners[[0, 3], 0] - back[0]).max() < 0.01
    assert landing.size[0] > 0.45
    cut, _ = segment_planes(
        scan(scene, eye, tilt=(38.0, 88.0)), GRAVITY, PARAMS, SOLE, eye
    )
    check_treads(cut, scene, [0, 1])
    heights = [float(p.X_WR.translation()[2]) for p in cut.planes]
    assert min(abs(height - 0.51) for height in heights) < 0.005


@pytest.mark.parametrize("width", [0.5, 0.8, 1.2])
@pytest.mark.parametrize("depth", [0.32, 0.4, 0.5, 0.62, 0.8, 1.5, 3.0])
def test_a_floor_above_ends_the_flight(
    scan: Scan, stair_scene: Any, depth: float, width: float
) -> None:
    """However deep it is beside the treads, and which of its sides is the longer."""
    scene = stair_scene(steps=2, rise=0.17, run=0.27, width=width, landing=depth)
    eye = scene.sensor()
    cloud = scan(scene, eye, tilt=(20.0, 80.0))
    found, _ = segment_planes(cloud, GRAVITY, PARAMS, SOLE, eye)
    *treads, top = found.staircase.treads
    staircase = replace(found.staircase, treads=tuple(treads))
    check_treads(replace(found, staircase=staircase), scene, [0, 1])
    corners = top.corners() @ scene.rotation()
    assert np.abs(corners[:, 2] - 0.51).max() < 0.005
    front = scene.tread_corners(1)[2] @ scene.rotation()
    assert np.abs(corners[[0, 3], 0] - front[0]).max() < 0.01
    assert 0.3 < top.size[0] < depth + 0.01
    assert top.size[1] == pytest.approx(width, abs=0.02)


def test_a_table_at_the_end_of_a_flight_is_no_floor_above(
    scan: Scan, stair_scene: Any
) -> None:
    """It begins where two treads of 15 cm end, but 45 cm above the second."""
    scene = stair_scene(steps=2, rise=0.15, run=0.27, width=0.8)
    eye = scene.sensor()
    cloud = scan(scene, eye)
    rotation, end = scene.rotation(), 2 * 0.27
    local = cloud @ rotation
    ahead = (local[:, 0] > end) & (np.abs(local[:, 1]) < 0.8)
    rng = np.random.default_rng(0)
    low, high = np.array([end, -0.4, 0.0]), np.array([end + 0.8, 0.4, 0.75])
    top = rng.uniform([low[0], low[1], high[2]], high, (6000, 3))
    front = rng.uniform(low, [low[0], high[1], high[2]], (6000, 3))
    table = np.vstack([top, front]) + rng.normal(0.0, 0.003, (12000, 3))
    found, _ = segment_planes(
        np.vstack([cloud[~ahead], table @ rotation.T]), GRAVITY, PARAMS, SOLE, eye
    )
    heights = [float(tread.X_WR.translation()[2]) for tread in found.staircase.treads]
    np.testing.assert_allclose(heights, [0.15, 0.30], atol=0.005)
    assert any(abs(p.X_WR.translation()[2] - 0.75) < 0.01 for p in found.planes)


def test_a_seat_with_a_table_behind_it_is_no_staircase(
    scan: Scan, stair_scene: Any
) -> None:
    """What stands 45 cm high alone is none, whatever deeper plane follows it."""
    scene = stair_scene(steps=1, rise=0.45, run=0.27, width=0.8, landing=1.0)
    eye = scene.sensor(distance=0.4)
    found, _ = segment_planes(scan(scene, eye), GRAVITY, PARAMS, SOLE, eye)
    assert not found.staircase.treads


def test_a_flight_goes_on_behind_a_landing(scan: Scan, stair_scene: Any) -> None:
    """Which may be wider than it is deep; a table beside the flight is none of it."""
    lower = stair_scene(steps=2, rise=0.15, run=0.30, width=1.0, landing=0.9)
    eye = lower.sensor()
    cloud = scan(lower, eye, tilt=(20.0, 80.0))
    shift = np.array([1.5, 0.0, 0.45]) @ lower.rotation().T
    upper = stair_scene(steps=2, rise=0.15, run=0.30, width=1.0)
    above = scan(upper, upper.sensor(), tilt=(20.0, 80.0))
    above = above[(above @ upper.rotation())[:, 2] > 0.01] + shift
    found, _ = segment_planes(np.vstack([cloud, above]), GRAVITY, PARAMS, SOLE, eye)
    heights = [float(tread.X_WR.translation()[2]) for tread in found.staircase.treads]
    np.testing.assert_allclose(heights, [0.15, 0.3, 0.45, 0.6, 0.75], atol=0.005)
    depths = [float(tread.size[0]) for tread in found.staircase.treads]
    np.testing.assert_allclose(depths[2], 0.9, atol=0.02)
