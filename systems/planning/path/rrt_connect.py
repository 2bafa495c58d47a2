"""RRT-Connect in the plane, by OMPL (Kuffner, LaValle 2000; room paper, Sec. 3.1)."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely  # type: ignore[import-untyped]
from ompl import base, geometric, util

from footfall.models.values.vector import Vector


@dataclass(frozen=True, eq=False)
class GrownTrees:
    """What one search came to."""

    path: Vector | None
    """Corners from start to goal, (n, 2), m; None where none was found in time."""
    start_tree: Vector
    """Edges of the tree from the start, (k, 2, 2), m."""
    goal_tree: Vector
    """Edges of the tree from the goal, (k, 2, 2), m."""


class _FreeSegments(base.MotionValidator):  # type: ignore[misc]
    """Says whether a segment lies in a polygon, exactly."""

    def __init__(self, info: Any, region: shapely.Polygon) -> None:
        super().__init__(info)
        self._region = region

    def checkMotion(self, a: Any, b: Any) -> bool:
        segment = shapely.linestrings([[a[0], a[1]], [b[0], b[1]]])
        return bool(shapely.covers(self._region, segment))


def rrt_connect(
    region: shapely.Polygon,
    start: Vector,
    goal: Vector,
    *,
    extension: float,
    time_limit: float,
    seed: int,
) -> GrownTrees:
    """Grows a tree from either end until they meet.

    OMPL's generator is one for the whole process and is seeded here, so that the same
    seed gives the same trees bit for bit; OMPL's messages are kept off the terminal.

    Args:
        region: the free polygon, prepared; it holds both ends.
        start: (2,), m.
        goal: (2,), m.
        extension: longest edge of a tree, m.
        time_limit: s.
        seed: of the samples, not negative.
    """
    level = util.getLogLevel()
    util.setLogLevel(util.LOG_NONE)
    try:
        # Zero would not be taken.
        util.RNG.setSeed(seed + 1)
        return _grow(region, start, goal, extension, time_limit)
    finally:
        util.setLogLevel(level)


def _grow(
    region: shapely.Polygon,
    start: Vector,
    goal: Vector,
    extension: float,
    time_limit: float,
) -> GrownTrees:
    space = base.RealVectorStateSpace(2)
    bounds = base.RealVectorBounds(2)
    low, high = region.bounds[:2], region.bounds[2:]
    for axis in (0, 1):
        bounds.setLow(axis, low[axis])
        bounds.setHigh(axis, high[axis])
    space.setBounds(bounds)
    info = base.SpaceInformation(space)
    info.setStateValidityChecker(
        lambda state: bool(shapely.intersects_xy(region, state[0], state[1]))
    )
    info.setMotionValidator(_FreeSegments(info, region))
    info.setup()
    problem = base.ProblemDefinition(info)
    ends = []
    for p in (start, goal):
        state = space.allocState()
        state[0], state[1] = float(p[0]), float(p[1])
        ends.append(state)
    problem.setStartAndGoalStates(*ends)
    planner = geometric.RRTConnect(info)
    planner.setRange(extension)
    planner.setProblemDefinition(problem)
    planner.setup()
    planner.solve(base.timedPlannerTerminationCondition(time_limit))
    path: Vector | None = None
    if problem.hasExactSolution():
        states = problem.getSolutionPath().getStates()
        path = np.array([[state[0], state[1]] for state in states])
    data = base.PlannerData(info)
    planner.getPlannerData(data)
    return GrownTrees(path, *_trees(data, start, goal))


def _trees(data: Any, start: Vector, goal: Vector) -> tuple[Vector, Vector]:
    """Edges of both trees, each (k, 2, 2), m, without the one that joins them."""
    count = data.numVertices()
    states = [data.getVertex(index).getState() for index in range(count)]
    points = np.array([[state[0], state[1]] for state in states]).reshape(-1, 2)
    links: list[list[int]] = [[] for _ in range(count)]
    for index in range(count):
        for other in data.getEdges(index):
            links[index].append(other)
            links[other].append(index)
    # OMPL tags the vertices of the start's tree 1, those of the goal's 2.
    tags = [data.getVertex(index).getTag() for index in range(count)]
    trees = []
    for tag in (1, 2):
        edges = [
            (points[index], points[other])
            for index in range(count)
            for other in links[index]
            if index < other and tags[index] == tag == tags[other]
        ]
        trees.append(np.array(edges).reshape(-1, 2, 2))
    return trees[0], trees[1]
