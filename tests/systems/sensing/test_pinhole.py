"""Rays of pixels, pictures of spheres and poses of cameras against closed forms."""

import numpy as np
import pytest

from footfall.systems.sensing.pinhole import looking_at, pixel_rays, pixels_of_sphere

ROWS, COLUMNS, FOCAL = 48, 64, 40.0


def test_rays_pass_through_the_middles_of_the_pixels() -> None:
    """The corner pixels look where the pinhole's geometry says."""
    rays = pixel_rays(ROWS, COLUMNS, FOCAL).reshape(ROWS, COLUMNS, 3)
    np.testing.assert_allclose(rays[0, 0], [-31.5 / 40.0, -23.5 / 40.0, 1.0])
    np.testing.assert_allclose(rays[-1, -1], [31.5 / 40.0, 23.5 / 40.0, 1.0])
    np.testing.assert_allclose(rays[10, 32] - rays[10, 31], [1.0 / 40.0, 0.0, 0.0])


@pytest.mark.parametrize("seed", range(60))
def test_no_pixel_that_sees_a_sphere_is_left_out(seed: int) -> None:
    """Whatever the sphere, all pixels whose rays meet it are among those returned."""
    rng = np.random.default_rng(seed)
    p_CS, radius = rng.uniform(-3.0, 3.0, 3), rng.uniform(0.05, 2.0)
    rays = pixel_rays(ROWS, COLUMNS, FOCAL)
    unit = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    along = np.maximum(unit @ p_CS, 0.0)
    off = np.linalg.norm(p_CS - along[:, None] * unit, axis=1)
    hit = set(np.flatnonzero(off <= radius))
    found = pixels_of_sphere(p_CS, radius, ROWS, COLUMNS, FOCAL)
    assert hit <= set(found)
    assert len(set(found)) == len(found)


def test_a_small_sphere_needs_few_pixels() -> None:
    """The rectangle is about as large as the sphere's picture."""
    found = pixels_of_sphere(np.array([0.0, 0.0, 4.0]), 0.2, ROWS, COLUMNS, FOCAL)
    assert 16 <= len(found) <= 64
    behind = pixels_of_sphere(np.array([0.0, 0.0, -4.0]), 0.2, ROWS, COLUMNS, FOCAL)
    assert len(behind) == 0


def test_a_camera_looks_at_its_target_upright() -> None:
    """The target is on the optical axis, and up in W is up in the picture."""
    p_WC, target = np.array([1.0, -2.0, 3.0]), np.array([0.5, 1.0, 0.2])
    X_CW = looking_at(p_WC, target).inverse()
    p_C = X_CW.multiply(target)
    np.testing.assert_allclose(p_C, [0, 0, np.linalg.norm(target - p_WC)], atol=1e-12)
    above = X_CW.multiply(target + np.array([0.0, 0.0, 0.1]))
    assert above[0] == pytest.approx(0.0, abs=1e-12)
    assert above[1] < 0.0


@pytest.mark.parametrize("height", [2.0, -2.0])
def test_straight_down_or_up_x_of_the_world_is_up(height: float) -> None:
    """A camera over or under its target is defined too."""
    X_CW = looking_at(np.array([0.0, 0.0, height]), np.zeros(3)).inverse()
    np.testing.assert_allclose(X_CW.multiply([0.1, 0, 0]), [0, -0.1, 2.0], atol=1e-12)


def test_no_direction_is_an_error() -> None:
    """A camera at its target looks nowhere."""
    with pytest.raises(ValueError, match="must differ"):
        looking_at(np.ones(3), np.ones(3))
