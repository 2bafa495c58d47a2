"""RANSAC, rectangles and outlines."""

import numpy as np
import pytest

from footfall.systems.perception.planes.planes import FittedPlane as Plane
from footfall.systems.perception.planes.planes import (
    bound_patch,
    fit_plane,
    make_patches,
    min_rectangle,
    ransac_planes,
)
from footfall.systems.perception.planes.voxels import voxelize


def test_ransac_splits_a_cluster_of_two_levels() -> None:
    """Two sheets and stray points in one cluster give two planes, the larger first."""
    rng = np.random.default_rng(3)
    low = np.column_stack([rng.uniform(0, 1, (600, 2)), rng.normal(0, 0.003, 600)])
    high = np.column_stack([rng.uniform(1, 2, (300, 2)), rng.normal(0.2, 0.003, 300)])
    stray = rng.uniform(0, 1, (60, 3))
    points = np.concatenate([low, high, stray])
    planes = ransac_planes(
        points,
        np.zeros(len(points), dtype=np.int64),
        tolerance=0.015,
        min_inliers=100,
        rng=np.random.default_rng(0),
    )
    assert len(planes) == 2
    for plane, height in zip(planes, (0.0, 0.2), strict=True):
        assert plane.point[2] == pytest.approx(height, abs=0.001)
        np.testing.assert_allclose(plane.normal, [0, 0, 1], atol=0.01)
    assert set(planes[0].inliers) >= set(range(600)) - set(planes[1].inliers)


def test_the_area_of_a_slope_is_larger_than_its_plan() -> None:
    """By the cosine of its slope, as a level plane over the same plan tells."""
    x, y = (v.ravel() for v in np.meshgrid(*2 * [np.arange(0.0025, 1.0, 0.005)]))
    areas = []
    for slope in np.radians([0.0, 24.0]):
        points = np.column_stack([x, y, np.tan(slope) * x])
        grid = voxelize(points, 0.02)
        owner = np.zeros(len(grid.keys), dtype=np.int64)
        normal = np.array([-np.sin(slope), 0.0, np.cos(slope)])
        (patch,) = make_patches(
            (Plane(points.mean(axis=0), normal, np.flatnonzero(owner == 0)),),
            owner,
            grid.index,
            grid.voxel_of_point,
            points,
            voxel_size=0.02,
            tolerance=0.015,
        )
        areas.append(patch.area)
    np.testing.assert_allclose(areas, [1.0, 1.0 / np.cos(slope)], rtol=1e-9)


def test_same_seed_same_planes() -> None:
    """The seed fixes the result bit for bit."""
    points = np.random.default_rng(4).uniform(0, 1, (300, 3)) * [1, 1, 0.02]

    def found(seed: int) -> list[float]:
        planes = ransac_planes(
            points,
            np.zeros(300, dtype=np.int64),
            tolerance=0.004,
            min_inliers=30,
            rng=np.random.default_rng(seed),
        )
        return [float(value) for plane in planes for value in plane.normal]

    assert found(7) == found(7)
    assert found(7) != found(8)


def test_plane_fit_points_up() -> None:
    """A least-squares plane of a slope, its normal up."""
    x, y = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 5))
    mean, normal = fit_plane(
        np.column_stack([x.ravel(), y.ravel(), 1.0 - 0.75 * x.ravel()])
    )
    np.testing.assert_allclose(mean, [0.5, 0.5, 0.625])
    np.testing.assert_allclose(normal, [0.6, 0.0, 0.8], atol=1e-12)


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.2, 2.0])
def test_least_rectangle_of_a_turned_rectangle(angle: float) -> None:
    """The rectangle comes back with its short side first, whichever way it lies."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    corners = np.array([[-0.5, -0.2], [0.5, -0.2], [0.5, 0.2], [-0.5, 0.2]])
    found, low, high = min_rectangle(corners @ turn.T + [3.0, -2.0])
    np.testing.assert_allclose(high - low, [0.4, 1.0], atol=1e-7)
    axis = np.array([np.cos(found), np.sin(found)])
    assert abs(axis @ turn[:, 1]) == pytest.approx(1.0)


def test_patch_of_a_tilted_rectangle() -> None:
    """Extent, centre, axes and outline of points on a slope."""
    rng = np.random.default_rng(5)
    normal = np.array([0.0, 0.6, 0.8])
    basis = np.column_stack([[1.0, 0.0, 0.0], [0.0, 0.8, -0.6]])
    points = rng.uniform(-0.5, 0.5, (4000, 2)) * [0.3, 0.8] @ basis.T
    plane = Plane(np.zeros(3), normal, np.arange(4000))
    patch = bound_patch(plane, points, 0.24)
    assert patch is not None
    np.testing.assert_allclose(patch.extent[:2], [0.3, 0.8], atol=0.01)
    assert patch.extent[2] == pytest.approx(0.6 * 0.8 * 0.96, abs=0.02)
    np.testing.assert_allclose(patch.center, np.zeros(3), atol=0.01)
    np.testing.assert_allclose(patch.axes[:, 2], normal)
    np.testing.assert_allclose(patch.axes @ patch.axes.T, np.eye(3), atol=1e-12)
    turns = np.cross(
        np.roll(patch.outline, -1, axis=0) - patch.outline,
        np.roll(patch.outline, -2, axis=0) - np.roll(patch.outline, -1, axis=0),
    )
    assert np.all(turns @ normal > 0.0)


def test_points_in_a_line_have_no_patch() -> None:
    """No area, no rectangle, no error."""
    line = np.column_stack([np.linspace(0, 1, 9), np.zeros(9), np.zeros(9)])
    plane = Plane(np.zeros(3), np.array([0.0, 0.0, 1.0]), np.arange(9))
    assert bound_patch(plane, line, 0.0) is None
    assert bound_patch(plane, line[:2], 0.0) is None
