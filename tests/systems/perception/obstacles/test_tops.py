"""Parts of a cluster by the heights of their tops, and things lower than noise."""

import numpy as np
import pytest

from footfall.systems.perception.obstacles.low_things import raised_points
from footfall.systems.perception.obstacles.tops import split_by_tops


def block(x: float, y: float, dx: float, dy: float, z: float, seed: int) -> np.ndarray:
    """Noisy points of a level top, 2 cm apart."""
    rng = np.random.default_rng(seed)
    grid = np.stack(
        np.meshgrid(np.arange(x, x + dx, 0.01), np.arange(y, y + dy, 0.01)), axis=-1
    ).reshape(-1, 2)
    return np.column_stack([grid, z + rng.normal(0.0, 0.015, len(grid))])


def split(points: np.ndarray) -> list[np.ndarray]:
    """Parts of 2 cm columns."""
    return split_by_tops(points, 0.02, 0.04, 30)


def test_two_heights_are_two_parts_the_higher_first() -> None:
    """They touch."""
    points = np.concatenate(
        [block(0, 0, 0.4, 0.4, 0.4, 0), block(0.4, 0, 0.4, 0.4, 0.7, 1)]
    )
    high, low = split(points)
    assert np.median(points[high, 2]) == pytest.approx(0.7, abs=0.01)
    assert np.median(points[low, 2]) == pytest.approx(0.4, abs=0.01)
    assert len(np.intersect1d(high, low)) == 0
    assert len(high) + len(low) > 0.95 * len(points)


def test_one_height_is_one_part_with_all_its_points() -> None:
    """The points of its sides are its own."""
    rng = np.random.default_rng(2)
    side = np.column_stack(
        [np.full(300, 0.4), rng.uniform(0, 0.4, 300), rng.uniform(0.06, 0.5, 300)]
    )
    points = np.concatenate([block(0, 0, 0.4, 0.4, 0.5, 0), side])
    (part,) = split(points)
    assert len(part) == len(points)


def test_a_thin_part_counts_where_it_is_the_taller() -> None:
    """A back of 4 cm behind a seat does; a strip below a top is its side."""
    seat = block(0, 0, 0.45, 0.41, 0.45, 0)
    assert len(split(np.concatenate([seat, block(0, 0.41, 0.45, 0.04, 0.9, 1)]))) == 2
    assert len(split(np.concatenate([seat, block(0, 0.41, 0.45, 0.04, 0.25, 1)]))) == 1


def test_what_slopes_is_no_top() -> None:
    """A wall that the edge of a picture cuts off on a slant stays one."""
    wall = block(0, 0, 2.0, 0.14, 0.6, 0)
    rest = block(2.0, 0, 0.7, 0.14, 0.0, 1)
    rest[:, 2] += 0.6 - 0.8 * (rest[:, 0] - 2.0)
    assert len(split(np.concatenate([wall, rest]))) == 1


@pytest.mark.parametrize("height", [0.0, 0.04, 0.06])
def test_what_is_lower_than_single_points_tell_is_told_by_patches(
    height: float,
) -> None:
    """Noise of 2 cm; the selection ends where the thing does, to a cell."""
    floor = block(-0.5, -0.5, 1.0, 1.0, 0.0, 0)
    floor[:, 2] *= 4.0 / 3.0
    on = np.all(np.abs(floor[:, :2]) < 0.2, axis=1)
    floor[on, 2] += height
    sigma = np.full(len(floor), 0.02)
    raised = raised_points(
        floor, floor[:, 2], 8.0 * sigma, sigma, patch=0.1, least=0.025
    )
    if height == 0.0:
        assert not raised.any()
        return
    assert raised[on].mean() > 0.8
    outside = np.any(np.abs(floor[:, :2]) > 0.25, axis=1)
    assert not raised[outside].any()
