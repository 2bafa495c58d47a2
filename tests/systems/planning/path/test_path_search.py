"""Paths through random rooms, refusals confirmed by a grid, answers for odd cases."""

import subprocess
import sys
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely
from pydrake.common.value import AbstractValue

from footfall.models.values.room import Environment, PathPlan
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.planning.path.path_planner import PathPlanner
from footfall.systems.planning.path.path_search import plan_path
from footfall.systems.planning.path.rrt_connect import rrt_connect
from tests.systems.planning.path.room_cases import (
    box,
    distance_to_boxes,
    distance_to_edge,
    floor,
    grid_finds_a_way,
    room,
)

PARAMS = PathPlannerParams()
START, GOAL = np.array([-2.5, 0.0]), np.array([2.5, 0.0, 0.4])


def along(points: np.ndarray) -> np.ndarray:
    """Points every 5 mm along a polyline."""
    legs = pairwise(points)
    return np.vstack(
        [np.linspace(a, b, max(2, int(np.hypot(*(b - a)) / 0.005))) for a, b in legs]
    )


def assert_sound(path: PathPlan, environment: Environment) -> None:
    """From the start to the goal, everywhere with the clearance, trees included."""
    np.testing.assert_array_equal(path.points[0], START)
    np.testing.assert_array_equal(path.points[-1], GOAL[:2])
    assert path.goal_yaw == GOAL[2]
    edges = [*path.start_tree, *path.goal_tree]
    for line in (path.points, path.found, *edges):
        p = along(line)
        assert distance_to_boxes(p, environment).min() >= PARAMS.clearance - 1e-9
        assert distance_to_edge(p, environment).min() >= PARAMS.clearance - 1e-9


@pytest.mark.parametrize("width", [2.6, 1.8])
@pytest.mark.parametrize("seed", range(20))
def test_random_rooms(seed: int, width: float) -> None:
    """A path that keeps the clearance, or a refusal that the grid confirms."""
    environment = room(seed, y=width, area_y=width - 0.5)
    path = plan_path(environment, START, GOAL, PARAMS)
    if path.status == "planned":
        assert path.reason == ""
        assert_sound(path, environment)
        found = np.linalg.norm(np.diff(path.found, axis=0), axis=1).sum()
        assert 5.0 - 1e-9 <= path.length <= found + 1e-9
    else:
        assert path.reason.startswith("no path")
        assert len(path.points) == 0
        assert not grid_finds_a_way(environment, START, GOAL[:2], PARAMS.clearance)


def test_random_rooms_are_of_both_kinds() -> None:
    """The test above sees paths and refusals."""
    answers = [
        plan_path(room(seed, y=1.8, area_y=1.3), START, GOAL, PARAMS).status
        for seed in range(20)
    ]
    assert 3 <= answers.count("planned") <= 17


def test_same_seed_same_path() -> None:
    """Bit for bit, trees included; another seed grows other trees."""
    environment = room(3)
    first = plan_path(environment, START, GOAL, PARAMS)
    assert first == plan_path(environment, START, GOAL, PARAMS)
    other = plan_path(environment, START, GOAL, replace(PARAMS, seed=7))
    assert not np.array_equal(first.start_tree, other.start_tree)


def test_trees_can_be_drawn() -> None:
    """Each is connected and holds its end of the path as found."""
    environment = room(3)
    path = plan_path(environment, START, GOAL, PARAMS)
    for tree, root in ((path.start_tree, START), (path.goal_tree, GOAL[:2])):
        assert len(tree) > 0
        drawn = shapely.union_all(shapely.linestrings(tree))
        assert drawn.distance(shapely.Point(root)) == 0.0
        nodes = {tuple(p) for p in tree.reshape(-1, 2)}
        # A tree has one edge fewer than nodes, and hangs together.
        assert len(tree) == len(nodes) - 1
        assert shapely.line_merge(drawn).is_valid
        assert shapely.get_num_geometries(shapely.node(drawn)) >= len(tree)
    joined = {tuple(p) for p in (*path.start_tree, *path.goal_tree) for p in p}
    assert {tuple(p) for p in path.found} <= joined


def test_empty_room_is_crossed_straight() -> None:
    """Nothing in the way, nothing but the straight line."""
    path = plan_path(Environment(floor()), START, GOAL, PARAMS)
    assert path.status == "planned"
    np.testing.assert_allclose(path.points, [START, GOAL[:2]])


def test_already_there() -> None:
    """A goal where the robot stands is a path without length."""
    path = plan_path(Environment(floor()), START, np.array([*START, 1.0]), PARAMS)
    assert (path.status, path.length) == ("planned", 0.0)


