"""How the robot faces along a path, and what its steps cost."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from footfall.systems.planning.footsteps.foothold import wrap
from footfall.systems.planning.path.path_headings import StepReach, choose_headings
from footfall.systems.planning.path.path_walk import (
    step_centres,
    walk_curve,
    walk_effort,
)

REACH = StepReach(
    forward=0.3, backward=0.15, sideways=0.075, turn=0.25, turn_narrows=0.15
)
WIDTH = 0.19


def test_steps_of_each_kind() -> None:
    """Forwards, backwards, sideways and askew by the reach's own sides."""
    going = REACH.steps_to_go(np.full(5, 0.6), np.array([0, pi, pi / 2, -pi / 2, 0.1]))
    np.testing.assert_allclose(going, [2, 4, 8, 8, 0.6 * np.cos(0.1) / 0.3])
    assert REACH.steps_to_turn(np.array(-0.5)) == 2.0


@pytest.mark.parametrize(
    ("way", "yaws", "heading"),
    [
        ((3.0, 0.0), (0.0, 0.0), 0.0),
        ((0.0, 3.0), (0.0, 0.0), pi / 2),
        ((0.0, 0.3), (0.0, 0.0), 0.0),
        ((0.0, -0.3), (0.0, 0.0), 0.0),
        ((-0.4, 0.0), (0.0, 0.0), 0.0),
        ((-9.0, 0.0), (0.0, 0.0), pi),
        ((0.0, 0.3), (0.0, 1.2), 1.2),
    ],
    ids=["ahead", "turn", "left", "right", "back", "about", "goal's"],
)
def test_short_ways_sideways_long_ones_forwards(
    way: tuple[float, float], yaws: tuple[float, float], heading: float
) -> None:
    """The choice between turning and going as it is."""
    points = np.array([[0.0, 0.0], way])
    (chosen,) = choose_headings(points, *yaws, REACH)
    assert abs(wrap(chosen - heading)) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_headings_are_the_best_of_all_choices(seed: int) -> None:
    """Against trying every combination on two legs."""
    rng = np.random.default_rng(seed)
    points = np.vstack([[0, 0], np.cumsum(rng.uniform(-0.8, 0.8, (2, 2)), axis=0)])
    start, goal = rng.uniform(-pi, pi, 2)
    legs = np.diff(points, axis=0)
    length, direction = np.hypot(*legs.T), np.arctan2(legs[:, 1], legs[:, 0])

    def cost(h: tuple[float, float]) -> float:
        turns = [wrap(b - a) for a, b in ((start, h[0]), (h[0], h[1]), (h[1], goal))]
        going = REACH.steps_to_go(length, direction - np.array(h))
        return float(np.sum(np.abs(turns)) / REACH.turn + going.sum())

    choices = [start, goal, *(d + q * pi / 2 for d in direction for q in range(4))]
    best = min(cost((a, b)) for a in choices for b in choices)
    assert cost(tuple(choose_headings(points, start, goal, REACH))) == pytest.approx(
        best
    )


@pytest.mark.parametrize("seed", range(20))
def test_curve_stays_on_the_path(seed: int) -> None:
    """Its ends are the start and the goal, its places are on the path, in order."""
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.uniform(-0.2, 0.8, (5, 2)), axis=0)
    start, goal = rng.uniform(-pi, pi, 2)
    curve, effort = walk_curve(points, start, goal, REACH, WIDTH)
    np.testing.assert_allclose(curve[0], [*points[0], start])
    np.testing.assert_allclose(curve[-1, :2], points[-1])
    assert wrap(curve[-1, 2] - goal) == pytest.approx(0.0, abs=1e-9)
    legs = np.diff(points, axis=0)
    length = np.hypot(*legs.T)
    off = np.min(
        [
            np.linalg.norm(
                curve[:, :2]
                - a
                - np.clip((curve[:, :2] - a) @ leg / n**2, 0, 1)[:, None] * leg,
                axis=1,
            )
            for a, leg, n in zip(points[:-1], legs, length, strict=True)
        ],
        axis=0,
    )
    np.testing.assert_allclose(off, 0.0, atol=1e-9)
    walked = np.hypot(*np.diff(curve[:, :2], axis=0).T).sum()
    assert walked == pytest.approx(length.sum())
    assert effort[0] == 0.0
    assert np.all(np.diff(effort) >= 0.0)


def test_turning_as_it_goes_saves_steps() -> None:
    """A slight bend costs less than turning on the spot in between."""
    points = np.array([[0.0, 0.0], [2.0, 0.0], [4.0, 0.8]])
    bend = float(np.arctan2(0.8, 2.0))
    _, effort = walk_curve(points, 0.0, bend, REACH, WIDTH)
    straight = (2.0 + np.hypot(2.0, 0.8)) / REACH.forward
    assert straight < effort[-1] < straight + 0.8 * bend / REACH.turn


def test_effort_bounds_every_step() -> None:
    """Between centres of like effort no step goes or turns more than the reach."""
    points = np.array([[0.0, 0.0], [1.0, 0.2], [2.0, -0.5], [2.2, -0.5]])
    curve, effort = walk_curve(points, 2.0, -1.0, REACH, WIDTH)
    assert effort[-1] == walk_effort(curve, REACH, WIDTH)[-1]
    centres = step_centres(curve, effort, int(np.ceil(effort[-1])))
    np.testing.assert_allclose(centres[-1], curve[-1])
    move = np.diff(np.vstack([curve[0], centres]), axis=0)
    assert np.hypot(*move[:, :2].T).max() <= np.hypot(0.3, 0.075) + 1e-9
    assert np.abs(move[:, 2]).max() <= 0.25 + 1e-9


def test_effort_of_turning_while_going() -> None:
    """On an arc the foot set down inward has the least room, and decides."""
    yaw = np.linspace(0.0, 0.5, 200)
    arc = np.column_stack([2.0 * np.sin(yaw), 2.0 - 2.0 * np.cos(yaw), yaw])
    effort = walk_effort(arc, REACH, WIDTH)[-1]
    outer = (2.0 + WIDTH / 2.0) * 0.5 / REACH.forward
    inward = (REACH.turn_narrows + REACH.forward / 2.0) * 0.5 / REACH.sideways
    assert effort == pytest.approx(max(outer, inward), rel=1e-4)
    tight = np.column_stack([0.5 * np.sin(yaw), 0.5 - 0.5 * np.cos(yaw), yaw])
    nimble = replace(REACH, turn=0.5)
    assert walk_effort(tight, nimble, WIDTH)[-1] == pytest.approx(inward, rel=1e-4)


def test_no_way_to_go_is_a_turn() -> None:
    """A path of one place is turned on."""
    curve, effort = walk_curve(np.zeros((2, 2)), 0.0, 1.0, REACH, WIDTH)
    np.testing.assert_allclose(curve[[0, -1]], [[0, 0, 0], [0, 0, 1]])
    assert effort[-1] == pytest.approx(4.0)
