"""A planned motion: its dynamics, its contacts, its feet, wherever it begins."""

import dataclasses
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.planned import Footstep, MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.motion import plan_motion, schedule
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.motion.step_timing import middle_zmp, stance_zmp

PARAMS = MotionPlannerParams()
PREVIEW = ZmpPreviewParams(com_height=0.85)
SOLE = JVRC1.sole
START = np.array([[0.39, 0.095, 0, 0, 0, 0], [0.39, -0.095, 0, 0, 0, 0]])
COM = np.array([0.425, 0.0, 0.85])
EDGES = np.array([[0.6, 0.0, 0.2], [0.87, 0.0, 0.4]])
NOTHING = np.zeros((0, 3))


def footstep(foot: Foot, x: float, z: float, turn: float = 0.0) -> Footstep:
    """A foot that stands level."""
    y = 0.095 if foot == "left" else -0.095
    R = RollPitchYaw(0.0, 0.0, turn).ToRotationMatrix()
    return Footstep(foot, RigidTransform(R, [x, y, z]), 0)


CLIMB = (
    footstep("right", 0.70, 0.2),
    footstep("left", 0.70, 0.2),
    footstep("right", 0.97, 0.4),
    footstep("left", 0.97, 0.4),
)
WALK = (footstep("right", 0.55, 0.0), footstep("left", 0.55, 0.0))

WALKER = Walker(PARAMS, PREVIEW, JVRC1)


@cache
def plan(name: str) -> MotionPlan:
    """From the start stance."""
    footsteps = {"climb": CLIMB, "walk": WALK, "stand": ()}[name]
    edges = EDGES if name == "climb" else NOTHING
    return plan_motion(MotionTask(START, COM, footsteps, edges), WALKER)


@pytest.fixture(params=["climb", "walk", "stand"])
def motion(request: pytest.FixtureRequest) -> MotionPlan:
    """Up two steps, one step ahead on the floor, and none."""
    return plan(request.param)


def toe_edge(poses: Vector) -> Vector:
    """Middle of the toe edge of each pose, (n, 3)."""
    return np.array(
        [
            RigidTransform(RollPitchYaw(pose[3:]), pose[:3]).multiply(
                np.array([SOLE.toe, 0.0, 0.0])
            )
            for pose in poses
        ]
    )


def test_zmp_is_that_of_the_com_motion(motion: MotionPlan) -> None:
    """Of a CoM of varying height: no moment about the horizontal axes at the ZMP."""
    arm = motion.com - motion.zmp
    force = motion.com_acceleration + np.array([0.0, 0.0, 9.81])
    moment = np.cross(arm, force)[:, :2]
    np.testing.assert_allclose(moment, 0.0, atol=1e-9)


def test_cart_zmp_is_that_of_a_cart_of_constant_height(motion: MotionPlan) -> None:
    """Kajita 2003, Eq. 4, of the same horizontal motion."""
    cart = motion.com[:, :2] - 0.85 / 9.81 * motion.com_acceleration[:, :2]
    np.testing.assert_allclose(motion.cart_zmp, cart, atol=1e-12)


def test_velocity_and_acceleration_are_the_derivatives(motion: MotionPlan) -> None:
    """By central differences."""
    inner = slice(2, -2)
    velocity = np.gradient(motion.com, motion.period, axis=0)
    acceleration = np.gradient(motion.com_velocity, motion.period, axis=0)
    np.testing.assert_allclose(motion.com_velocity[inner], velocity[inner], atol=2e-3)
    np.testing.assert_allclose(
        motion.com_acceleration[inner], acceleration[inner], atol=0.12
    )


