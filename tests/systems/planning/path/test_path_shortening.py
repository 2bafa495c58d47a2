"""Shortening: never longer, never through an obstacle, same ends."""

import numpy as np
import pytest
import shapely

from footfall.systems.planning.path.path_shortening import (
    path_length,
    shorten_path,
    skip_corners,
)

WALL = shapely.box(-0.2, -5.0, 0.2, 1.0)


def clear_of_wall(segment: np.ndarray) -> bool:
    """Whether a segment does not cross the wall."""
    return not shapely.intersects(WALL, shapely.linestrings(segment))


def open_field(segment: np.ndarray) -> bool:
    """Everything is free."""
    return True


def test_open_field_leaves_the_straight_line() -> None:
    """All corners go."""
    path = np.random.default_rng(0).uniform(-1, 1, (30, 2))
    np.testing.assert_array_equal(skip_corners(path, open_field), path[[0, -1]])


@pytest.mark.parametrize("seed", range(10))
def test_detour_over_a_wall_comes_near_the_shortest(seed: int) -> None:
    """A zigzag becomes nearly the way around the wall's two upper corners."""
    rng = np.random.default_rng(seed)
    left = np.column_stack([np.sort(rng.uniform(-3, -0.3, 8)), rng.uniform(1.1, 3, 8)])
    right = np.column_stack([np.sort(rng.uniform(0.3, 3, 8)), rng.uniform(1.1, 3, 8)])
    path = np.vstack([[-3.0, 0.0], left, right, [3.0, 0.0]])
    short = shorten_path(path, clear_of_wall, 200, seed)
    np.testing.assert_array_equal(short[[0, -1]], path[[0, -1]])
    legs = np.stack([short[:-1], short[1:]], axis=1)
    assert all(clear_of_wall(leg) for leg in legs)
    shortest = 2.0 * np.hypot(2.8, 1.0) + 0.4
    assert shortest <= path_length(short) <= 1.02 * shortest
    again = shorten_path(path, clear_of_wall, 200, seed)
    np.testing.assert_array_equal(short, again)


@pytest.mark.parametrize("count", [1, 2])
def test_what_cannot_be_shorter_stays(count: int) -> None:
    """A point and a straight line are left as they are."""
    path = np.arange(2.0 * count).reshape(count, 2)
    np.testing.assert_array_equal(shorten_path(path, open_field, 50, 0), path)
