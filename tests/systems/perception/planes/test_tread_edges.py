"""Ends of treads between the last ray on them and the first that passes by."""

import numpy as np
import pytest

from footfall.systems.perception.planes.tread_edges import (
    find_face,
    pierced,
    strip_end,
)

EYE = np.array([-1.0, 0.0, 1.5])
POINT, UP = np.array([0.0, 0.0, 0.2]), np.array([0.0, 0.0, 1.0])


def test_noise_along_rays_moves_no_piercing() -> None:
    """Ranges that err by centimetres meet the plane where they would have."""
    rng = np.random.default_rng(0)
    on_plane = np.column_stack([rng.uniform(-0.2, 0.5, (200, 2)), np.full(200, 0.2)])
    ray = on_plane - EYE
    noisy = EYE + ray * rng.uniform(0.97, 1.03, (200, 1))
    np.testing.assert_allclose(pierced(noisy, EYE, POINT, UP), on_plane[:, :2])


def test_from_hardly_above_points_stay_where_they_are() -> None:
    """Rays along the plane pierce it anywhere."""
    points = np.array([[0.1, 0.2, 0.21]])
    low = np.array([-1.0, 0.0, 0.25])
    np.testing.assert_array_equal(pierced(points, low, POINT, UP), [[0.1, 0.2]])


def lines(ends: float, step: float) -> np.ndarray:
    """Points across 0.6 m on lines up to an end, (n, 2)."""
    along = np.arange(ends, -0.2, -step)
    across = np.arange(0.0, 0.6, 0.01)
    return np.stack(np.meshgrid(across, along), axis=-1).reshape(-1, 2)


def test_the_end_is_half_way_to_the_next_ray() -> None:
    """Lines 2 cm apart: the last one on, the first one past."""
    on, past = lines(0.10, 0.02), lines(0.12, 1.0)
    assert strip_end(on, past, 0.03) == (pytest.approx(0.11), True)
    # A gap wider than lines are apart tells that it ends, not where.
    assert strip_end(on, lines(0.25, 1.0), 0.03) == (pytest.approx(0.10), True)
    assert strip_end(on, np.zeros((0, 2)), 0.03) == (pytest.approx(0.10), False)


def test_a_view_that_ends_askew_ends_at_its_middle() -> None:
    """Without rays beyond, where strips end along a slant."""
    on = lines(0.3, 0.005)
    on = on[on[:, 1] < 0.3 * on[:, 0]]
    beside = np.array([[5.0, 0.0]])
    end, seen = strip_end(on, beside, 0.03)
    assert not seen
    assert end == pytest.approx(0.09, abs=0.01)


def test_a_few_strips_that_see_the_edge_are_enough() -> None:
    """The others are cut off by the view before it."""
    on = lines(0.2, 0.01)
    on = on[(on[:, 0] < 0.2) | (on[:, 1] < 0.05)]
    past = lines(0.21, 1.0)
    end, seen = strip_end(on, past[past[:, 0] < 0.2], 0.03)
    assert seen
    assert end == pytest.approx(0.205, abs=0.001)


def test_a_face_is_where_its_points_are() -> None:
    """Fewer points than a face has leave the edge as it was."""
    rng = np.random.default_rng(0)
    x = 0.27 + rng.normal(0.0, 0.003, 100)
    place, found = find_face(x, 0.25)
    assert found
    assert place == pytest.approx(0.27, abs=0.001)
    assert find_face(x[:10], 0.25) == (0.25, False)
