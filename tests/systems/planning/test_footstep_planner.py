"""The footstep planner on made-up estimates of staircases."""

import dataclasses
from math import degrees, radians

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.common.yaml import yaml_dump_typed, yaml_load_typed
from pydrake.math import RigidTransform, RollPitchYaw

from models.robot import Sole
from systems.planning.foothold import heading, sole_corners
from systems.planning.footstep_params import FootstepPlannerParams
from systems.planning.footstep_planner import FootstepPlanner, plan_footsteps
from systems.ports import Vector, eval_abstract
from systems.values import FootstepPlan, PlaneSegment, Staircase, other_foot

PARAMS = FootstepPlannerParams(foothold_bias=0.0)
SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)


def rectangle(X_WR: RigidTransform, depth: float, width: float) -> PlaneSegment:
    """A plane segment whose polygon is its rectangle."""
    size = np.array([depth, width])
    half = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * size / 2.0
    corners = np.array([X_WR.multiply(np.array([*p, 0.0])) for p in half])
    normal: Vector = X_WR.rotation().matrix()[:, 2]
    return PlaneSegment(corners, X_WR, size, normal, depth * width, 100)


def staircase(
    runs: list[float],
    rises: list[float],
    width: float = 0.8,
    yaw: float = 0.0,
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    noise: float = 0.0,
    turn_noise: float = 0.0,
    rng: np.random.Generator | None = None,
) -> Staircase:
    """Treads from an origin on the floor at the middle of the first riser.

    `noise` shrinks the rectangles (m) and shifts their heights, `turn_noise` turns
    them (rad); both are uniform.
    """
    rng = np.random.default_rng(0) if rng is None else rng
    X_WS = RigidTransform(RollPitchYaw(0.0, 0.0, yaw), np.array(origin))
    treads, x, z = [], 0.0, 0.0
    for run, rise in zip(runs, rises, strict=True):
        z += rise
        cut = rng.uniform(0.0, noise, 4)
        middle = np.array(
            [
                x + (run + cut[0] - cut[1]) / 2.0,
                (cut[2] - cut[3]) / 2.0,
                z + rng.uniform(-0.3, 0.3) * noise,
            ]
        )
        turn = RollPitchYaw(0.0, 0.0, rng.uniform(-turn_noise, turn_noise))
        treads.append(
            rectangle(
                X_WS @ RigidTransform(turn, middle),
                run - cut[0] - cut[1],
                width - cut[2] - cut[3],
            )
        )
        x += run
    floor = rectangle(X_WS @ RigidTransform([-1.1, 0.0, 0.0]), 2.0, 3.0)
    return Staircase(tuple(treads), floor)


def feet_at(
    stairs_yaw: float,
    origin: tuple[float, float, float],
    x: float,
    y: float,
    yaw: float,
    z: float = 0.0,
    stance_width: float = 0.19,
) -> tuple[RigidTransform, RigidTransform]:
    """Left and right sole side by side about (x, y, z) in the staircase's frame."""
    X_WS = RigidTransform(RollPitchYaw(0.0, 0.0, stairs_yaw), np.array(origin))
    X_WM = X_WS @ RigidTransform(RollPitchYaw(0.0, 0.0, yaw), np.array([x, y, z]))
    half = stance_width / 2.0
    return (
        X_WM @ RigidTransform([0.0, half, 0.0]),
        X_WM @ RigidTransform([0.0, -half, 0.0]),
    )


