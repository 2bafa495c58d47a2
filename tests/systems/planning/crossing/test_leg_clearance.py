"""Distances of outlines to an obstacle in the plane."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.leg_clearance import (
    Section,
    outline_gap,
    segments_intersect,
)


def _square(x: float, z: float, side: float = 0.1) -> Vector:
    corners = np.array([[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]])
    return (corners + np.array([x, z]))[None]


@pytest.mark.parametrize(
    ("x", "z", "gap"),
    [
        (-0.15, 0.0, 0.05),
        (0.08, 0.0, 0.03),
        (0.0, 0.25, 0.05),
        (0.08, 0.24, np.hypot(0.03, 0.04)),
        (-0.02, 0.0, None),
        (-0.02, 0.15, None),
    ],
)
def test_gap(x: float, z: float, gap: float | None) -> None:
    """Before, beyond, above, over a corner, and twice in it."""
    found = outline_gap(_square(x, z), Section(0.05, 0.2))[0]
    if gap is None:
        assert found <= 0.0
    else:
        assert found == pytest.approx(gap, abs=1e-9)


def test_an_edge_over_the_corner_counts() -> None:
    """The obstacle's corner is nearest to the middle of an edge."""
    triangle: Vector = np.array([[[-0.2, 0.25], [0.2, 0.25], [0.0, 0.6]]])
    assert outline_gap(triangle, Section(0.05, 0.2))[0] == pytest.approx(0.05)


@pytest.mark.parametrize(
    ("line", "gap"),
    [
        ([[-0.1, 0.15], [0.15, 0.15]], -0.025),
        ([[-0.1, 0.19], [0.15, 0.19]], -0.01),
        ([[0.02, 0.5], [0.02, -0.5]], -0.02),
        ([[-0.12, 0.06], [0.12, 0.30]], -0.01),
        ([[0.12, 0.11], [0.06, 0.17]], np.hypot(0.01, 0.0)),
    ],
)
def test_an_edge_that_passes_through_is_as_deep_as_its_deepest_point(
    line: list[list[float]], gap: float
) -> None:
    """From side to side, near the top, from the top, a corner cut off; and beside."""
    found = outline_gap(np.array([line]), Section(0.05, 0.2))[0]
    assert found == pytest.approx(gap, abs=1e-9)


def test_an_outline_around_the_obstacle_meets_it() -> None:
    """No corner of the outline is inside and no distance is small."""
    assert outline_gap(_square(-1.0, -2.0, 3.0), Section(0.05, 0.2))[0] <= 0.0


def test_segments_cross_as_their_cross_products_say() -> None:
    """Eq. 9."""
    origin, x, z = np.zeros(2), np.array([1.0, 0.0]), np.array([0.0, 1.0])
    assert segments_intersect(origin, x + z, x, z) == 1.0
    assert segments_intersect(origin, x, z, x + z) == 0.0
    assert segments_intersect(origin, 0.4 * (x + z), x, z) == 0.0
