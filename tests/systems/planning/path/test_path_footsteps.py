"""Footsteps along paths through random rooms, judged by measures of their own."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
import shapely
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import FEET
from footfall.models.values.geometry import heading
from footfall.models.values.planned import FootstepPlan
from footfall.models.values.room import Environment, PathPlan
from footfall.systems.planning.footsteps.foothold import SIDE, wrap
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.path.path_footstep_planner import PathFootstepPlanner
from footfall.systems.planning.path.path_footsteps import plan_path_footsteps
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.planning.path.path_search import plan_path
from tests.systems.planning.path.room_cases import box, floor, room, stand

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)
PARAMS = FootstepPlannerParams()


def walk(
    environment: Environment,
    feet: list[RigidTransform],
    goal: np.ndarray,
    params: FootstepPlannerParams = PARAMS,
) -> FootstepPlan:
    """Path and footsteps from the feet to a goal."""
    start = np.mean([X.translation()[:2] for X in feet], axis=0)
    path = plan_path(environment, start, goal, PathPlannerParams())
    return plan_path_footsteps(path, environment, *feet, params, SOLE)


def outline(X_WF: RigidTransform) -> shapely.Polygon:
    """The sole on the floor."""
    corners = [[-0.075, -0.042], [0.15, -0.042], [0.15, 0.042], [-0.075, 0.042]]
    p_F = np.hstack([corners, np.zeros((4, 1))])
    return shapely.Polygon(np.array(X_WF.multiply(p_F.T)).T[:, :2])


def assert_sound(
    plan: FootstepPlan,
    environment: Environment,
    feet: list[RigidTransform],
    goal: np.ndarray,
) -> None:
    """Alternating, in reach, feet apart and clear of boxes, together at the goal."""
    assert plan.status == "planned", plan.reason
    now = dict(zip(FEET, feet, strict=True))
    boxes = [shapely.Polygon(b.footprint()) for b in environment.boxes]
    before = None
    for step in plan.footsteps:
        assert step.foot != before
        assert step.plane == -1
        before = step.foot
        stance = now["right" if step.foot == "left" else "left"]
        X_SF = stance.InvertAndCompose(step.X_WF)
        x, y, z = X_SF.translation()
        assert -PARAMS.max_back_step - 1e-9 <= x <= PARAMS.max_step_length + 1e-9
        assert abs(y) <= PARAMS.max_stance_width + 1e-9
        assert z == pytest.approx(0.0, abs=1e-12)
        assert abs(heading(X_SF)) <= PARAMS.max_turn + 1e-9
        # The whole sole lands on its own side of the other one, a gap away.
        corners = np.array(outline(X_SF).exterior.coords)
        inner = (corners[:, 1] * SIDE[step.foot]).min()
        assert inner >= SOLE.half_width + PARAMS.sole_gap - 1e-9
        # On the way, too, it keeps off the other one: feet are wider than their soles.
        swing = shapely.union(outline(now[step.foot]), outline(step.X_WF)).convex_hull
        assert swing.distance(outline(stance)) >= PARAMS.sole_gap - 1e-6
        assert all(swing.distance(b) >= 0.03 for b in boxes)
        now[step.foot] = step.X_WF
    c, s = np.cos(goal[2]), np.sin(goal[2])
    for foot, X in now.items():
        side = SIDE[foot] * PARAMS.stance_width / 2.0
        wanted = goal[:2] + side * np.array([-s, c])
        assert np.linalg.norm(X.translation()[:2] - wanted) < 0.02
        assert abs(wrap(heading(X) - goal[2])) < np.radians(2.0)


@pytest.mark.parametrize("seed", range(40))
def test_random_rooms(seed: int) -> None:
    """Every room that has a path has sound footsteps, whatever the headings."""
    environment = room(seed)
    start, end = np.random.default_rng(seed).uniform(-pi, pi, 2)
    feet, goal = stand(-2.5, 0.0, start), np.array([2.5, 0.0, end])
    path = plan_path(environment, np.array([-2.5, 0.0]), goal, PathPlannerParams())
    plan = plan_path_footsteps(path, environment, *feet, PARAMS, SOLE)
    if path.status == "refused":
        assert (plan.status, plan.reason) == ("infeasible", path.reason)
        assert plan.footsteps == ()
        return
    assert_sound(plan, environment, feet, goal)
    # Going 0.3 m a step and, apart from that, turning by half of what a step allows.
    turns = np.abs(np.diff(np.unwrap([start, *directions(path.points), end]))).sum()
    assert len(plan.footsteps) <= path.length / 0.3 + turns / 0.13 + 6


def directions(points: np.ndarray) -> np.ndarray:
    """Directions of the legs of a polyline, rad."""
    legs = np.diff(points, axis=0)
    return np.arctan2(legs[:, 1], legs[:, 0])


@pytest.mark.parametrize("seed", range(60))
def test_short_ways_on_open_floor(seed: int) -> None:
    """Any near goal and heading from feet that stand as they stopped."""
    rng = np.random.default_rng(seed)
    open_floor = Environment(floor(9.0, 9.0))
    stride = rng.uniform(-0.14, 0.14)
    X_WM = RigidTransform(RollPitchYaw(0, 0, rng.uniform(-pi, pi)), [1.0, -2.0, 0.0])
    feet = [
        X_WM
        @ RigidTransform(
            RollPitchYaw(0, 0, rng.uniform(0.0, 0.1) * SIDE[f]),
            [stride * SIDE[f], SIDE[f] * rng.uniform(0.09, 0.12), 0.0],
        )
        for f in FEET
    ]
    goal = rng.uniform([0.0, -3.0, -pi], [2.0, -1.0, pi])
    assert_sound(walk(open_floor, feet, goal), open_floor, feet, goal)


@pytest.mark.parametrize(
    ("goal", "count"),
    [
        ((2.1, 0.0, 0.0), 8),
        ((0.0, 0.3, 0.0), 5),
        ((-0.3, 0.0, 0.0), 3),
        ((0.0, 0.0, pi / 2), 8),
        ((0.05, 0.0, 0.0), 2),
    ],
    ids=["ahead", "sideways", "back", "turn", "adjust"],
)
def test_few_steps(goal: tuple[float, float, float], count: int) -> None:
    """As many as the reach takes, and one that brings the feet together."""
    open_floor, feet = Environment(floor()), stand(0.0, 0.0, 0.0)
    plan = walk(open_floor, feet, np.array(goal))
    assert_sound(plan, open_floor, feet, np.array(goal))
    assert len(plan.footsteps) == count


def test_straight_walk_is_fast_enough() -> None:
    """At 0.95 s a step the straight is walked at more than 0.25 m/s."""
    plan = walk(Environment(floor()), stand(-2.5, 0, 0), np.array([2.5, 0.0, 0.0]))
    x = np.array([step.X_WF.translation()[0] for step in plan.footsteps])
    assert np.diff(x)[:-1].mean() / 0.95 > 0.25


def test_at_the_goal_already() -> None:
    """Nothing is to be done."""
    plan = walk(Environment(floor()), stand(0, 0, 0.3), np.array([0.005, 0, 0.31]))
    assert (plan.status, plan.footsteps) == ("finished", ())


def test_height_is_that_of_the_feet() -> None:
    """The soles are set down level where they stand, not where the floor was seen."""
    feet = [RigidTransform([0, 0, 0.012]) @ X for X in stand(0, 0, 0)]
    plan = walk(Environment(floor()), feet, np.array([1.0, 0.0, 0.0]))
    heights = [step.X_WF.translation()[2] for step in plan.footsteps]
    np.testing.assert_allclose(heights, 0.012)


def test_a_sole_beside_a_box_is_refused() -> None:
    """A path that is not clear of the boxes does not become steps."""
    path = PathPlan(np.array([[0.0, 0.0], [2.0, 0.0]]), 0.0, "planned")
    crossed = Environment(floor(), (box("crate", 1.0, 0.0),))
    plan = plan_path_footsteps(path, crossed, *stand(0, 0, 0), PARAMS, SOLE)
    assert plan.status == "infeasible"
    assert "to a box" in plan.reason


def test_feet_out_of_reach_are_refused() -> None:
    """Feet that stand too far apart cannot begin."""
    feet = stand(0.0, 0.0, 0.0, width=0.8)
    plan = walk(Environment(floor()), feet, np.array([1.0, 0.0, 0.0]))
    assert plan.status == "infeasible"
    assert "beside the other" in plan.reason


def test_a_foot_does_not_pass_over_the_other() -> None:
    """Feet that stand crossed are not uncrossed through each other."""
    left, right = RigidTransform([-0.3, -0.3, 0.0]), RigidTransform([0.0, -0.095, 0.0])
    path = PathPlan(np.array([[0.0, 0.0], [1.0, 0.0]]), 0.0, "planned")
    open_floor = Environment(floor())
    plan = plan_path_footsteps(path, open_floor, left, right, PARAMS, SOLE)
    assert (plan.status, plan.footsteps) == ("infeasible", ())
    beside = RigidTransform([-0.1, 0.095, 0.0])
    plan = plan_path_footsteps(path, open_floor, beside, right, PARAMS, SOLE)
    assert plan.status == "planned"


@pytest.mark.parametrize("max_turn", [0.1, 0.4])
def test_limits_come_from_the_parameters(max_turn: float) -> None:
    """A robot that turns less takes more steps."""
    params = replace(PARAMS, max_turn=max_turn)
    feet, goal = stand(0.0, 0.0, 0.0), np.array([0.0, 0.0, 1.0])
    plan = walk(Environment(floor()), feet, goal, params)
    yaws = [0.0, *(heading(step.X_WF) for step in plan.footsteps)]
    assert np.abs(np.diff(yaws)).max() <= max_turn + 1e-9
    assert len(plan.footsteps) <= 1.0 / (max_turn * 0.5) + 2


def test_system_gives_the_plan_or_the_paths_reason() -> None:
    """Plan and refusal on the port."""
    environment, goal = room(3), np.array([2.5, 0.0, 0.0])
    path = plan_path(environment, np.array([-2.5, 0.0]), goal, PathPlannerParams())
    system = PathFootstepPlanner(PARAMS, SOLE)
    context = system.CreateDefaultContext()
    port = system.GetInputPort("path_plan")
    port.FixValue(context, AbstractValue.Make(path))
    system.GetInputPort("environment").FixValue(
        context, AbstractValue.Make(environment)
    )
    poses = [-2.5, 0.095, 0, 0, 0, 0, -2.5, -0.095, 0, 0, 0, 0]
    system.GetInputPort("foot_poses").FixValue(context, poses)
    plan = system.GetOutputPort("footstep_plan").Eval(context)
    assert_sound(plan, environment, stand(-2.5, 0, 0), goal)
    port.FixValue(context, AbstractValue.Make(PathPlan(reason="no path found in 2 s")))
    refused = system.GetOutputPort("footstep_plan").Eval(context)
    assert (refused.status, refused.reason) == ("infeasible", "no path found in 2 s")