def check_steps(
    plan: FootstepPlan,
    stairs: Staircase,
    feet: tuple[RigidTransform, RigidTransform],
    params: FootstepPlannerParams = PARAMS,
) -> None:
    """Every step within its limits, every sole on its tread, feet side by side."""
    assert plan.status == "planned", plan.reason
    now = dict(zip(("left", "right"), feet, strict=True))
    for before, after in zip(plan.footsteps, plan.footsteps[1:], strict=False):
        assert after.foot == other_foot(before.foot)
    for step in plan.footsteps:
        stance = now[other_foot(step.foot)]
        X_SF = stance.inverse() @ step.X_WF
        x, y, _ = X_SF.translation()
        turn = RollPitchYaw(X_SF.rotation()).yaw_angle()
        side = 1.0 if step.foot == "left" else -1.0
        reach = params.max_step_length if step.plane < 0 else params.max_climb_length
        assert -params.max_back_step - 1e-6 <= x <= reach + 1e-6
        assert side * y <= params.max_stance_width + 1e-6
        assert abs(turn) <= params.max_turn + 1e-6
        inner = side * (stance.inverse().multiply(sole_corners(step.X_WF, SOLE).T))[1]
        assert inner.min() >= SOLE.half_width + params.sole_gap - 1e-6
        p_W = sole_corners(step.X_WF, SOLE)
        if step.plane < 0:
            X_R1W = stairs.treads[0].X_WR.inverse()
            ahead = X_R1W.multiply(p_W.T)[0] + stairs.treads[0].size[0] / 2.0
            assert ahead.max() < 0.0
        else:
            tread = stairs.treads[step.plane]
            p_R = np.array(tread.X_WR.inverse().multiply(p_W.T))
            room = tread.size[:, None] / 2.0 - np.abs(p_R[:2])
            assert room[0].min() >= -params.max_heel_overhang - 1e-6
            toes = tread.size[0] / 2.0 - p_R[0].max()
            assert toes >= params.edge_margin - 1e-6
            assert room[1].min() >= params.side_margin - 1e-6
            np.testing.assert_allclose(p_R[2], 0.0, atol=1e-6)
        now[step.foot] = step.X_WF
    apart = now["right"].inverse() @ now["left"]
    p = apart.translation()
    assert abs(p[0]) < 0.012
    np.testing.assert_allclose(p[1:], [params.stance_width, 0.0], atol=1e-6)
    assert abs(degrees(heading(now["left"]) - heading(now["right"]))) < 1e-6


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


@pytest.mark.parametrize(
    ("x", "steps"),
    [(-0.20, 0), (-0.21, 0), (-0.30, 2), (-0.50, 2), (-0.51, 3), (-0.81, 4)],
)
def test_the_approach_takes_the_fewest_steps(x: float, steps: int) -> None:
    """Straight ahead n + 1 steps get n step lengths far; 5 cm before is the stand."""
    stairs = staircase([0.28] * 2, [0.2] * 2)
    plan = plan_footsteps(stairs, *feet_at(0.0, (0, 0, 0), x, 0.0, 0.0), PARAMS, SOLE)
    assert sum(step.plane < 0 for step in plan.footsteps) == steps


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


def refused(
    stairs: Staircase,
    x: float = -0.2,
    y: float = 0.0,
    yaw: float = 0.0,
    z: float = 0.0,
    params: FootstepPlannerParams = PARAMS,
) -> str:
    """The reason for refusing a robot at this place."""
    feet = feet_at(0.0, (0, 0, 0), x, y, yaw, z)
    plan = plan_footsteps(stairs, *feet, params, SOLE)
    assert plan.status == "infeasible"
    assert plan.footsteps == ()
    assert "\n" not in plan.reason
    return plan.reason


def tilted(stairs: Staircase, slope: float) -> Staircase:
    """The same with its first tread sloping down to the side, deg."""
    first = stairs.treads[0]
    X_WR = first.X_WR @ RigidTransform(
        RollPitchYaw(radians(slope), 0.0, 0.0), np.zeros(3)
    )
    first = rectangle(X_WR, *first.size)
    return dataclasses.replace(stairs, treads=(first, *stairs.treads[1:]))


