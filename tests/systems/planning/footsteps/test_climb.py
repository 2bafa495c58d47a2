"""Where the feet come to stand on the treads of made-up staircases."""

import dataclasses
from math import radians

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.values.geometry import heading
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import plan_footsteps
from tests.systems.planning.footsteps.staircase_cases import (
    PARAMS,
    SOLE,
    check_steps,
    feet_at,
    rectangle,
    staircase,
)


def test_soles_stand_in_the_middle_of_the_treads_on_straight_lines() -> None:
    """Paper Sec. 6.1: x in the middle of the segment, y constant for each foot."""
    stairs = staircase([0.28, 0.30], [0.2, 0.18], yaw=0.4, origin=(1.0, -2.0, 0.5))
    feet = feet_at(0.4, (1.0, -2.0, 0.5), -0.2, 0.03, 0.0)
    plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
    X_WS = RigidTransform(RollPitchYaw(0.0, 0.0, 0.4), np.array([1.0, -2.0, 0.5]))
    ankle = (SOLE.toe - SOLE.heel) / 2.0
    expected = [
        ("right", [0.14 - ankle, -0.065, 0.2]),
        ("left", [0.14 - ankle, 0.125, 0.2]),
        ("right", [0.43 - ankle, -0.065, 0.38]),
        ("left", [0.43 - ankle, 0.125, 0.38]),
    ]
    for step, (foot, p_S) in zip(plan.footsteps, expected, strict=True):
        assert step.foot == foot
        p = X_WS.inverse().multiply(step.X_WF.translation())
        np.testing.assert_allclose(p, p_S, atol=1e-9)
        assert heading(step.X_WF) == pytest.approx(0.4)


def test_the_bias_shifts_footholds_until_the_margin() -> None:
    """A 28 cm tread leaves 1.25 cm either way."""
    stairs = staircase([0.28], [0.2])
    feet = feet_at(0.0, (0, 0, 0), -0.2, 0.0, 0.0)
    middle = 0.14 - (SOLE.toe - SOLE.heel) / 2.0
    for bias, shift in ((0.01, 0.01), (-0.01, -0.01), (0.05, 0.0125), (-0.05, -0.0125)):
        params = FootstepPlannerParams(foothold_bias=bias)
        plan = plan_footsteps(stairs, *feet, params, SOLE)
        x = [step.X_WF.translation()[0] for step in plan.footsteps]
        np.testing.assert_allclose(x, middle + shift, atol=1e-9)


def test_a_shallow_tread_costs_the_heel_its_margin_then_an_overhang() -> None:
    """The sole and the margin at the riser take 24 cm."""
    feet = feet_at(0.0, (0, 0, 0), -0.2, 0.0, 0.0)
    for run, overhang, status in (
        (0.245, 0.0, "planned"),
        (0.235, 0.0, "infeasible"),
        (0.235, 0.01, "planned"),
        (0.225, 0.01, "infeasible"),
    ):
        params = FootstepPlannerParams(foothold_bias=0.0, max_heel_overhang=overhang)
        stairs = staircase([run], [0.2])
        plan = plan_footsteps(stairs, *feet, params, SOLE)
        assert plan.status == status, (run, overhang)
        if status == "planned":
            check_steps(plan, stairs, feet, params)


def test_a_tread_that_hangs_over_keeps_the_toes_out() -> None:
    """The toes stay before the next tread's front edge, not before the own back one."""
    lower = rectangle(RigidTransform([0.16, 0.0, 0.2]), 0.32, 0.8)
    upper = rectangle(RigidTransform([0.41, 0.0, 0.4]), 0.30, 0.8)
    stairs = staircase([0.3], [0.2])
    stairs = dataclasses.replace(stairs, treads=(lower, upper))
    feet = feet_at(0.0, (0, 0, 0), -0.2, 0.0, 0.0)
    params = FootstepPlannerParams(foothold_bias=0.05)
    plan = plan_footsteps(stairs, *feet, params, SOLE)
    toes = plan.footsteps[0].X_WF.translation()[0] + SOLE.toe
    assert toes == pytest.approx(0.26 - params.edge_margin)


def test_a_tread_within_three_degrees_gets_level_soles_a_steeper_one_does_not() -> None:
    """Either way the middle of the sole lies in the plane."""
    feet = feet_at(0.0, (0, 0, 0), -0.2, 0.0, 0.0)
    for slope, level in ((2.0, True), (6.0, False)):
        X_WR = RigidTransform(
            RollPitchYaw(0.0, -radians(slope), 0.0), np.array([0.15, 0.0, 0.2])
        )
        tread = rectangle(X_WR, 0.30, 0.8)
        stairs = dataclasses.replace(staircase([0.3], [0.2]), treads=(tread,))
        plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
        for step in plan.footsteps:
            z_W = step.X_WF.rotation().matrix()[:, 2]
            np.testing.assert_allclose(
                z_W, [0.0, 0.0, 1.0] if level else tread.normal, atol=1e-9
            )
            middle = step.X_WF.multiply([(SOLE.toe - SOLE.heel) / 2.0, 0.0, 0.0])
            assert X_WR.inverse().multiply(middle)[2] == pytest.approx(0.0, abs=1e-9)


def test_the_tread_under_the_feet_may_be_hidden() -> None:
    """On tread 1, which the robot's own legs hide from the sensor."""
    stairs = staircase([0.28] * 3, [0.2] * 3)
    stairs = dataclasses.replace(stairs, treads=stairs.treads[1:])
    feet = feet_at(0.0, (0, 0, 0), 0.1025, 0.0, 0.0, z=0.2)
    for floor in (stairs.floor, None):
        seen = dataclasses.replace(stairs, floor=floor)
        plan = plan_footsteps(seen, *feet, PARAMS, SOLE)
        check_steps(plan, seen, feet)
        assert [step.plane for step in plan.footsteps] == [0, 0, 1, 1]


def test_a_second_tread_seen_in_part_is_left_to_the_next_scan() -> None:
    """It is too shallow now, the first one is not."""
    stairs = staircase([0.28, 0.15], [0.2, 0.2])
    feet = feet_at(0.0, (0, 0, 0), -0.2, 0.0, 0.0)
    plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
    assert [step.plane for step in plan.footsteps] == [0, 0]
