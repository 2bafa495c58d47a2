"""Normals and Filter 1."""

import numpy as np
import pytest

from footfall.systems.perception.planes.normals import (
    estimate_normals,
    filter_slopes,
    gravity_aligned_rotation,
    gravity_direction,
    normal_distance,
    orient_normals,
)

DOWN = np.array([0.0, 0.0, -1.0])


def test_distance_of_normals_is_eq_2() -> None:
    """D_n is 0 for equal, 1 for orthogonal, 2 for opposite normals."""
    z, x = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
    np.testing.assert_allclose(
        normal_distance(np.array([z, z, z]), np.array([z, x, -z])), [0.0, 1.0, 2.0]
    )


def test_filter_1_keeps_slopes_within_the_tolerance() -> None:
    """With T = 1 + cos 15 deg a slope of 14.9 deg stays and one of 15.1 deg goes."""
    slopes = np.radians([0.0, 14.9, 15.1, 90.0, 180.0])
    normals = np.column_stack([np.sin(slopes), np.zeros(5), np.cos(slopes)])
    kept = filter_slopes(normals, DOWN, np.radians(15.0))
    assert kept.tolist() == [True, True, False, False, False]
    assert not filter_slopes(np.zeros((1, 3)), DOWN, np.radians(15.0)).any()


def test_normals_of_a_plane() -> None:
    """Points of a plane get its normal, and the viewpoint gives its side."""
    rng = np.random.default_rng(0)
    normal = np.array([0.6, 0.0, 0.8])
    basis = np.array([[0.8, 0.0, -0.6], [0.0, 1.0, 0.0]])
    points = rng.uniform(-1.0, 1.0, (400, 2)) @ basis
    found = estimate_normals(points, 10, 1)
    up = orient_normals(points, found, DOWN, None)
    np.testing.assert_allclose(up, np.tile(normal, (400, 1)), atol=1e-6)
    below = orient_normals(points, found, DOWN, -5.0 * normal)
    np.testing.assert_allclose(below, np.tile(-normal, (400, 1)), atol=1e-6)
    np.testing.assert_array_equal(found, estimate_normals(points, 10, 2))


def test_too_few_points_have_no_normal() -> None:
    """Fewer than five points: zeros, which no filter passes."""
    np.testing.assert_array_equal(estimate_normals(np.eye(3), 10, 1), np.zeros((3, 3)))


@pytest.mark.parametrize(
    "gravity", [[0, 0, -9.81], [0, 0, 9.81], [1, 2, -3], [-5, 0, 0], [0, 1e-3, 0]]
)
def test_gravity_points_down_in_the_aligned_frame(gravity: list[float]) -> None:
    """R_GW is a rotation that turns gravity to -z, however gravity lies."""
    g = np.array(gravity, dtype=np.float64)
    R_GW = gravity_aligned_rotation(g)
    np.testing.assert_allclose(R_GW @ g, [0.0, 0.0, -np.linalg.norm(g)], atol=1e-12)
    np.testing.assert_allclose(R_GW @ R_GW.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(R_GW) == pytest.approx(1.0)


@pytest.mark.parametrize("gravity", [[0, 0, 0], [np.nan, 0, 1], [np.inf, 0, 0], [1, 2]])
def test_gravity_without_direction_is_refused(gravity: list[float]) -> None:
    """Zero, not finite or of another size: an error that shows it."""
    with pytest.raises(ValueError, match=r"gravity: must be a finite vector of 3"):
        gravity_direction(np.array(gravity, dtype=np.float64))
