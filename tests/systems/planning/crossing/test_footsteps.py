"""Footsteps that fit the key configuration, or why there are none."""

from itertools import pairwise

import numpy as np
import pytest

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.obstacle import Feasibility, KeyConfiguration, Obstacle
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.footsteps import (
    CrossingSteps,
    in_the_way,
    plan_crossing_steps,
)
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

KEY = KeyConfiguration(X_ads=0.40, X_hds=0.20, Z_hds=0.78, front=0.21)
PARAMS = FootstepPlannerParams(max_step_length=0.22)
GOAL: Vector = np.array([2.5, 0.0, 0.0])


def _obstacle(
    x: float, y: float = 0.0, yaw: float = 0.0, length: float = 1.2
) -> Obstacle:
    return Obstacle(np.array([x, y]), yaw, 0.05, 0.15, length)


def _plan(*obstacles: Obstacle, key: KeyConfiguration | None = KEY) -> CrossingSteps:
    feet: Vector = np.zeros((2, 6))
    feet[:, 1] = [0.095, -0.095]
    ahead = in_the_way(obstacles, np.zeros(2), GOAL[:2], JVRC1.sole)
    answers = tuple(Feasibility(key, "" if key else "Eq. 5: it is so") for _ in ahead)
    return plan_crossing_steps(feet, GOAL, ahead, answers, JVRC1.sole, PARAMS)


@pytest.mark.parametrize("yaw", [0.0, 0.26, -0.2, np.pi])
@pytest.mark.parametrize("x", [0.9, 1.03, 1.2])
def test_both_feet_cross_from_where_the_key_begins(x: float, yaw: float) -> None:
    """Whatever the distance: the approach takes up the difference."""
    steps = _plan(_obstacle(x, yaw=yaw)).plan.footsteps
    crossing = [index for index, step in enumerate(steps) if step.plane == 0]
    first, second = crossing
    assert second == first + 1
    assert steps[first].foot != steps[second].foot
    turned = yaw if abs(yaw) < 2.0 else 0.0
    ahead = np.array([np.cos(turned), np.sin(turned)])
    face = np.array([x, 0.0]) @ ahead - 0.025
    for index in crossing:
        before = next(
            step for step in reversed(steps[:first]) if step.foot == steps[index].foot
        )
        rear = before.X_WF.translation()[:2] @ ahead
        assert face - rear == pytest.approx(KEY.front, abs=1e-6)
        front = steps[index].X_WF.translation()[:2] @ ahead
        assert front - rear == pytest.approx(KEY.X_ads, abs=1e-6)
    last = np.mean([step.X_WF.translation()[:2] for step in steps[-2:]], axis=0)
    np.testing.assert_allclose(last, GOAL[:2], atol=1e-6)


def test_feet_alternate_all_the_way() -> None:
    """A walk, not a shuffle."""
    feet = [step.foot for step in _plan(_obstacle(1.2)).plan.footsteps]
    assert sum(a == b for a, b in pairwise(feet)) <= 1


def test_what_is_not_in_the_way_is_left_alone() -> None:
    """Behind, beside, and beyond the goal."""
    plan = _plan(_obstacle(-0.6), _obstacle(1.2, y=0.9), _obstacle(3.2))
    assert plan.plan.status == "planned"
    assert plan.obstacles == ()
    assert _plan(_obstacle(1.2, y=0.55)).obstacles != ()


def test_two_in_a_row_are_crossed_one_after_the_other() -> None:
    """60 cm apart; 25 cm are too few."""
    far = _plan(_obstacle(1.1), _obstacle(1.7))
    assert [step.plane for step in far.plan.footsteps if step.plane >= 0] == [
        0,
        0,
        1,
        1,
    ]
    near = _plan(_obstacle(1.1), _obstacle(1.35)).plan
    assert near.status == "infeasible"
    assert "too near to the one before it" in near.reason


def test_an_obstacle_that_cannot_be_crossed_is_refused_with_the_reason() -> None:
    """Before the robot moves."""
    plan = _plan(_obstacle(1.2), key=None).plan
    assert plan.status == "infeasible"
    assert plan.footsteps == ()
    assert "1.20 m ahead cannot be crossed: Eq. 5: it is so" in plan.reason


def test_at_the_goal_nothing_is_left_to_do() -> None:
    """No footsteps, finished."""
    feet: Vector = np.zeros((2, 6))
    feet[:, 1] = [0.095, -0.095]
    plan = plan_crossing_steps(feet, np.zeros(3), (), (), JVRC1.sole, PARAMS).plan
    assert plan.status == "finished"


def test_a_goal_on_the_obstacle_or_too_near_beyond_it_is_refused() -> None:
    """Before the feet would have to step back over it."""
    assert "the goal is too near to the obstacle" in _plan(_obstacle(2.5)).plan.reason
    assert _plan(_obstacle(2.28)).plan.status == "planned"


def test_what_lies_beyond_the_goal_is_not_crossed() -> None:
    """Nor is what is turned so that only its end beside the way is nearer."""
    toes = float(GOAL[0]) + JVRC1.sole.toe
    for obstacle in (
        _obstacle(toes + 0.1),
        _obstacle(toes + 0.3, yaw=0.7, length=2.0),
    ):
        assert in_the_way((obstacle,), np.zeros(2), GOAL[:2], JVRC1.sole) == ()
