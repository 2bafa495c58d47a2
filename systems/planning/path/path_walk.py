"""The way of the robot's middle along a path: how it turns, and how far a step gets.

A walk is a curve of poses (x, y, yaw) whose places are on the path. Along it an effort
grows that counts steps: a step may spend one unit, which bounds how far it goes and
how far it turns.
"""

from math import ceil

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.planning.path.path_headings import StepReach, choose_headings

SPACING = 0.03
"""Between poses of a curve, m."""
BLENDS = (0.0, 0.1, 0.2, 0.3, 0.45)
"""How far before and after a corner the robot may turn as it goes, m, as tried."""


def walk_curve(
    points: Vector,
    start_yaw: float,
    goal_yaw: float,
    reach: StepReach,
    stance_width: float,
) -> tuple[Vector, Vector]:
    """Poses along a path, near enough to each other to be joined linearly.

    The robot turns on the spot at the start and the goal. At the corners it turns as
    it goes, with the mean heading of the path's next and last stretch; of several
    lengths of that stretch, the one of least effort counts. It stays on the path all
    the while, where every heading is free.

    Args:
        points: the path's corners, (n, 2), m.
        start_yaw: heading at the start, rad.
        goal_yaw: heading at the goal, rad.
        reach: what a step covers.
        stance_width: between the feet, m.

    Returns:
        Poses (x, y, yaw), (k, 3), m and rad, whose yaw runs on beyond pi without jumps,
        and their efforts, (k,); see `walk_effort`.
    """
    apart = np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-6
    points = points[np.concatenate([[True], apart])]
    headings = choose_headings(points, start_yaw, goal_yaw, reach)
    yaws = np.unwrap(np.concatenate([[start_yaw], headings, [goal_yaw]]))
    best: tuple[Vector, Vector] | None = None
    for blend in BLENDS if len(headings) > 1 else BLENDS[:1]:
        curve = _curve(points, yaws, blend)
        effort = walk_effort(curve, reach, stance_width)
        if best is None or effort[-1] < best[1][-1]:
            best = curve, effort
    assert best is not None
    return best


def _curve(points: Vector, yaws: Vector, blend: float) -> Vector:
    """Poses (x, y, yaw), (k, 3), of one way of turning.

    Args:
        points: the path's corners, (n, 2), m.
        yaws: headings at the start, on the n - 1 legs and at the goal, rad.
        blend: half the stretch whose mean heading counts, m.
    """
    first, last = [*points[0], yaws[0]], [*points[-1], yaws[-1]]
    if len(points) < 2:
        return np.array([first, last])
    length = np.linalg.norm(np.diff(points, axis=0), axis=1)
    knots = np.concatenate([[0.0], np.cumsum(length)])
    if blend == 0.0:
        legs = [
            [*points[leg + end], yaws[leg + 1]]
            for leg in range(len(length))
            for end in (0, 1)
        ]
        return np.array([first, *legs, last])
    count = max(1, ceil(knots[-1] / SPACING))
    s = np.union1d(knots, np.linspace(0.0, knots[-1], count + 1))
    # The integral of the heading, carried on straight beyond both ends.
    ends = np.concatenate([[-blend], knots, [knots[-1] + blend]])
    held = np.concatenate([yaws[1:2], yaws[1:-1], yaws[-2:-1]])
    turned = np.concatenate([[0.0], np.cumsum(held * np.diff(ends))])
    later, before = (np.interp(s + d, ends, turned) for d in (blend, -blend))
    x, y = (np.interp(s, knots, coordinate) for coordinate in points.T)
    middle = np.column_stack([x, y, (later - before) / (2.0 * blend)])
    return np.vstack([first, middle, last])


def walk_effort(curve: Vector, reach: StepReach, stance_width: float) -> Vector:
    """How many steps, not whole, each pose of a curve is away from its start.

    Where the robot turns as it goes, the outer foot has the longer way, and the foot
    that is set down inward, across the other one's heading, has less room beside it.

    Args:
        curve: poses, (k, 3).
        reach: what a step covers.
        stance_width: between the feet, m.

    Returns:
        (k,), ascending from 0.
    """
    move = np.diff(curve, axis=0)
    distance = np.hypot(move[:, 0], move[:, 1])
    turn = np.abs(move[:, 2])
    going = distance > 1e-9
    direction = np.arctan2(move[:, 1], move[:, 0])
    direction -= (curve[1:, 2] + curve[:-1, 2]) / 2.0
    along, across = distance * np.cos(direction), np.abs(distance * np.sin(direction))
    outer = np.where(going, stance_width / 2.0, 0.0)
    # The stance foot faces where the robot did a step ago: half the turn of a step.
    inward = np.where(going, reach.turn_narrows + reach.forward / 2.0, 0.0)
    effort = np.maximum.reduce(
        [
            reach.steps_to_turn(turn),
            (along + outer * turn) / reach.forward,
            (outer * turn - along) / reach.backward,
            (across + inward * turn) / reach.sideways,
        ]
    )
    return np.concatenate([[0.0], np.cumsum(effort)])


def step_centres(curve: Vector, effort: Vector, count: int) -> Vector:
    """Where the robot's middle is after each of `count` steps of like effort.

    Args:
        curve: poses, (k, 3).
        effort: of each, (k,).
        count: at least 1.

    Returns:
        Poses (x, y, yaw), (count, 3); the last is the curve's end.
    """
    spent = np.linspace(0.0, effort[-1], count + 1)[1:]
    # A pose that is reached at no effort would make the interpolation ambiguous.
    rising = np.concatenate([[True], np.diff(effort) > 0.0])
    columns = [np.interp(spent, effort[rising], c) for c in curve[rising].T]
    centres = np.column_stack(columns)
    centres[-1] = curve[-1]
    return centres
