"""Small scenes with a known answer, swept by a tilting scanner."""

import importlib.util
import os
import sys
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import footfall.systems.open3d_loader  # noqa: F401  the scenes import Open3D
from footfall.models.robots.robot_description import default_sole
from footfall.models.values.perceived import PlaneSegmentation
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams

SCENES = (
    Path(os.environ.get("FOOTFALL_DATA", "/nowhere")).parent
    / "cases"
    / "perception"
    / "scenes.py"
)
GRAVITY = np.array([0.0, 0.0, -9.81])
NO_SCENES = "needs cases/perception/scenes.py beside the folder FOOTFALL_DATA names"


@cache
def _scenes() -> ModuleType:
    if not SCENES.is_file():
        pytest.skip(NO_SCENES)
    spec = importlib.util.spec_from_file_location("perception_scenes", SCENES)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@cache
def _segment(name: str) -> PlaneSegmentation:
    cloud = _scenes().cloud(name)
    return segment_planes(cloud, GRAVITY, PlaneSegmenterParams(), default_sole())[0]


def _boxes(name: str) -> np.ndarray:
    """Returns (x low, x high, y low, y high, z) of each tread of the first flight."""
    corners = np.array([tread.corners() for tread in _segment(name).staircase.treads])
    corners = corners.reshape(-1, 4, 3)
    low, high = corners.min(axis=1), corners.max(axis=1)
    middle = (low[:, 2] + high[:, 2]) / 2.0
    return np.column_stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1], middle])


def _flight(rises, fronts, half_width):
    """The expected boxes of a straight flight; its last edge is the end of `fronts`."""
    return [
        [fronts[i], fronts[i + 1], -half_width, half_width, z]
        for i, z in enumerate(rises)
    ]


THREE = _flight((0.17, 0.34, 0.51), (0.60, 0.88, 1.16, 1.44), 0.45)
EXPECTED = {
    "straight": THREE,
    "handrail-slab": [[*box[:3], 0.41, box[4]] for box in THREE],
    "outliers-2": THREE,
    "outliers-5": THREE,
    "wide-3.5": _flight((0.18, 0.36, 0.54), (0.60, 0.88, 1.16, 1.44), 1.75),
    "run-50": _flight((0.12, 0.24), (0.60, 1.10, 1.60), 0.75),
    "low-5cm": _flight((0.05, 0.10, 0.15, 0.20), (0.6, 0.95, 1.3, 1.65, 2.0), 0.5),
    "uneven": _flight((0.14, 0.33, 0.49), (0.60, 0.88, 1.14, 1.50), 0.45),
    "L-landing": [
        [0.88, 1.16, -0.5, 0.5, 0.34],
        [1.16, 2.16, -0.5, 0.5, 0.51],
    ],
    "far-10km": [
        [a + 1e4, b + 1e4, c + 2e3, d + 2e3, z + 300.0] for a, b, c, d, z in THREE
    ],
}


@pytest.mark.parametrize("name", EXPECTED)
def test_a_flight_is_found_as_it_is(name: str) -> None:
    """Of each tread z to 1 cm, edges to 2 cm."""
    found, expected = _boxes(name), np.array(EXPECTED[name])
    assert len(found) >= len(expected)
    found = found[: len(expected)]
    np.testing.assert_allclose(found[:, 4], expected[:, 4], atol=0.01)
    np.testing.assert_allclose(found[:, :4], expected[:, :4], atol=0.02)


@pytest.mark.parametrize("name", ["bench", "table-90", "chair"])
def test_furniture_is_no_staircase(name: str) -> None:
    """A lone plane as high as a seat is no tread, and the floor is the floor."""
    found = _segment(name)
    assert not found.staircase.treads
    assert found.staircase.floor is not None
    assert abs(found.staircase.floor.X_WR.translation()[2]) < 0.01


@pytest.mark.parametrize(
    ("name", "slope", "count"),
    [("roll-1.5-wide", 1.5, 3), ("roll-1-wide", 1.0, 3), ("treads-slope-6", 6.0, 3)],
)
def test_treads_that_lean_are_found(name: str, slope: float, count: int) -> None:
    """Gravity a degree off, or a tread that slopes, loses no tread."""
    treads = _segment(name).staircase.treads
    assert len(treads) == count
    slopes = [np.degrees(np.arccos(tread.normal[2])) for tread in treads]
    np.testing.assert_allclose(slopes, slope, atol=0.5)


