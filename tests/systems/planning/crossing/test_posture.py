"""Waist and arms of a crossing: when they move, to which side and how far."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.feet import Foot, other_foot
from footfall.models.values.obstacle import KeyConfiguration
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import Repairs
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.crossing.posture import (
    arm_swing,
    straddling,
    third_order,
    waist_height,
    waist_rpy,
)
from footfall.systems.planning.crossing.timing import CrossingStep, time_steps
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from tests.systems.planning.crossing.crossing_cases import footstep, planned

PARAMS = CrossingParams(
    single_support=1.0, double_support=0.2, waist_yaw=0.3, arm_swing=0.5, lean=0.1
)
KEY = KeyConfiguration(X_ads=0.4, X_hds=0.2, Z_hds=0.7, front=0.2)
WALKING = 0.8


def _timed(lead: Foot = "left") -> tuple[tuple[CrossingStep, ...], Vector, Vector]:
    """One step up to the obstacle, two over it, one beyond; the time, the feet."""
    feet: Vector = np.zeros((2, 6))
    feet[:, 1] = [0.095, -0.095]
    steps, end = time_steps(
        feet,
        (
            footstep(other_foot(lead), 0.0),
            footstep(lead, 0.4, 0),
            footstep(other_foot(lead), 0.4, 0),
            footstep(lead, 0.5),
        ),
        MotionPlannerParams(),
        PARAMS,
    )
    return steps, np.arange(0.0, end, 0.01), feet


def _phases(steps: tuple[CrossingStep, ...], time: Vector) -> tuple[Vector, ...]:
    """Whether each moment lies before, in phase 2, and after the crossing."""
    lead, trail = (step for step in steps if step.obstacle == 0)
    return (
        time < lead.lift,
        (time > lead.land) & (time < trail.lift),
        time > trail.land,
    )


def test_third_order_is_level_at_both_ends() -> None:
    """Position and speed are given there (Sec. III-C1)."""
    u = np.linspace(-0.5, 1.5, 2001)
    blend = third_order(u)
    assert (blend[u <= 0.0] == 0.0).all()
    assert (blend[u >= 1.0] == 1.0).all()
    assert np.abs(np.gradient(blend, u)).max() == pytest.approx(1.5, abs=1e-3)
    assert np.abs(np.diff(blend, 2)).max() < 1e-4


def test_dynamically_it_comes_in_phase_1_and_goes_in_phase_3() -> None:
    """All of it while both feet are down."""
    steps, time, _ = _timed()
    before, middle, after = _phases(steps, time)
    shape = straddling(time, steps)
    assert not shape[before].any()
    np.testing.assert_allclose(shape[middle], 1.0)
    np.testing.assert_allclose(shape[after], 0.0, atol=1e-12)
    late = straddling(time, steps, "quasi_static")
    assert not late[before].any()
    assert late[middle].min() < 0.1
    assert late[middle].max() > 0.9
    assert late[time < steps[1].land].max() == 0.0


def test_the_waist_goes_down_to_the_key_and_back() -> None:
    """Lowered and raised by the repairs."""
    steps, time, _ = _timed()
    before, middle, after = _phases(steps, time)
    heights = {
        name: waist_height(time, steps, (KEY,), WALKING, 0.02, repairs, PARAMS)
        for name, repairs in (
            ("none", Repairs()),
            ("lowered", Repairs(lowered=0.03)),
            ("raised", Repairs(raised=0.04)),
        )
    }
    plain = heights["none"]
    np.testing.assert_allclose(plain[before], WALKING)
    np.testing.assert_allclose(plain[middle], 0.72)
    np.testing.assert_allclose(plain[after], WALKING)
    np.testing.assert_allclose(heights["lowered"][middle], 0.69)
    np.testing.assert_allclose(heights["raised"][middle], 0.72)
    assert (heights["raised"] - plain).max() == pytest.approx(0.04, abs=1e-3)
    # High as long as the foot is folded: only the last share of phase 1 lowers.
    lead = steps[1]
    early = (time > lead.lift) & (time < lead.lift + 0.39)
    np.testing.assert_allclose(plain[early], WALKING)


def test_a_quasi_static_key_takes_the_waist_to_its_end() -> None:
    """From Z_hds to Z_end while both feet carry."""
    steps, time, _ = _timed()
    _, middle, after = _phases(steps, time)
    key = replace(KEY, X_end=0.4, Z_end=0.76)
    height = waist_height(time, steps, (key,), WALKING, 0.0, Repairs(), PARAMS)
    assert height[middle][0] == pytest.approx(0.70, abs=2e-3)
    assert height[middle][-1] == pytest.approx(0.76, abs=2e-3)
    np.testing.assert_allclose(height[after], WALKING)


@pytest.mark.parametrize(("lead", "side"), [("right", 1.0), ("left", -1.0)])
def test_the_waist_turns_the_leading_hip_ahead(lead: Foot, side: float) -> None:
    """To the left for a right foot in front, and back."""
    steps, time, feet = _timed(lead)
    before, middle, after = _phases(steps, time)
    rpy = waist_rpy(time, steps, feet, PARAMS)
    np.testing.assert_allclose(rpy[before, 2], 0.0, atol=1e-12)
    np.testing.assert_allclose(rpy[middle, 2], side * PARAMS.waist_yaw)
    np.testing.assert_allclose(rpy[after, 2], 0.0, atol=1e-12)
    np.testing.assert_allclose(rpy[middle, 1], PARAMS.lean)


@pytest.mark.parametrize(("lead", "side"), [("left", 1.0), ("right", -1.0)])
def test_the_waist_raises_the_hip_of_the_foot_over_the_obstacle(
    lead: Foot, side: float
) -> None:
    """Left up is positive; level on the ground before, between and after."""
    steps, time, feet = _timed(lead)
    rpy = waist_rpy(time, steps, feet, PARAMS)
    for phase in _phases(steps, time):
        np.testing.assert_allclose(rpy[phase, 0], 0.0, atol=1e-12)
    for step, sign in zip(steps[1:3], (side, -side), strict=True):
        roll = sign * rpy[(time > step.lift) & (time < step.land), 0]
        assert roll.max() == pytest.approx(PARAMS.waist_roll, rel=1e-3)
        assert roll.min() > 0.0


def test_the_arms_swing_with_it() -> None:
    """To the rear for a positive swing."""
    steps, time, _ = _timed()
    _, middle, after = _phases(steps, time)
    arms = arm_swing(time, steps, PARAMS)
    np.testing.assert_allclose(arms[middle], 0.5)
    np.testing.assert_allclose(arms[after], 0.0, atol=1e-12)


def _straddle(**changed: float) -> tuple[float, float, float]:
    """Waist ahead of the CoM in phase 2, m; how far it was lowered; the legs' gap."""
    motion, _ = planned(0.05, 0.15, replace(CrossingParams(), **changed))
    curves = motion.report.curves
    assert curves is not None
    lift = [phase for phase in motion.phases if phase.swing][2].end
    row = round(lift / motion.period) + 20
    k = int(np.argmin(np.abs(curves.time - row * motion.period)))
    ahead = curves.waist[k, 0] - motion.com[row, 0]
    return float(ahead), motion.report.repairs.lowered, motion.report.gap


def test_arms_to_the_rear_bring_the_waist_forward() -> None:
    """Sec. III-D; the CoM stays where the ZMP wants it."""
    rest, back, forth = (_straddle(arm_swing=swing)[0] for swing in (0.0, 0.4, -0.4))
    assert back > rest + 0.01
    assert forth < rest - 0.01


def test_a_turned_waist_needs_less_lowering() -> None:
    """Sec. III-C3: both legs reach farther, at no cost in clearance."""
    _, straight, gap = _straddle(waist_yaw=0.0)
    _, turned, turned_gap = _straddle(waist_yaw=0.2)
    assert turned < straight
    assert turned_gap > gap - 1e-3


def test_validation() -> None:
    """Arms may swing either way, the waist's turn is a size."""
    replace(CrossingParams(), arm_swing=-0.5).validate()
    with pytest.raises(ValueError, match="waist_yaw"):
        replace(CrossingParams(), waist_yaw=-0.1).validate()
