"""A walk whose whole body, not a single mass, has its ZMP where it is wanted."""

from functools import cache

import numpy as np
import pytest
from pydrake.math import RigidTransform

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.planned import Footstep, MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion import motion
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_stop import stop_early
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.whole_body.whole_body_plan import (
    body_motion,
    body_zmp,
    waist_above_com,
)
from tests.systems.planning.crossing.crossing_cases import body

PARAMS = MotionPlannerParams()
PREVIEW = ZmpPreviewParams(com_height=0.85)
FEET: Vector = np.zeros((2, 6))
FEET[:, 1] = [0.095, -0.095]
COM = np.array([0.035, 0.0, 0.85])


@cache
def walk(whole: bool) -> MotionPlan:
    """Eight steps of 30 cm straight ahead, and one that brings the feet together."""
    steps = []
    for i in range(9):
        foot, y = (("right", -0.095), ("left", 0.095))[i % 2]
        x = 0.3 * min(i + 1, 8)
        steps.append(Footstep(foot, RigidTransform([x, y, 0.0]), -1))
    walker = Walker(PARAMS, PREVIEW, JVRC1, body() if whole else None)
    return plan_motion(MotionTask(FEET, COM, tuple(steps)), walker)


def zmp_error(plan: MotionPlan) -> Vector:
    """Of the whole body along a plan, looked at every 10 ms, (n, 2), m."""
    rows = np.arange(0, len(plan.zmp), 2)
    motion = body_motion(
        body(),
        plan.com[rows, :2],
        plan.com[rows, 2] + waist_above_com(body()),
        plan.waist[rows],
        plan.foot_poses[rows],
        0.0,
    )
    p_MB = body_zmp(body(), motion.q, plan.zmp[rows, 2], 0.01)
    return np.abs(p_MB - plan.zmp[rows, :2])


def test_the_zmp_of_the_whole_body_comes_nearer() -> None:
    """By a factor of four on the average, of two at its worst moment."""
    before, after = zmp_error(walk(False)), zmp_error(walk(True))
    assert before[:, 0].max() > 0.04
    assert (after.mean(axis=0) < before.mean(axis=0) / 4.0).all()
    assert after.max() < before.max() / 2.0


def as_high_as_ever(monkeypatch: pytest.MonkeyPatch) -> MotionPlan:
    """The walk with the CoM at its height even where that stretches a knee."""
    monkeypatch.setattr(motion, "height_excess", lambda *args: np.zeros(1))
    return walk.__wrapped__(True)


def test_nothing_but_the_com_moves_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the same start, to rest at the end; where no knee asks for less height."""
    before, after = walk(False), as_high_as_ever(monkeypatch)
    np.testing.assert_array_equal(after.foot_poses, before.foot_poses)
    np.testing.assert_array_equal(after.zmp, before.zmp)
    np.testing.assert_allclose(after.com[0], COM, atol=1e-9)
    assert np.abs(after.com[:, :2] - before.com[:, :2]).max() > 0.005
    np.testing.assert_array_equal(after.com[:, 2], before.com[:, 2])
    assert np.abs(after.com_velocity[-1]).max() < 1e-3
    rate = np.gradient(after.com[:, :2], after.period, axis=0)
    np.testing.assert_allclose(after.com_velocity[1:-1, :2], rate[1:-1], atol=2e-3)


def test_bent_knees_keep_the_zmp_from_jumping(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without, that of the whole body is off by three times as much at its worst."""
    low = zmp_error(walk(True))
    high = zmp_error(as_high_as_ever(monkeypatch))
    assert low.max() < 0.03
    assert high.max() > 3.0 * low.max()


@pytest.mark.parametrize("time", [1.5, 3.0])
def test_a_walk_that_is_cut_short_goes_on_without_a_jump(time: float) -> None:
    """The shorter plan, too, is that of the whole body."""
    plan = walk(True)
    shorter = stop_early(plan, time, 0.19, Walker(PARAMS, PREVIEW, JVRC1, body()))
    assert shorter is not None
    now = round(time / plan.period) + 1
    np.testing.assert_allclose(shorter.com[:now], plan.com[:now], atol=1.5e-3)
