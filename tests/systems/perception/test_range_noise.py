"""The sensor's scatter, and points slid along their rays."""

import numpy as np
import pytest

from footfall.systems.perception.range_noise import RangeNoise, slide_to_plane


def test_deviation_is_the_papers_at_both_ends() -> None:
    """Millimetres at 0.5 m, 4 cm at 5 m."""
    deviation = RangeNoise().deviation(np.array([0.5, 5.0]))
    np.testing.assert_allclose(deviation, [0.0024, 0.042])


def test_height_scatters_by_the_rays_part_along_z() -> None:
    """Straight down all of it, at 60 deg from the vertical half, level none."""
    points = np.array([[0.0, 0, -2], [np.sqrt(3.0), 0, -1], [2, 0, 0]])
    sigma = RangeNoise().height_deviation(points, np.zeros(3))
    whole = float(RangeNoise().deviation(np.array(2.0)))
    np.testing.assert_allclose(sigma, [whole, whole / 2.0, 0.0], atol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_sliding_undoes_an_error_along_the_ray(seed: int) -> None:
    """Points of a plane come back to their places whatever their ranges' errors."""
    rng = np.random.default_rng(seed)
    normal = np.array([0.1, -0.05, 1.0]) / np.linalg.norm([0.1, -0.05, 1.0])
    plane = np.append(normal, -0.3)
    viewpoint = rng.uniform([-1, -1, 2], [1, 1, 3])
    xy = rng.uniform(-2, 2, (100, 2))
    z = (0.3 - xy @ normal[:2]) / normal[2]
    points = np.column_stack([xy, z])
    wrong = viewpoint + (points - viewpoint) * rng.uniform(0.8, 1.2, (100, 1))
    np.testing.assert_allclose(slide_to_plane(wrong, viewpoint, plane), points)


def test_a_ray_along_the_plane_stays() -> None:
    """There is no place to slide to."""
    point = np.array([[1.0, 0.0, 2.0]])
    level = np.array([0.0, 0.0, 1.0, 0.0])
    slid = slide_to_plane(point, np.array([0.0, 0.0, 2.0]), level)
    np.testing.assert_array_equal(np.isfinite(slid), True)


@pytest.mark.parametrize("field", ["near", "growth"])
def test_wrong_parameters_are_named(field: str) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        RangeNoise(**{field: -1.0}).validate()
