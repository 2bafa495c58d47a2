"""Walking to the stand line in the fewest steps."""

from math import ceil, radians

import numpy as np
import pytest

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.geometry import rotate
from footfall.systems.planning.footsteps.approach import FloorStep, plan_approach
from footfall.systems.planning.footsteps.foothold import SIDE, Refusal
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)
PARAMS = FootstepPlannerParams()
GOAL = np.array([3.0, -1.0])


def feet(x: float, y: float, yaw: float) -> dict[Foot, FloorStep]:
    """Feet side by side at this place from the goal."""
    return {
        foot: FloorStep(
            foot,
            GOAL + np.array([x, y]) + rotate(yaw, np.array([0.0, SIDE[foot] * 0.095])),
            yaw,
        )
        for foot in FEET
    }


def count(x: float, y: float, yaw: float, last: Foot = "left") -> int:
    """How many steps it takes."""
    steps = plan_approach(feet(x, y, yaw), GOAL, last, SOLE, PARAMS)
    assert not isinstance(steps, Refusal)
    return len(steps)


@pytest.mark.parametrize("distance", [0.02, 0.29, 0.31, 0.61, 0.95, 1.5])
def test_ahead_n_plus_one_steps_get_n_step_lengths_far(distance: float) -> None:
    """The last step only comes beside the foot before."""
    assert count(-distance, 0.0, 0.0) == ceil(distance / 0.30) + 1
    assert count(distance, 0.0, 0.0) == ceil(distance / 0.15) + 1


@pytest.mark.parametrize("turn", [5.0, 16.0, -40.0, 90.0])
def test_on_the_spot_n_plus_one_steps_turn_n_times(turn: float) -> None:
    """At most 14.9 deg (0.26 rad) a step."""
    assert count(0.0, 0.0, radians(turn)) == ceil(abs(radians(turn)) / 0.26) + 1


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_sideways_the_outer_foot_goes_wide_and_the_inner_one_follows(
    side: float,
) -> None:
    """Outward a foot gains 9 cm (0.28 - 0.19), inward 7.6 cm (0.19 - 0.114)."""
    assert count(0.0, side * 0.089, 0.0) == 2
    assert count(0.0, side * 0.091, 0.0) == 3
    assert count(0.0, side * 0.165, 0.0) == 3
    assert count(0.0, side * 0.168, 0.0) == 4


def test_feet_at_the_goal_stay_and_one_off_it_comes_alone() -> None:
    """Within the tolerances no foot steps again."""
    assert count(0.01, -0.01, 0.02) == 0
    start = feet(0.0, 0.0, 0.0)
    start["right"] = FloorStep("right", start["right"].p - [0.1, 0.0], 0.0)
    steps = plan_approach(start, GOAL, "left", SOLE, PARAMS)
    assert not isinstance(steps, Refusal)
    assert [step.foot for step in steps] == ["right"]
    np.testing.assert_allclose(steps[0].p, GOAL - [0.0, 0.095], atol=1e-12)


@pytest.mark.parametrize("last", FEET)
@pytest.mark.parametrize("distance", [0.25, 0.55])
def test_the_wanted_foot_steps_last(last: Foot, distance: float) -> None:
    """For an even and an odd number of steps."""
    steps = plan_approach(feet(-distance, 0.0, 0.0), GOAL, last, SOLE, PARAMS)
    assert not isinstance(steps, Refusal)
    assert steps[-1].foot == last


@pytest.mark.parametrize("seed", range(20))
def test_no_foot_goes_beyond_the_stand_line(seed: int) -> None:
    """Nor farther than it stands already, when it starts too near to the stairs."""
    rng = np.random.default_rng(seed)
    start = feet(*rng.uniform([-0.3, -0.5, -1.0], [0.1, 0.5, 1.0]))
    steps = plan_approach(start, GOAL, "left", SOLE, PARAMS)
    assert not isinstance(steps, Refusal)
    farthest = max(GOAL[0], *(foot.p[0] for foot in start.values()))
    assert max(step.p[0] for step in steps) <= farthest + 1e-6


def test_a_walk_that_is_too_long_is_refused() -> None:
    """The limit is a parameter."""
    params = FootstepPlannerParams(max_approach_steps=3)
    steps = plan_approach(feet(-0.9, 0.0, 0.0), GOAL, "left", SOLE, params)
    assert steps == Refusal(
        "the stand line, 0.90 m away, cannot be reached within 3 steps"
    )