def test_the_side_of_a_flight_does_not_widen_its_treads() -> None:
    """Seen from aside, tread 1 is wholly in view."""
    tread = _segment("side-faces").staircase.treads[0]
    np.testing.assert_allclose(tread.size, [0.27, 0.50], atol=0.02)
    assert abs(tread.X_WR.translation()[2] - 0.2) < 0.01


def test_what_follows_a_turn_is_a_flight_of_its_own() -> None:
    """Behind the landing of an L the next flight goes to the left."""
    flights = _segment("L-landing").flights
    assert len(flights) == 2
    heights = [tread.X_WR.translation()[2] for tread in flights[1].treads]
    np.testing.assert_allclose(heights, [0.68, 0.85, 1.02], atol=0.01)
    up = flights[1].treads[0].X_WR.rotation().matrix()[:, 0]
    assert np.degrees(np.arccos(np.clip(up[1], -1.0, 1.0))) < 1.0


def test_winding_treads_are_polygons() -> None:
    """A wedge's polygon is its outline; its rectangle lies within it."""
    centre = np.array([0.6, 1.25])
    treads = _segment("spiral").staircase.treads
    heights = [tread.X_WR.translation()[2] for tread in treads]
    np.testing.assert_allclose(heights[:3], [0.19, 0.38, 0.57], atol=0.01)
    for number, tread in enumerate(treads[:3]):
        for corners in (tread.polygon, tread.corners()):
            offset = corners[:, :2] - centre
            radius = np.linalg.norm(offset, axis=1)
            assert np.all((radius > 0.17) & (radius < 1.23))
            angle = np.degrees(np.arctan2(offset[:, 1], offset[:, 0])) + 90.0
            off = np.maximum(24.0 * number - angle, angle - 24.0 * (number + 1))
            assert np.all(np.radians(off) * radius < 0.03)


def test_an_edge_where_lines_are_missing_is_not_an_edge() -> None:
    """All three treads are found; a depth to a lost line is a lower bound."""
    found = _boxes("lines-lost")
    np.testing.assert_allclose(found[:, 4], [0.17, 0.34, 0.51], atol=0.01)
    np.testing.assert_allclose(found[:, 0], [0.60, 0.88, 1.16], atol=0.02)
    edges = [tread.edges for tread in _segment("lines-lost").staircase.treads]
    assert [edge.back for edge in edges if edge is not None] == [True, False, False]


def test_the_backs_of_treads_seen_from_above_are_hidden() -> None:
    """Down the stairs the nosing before hides the back of each."""
    treads = _segment("down-from-30cm").staircase.treads
    heights = [tread.X_WR.translation()[2] for tread in treads]
    np.testing.assert_allclose(heights, [-0.85, -0.68, -0.51, -0.34, -0.17], atol=0.01)
    fronts = [tread.corners()[:, 0].max() for tread in treads]
    np.testing.assert_allclose(fronts, [1.90, 1.62, 1.34, 1.06, 0.78], atol=0.02)
    assert not any(tread.edges.back for tread in treads if tread.edges is not None)


def test_cells_of_an_elevation_map_are_a_cloud_too() -> None:
    """Three treads, to a cell of 4 cm."""
    found = _boxes("elevation-4cm")
    np.testing.assert_allclose(found[:, 4], [0.17, 0.34, 0.51], atol=0.015)
    np.testing.assert_allclose(found[:, 0], [0.60, 0.88, 1.16], atol=0.04)


@pytest.mark.parametrize("name", ["noise-20", "noise-30"])
def test_noise_invents_no_tread(name: str) -> None:
    """Every tread is a true one; at 20 mm the first two are there."""
    found = _boxes(name)
    for box in found:
        true = min(THREE, key=lambda tread: abs(tread[4] - box[4]))
        overlap = np.prod(
            [
                max(min(box[k + 1], true[k + 1]) - max(box[k], true[k]), 0.0)
                for k in (0, 2)
            ]
        )
        assert abs(box[4] - true[4]) < 0.02
        assert overlap > 0.5 * (box[1] - box[0]) * (box[3] - box[2])
    if name == "noise-20":
        assert len(found) >= 2
        np.testing.assert_allclose(found[:2, 4], [0.17, 0.34], atol=0.01)