def test_begins_where_the_robot_is_and_ends_at_rest(motion: MotionPlan) -> None:
    """Over the feet it ends on, at its height above the lower one."""
    np.testing.assert_allclose(motion.com[0], COM, atol=1e-9)
    np.testing.assert_array_equal(motion.foot_poses[0], START)
    for row in (0, -1):
        assert np.abs(motion.com_velocity[row]).max() < 0.01
    end = motion.foot_poses[-1]
    want = dict(zip(FEET, START, strict=True))
    for step in motion.footsteps:
        want[step.foot] = np.concatenate([step.X_WF.translation(), np.zeros(3)])
    np.testing.assert_allclose(end, [want[foot] for foot in FEET], atol=1e-12)
    middle = end[:, :2].mean(axis=0) + np.array([PARAMS.zmp_forward, 0.0])
    np.testing.assert_allclose(motion.com[-1, :2], middle, atol=2e-3)
    assert motion.com[-1, 2] == pytest.approx(end[:, 2].min() + 0.85)


def test_zmp_stays_on_the_stance(motion: MotionPlan) -> None:
    """On the sole in single support, between the soles in double support."""
    for phase in motion.phases:
        rows = slice(
            round(phase.start / motion.period) + 2, round(phase.end / motion.period) - 1
        )
        zmp, poses = motion.zmp[rows], motion.foot_poses[rows]
        if phase.swing is not None:
            pose = poses[:, FEET.index(phase.stance[0])]
            offset = zmp[:, :2] - pose[:, :2]
            assert (offset[:, 0] > -SOLE.heel).all()
            assert (offset[:, 0] < SOLE.toe).all()
            assert (np.abs(offset[:, 1]) < SOLE.half_width).all()
            np.testing.assert_allclose(zmp[:, 2], pose[:, 2], atol=1e-9)
        else:
            least, most = poses[:, :, 1].min(axis=1), poses[:, :, 1].max(axis=1)
            assert (zmp[:, 1] > least - SOLE.half_width).all()
            assert (zmp[:, 1] < most + SOLE.half_width).all()


def test_phases_follow_each_other_and_match_the_contacts(motion: MotionPlan) -> None:
    """Without gaps from the start to the end; a swing foot is the one in the air."""
    assert motion.phases[0].start == 0.0
    assert motion.phases[-1].end == pytest.approx(motion.duration)
    for before, after in pairwise(motion.phases):
        assert before.end == after.start
    for phase in motion.phases:
        row = round(0.5 * (phase.start + phase.end) / motion.period)
        want = [float(foot in phase.stance) for foot in FEET]
        assert motion.contacts[row].tolist() == want
        assert (phase.swing is None) == (len(phase.stance) == 2)
    assert len(motion.phases) == 2 * len(motion.footsteps) + 1


def test_feet_on_the_ground_stay_there(motion: MotionPlan) -> None:
    """Their toe edges do; heels may lift, and then a strip at the toes carries."""
    for i in range(2):
        poses = motion.foot_poses[:, i]
        down = (motion.contacts[:-1, i] > 0.5) & (motion.contacts[1:, i] > 0.5)
        toes = toe_edge(poses)
        moved = np.abs(np.diff(toes, axis=0))[down]
        assert moved.size == 0 or moved.max() < 1e-9
        pitched = (poses[:, 4] > 1e-6) & (motion.contacts[:, i] > 0.5)
        lengths = motion.contact_lengths[:, i]
        np.testing.assert_array_equal(lengths[pitched], PARAMS.toe_strip)
        flat = (motion.contacts[:, i] > 0.5) & (poses[:, 4] == 0.0)
        assert (lengths[flat] == SOLE.length).mean() > 0.98


def test_feet_move_without_jumps(motion: MotionPlan) -> None:
    """At speeds and accelerations that a leg can follow."""
    velocity = np.diff(motion.foot_poses, axis=0) / motion.period
    acceleration = np.diff(velocity, axis=0) / motion.period
    assert np.abs(velocity[..., :3]).max() < 2.5
    assert np.abs(velocity[..., 3:]).max() < 6.0
    assert np.abs(acceleration[..., :3]).max() < 60.0