@pytest.mark.parametrize(
    ("stairs", "pose", "reason"),
    [
        (Staircase(), {}, "no staircase seen"),
        (
            staircase([0.28], [0.40]),
            {},
            "tread 1 rises 0.40 m above the floor, more than the 0.25 m the robot can "
            "climb",
        ),
        (
            staircase([0.28] * 2, [0.2, 0.4]),
            {},
            "tread 2 rises 0.40 m above tread 1, more than the 0.25 m the robot can "
            "climb",
        ),
        (
            staircase([0.28] * 2, [0.2, -0.1]),
            {},
            "tread 2 lies 0.10 m below tread 1",
        ),
        (
            staircase([0.28], [0.2], width=0.3),
            {},
            "tread 1 is 0.300 m wide, less than the 0.334 m that both feet need",
        ),
        (
            staircase([0.23], [0.2]),
            {},
            "tread 1 is 0.230 m deep, too shallow for the 0.225 m sole: its heel would "
            "stand out by 0.010 m, more than 0.000 m",
        ),
        (
            staircase([0.50], [0.2]),
            {},
            "tread 1 needs a step of 0.41 m from the stance foot, more than 0.36 m",
        ),
        (
            tilted(staircase([0.28], [0.2]), 12.0),
            {},
            "tread 1 slopes by 12.0 deg, more than 10.0 deg",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": 0.1, "z": 0.3},
            "the feet are 0.100 m off the height of tread 1 where they stand",
        ),
        (
            staircase([0.28], [0.2]),
            {"z": -0.1},
            "the feet are 0.100 m below the floor that was seen",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": -1.0, "z": 0.1},
            "tread 1 needs a step of 1.10 m from the stance foot, more than 0.36 m; "
            "the feet stand on nothing that was seen",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": -1.0, "z": 0.5},
            "the feet stand 0.30 m above the highest tread, on nothing that was seen",
        ),
        (
            dataclasses.replace(staircase([0.28], [0.2]), floor=None),
            {"x": -1.0},
            "tread 1 needs a step of 1.10 m from the stance foot, more than 0.36 m; "
            "the feet stand on nothing that was seen",
        ),
        (
            staircase([0.28] * 3, [0.2] * 3),
            {"x": 0.3, "y": 0.8},
            "the way to the stand line leads through tread 1",
        ),
        (
            staircase([0.28], [0.2]),
            {"x": -9.0},
            "the stand line, 8.80 m away, cannot be reached within 24 steps",
        ),
        (
            dataclasses.replace(
                staircase([0.28], [0.2]),
                floor=rectangle(RigidTransform([-1.5, 0.0, 0.0]), 1.0, 3.0),
            ),
            {"x": -1.0},
            "the stand line lies 0.95 m from the floor that was seen, more than 0.30 m",
        ),
    ],
)
def test_a_refusal_says_why(
    stairs: Staircase, pose: dict[str, float], reason: str
) -> None:
    """One line, with the numbers."""
    assert refused(stairs, **pose) == reason


def test_a_sloping_floor_is_refused() -> None:
    """The approach is for a flat floor."""
    stairs = staircase([0.28], [0.2])
    X_WR = RigidTransform(RollPitchYaw(0.0, radians(4.0), 0.0), np.array([-0.6, 0, 0]))
    stairs = dataclasses.replace(stairs, floor=rectangle(X_WR, 2.0, 3.0))
    reason = refused(stairs, x=-0.6)
    assert (
        reason == "the floor before the staircase slopes by 4.0 deg, more than 3.0 deg"
    )


def test_a_spiral_is_refused() -> None:
    """Two treads turned by 30 deg are each 15 deg off their mean."""
    first = rectangle(RigidTransform([0.15, 0.0, 0.2]), 0.3, 0.8)
    X_WR = RigidTransform(
        RollPitchYaw(0.0, 0.0, radians(30.0)), np.array([0.4, 0, 0.4])
    )
    stairs = Staircase((first, rectangle(X_WR, 0.3, 0.8)), None)
    stairs = dataclasses.replace(staircase([0.3], [0.2]), treads=stairs.treads)
    assert refused(stairs) == (
        "tread 1 is turned by 15.0 deg from the staircase, more than 10.0 deg"
    )


@pytest.mark.parametrize(
    ("right", "reason"),
    [
        (
            RigidTransform([-0.2, -0.095, 0.1]),
            "the right foot stands 0.100 m above the left one, more than 0.030 m",
        ),
        (
            RigidTransform(RollPitchYaw(0.3, 0.0, 0.0), [-0.2, -0.095, 0.0]),
            "the right sole is tilted by 17.2 deg, more than 10.0 deg",
        ),
        (
            RigidTransform([-0.2, 0.045, 0.0]),
            "the left foot is 0.050 m to the left of the right one, less than the "
            "0.084 m that the soles take",
        ),
    ],
)
def test_feet_that_do_not_stand_are_refused(right: RigidTransform, reason: str) -> None:
    """Only feet side by side on one level can start a plan."""
    left = RigidTransform([-0.2, 0.095, 0.0])
    plan = plan_footsteps(staircase([0.28], [0.2]), left, right, PARAMS, SOLE)
    assert (plan.status, plan.reason) == ("infeasible", reason)


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
