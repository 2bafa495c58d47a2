"""The quasi-static crossing as a whole, without physics."""

import numpy as np
import pytest

from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.balance.convex_polygon import signed_margin
from footfall.systems.planning.crossing.params import CrossingParams, slowed
from footfall.systems.planning.crossing.quasi_static_check import worst_torque
from footfall.systems.planning.crossing.report import CrossingMotion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.whole_body.whole_body_plan import body_motion
from tests.systems.planning.crossing.crossing_cases import body, planned, scratch


@pytest.fixture(scope="module")
def motion() -> CrossingMotion:
    """Over 15 x 5 cm."""
    return planned(0.05, 0.15, mode="quasi_static")[0]


def test_the_com_is_always_over_what_stands(motion: CrossingMotion) -> None:
    """Checked in single support by the sole's own corners, at every row."""
    sole = body().robot.sole
    corners = np.array(
        [[-sole.heel, -1], [sole.toe, -1], [sole.toe, 1], [-sole.heel, 1]], dtype=float
    )
    corners[:, 1] *= sole.half_width
    least = np.inf
    for phase in motion.phases:
        if phase.swing is None:
            continue
        i = FEET.index(phase.stance[0])
        first, last = (round(t / motion.period) for t in (phase.start, phase.end))
        for row in range(first, last + 1, 5):
            polygon = corners + motion.foot_poses[row, i, :2]
            least = min(least, signed_margin(polygon, motion.com[row, :2]))
    assert least > 0.015
    assert motion.report.balance is not None
    assert motion.report.balance.margin == pytest.approx(least, abs=3e-3)


def test_standing_is_within_the_effort_limits(motion: CrossingMotion) -> None:
    """The knees carry most."""
    balance = motion.report.balance
    assert balance is not None
    assert 0.5 < balance.torque_share < 0.95
    assert balance.joint.endswith("KNEE")


def test_one_leg_alone_carries_more_than_with_the_other() -> None:
    """The same posture, the CoM over the left foot, with and without the right one."""
    feet: Vector = np.zeros((1, 2, 6))
    feet[:, 0, 1], feet[:, 1, 1] = 0.095, -0.095
    stand = body_motion(
        body(),
        np.array([[0.03, 0.05]]),
        np.array([0.70]),
        np.zeros((1, 3)),
        feet,
        0.0,
        rounds=5,
    )
    shares = [
        worst_torque(body(), scratch(), stand.q, feet, np.array([contacts]), 0.6)
        for contacts in ([1.0, 1.0], [1.0, 0.0])
    ]
    assert shares[1][0] > shares[0][0] + 0.1
    assert shares[0][1].startswith("L_")
    assert shares[1][2] == 0


def test_margins_and_reach(motion: CrossingMotion) -> None:
    """As dynamically: more than 3 cm off the obstacle, and the feet are reached."""
    assert motion.report.gap > 0.033
    assert motion.report.short < 0.003


def test_it_is_slow(motion: CrossingMotion) -> None:
    """The ZMP of the whole body stays within 2.5 cm of the CoM's projection."""
    assert motion.report.curves is not None
    curves = motion.report.curves
    rows = np.round(curves.time / motion.period).astype(int)
    apart = np.abs(curves.zmp_cwtg2 - motion.com[rows, :2])
    assert apart.max() < 0.025
    ((begin, end),) = motion.report.phases
    pace = CrossingParams().quasi_static
    assert end - begin == pytest.approx(2.0 * pace.single_support + pace.double_support)


def test_lean_and_arms_come_while_both_feet_carry(motion: CrossingMotion) -> None:
    """Nothing in phase 1, all as phase 3 begins, nothing after it."""
    pace = CrossingParams().quasi_static
    ((begin, end),) = motion.report.phases
    middle = begin + pace.single_support
    at = {
        name: round(t / motion.period)
        for name, t in (
            ("phase 2", middle),
            ("phase 3", middle + pace.double_support),
            ("after", end),
        )
    }
    for curve, most in ((motion.waist[:, 1], pace.lean), (motion.arms, -pace.arms)):
        assert curve[: at["phase 2"]] == pytest.approx(0.0)
        assert curve[at["phase 3"]] == pytest.approx(most)
        assert curve[at["after"] :] == pytest.approx(0.0)


def test_the_pace_is_that_of_its_parameters() -> None:
    """Everything that has a duration or a place of the CoM."""
    walking, crossing = slowed(MotionPlannerParams(), CrossingParams())
    pace = crossing.quasi_static
    assert walking.double_support == walking.lead_in == pace.walk_double_support
    assert walking.single_support == pace.walk_single_support
    assert crossing.zmp_forward == pace.com_end
    assert crossing.zmp_forward + crossing.zmp_rolling == pytest.approx(pace.com_begin)
    assert (crossing.lean, crossing.arm_swing) == (pace.lean, -pace.arms)
