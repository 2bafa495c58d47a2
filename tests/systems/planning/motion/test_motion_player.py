"""Playing a motion plan: the row that is due, its rates, and its ends."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RollPitchYaw
from pydrake.systems.framework import Context

from footfall.models.values.planned import MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.motion_player import (
    MotionPlayer,
    footholds,
    plan_row,
)
from footfall.systems.ports import eval_vector

ROWS = 5


def numbered(start_time: float = 2.0) -> MotionPlan:
    """A plan of five rows in which every number is different."""
    count = iter(range(1000))

    def numbers(*shape: int) -> Vector:
        size = int(np.prod(shape))
        return np.array([next(count) for _ in range(size)], dtype=float).reshape(shape)

    return MotionPlan(
        start_time=start_time,
        period=0.005,
        footsteps=(),
        phases=(),
        contacts=numbers(ROWS, 2),
        foot_poses=numbers(ROWS, 2, 6) ** 2,
        contact_lengths=numbers(ROWS, 2),
        com=numbers(ROWS, 3),
        com_velocity=numbers(ROWS, 3),
        com_acceleration=numbers(ROWS, 3),
        zmp=numbers(ROWS, 3),
        cart_zmp=numbers(ROWS, 2),
        waist=numbers(ROWS, 3) ** 2,
        arms=numbers(ROWS) ** 2,
    )


PLAN = numbered()


def at(time: float, plan: MotionPlan = PLAN) -> tuple[MotionPlayer, Context]:
    """A player of that plan at a time, with three ticks of preview."""
    system = MotionPlayer(3)
    context = system.CreateDefaultContext()
    context.SetTime(time)
    system.GetInputPort("motion_plan").FixValue(context, AbstractValue.Make(plan))
    return system, context


def output(time: float, name: str) -> Vector:
    """A port's value at a time."""
    system, context = at(time)
    return eval_vector(system.GetOutputPort(name), context)


@pytest.mark.parametrize(
    ("time", "row"),
    [(-1.0, 0), (2.0, 0), (2.0049, 0), (2.005, 1), (2.012, 2), (2.02, 4), (9.0, 4)],
)
def test_the_row_that_is_due(time: float, row: int) -> None:
    """The first before the start, the last after the end."""
    assert plan_row(PLAN, time) == row
    np.testing.assert_array_equal(output(time, "zmp"), PLAN.zmp[row])


def test_ticks_of_a_simulation_meet_every_row() -> None:
    """Times that are sums of a period, a little early or late by rounding."""
    long = numbered(start_time=6.35)
    rows = [plan_row(long, 6.35 + k * 0.005) for k in range(ROWS)]
    assert rows == list(range(ROWS))
    rows = [plan_row(numbered(0.7), k * 0.005) for k in range(140, 140 + ROWS)]
    assert rows == list(range(ROWS))


def test_outputs_are_the_row() -> None:
    """Each of its port, in the order the docstring says."""
    row, time = 2, 2.011
    for name, want in (
        ("contacts", [*PLAN.contacts[row], *PLAN.contact_lengths[row]]),
        (
            "com_height",
            [
                PLAN.com[row, 2],
                PLAN.com_velocity[row, 2],
                PLAN.com_acceleration[row, 2],
            ],
        ),
        ("zmp", PLAN.zmp[row]),
        ("plan_start", [2.0]),
    ):
        np.testing.assert_array_equal(output(time, name), want)


def test_rates_are_towards_the_following_row() -> None:
    """Of feet and waist; zero at the end, where the last row is held."""
    feet = output(2.011, "foot_references")
    np.testing.assert_array_equal(feet[:12], PLAN.foot_poses[2].ravel())
    rate = (PLAN.foot_poses[3] - PLAN.foot_poses[2]) / 0.005
    np.testing.assert_allclose(feet[12:], rate.ravel())
    waist = output(2.011, "waist")
    np.testing.assert_array_equal(waist[:3], PLAN.waist[2])
    np.testing.assert_allclose(waist[3:], (PLAN.waist[3] - PLAN.waist[2]) / 0.005)
    assert not output(5.0, "foot_references")[12:].any()
    assert not output(5.0, "waist")[3:].any()


def test_arms_swing_as_planned_and_rest_where_nothing_is_planned() -> None:
    """Pitch and its rate; a plan without them leaves the arms at their posture."""
    arms = output(2.011, "arms")
    assert arms[0] == PLAN.arms[2]
    assert arms[1] == pytest.approx((PLAN.arms[3] - PLAN.arms[2]) / 0.005)
    assert output(5.0, "arms")[1] == 0.0
    system, context = at(2.011, replace(PLAN, arms=np.zeros(0)))
    assert not eval_vector(system.GetOutputPort("arms"), context).any()


def test_preview_looks_ahead_and_holds_the_end() -> None:
    """First all x, then all y."""
    xs, ys = PLAN.cart_zmp.T
    want = np.concatenate([xs[[1, 2, 3, 4]], ys[[1, 2, 3, 4]]])
    np.testing.assert_array_equal(output(2.006, "zmp_preview"), want)
    want = np.concatenate([xs[[3, 4, 4, 4]], ys[[3, 4, 4, 4]]])
    np.testing.assert_array_equal(output(2.016, "zmp_preview"), want)


def test_a_new_plan_is_played() -> None:
    """From its own start."""
    system, context = at(2.011)
    port = system.GetOutputPort("zmp")
    before = eval_vector(port, context)
    later = numbered(start_time=2.01)
    system.GetInputPort("motion_plan").FixValue(context, AbstractValue.Make(later))
    np.testing.assert_array_equal(eval_vector(port, context), later.zmp[0])
    assert (eval_vector(port, context) != before).all()
    start = eval_vector(system.GetOutputPort("plan_start"), context)
    assert start[0] == 2.01


def test_a_horizon_of_nothing_is_refused() -> None:
    """With what it got."""
    with pytest.raises(ValueError, match="horizon must be at least 1 tick, got 0"):
        MotionPlayer(0)


def test_footholds_are_planes_of_soles_that_lie() -> None:
    """Normal and distance; nothing of a foot that moves, is up, or on its toes."""
    poses = np.zeros((4, 2, 6))
    poses[:, 0] = [0.3, 0.1, 0.2, 0.0, 0.1, 0.5]
    poses[:, 1] = [0.5, -0.1, 0.4, 0.0, 0.0, 0.0]
    poses[2, 1, 4] = 0.3
    contacts, lengths = np.ones((4, 2)), np.full((4, 2), 0.225)
    contacts[0, 1] = 0.0
    lengths[3, 1] = 0.01
    plan = replace(
        numbered(0.0),
        foot_poses=poses[[0, 1, 2, 3, 3]],
        contacts=contacts[[0, 1, 2, 3, 3]],
        contact_lengths=lengths[[0, 1, 2, 3, 3]],
    )
    rotation = RollPitchYaw(0.0, 0.1, 0.5).ToRotationMatrix()
    normal = rotation.matrix()[:, 2]
    for row in range(4):
        left, right = footholds(plan, row).reshape(2, 4)
        np.testing.assert_allclose(left[:3], normal)
        assert left[3] == pytest.approx(normal @ [0.3, 0.1, 0.2])
        assert not right.any()
    still = replace(plan, contacts=np.ones((5, 2)), contact_lengths=np.ones((5, 2)))
    assert footholds(still, 4)[4:].tolist() == [0.0, 0.0, 1.0, 0.4]
