"""Legs of a way that end where the robot has to look again."""

import numpy as np
import pytest

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.obstacle import Obstacle, ObstacleMap
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.seen_floor import (
    EDGE,
    ROOM,
    WalkSegment,
    plan_walk_segment,
)
from footfall.systems.planning.footsteps.foothold import Refusal

SEEN = 2.6
TOE = JVRC1.sole.toe


def _leg(
    *obstacles: Obstacle, goal: Vector, start: Vector | None = None, seen: float = SEEN
) -> WalkSegment | Refusal:
    outline: Vector = np.array([[0.0, -2.0], [seen, -2.0], [seen, 2.0], [0.0, 2.0]])
    begin = np.zeros(3) if start is None else start
    return plan_walk_segment(
        ObstacleMap(obstacles, 0.0, "ok", outline), begin, goal, JVRC1.sole
    )


def _box(x: float, y: float = 0.0, yaw: float = 0.0) -> Obstacle:
    return Obstacle(np.array([x, y]), yaw, 0.05, 0.15, 1.2)


def _planned(segment: WalkSegment | Refusal) -> WalkSegment:
    assert isinstance(segment, WalkSegment)
    return segment


def test_a_goal_on_seen_floor_is_the_leg() -> None:
    """With all that lies about it."""
    goal: Vector = np.array([2.3, 0.2, 0.4])
    segment = _planned(_leg(_box(1.2), _box(1.8), goal=goal))
    assert segment.final
    np.testing.assert_array_equal(segment.goal, goal)
    assert len(segment.obstacles) == 2


def test_beyond_the_seen_floor_the_leg_ends_before_its_edge() -> None:
    """The toes stay on what was seen; the robot faces its way."""
    segment = _planned(_leg(goal=np.array([4.0, 3.0, 0.0])))
    assert not segment.final
    ahead = np.array([0.8, 0.6])
    assert segment.goal[2] == pytest.approx(np.arctan2(3.0, 4.0))
    reached = segment.goal[:2] + TOE * ahead
    assert reached[0] < SEEN
    np.testing.assert_allclose(segment.goal[:2] @ [-0.6, 0.8], 0.0, atol=1e-9)
    assert np.linalg.norm(segment.goal[:2]) > 2.0


def test_an_obstacle_at_the_edge_of_sight_waits() -> None:
    """Its top was not seen: no segment goes over it."""
    box = _box(SEEN - EDGE + 0.1)
    segment = _planned(_leg(box, goal=np.array([4.0, 0.0, 0.0])))
    assert segment.obstacles == ()
    assert segment.goal[0] == pytest.approx(SEEN - EDGE + 0.075 - TOE - ROOM)
    near = _planned(_leg(_box(1.2), goal=np.array([4.0, 0.0, 0.0])))
    assert len(near.obstacles) == 1
    assert near.goal[0] > 2.0


def test_no_leg_ends_on_an_obstacle() -> None:
    """It ends before the one that it could not stand beyond."""
    for x in np.arange(1.2, 2.9, 0.1):
        segment = _planned(_leg(_box(float(x)), goal=np.array([4.0, 0.0, 0.0])))
        end = segment.goal[0]
        before = end + TOE < x - 0.025 - 0.1
        beyond = end > x + 0.025 + 0.4
        assert before or beyond, x


def test_what_is_beside_the_way_or_beyond_the_goal_does_not_stop_it() -> None:
    """However badly it is seen."""
    for box in (_box(2.4, y=1.0), _box(2.55)):
        segment = _planned(_leg(box, goal=np.array([2.2, 0.0, 0.0])))
        assert segment.final


def test_towards_what_is_behind_it_turns_first() -> None:
    """Then it looks."""
    segment = _planned(_leg(_box(1.2), goal=np.array([-1.5, 0.0, 0.0])))
    assert not segment.final
    np.testing.assert_allclose(segment.goal, [0.0, 0.0, np.pi])
    assert segment.obstacles == ()
    blocked = _leg(goal=np.array([1.5, 0.0, 0.0]), seen=0.2)
    assert isinstance(blocked, Refusal)
    assert "seen for 0.20 m only" in blocked.reason


def test_a_short_way_needs_no_look() -> None:
    """A correction of the stance, whichever way."""
    segment = _planned(_leg(goal=np.array([-0.1, 0.05, 0.0])))
    assert segment.final


def test_a_stop_before_one_obstacle_is_not_on_the_landing_beyond_another() -> None:
    """In whichever order they were seen."""
    near, far = _box(1.4), _box(2.0)
    for boxes in ((near, far), (far, near)):
        segment = _planned(_leg(*boxes, goal=np.array([4.0, 0.0, 0.0])))
        assert segment.goal[0] + TOE < 1.375 - 0.1