def test_swinging_feet_clear_the_edges() -> None:
    """Both edges of the sole pass above every nosing, or beside it."""
    motion = plan("climb")
    for i in range(2):
        air = motion.contacts[:, i] < 0.5
        poses = motion.foot_poses[air, i]
        toes = toe_edge(poses)
        heels = poses[:, :3] - SOLE.heel / SOLE.toe * (toes - poses[:, :3])
        for edge in EDGES:
            over = (toes[:, 0] > edge[0]) & (heels[:, 0] < edge[0])
            share = (edge[0] - heels[over, 0]) / (toes[over, 0] - heels[over, 0])
            height = heels[over, 2] + share * (toes[over, 2] - heels[over, 2])
            resting = np.abs(height - edge[2]) < 1e-9
            assert (height[~resting] > edge[2]).all()
            assert over.any()


def test_rear_heel_lifts_only_where_the_leg_is_too_short() -> None:
    """While climbing, not on the floor; the ankle then comes within reach."""
    assert (plan("walk").foot_poses[..., 4] == 0.0).all()
    climb = plan("climb")
    rear = (climb.contacts[:, 0] > 0.5) & (climb.foot_poses[:, 0, 4] > 0.0)
    assert rear.any()
    assert climb.foot_poses[rear, 0, 4].max() <= PARAMS.max_toe_off
    lead = (climb.contacts[:, 1] > 0.5) & (climb.foot_poses[:, 1, 4] > 0.0)
    assert not lead.any()


