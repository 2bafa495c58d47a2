"""Feet along a crossing: whose way the repairs change, and where FTA looks."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.obstacle import Obstacle
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet import (
    crossing_rows,
    feet_along,
    front_distance,
    yielding_path,
)
from footfall.systems.planning.crossing.feet_adaptor import (
    KNOTS,
    LegPoses,
    Repairs,
    ankle_displacement,
)
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.crossing.timing import (
    CrossingStep,
    time_steps,
    zmp_reference,
)
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.motion.step_timing import stance_zmp
from tests.systems.planning.crossing.crossing_cases import body, footstep

PARAMS = CrossingParams()
WALKING = MotionPlannerParams()
FEET: Vector = np.array([[0.0, 0.095, 0, 0, 0, 0], [0.0, -0.095, 0, 0, 0, 0]])
BOX = Obstacle(np.array([0.24, 0.0]), 0.0, 0.05, 0.15, 1.0)
COM: Vector = np.array([0.035, 0.0, 0.83])


def _timed(
    params: CrossingParams = PARAMS,
) -> tuple[tuple[CrossingStep, ...], Vector, float]:
    """Left, then right over the box, then both a little further."""
    steps, end = time_steps(
        FEET,
        (
            footstep("left", 0.42, 0),
            footstep("right", 0.42, 0),
            footstep("left", 0.5),
            footstep("right", 0.5),
        ),
        WALKING,
        params,
    )
    return steps, np.arange(0.0, end, 0.01), end


def _ways(repairs: Repairs) -> Vector:
    steps, time, _ = _timed()
    return feet_along(time, steps, FEET, (BOX,), body().leg, PARAMS, repairs)


def test_feet_rest_where_they_stepped() -> None:
    """Before, between and after their steps."""
    steps, time, _ = _timed()
    poses = _ways(Repairs())
    left, right = poses[:, 0], poses[:, 1]
    np.testing.assert_array_equal(left[time < steps[0].lift][-1], FEET[0])
    between = (time > steps[0].land) & (time < steps[2].lift)
    np.testing.assert_array_equal(
        left[between], np.tile(steps[0].end, (between.sum(), 1))
    )
    np.testing.assert_array_equal(right[time < steps[1].lift][-1], FEET[1])
    np.testing.assert_array_equal(right[-1], steps[3].end)


def test_a_shift_is_the_second_foots_alone() -> None:
    """The first repair (Sec. III-E1): to the rear, in phase 3 only."""
    steps, time, _ = _timed()
    change = _ways(Repairs(shift=0.04)) - _ways(Repairs())
    assert not change[:, 0].any()
    inside = (time > steps[1].lift) & (time < steps[1].land)
    assert change[inside, 1, 0].min() == pytest.approx(-0.04, abs=3e-3)
    assert not change[~inside, 1].any()


def test_a_path_pushes_the_second_foot_along_the_heading() -> None:
    """The third repair: as far as it says, when it says."""
    steps, time, _ = _timed()
    path = -0.03 * np.sin(np.linspace(0.0, np.pi, KNOTS))
    change = _ways(Repairs(path=path)) - _ways(Repairs())
    assert not change[:, 0].any()
    middle = 0.5 * (steps[1].lift + steps[1].land)
    row = int(np.argmin(np.abs(time - middle)))
    assert change[row, 1, 0] == pytest.approx(-0.03, abs=1e-3)
    assert not change[:, 1, 1:].any()


def test_a_foot_near_the_obstacle_draws_back_before_its_margin() -> None:
    """Until it is above it: the toe stays behind the inflated front face."""
    steps, time, _ = _timed()
    near = replace(BOX, center=np.array([0.17, 0.0]))
    poses = feet_along(time, steps, FEET, (near,), body().leg, PARAMS, Repairs())
    lead = poses[time <= steps[0].land, 0]
    front = 0.17 - 0.025 - PARAMS.feasibility.s_w
    back = lead[:, 0].min()
    assert back == pytest.approx(front - body().leg.outline.toe, abs=8e-3)
    assert back < -PARAMS.feet.retraction - 0.01


def test_the_front_is_measured_along_the_obstacles_direction() -> None:
    """Before it positive, whatever the yaw."""
    assert front_distance(BOX, np.zeros(2)) == pytest.approx(0.24 - 0.025)
    turned = replace(BOX, yaw=0.3)
    along = 0.24 * np.cos(0.3) - 0.025
    assert front_distance(turned, np.zeros(2)) == pytest.approx(along)


def test_fta_looks_at_phases_1_to_3() -> None:
    """And at the double support before them."""
    steps, time, _ = _timed()
    inside = crossing_rows(time, steps)
    assert inside[time < steps[1].land].all()
    assert not inside[time > steps[1].land + 0.06].any()


def test_only_a_second_foot_that_meets_the_obstacle_yields() -> None:
    """Where and as deep as it does."""
    steps, time, _ = _timed()
    angles = np.tile([-0.6, 0.0, 0.0, 1.2, 0.0, -0.6], (len(time), 2, 1))
    poses = LegPoses(angles, _ways(Repairs()))
    gaps = np.full((1, len(time), 2), 0.1)
    gaps[0, :, 0] = -0.05
    leg = body().leg
    assert yielding_path(poses, gaps, time, steps, leg, Repairs()) is None
    middle = 0.5 * (steps[1].lift + steps[1].land)
    gaps[0, np.abs(time - middle) < 0.02, 1] = -0.01
    path = yielding_path(poses, gaps, time, steps, leg, Repairs())
    assert path is not None
    assert int(np.argmin(path)) == KNOTS // 2
    # By the depth times what Eq. 25 says for the middle of the shin, and 2 mm.
    leverage = ankle_displacement(leg, "right", angles[0, 1], 0.5 * leg.shank, 1.0)
    assert leverage > 1.1
    assert path.min() == pytest.approx(-(0.01 * leverage + 0.002), rel=1e-6)
    # A point half-way down the shin moves less than the ankle does.
    assert -0.03 <= path.min() < -0.012
    assert path[[0, -1]] == pytest.approx(0.0)


def test_the_zmp_is_over_the_stance_before_a_foot_lifts_quasi_statically() -> None:
    """By the rest; dynamically it arrives as the foot lifts."""
    steps, _, end = _timed()
    rest = PARAMS.quasi_static.rest
    modes: tuple[tuple[Mode, float], ...] = (("quasi_static", rest), ("dynamic", 0.0))
    for mode, before in modes:
        step = steps[1]
        time = np.array([step.lift - before, step.lift, step.land])
        zmp = zmp_reference(
            time,
            steps,
            FEET,
            COM,
            end,
            WALKING,
            PARAMS,
            mode,
        )
        over = stance_zmp(step.stance, "left", PARAMS.zmp_forward, WALKING)
        np.testing.assert_allclose(zmp, np.tile(over, (3, 1)), atol=1e-9)
        early = np.array([step.lift - before - 0.05])
        moving = zmp_reference(
            early,
            steps,
            FEET,
            COM,
            end,
            WALKING,
            PARAMS,
            mode,
        )
        assert np.abs(moving[0] - over).max() > 1e-4


def test_the_zmp_rolls_on_in_phase_1_alone() -> None:
    """Towards the toes of the rear foot."""
    steps, _, end = _timed()
    time = np.array([step.land for step in steps[:3]])
    sharp = replace(PARAMS, zmp_rounding=0.0)
    zmp = zmp_reference(time, steps, FEET, COM, end, WALKING, sharp)
    ahead = zmp[:, 0] - [step.stance[0] for step in steps[:3]]
    rolled = PARAMS.zmp_forward + PARAMS.zmp_rolling
    np.testing.assert_allclose(
        ahead, [rolled, PARAMS.zmp_forward, WALKING.zmp_forward], atol=1e-9
    )


def test_double_supports_about_a_crossing_have_their_own_time() -> None:
    """Before phase 1 (but for the first step of all), in phase 2 and after phase 3."""
    steps, _ = time_steps(
        FEET,
        (
            footstep("right", 0.0),
            footstep("left", 0.42, 0),
            footstep("right", 0.42, 0),
            footstep("left", 0.5),
            footstep("right", 0.5),
        ),
        WALKING,
        PARAMS,
    )
    double = [step.lift - step.push for step in steps]
    own, walk = PARAMS.double_support, WALKING.double_support
    assert double == pytest.approx([WALKING.lead_in, own, own, own, walk])
    single = [step.land - step.lift for step in steps]
    slow, fast = PARAMS.single_support, WALKING.single_support
    assert single == pytest.approx([fast, slow, slow, fast, fast])
    assert [step.leads for step in steps] == [False, True, False, False, False]


def test_the_corners_of_the_zmp_are_rounded() -> None:
    """Its speed no longer jumps; in between it is where it was."""
    steps, _, end = _timed()
    time = np.arange(0.0, end, WALKING.period)
    sharp, round_ = (
        zmp_reference(
            time,
            steps,
            FEET,
            COM,
            end,
            WALKING,
            replace(PARAMS, zmp_rounding=rounding),
        )
        for rounding in (0.0, 0.045)
    )
    jumps = [np.abs(np.diff(zmp[:, 1], n=2)).max() for zmp in (sharp, round_)]
    assert jumps[1] < 0.2 * jumps[0]
    corners = np.array([t for step in steps for t in (step.lift, step.land)])
    far = np.abs(time[:, None] - corners).min(axis=1) > 0.05
    far &= (time > steps[0].lift) & (time < steps[-1].land)
    np.testing.assert_allclose(round_[far, 1], sharp[far, 1], atol=1e-9)


def test_a_foot_over_the_obstacle_is_drawn_inwards() -> None:
    """Both feet towards the other, in the air alone."""
    steps, time, _ = _timed()
    straight, drawn = (
        feet_along(
            time,
            steps,
            FEET,
            (BOX,),
            body().leg,
            replace(PARAMS, inward=inward),
            Repairs(),
        )
        for inward in (0.0, 0.04)
    )
    shift = drawn - straight
    assert shift[:, 0, 1].min() == pytest.approx(-0.04, abs=1e-3)
    assert shift[:, 1, 1].max() == pytest.approx(0.04, abs=1e-3)
    assert shift[:, 0, 1].max() <= 0.0 <= shift[:, 1, 1].min()
    crossing = np.zeros(len(time), dtype=bool)
    for step in steps:
        if step.obstacle >= 0:
            crossing |= (time > step.lift) & (time < step.land)
    np.testing.assert_allclose(shift[~crossing], 0.0, atol=1e-12)
    np.testing.assert_allclose(np.delete(shift, 1, axis=2), 0.0, atol=1e-12)
