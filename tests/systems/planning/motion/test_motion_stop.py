"""Stopping early: the same motion until the cut, feet side by side, in balance."""

from functools import cache

import numpy as np
import pytest
from pydrake.math import RigidTransform

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.planned import Footstep, MotionPlan
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_stop import COMMITTED, stop_early
from footfall.systems.planning.motion.motion_task import MotionTask, Walker

PARAMS = MotionPlannerParams()
PREVIEW = ZmpPreviewParams(com_height=0.85, preview_time=2.4)
WIDTH = 0.19
START = np.array([[0.0, WIDTH / 2, 0, 0, 0, 0], [0.0, -WIDTH / 2, 0, 0, 0, 0]])
COM = np.array([0.035, 0.0, 0.85])
BEGIN = 7.0
WALKER = Walker(PARAMS, PREVIEW, JVRC1)


@cache
def walk() -> MotionPlan:
    """Ten steps of 25 cm straight ahead, begun at `BEGIN`."""
    steps = []
    for i in range(10):
        foot, y = (("right", -WIDTH / 2), ("left", WIDTH / 2))[i % 2]
        x = 0.25 * min(i + 1, 9)
        steps.append(Footstep(foot, RigidTransform([x, y, 0.0]), -1))
    plan = plan_motion(MotionTask(START, COM, tuple(steps)), WALKER)
    return plan.starting_at(BEGIN)


def stopped(time: float) -> MotionPlan | None:
    """The walk cut short at a time since its beginning."""
    return stop_early(walk(), BEGIN + time, WIDTH, WALKER)


@pytest.mark.parametrize("time", [0.5, 1.5, 3.0, 5.0])
def test_it_is_the_same_motion_until_now(time: float) -> None:
    """Feet bit for bit; the CoM to less than a millimetre, so that nothing jumps."""
    plan, shorter = walk(), stopped(time)
    assert shorter is not None
    assert shorter.start_time == plan.start_time
    assert shorter.duration < plan.duration - 0.5
    now = round(time / plan.period) + 1
    np.testing.assert_array_equal(shorter.foot_poses[:now], plan.foot_poses[:now])
    np.testing.assert_allclose(shorter.com[:now], plan.com[:now], atol=1e-3)
    np.testing.assert_allclose(
        shorter.com_velocity[:now], plan.com_velocity[:now], atol=6e-3
    )


@pytest.mark.parametrize("time", [0.5, 1.5, 3.0, 5.0])
def test_it_ends_standing_side_by_side(time: float) -> None:
    """At rest over the middle of the feet, whichever foot comes last."""
    shorter = stopped(time)
    assert shorter is not None
    left, right = shorter.foot_poses[-1]
    np.testing.assert_allclose(left[:3] - right[:3], [0.0, WIDTH, 0.0], atol=1e-9)
    assert np.abs(shorter.com_velocity[-1]).max() < 0.01
    middle = (left[:2] + right[:2]) / 2.0 + [PARAMS.zmp_forward, 0.0]
    np.testing.assert_allclose(shorter.com[-1, :2], middle, atol=2e-3)


def test_it_takes_few_more_steps() -> None:
    """Those the CoM moves for already, one to stop on and one beside it."""
    shorter = stopped(1.5)
    assert shorter is not None
    lands = [phase.end for phase in walk().phases if phase.swing is not None]
    within = sum(land < 1.5 + COMMITTED for land in lands)
    assert len(shorter.footsteps) == within + 2
    assert shorter.footsteps[: within + 1] == walk().footsteps[: within + 1]


def test_there_is_nothing_to_cut_near_the_end() -> None:
    """None where the walk is over as soon."""
    assert stopped(walk().duration - 2.0) is None
    assert stopped(walk().duration) is None