def test_the_waist_leans_only_while_climbing() -> None:
    """Forward by the parameter in the middle, upright at both ends."""
    climb, walk = plan("climb"), plan("walk")
    assert climb.waist[len(climb.waist) // 2, 1] == pytest.approx(PARAMS.lean)
    for row in (0, -1):
        assert climb.waist[row, 1] == pytest.approx(0.0, abs=1e-9)
    assert not walk.waist.any()


@pytest.mark.parametrize("name", ["climb", "walk"])
def test_the_zmp_sets_off_and_arrives_without_a_jump(name: str) -> None:
    """By less than 5 mm in a tick; at both ends it rests under the CoM."""
    motion = plan(name)
    for zmp in (motion.zmp[:, :2], motion.cart_zmp):
        assert np.abs(np.diff(zmp, axis=0)).max() < 0.005
        np.testing.assert_allclose(zmp[[0, -1]], motion.com[[0, -1], :2], atol=1e-9)
    first = motion.phases[1]
    zmp = motion.zmp[round(first.start / motion.period)]
    wanted = stance_zmp(
        START[FEET.index(first.stance[0])],
        first.stance[0],
        PARAMS.climb_zmp_forward if name == "climb" else PARAMS.zmp_forward,
        PARAMS,
    )
    np.testing.assert_allclose(zmp[:2], wanted[:2], atol=0.003)


def test_a_climbing_foot_swings_inwards_under_a_raised_hip() -> None:
    """The right one to the left, the right hip up; in a walk neither."""
    climb, walk = plan("climb"), plan("walk")
    swing = next(phase for phase in climb.phases if phase.swing == "right")
    rows = slice(round(swing.start / climb.period), round(swing.end / climb.period) + 1)
    aside = climb.foot_poses[rows, 1, 1] - START[1, 1]
    assert aside.max() == pytest.approx(PARAMS.climb_inward, rel=1e-3)
    assert aside.min() > -1e-9
    np.testing.assert_allclose(climb.waist[rows, 0], -PARAMS.climb_roll)
    np.testing.assert_allclose(walk.foot_poses[:, 1, 1], START[1, 1], atol=1e-9)


def test_standing_is_a_plan_without_steps() -> None:
    """Nothing moves in it."""
    stand = plan("stand")
    assert stand.duration == pytest.approx(PARAMS.lead_in)
    np.testing.assert_allclose(stand.com_velocity, 0.0, atol=1e-9)
    assert (stand.foot_poses == START).all()
    assert (stand.contacts == 1.0).all()


def test_turning_the_world_turns_the_plan() -> None:
    """Everything about z, and moved, also upwards."""
    X = RigidTransform(RollPitchYaw(0.0, 0.0, 0.9), [2.0, -3.0, 0.15])
    turn = X.rotation().matrix()
    start = START.copy()
    for pose in start:
        pose[:3] = X.multiply(pose[:3])
        pose[5] += 0.9
    steps = tuple(
        dataclasses.replace(step, X_WF=X.multiply(step.X_WF)) for step in CLIMB
    )
    edges = np.array([X.multiply(edge) for edge in EDGES])
    there = plan_motion(MotionTask(start, X.multiply(COM), steps, edges), WALKER)
    here = plan("climb")
    np.testing.assert_allclose(there.com, [X.multiply(p) for p in here.com], atol=1e-6)
    np.testing.assert_allclose(there.zmp, [X.multiply(p) for p in here.zmp], atol=1e-6)
    np.testing.assert_allclose(
        there.com_acceleration, here.com_acceleration @ turn.T, atol=1e-4
    )
    np.testing.assert_allclose(
        there.foot_poses[..., :3].reshape(-1, 3),
        [X.multiply(p) for p in here.foot_poses[..., :3].reshape(-1, 3)],
        atol=1e-6,
    )
    turned = np.array([0.0, 0.0, 0.9])
    np.testing.assert_allclose(
        there.foot_poses[..., 3:], here.foot_poses[..., 3:] + turned, atol=1e-6
    )
    np.testing.assert_allclose(there.waist, here.waist + turned, atol=1e-6)


def test_schedule_gives_climbing_steps_their_own_times() -> None:
    """A foot that changes its own height climbs, wherever the other one is."""
    steps, end = schedule(START, (*WALK, footstep("right", 0.70, 0.2)), PARAMS)
    assert [step.climbs for step in steps] == [False, False, True]
    durations = [step.land - step.lift for step in steps]
    np.testing.assert_allclose(durations, [0.70, 0.70, 0.80])
    supports = [step.lift - step.push for step in steps]
    np.testing.assert_allclose(supports, [PARAMS.lead_in, 0.25, 0.25])
    assert end == pytest.approx(steps[-1].land + PARAMS.lead_out)
    np.testing.assert_array_equal(steps[1].stance, steps[0].end)
    np.testing.assert_array_equal(steps[2].start, steps[0].end)
    following, _ = schedule(START, CLIMB, PARAMS)
    assert following[1].lift - following[0].land == pytest.approx(0.50)


def test_com_height_rises_with_the_stance() -> None:
    """Monotonously up a staircase; never above what the higher foot allows."""
    motion = plan("climb")
    height = motion.com[:, 2]
    assert (np.diff(height) > -1e-12).all()
    assert height[-1] == pytest.approx(0.4 + PARAMS.com_height)
    highest = motion.foot_poses[..., 2].max(axis=1)
    assert (height <= highest + PARAMS.com_height + 1e-9).all()


@pytest.mark.parametrize(("foot", "side"), [("left", -1.0), ("right", 1.0)])
def test_zmp_in_single_support_is_ahead_and_towards_the_other_foot(
    foot: Foot, side: float
) -> None:
    """Seen in the foot, wherever it points; at its own height."""
    pose = np.array([1.0, 2.0, 0.3, 0.0, 0.0, 0.8])
    X_WF = RigidTransform(RollPitchYaw(pose[3:]), pose[:3])
    p_F = X_WF.inverse().multiply(stance_zmp(pose, foot, 0.06, PARAMS))
    np.testing.assert_allclose(p_F, [0.06, side * PARAMS.zmp_inward, 0.0], atol=1e-12)
    middle = middle_zmp(START + np.array([0, 0, 0.1, 0, 0, 0]), PARAMS)
    np.testing.assert_allclose(middle, [0.39 + PARAMS.zmp_forward, 0.0, 0.1])


def test_a_plan_that_ends_astride_keeps_to_the_lower_foot() -> None:
    """So that the rear leg still reaches the ground."""
    motion = plan_motion(MotionTask(START, COM, CLIMB[:1], EDGES), WALKER)
    assert motion.foot_poses[-1, :, 2].tolist() == [0.0, 0.2]
    assert motion.com[-1, 2] == pytest.approx(PARAMS.com_height)
