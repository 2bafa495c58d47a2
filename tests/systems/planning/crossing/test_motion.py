"""Algorithm 1 as a whole, without physics."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.feet import FEET
from footfall.systems.planning.crossing import crossing_problem
from footfall.systems.planning.crossing.feasibility_unit import FeasibilityParams
from footfall.systems.planning.crossing.feet_adaptor import ankle_displacement
from footfall.systems.planning.crossing.foot_trajectory_generator import (
    FootTrajectoryParams,
)
from footfall.systems.planning.crossing.params import CrossingParams, ways_of_crossing
from footfall.systems.planning.crossing.report import CrossingMotion, refusal_of
from footfall.systems.planning.whole_body.leg_model import LegModel
from tests.systems.planning.crossing.crossing_cases import body, planned


@pytest.fixture(scope="module")
def motion() -> CrossingMotion:
    """Over 15 x 5 cm."""
    return planned(0.05, 0.15)[0]


def test_margins_and_reach(motion: CrossingMotion) -> None:
    """The legs keep more than 3 cm off the obstacle and reach their feet."""
    assert motion.report.gap > 0.035
    assert motion.report.short == 0.0


def test_the_filter_brings_the_zmp_five_times_nearer(motion: CrossingMotion) -> None:
    """CWTG2 against CWTG1, along and across."""
    before, after = motion.report.zmp_error_before, motion.report.zmp_error_after
    assert after[0] < before[0] / 5.0
    assert after[1] < before[1] / 5.0


def test_the_curves_show_the_zmp_of_both_stages(motion: CrossingMotion) -> None:
    """Their distance to the reference in phases 1 to 3 is what the report states."""
    report, curves = motion.report, motion.report.curves
    assert curves is not None
    assert curves.waist.shape == (len(curves.time), 3)
    ((begin, end),) = report.phases
    rows = np.round(curves.time / motion.period).astype(int)
    inside = (curves.time > begin) & (curves.time < end)
    for zmp, worst in (
        (curves.zmp_cwtg1, report.zmp_error_before),
        (curves.zmp_cwtg2, report.zmp_error_after),
    ):
        error = np.abs(zmp - motion.zmp[rows, :2])[inside].max(axis=0)
        assert np.all(error <= np.array(worst) + 1e-9)
        assert error[0] > 0.8 * worst[0]


def test_the_phases_take_less_than_four_seconds(motion: CrossingMotion) -> None:
    """1 to 3, as the paper counts."""
    ((begin, end),) = motion.report.phases
    assert 0.0 < end - begin < 4.0
    assert end < motion.duration


def test_the_motion_is_smooth_and_ends_at_rest(motion: CrossingMotion) -> None:
    """No jump of CoM or feet."""
    assert np.abs(np.diff(motion.com, axis=0)).max() < 0.01
    assert np.abs(np.diff(motion.foot_poses, axis=0)).max() < 0.03
    assert np.abs(motion.com_velocity[[0, -1]]).max() < 0.01
    rate = np.gradient(motion.com, motion.period, axis=0)
    np.testing.assert_allclose(rate[5:-5], motion.com_velocity[5:-5], atol=0.02)


def test_the_adaptor_repairs_what_the_key_configuration_leaves() -> None:
    """A high obstacle: without repairs a leg is over-stretched in phase 2."""
    params = CrossingParams(
        single_support=1.5,
        double_support=0.14,
        lean=0.1,
        knee_margin=0.15,
        waist_yaw=0.0,
        feet=FootTrajectoryParams(lead_pitch=0.2, trail_pitch=0.6, over_share=0.9),
    )
    bare = planned(0.05, 0.24, replace(params, max_repairs=0))[0].report
    repaired = planned(0.05, 0.24, params)[0].report
    assert repaired.repairs != bare.repairs
    assert bare.short > 0.005
    assert repaired.short == 0.0
    assert repaired.gap > 0.03


def test_the_ankle_yields_as_the_jacobians_say() -> None:
    """Eq. 25: a point half-way down the shin moves less than the ankle."""
    leg: LegModel = body().leg
    angles = np.array([-0.8, 0.0, 0.0, 1.4, 0.0, -0.6])
    at_ankle = ankle_displacement(leg, "left", angles, leg.shank, 0.01)
    half_way = ankle_displacement(leg, "left", angles, 0.5 * leg.shank, 0.01)
    assert at_ankle == pytest.approx(0.01, abs=1e-6)
    assert 0.0 < half_way < 0.03
    assert half_way != pytest.approx(at_ankle, abs=1e-4)


def test_contacts_are_those_of_the_phases(motion: CrossingMotion) -> None:
    """A foot is off the ground from its lift to its landing, and only then."""
    time = np.arange(len(motion.contacts)) * motion.period
    for phase in motion.phases:
        inside = (time > phase.start + 0.01) & (time < phase.end - 0.01)
        want = [1.0 if foot in phase.stance else 0.0 for foot in FEET]
        np.testing.assert_array_equal(
            motion.contacts[inside], np.tile(want, (inside.sum(), 1))
        )
    for i in range(2):
        moves = np.abs(np.diff(motion.foot_poses[:, i], axis=0)).max(axis=1) > 1e-9
        assert not motion.contacts[:-1, i][moves].any()


def test_speeds_accelerations_and_the_carts_zmp_belong_to_the_com(
    motion: CrossingMotion,
) -> None:
    """One motion, said in four ways."""
    rate = np.gradient(motion.com_velocity, motion.period, axis=0)
    np.testing.assert_allclose(
        rate[5:-5, :2], motion.com_acceleration[5:-5, :2], atol=0.08
    )
    np.testing.assert_allclose(
        rate[5:-5, 2], motion.com_acceleration[5:-5, 2], atol=0.3
    )
    assert np.abs(motion.com_acceleration[:, 2]).max() > 0.3
    cart = motion.com[:, :2] - 0.85 / 9.81 * motion.com_acceleration[:, :2]
    np.testing.assert_allclose(motion.cart_zmp, cart, atol=1e-12)


def test_the_arms_swing_in_the_plan() -> None:
    """As the robot is to carry it out."""
    plan = planned(0.05, 0.15, CrossingParams(arm_swing=-0.3))[0]
    assert plan.arms.shape == (len(plan.zmp),)
    assert plan.arms.min() == pytest.approx(-0.3)
    assert plan.arms[0] == 0.0
    assert abs(plan.arms[-1]) < 1e-9


def test_fta_keeps_the_margins_beyond_the_true_obstacle() -> None:
    """Those that it is given, over a high obstacle that needs every repair."""
    params = CrossingParams(
        single_support=1.5,
        double_support=0.14,
        lean=0.1,
        knee_margin=0.15,
        feet=FootTrajectoryParams(lead_pitch=0.2, trail_pitch=0.6, over_share=0.9),
    )
    wide, narrow = (
        planned(
            0.05,
            0.25,
            replace(params, feasibility=FeasibilityParams(s_w=margin, s_h=margin)),
        )[0].report
        for margin in (0.03, 0.005)
    )
    assert wide.gap > 0.03
    assert 0.005 < narrow.gap < 0.03


def test_the_com_sets_off_and_arrives_without_a_jump(motion: CrossingMotion) -> None:
    """Of its ZMP by more than 5 mm in a tick, in the lead-in's first 3/4 and the end.

    Where a foot lifts the waist takes off at once, and the ZMP with it.
    """
    jumps = np.abs(np.diff(motion.cart_zmp, axis=0)).max(axis=1)
    assert jumps[:120].max() < 0.005
    assert jumps[-120:].max() < 0.005


def test_a_knee_that_folds_too_far_raises_the_waist() -> None:
    """The second repair: as far as the stance leg reaches."""
    free = planned(0.05, 0.20, CrossingParams(fold_margin=0.0))[0]
    tight = planned(0.05, 0.20, CrossingParams(fold_margin=0.4))[0]
    assert free.report.repairs.raised == 0.0
    assert tight.report.repairs.raised > 0.0
    assert tight.com[:, 2].max() > free.com[:, 2].max()


def test_the_plan_stays_within_torque_and_joint_limits(motion: CrossingMotion) -> None:
    """And says what comes nearest to them."""
    report = motion.report
    assert 0.5 < report.torque_share < 1.0
    assert report.torque_joint.endswith("KNEE")
    assert report.limit_distance > 0.05
    assert report.limit_joint in {
        name for joints in body().robot.leg_joints.values() for name in joints
    }


def test_a_foot_that_is_not_drawn_in_rolls_the_hip_beyond_its_limit() -> None:
    """Over 25 cm, in the way for high obstacles."""
    params = ways_of_crossing(CrossingParams())[-1]
    drawn, hanging = (
        planned(0.05, 0.25, replace(params, inward=inward))[0].report
        for inward in (params.inward, 0.0)
    )
    assert drawn.limit_distance > 0.02
    assert hanging.limit_distance < 0.0
    assert hanging.limit_joint.endswith("HIP_R")


def test_the_third_repair_acts_where_the_others_do_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Over a thin high slat the second shin is less deep in the margin for it.

    With the pelvis level and the foot hardly drawn in: raised hips leave it nothing.
    """
    level = CrossingParams(inward=0.03, waist_roll=0.0)
    yielding, _ = planned(0.024, 0.291, level)
    path = yielding.report.repairs.path
    assert path.size
    assert path.min() < -0.005
    assert path.max() <= 0.0
    monkeypatch.setattr(crossing_problem, "yielding_path", lambda *_: None)
    stiff, _ = planned(0.024, 0.291, level)
    assert not stiff.report.repairs.path.size
    assert yielding.report.repairs.shift == stiff.report.repairs.shift
    assert yielding.report.repairs.raised == stiff.report.repairs.raised
    assert yielding.report.gap > stiff.report.gap + 0.003


def test_a_thigh_that_meets_the_pelvis_is_refused(motion: CrossingMotion) -> None:
    """With both names; the crossing as it is keeps them apart."""
    params = CrossingParams()
    assert motion.report.self_distance > params.min_self_distance
    straight = CrossingParams(inward=0.0, waist_roll=0.0)
    meeting, _ = planned(0.05, 0.15, straight)
    assert meeting.report.self_distance < 0.0
    assert meeting.report.self_bodies == ("PELVIS_S", "R_HIP_Y_S")
    assert "PELVIS_S and R_HIP_Y_S come within -" in refusal_of(
        meeting.report, straight
    )
