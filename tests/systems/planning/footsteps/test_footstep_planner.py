"""The footstep planner on made-up estimates of staircases: the way up, from afar."""

import dataclasses
from math import radians

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.common.yaml import yaml_dump_typed, yaml_load_typed
from pydrake.math import RollPitchYaw

from footfall.models.values.planned import FootstepPlan
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import (
    FootstepPlanner,
    plan_footsteps,
)
from footfall.systems.ports import eval_abstract
from tests.systems.planning.footsteps.staircase_cases import (
    PARAMS,
    SOLE,
    check_steps,
    feet_at,
    staircase,
)


@pytest.mark.parametrize("seed", range(60))
def test_a_random_staircase_is_climbed_to_the_top(seed: int) -> None:
    """Plan by plan, within all limits, and the same plan for the same inputs."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 7))
    run = rng.uniform(0.265, 0.31)
    yaw = rng.uniform(-np.pi, np.pi)
    origin = tuple(rng.uniform(-3.0, 3.0, 3))
    stairs = staircase(
        [run] * n,
        list(rng.uniform(0.08, 0.24, n)),
        width=rng.uniform(0.5, 1.3),
        yaw=yaw,
        origin=origin,
        noise=0.005,
        turn_noise=radians(1.0),
        rng=rng,
    )
    turn = radians(rng.uniform(-15.0, 15.0))
    x, y = -rng.uniform(0.3, 1.5) - SOLE.toe, rng.uniform(-0.15, 0.15)
    feet = feet_at(yaw, origin, x, y, turn)
    on = -1
    for _ in range(8):
        plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
        again = plan_footsteps(stairs, *feet, PARAMS, SOLE)
        assert plan == again
        if plan.status == "finished":
            break
        check_steps(plan, stairs, feet)
        planes = [step.plane for step in plan.footsteps]
        climbed = [plane for plane in planes if plane >= 0]
        want = range(on + 1, min(on + 1 + PARAMS.steps_between_scans, n))
        assert climbed in ([], [i for i in want for _ in range(2)])
        assert len(planes) - len(climbed) <= 10
        on = max(planes)
        final = {step.foot: step.X_WF for step in plan.footsteps}
        feet = (final["left"], final["right"])
    assert plan.status == "finished"
    assert on == n - 1


@pytest.mark.parametrize("depth", [0.5, 0.9, 1.4])
@pytest.mark.parametrize("yaw", [0.0, 0.8])
def test_a_landing_is_walked_across_to_the_next_riser(depth: float, yaw: float) -> None:
    """Onto it near its front edge, then to the stand line on it, then on."""
    stairs = staircase(
        [0.27, depth, 0.3], [0.14, 0.18, 0.2], yaw=yaw, noise=0.005, turn_noise=0.01
    )
    feet = feet_at(yaw, (0.0, 0.0, 0.0), -0.25 - SOLE.toe, 0.02, 0.0)
    planes: list[int] = []
    for _ in range(6):
        plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
        if plan.status == "finished":
            break
        check_steps(plan, stairs, feet)
        planes += [step.plane for step in plan.footsteps]
        last = {step.foot: step.X_WF for step in plan.footsteps}
        feet = (last["left"], last["right"])
        if planes[-1] == 1:
            toes = feet[0].multiply(np.array([SOLE.toe, 0.0, 0.0]))
            before = stairs.treads[2].X_WR.inverse().multiply(toes)[0] + 0.15
            if plan.footsteps[0].plane == 1:
                assert before == pytest.approx(-PARAMS.stand_distance, abs=0.01)
    assert plan.status == "finished"
    crossing = len(planes) - 8
    assert planes[-2:] == [2, 2]
    assert crossing == planes.count(1) - 2 >= 2


def test_a_way_that_leads_off_the_landing_is_refused() -> None:
    """The robot stands with a foot beside it."""
    stairs = staircase([0.27, 0.9, 0.3], [0.14, 0.18, 0.2], width=0.42)
    feet = feet_at(0.0, (0.0, 0.0, 0.0), 0.5, 0.1, 0.0, z=0.32)
    plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
    assert (plan.status, plan.reason) == (
        "infeasible",
        "the way to the stand line leads off tread 2",
    )


@pytest.mark.parametrize(
    ("x", "steps"),
    [(-0.20, 0), (-0.21, 0), (-0.30, 2), (-0.50, 2), (-0.51, 3), (-0.81, 4)],
)
def test_the_approach_takes_the_fewest_steps(x: float, steps: int) -> None:
    """Straight ahead n + 1 steps get n step lengths far; 5 cm before is the stand."""
    stairs = staircase([0.28] * 2, [0.2] * 2)
    plan = plan_footsteps(stairs, *feet_at(0.0, (0, 0, 0), x, 0.0, 0.0), PARAMS, SOLE)
    assert sum(step.plane < 0 for step in plan.footsteps) == steps


def test_an_approach_ends_with_the_foot_that_does_not_lead() -> None:
    """So that feet alternate into the climb."""
    stairs = staircase([0.28] * 2, [0.2] * 2)
    feet = feet_at(0.0, (0, 0, 0), -0.45, 0.0, 0.0)
    for lead in ("left", "right"):
        plan = plan_footsteps(
            stairs,
            *feet,
            FootstepPlannerParams(foothold_bias=0.0, lead_foot=lead),
            SOLE,
        )
        first_up = next(step for step in plan.footsteps if step.plane == 0)
        assert first_up.foot == lead
        check_steps(plan, stairs, feet)


def test_a_long_approach_ends_on_the_stand_line_for_a_new_scan() -> None:
    """Beyond 0.5 m; always with the toes 5 cm before the first tread."""
    stairs = staircase([0.28] * 2, [0.2] * 2)
    for x, planes in ((-0.65, {-1, 0, 1}), (-0.75, {-1})):
        feet = feet_at(0.0, (0, 0, 0), x, 0.0, 0.0)
        plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
        assert {step.plane for step in plan.footsteps} == planes
        toes = max(
            step.X_WF.translation()[0] + SOLE.toe
            for step in plan.footsteps
            if step.plane < 0
        )
        assert toes == pytest.approx(-PARAMS.stand_distance)


def test_a_robot_too_near_steps_back_first() -> None:
    """Toes 1 cm before the riser are too near to be lifted."""
    stairs = staircase([0.28], [0.2])
    feet = feet_at(0.0, (0, 0, 0), -SOLE.toe - 0.01, 0.0, radians(3.0))
    plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
    check_steps(plan, stairs, feet)
    back = [step.X_WF.translation()[0] for step in plan.footsteps if step.plane < 0]
    np.testing.assert_allclose(back, -0.2, atol=1e-9)


def test_a_robot_beside_the_middle_keeps_to_its_line_as_far_as_the_treads_reach() -> (
    None
):
    """A narrow staircase pulls it to the middle, a wide one does not."""
    narrow = staircase([0.28], [0.2], width=0.5)
    wide = staircase([0.28], [0.2], width=1.2)
    feet = feet_at(0.0, (0, 0, 0), -0.6, 0.15, 0.0)
    room = 0.25 - PARAMS.side_margin - SOLE.half_width - PARAMS.stance_width / 2.0
    for stairs, y in ((narrow, room), (wide, 0.15)):
        plan = plan_footsteps(stairs, *feet, PARAMS, SOLE)
        final = {step.foot: step.X_WF.translation()[1] for step in plan.footsteps}
        assert (final["left"] + final["right"]) / 2.0 == pytest.approx(y)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("max_rise", 0.0),
        ("edge_margin", -0.01),
        ("steps_between_scans", 0),
        ("lead_foot", "middle"),
        ("stance_width", 0.10),
        ("foothold_bias", float("nan")),
        ("max_step_length", float("nan")),
    ],
)
def test_a_parameter_out_of_range_is_named(field: str, value: object) -> None:
    """Before anything is planned."""
    params = dataclasses.replace(PARAMS, **{field: value})
    with pytest.raises(ValueError, match=f"^{field}: "):
        FootstepPlanner(params, SOLE)


def test_the_parameters_are_read_from_yaml() -> None:
    """As scenarios hold them."""
    params = FootstepPlannerParams(max_rise=0.22, lead_foot="left")
    text = yaml_dump_typed(params)
    assert yaml_load_typed(schema=FootstepPlannerParams, data=text) == params


def test_the_system_plans_what_the_core_plans() -> None:
    """And plans once for the same inputs."""
    stairs = staircase([0.28] * 2, [0.2] * 2, yaw=0.3)
    feet = feet_at(0.3, (0, 0, 0), -0.5, 0.05, 0.1)
    planner = FootstepPlanner(PARAMS, SOLE)
    context = planner.CreateDefaultContext()
    planner.GetInputPort("staircase").FixValue(context, AbstractValue.Make(stairs))
    poses = [
        np.concatenate([X.translation(), RollPitchYaw(X.rotation()).vector()])
        for X in feet
    ]
    planner.GetInputPort("foot_poses").FixValue(context, np.concatenate(poses))
    port = planner.GetOutputPort("footstep_plan")
    plan = eval_abstract(port, context, FootstepPlan)
    wanted = plan_footsteps(stairs, *feet, PARAMS, SOLE)
    assert plan.status == "planned"
    for step, want in zip(plan.footsteps, wanted.footsteps, strict=True):
        assert (step.foot, step.plane) == (want.foot, want.plane)
        assert step.X_WF.IsNearlyEqualTo(want.X_WF, 1e-9)
    assert eval_abstract(port, context, FootstepPlan) is plan
