"""Free space of a disc: exact up to the drawing of arcs, and never too large."""

import numpy as np
import pytest

from footfall.models.values.room import Environment
from footfall.systems.planning.path.free_space import free_space, refuse_place
from tests.systems.planning.path.room_cases import (
    box,
    distance_to_boxes,
    distance_to_edge,
    floor,
    room,
)


@pytest.mark.parametrize("seed", range(10))
def test_what_is_free_keeps_the_clearance(seed: int) -> None:
    """Against distances by another formula: no free point is too near, by nothing."""
    environment = room(seed)
    space = free_space(environment.floor.polygon[:, :2], environment.boxes, 0.45)
    points = np.random.default_rng(seed).uniform([-3.5, -2.6], [3.5, 2.6], (3000, 2))
    free = np.array([space.part_of(p) is not None for p in points])
    away = np.minimum(
        distance_to_boxes(points, environment), distance_to_edge(points, environment)
    )
    assert 0 < free.sum() < len(points)
    assert away[free].min() >= 0.45 - 1e-12
    # What is called occupied is at most the height of an arc over its chord off.
    assert away[~free].max() <= 0.45 / np.cos(np.pi / 32.0) + 1e-12


def test_a_wall_of_boxes_splits_the_room() -> None:
    """Two parts, and a line from one to the other is not free."""
    wall = tuple(
        box(f"wall_{i}", 0.0, y) for i, y in enumerate((-2.2, -1.1, 0, 1.1, 2.2))
    )
    space = free_space(floor().polygon[:, :2], wall, 0.4)
    assert len(space.parts) == 2
    left, right = (space.part_of(np.array([x, 0.0])) for x in (-2.0, 2.0))
    assert None not in (left, right)
    assert left != right
    assert space.holds(np.array([[-2.0, -1.0], [-1.0, 0.0], [-2.0, 1.0]]))
    assert not space.holds(np.array([[-2.0, 0.0], [2.0, 0.0]]))


@pytest.mark.parametrize(
    ("p", "reason"),
    [
        ((9.0, 0.0), "the goal (9.00, 0.00) m is outside the floor that was seen"),
        ((9.0, -1e-4), "the goal (9.00, 0.00) m is outside the floor that was seen"),
        ((0.1, 0.1), "the goal (0.10, 0.10) m is inside crate"),
        ((0.5, 0.0), "in collision: 0.30 m from crate, where the footprint takes 0.45"),
        ((3.2, 0.0), "0.30 m from the edge of the floor that was seen"),
        ((2.0, 0.0), None),
    ],
)
def test_places_are_refused_with_what_is_in_the_way(
    p: tuple[float, float], reason: str | None
) -> None:
    """Outside, inside a box, too near a box, too near the edge, and free."""
    environment = Environment(floor(), (box("crate", 0.0, 0.0),))
    refusal = refuse_place("goal", np.array(p), environment, 0.45)
    assert (refusal is None) if reason is None else (reason in refusal)