@pytest.mark.parametrize(
    ("environment", "start", "goal", "reason"),
    [
        (Environment(reason="no floor in view: fog"), START, GOAL, "no floor in view"),
        (Environment(), START, GOAL, "no floor in the environment"),
        (Environment(floor()), START, [9, 0, 0], "goal (9.00, 0.00) m is outside"),
        (Environment(floor()), [-9, 0], GOAL, "start (-9.00, 0.00) m is outside"),
        (Environment(floor()), START, [np.nan, 0, 0], "must be finite"),
        (Environment(floor(), (box("b", 2.5, 0.1),)), START, GOAL, "goal (2.50, 0.00"),
        (Environment(floor(), (box("b", 2.5, 0.1),)), START, GOAL, "m is inside b"),
        (Environment(floor(), (box("b", 2.5, 0.6),)), START, GOAL, "is in collision"),
        (Environment(floor(), (box("b", -2.5, 0.5),)), START, GOAL, "the start"),
        (
            Environment(floor(), (box("b", 0.0, 0.0, 0.0, (0.4, 4.6)),)),
            START,
            GOAL,
            "no path exists",
        ),
    ],
)
def test_refusals_say_why(
    environment: Environment, start: object, goal: object, reason: str
) -> None:
    """No floor, outside, in a box, in collision, cut off: each has its answer."""
    path = plan_path(environment, np.array(start), np.array(goal, dtype=float), PARAMS)
    assert path.status == "refused"
    assert reason in path.reason
    assert len(path.points) == len(path.start_tree) == 0


def test_room_full_of_boxes() -> None:
    """Boxes everywhere but at start and goal leave no way."""
    full = tuple(
        box(f"box_{x}_{y}", 0.6 * x, 0.6 * y)
        for x in range(-2, 3)
        for y in range(-4, 5)
    )
    path = plan_path(Environment(floor(), full), START, GOAL, PARAMS)
    assert path.reason.startswith("no path exists")


def test_a_box_that_has_come_near_is_left() -> None:
    """A start whose margin alone is violated is left straight away."""
    near = Environment(floor(), (box("mover", -2.5, 0.61),))
    path = plan_path(near, START, GOAL, PARAMS)
    assert path.status == "planned"
    np.testing.assert_array_equal(path.points[0], START)
    distance = distance_to_boxes(along(path.points), near)
    assert distance[0] == pytest.approx(0.41)
    assert distance.min() == pytest.approx(0.41)
    assert np.all(
        distance[np.linalg.norm(along(path.points) - START, axis=1) > 0.06]
        >= PARAMS.clearance - 1e-9
    )


def test_time_limit_is_told_plainly() -> None:
    """A slit that is free on paper only: the trees give up, and it says when."""
    slit = PARAMS.clearance / np.cos(np.pi / 32.0) + 1e-6
    walls = tuple(
        box(f"wall_{s}", 0.0, s * (slit + 1.5), 0.0, (0.4, 3.0)) for s in (-1, 1)
    )
    path = plan_path(
        Environment(floor(), walls),
        np.array([-2.5, 1.0]),
        np.array([2.5, 1.0, 0.0]),
        replace(PARAMS, time_limit=0.3),
    )
    assert path.reason == "no path found in 0.3 s"


def test_nothing_is_printed() -> None:
    """OMPL's messages and its complaints at exit do not reach the user."""
    code = """
import numpy as np
from footfall.systems.planning.path.path_search import plan_path
from footfall.systems.planning.path.path_params import PathPlannerParams
from tests.systems.planning.path.room_cases import room
for seed in (1, 3):
    plan = plan_path(room(seed), np.array([-2.5, 0.0]), np.array([2.5, 0.0, 0.0]),
                     PathPlannerParams(seed=0))
    assert plan.status == "planned"
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert (done.stdout, done.stderr) == ("", "")


def test_rrt_connect_stays_in_its_region() -> None:
    """Around a corner, with both trees in the free polygon."""
    region = shapely.box(0, 0, 4, 4).difference(shapely.box(0, 1, 3, 4))
    shapely.prepare(region)
    start, goal = np.array([0.5, 0.5]), np.array([3.5, 3.5])
    growth = rrt_connect(region, start, goal, extension=0.5, time_limit=1.0, seed=0)
    assert growth.path is not None
    np.testing.assert_array_equal(growth.path[[0, -1]], [start, goal])
    assert region.covers(shapely.LineString(growth.path))
    for edge in (*growth.start_tree, *growth.goal_tree):
        assert region.covers(shapely.LineString(edge))
        assert np.linalg.norm(edge[1] - edge[0]) <= 0.5 + 1e-9


def test_system_plans_from_between_the_feet() -> None:
    """The start is midway between the soles."""
    system = PathPlanner()
    context = system.CreateDefaultContext()
    environment = room(3)
    system.GetInputPort("environment").FixValue(
        context, AbstractValue.Make(environment)
    )
    feet = np.array([-2.4, 0.1, 0, 0, 0, 0.2, -2.6, -0.1, 0, 0, 0, 0.2])
    system.GetInputPort("foot_poses").FixValue(context, feet)
    system.GetInputPort("goal").FixValue(context, GOAL)
    path = system.GetOutputPort("path_plan").Eval(context)
    assert path == plan_path(
        environment, np.mean(feet.reshape(2, 6)[:, :2], 0), GOAL, PARAMS
    )
    assert path.status == "planned"


@pytest.mark.parametrize(
    ("field", "value"),
    [("footprint_radius", 0.0), ("margin", -1.0), ("time_limit", 0.0), ("attempts", 0)],
)
def test_wrong_parameters_are_named(field: str, value: float) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        PathPlanner(replace(PARAMS, **{field: value}))
