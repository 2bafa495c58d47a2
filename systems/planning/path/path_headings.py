"""How the robot faces on each leg of a path: the headings that cost the fewest steps.

On a long leg it pays to turn and walk forwards, on a short one to go sideways or back.
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import wrap


@dataclass(frozen=True)
class StepReach:
    """How far the robot's middle gets with a step, and how far it turns."""

    forward: float
    """m."""
    backward: float
    """m."""
    sideways: float
    """m; the foot that leads steps wider, the other one narrower."""
    turn: float
    """rad."""
    turn_narrows: float
    """How much wider a foot must step for each rad it is turned, as its toes or its
    heel come nearer to the other foot, m/rad."""

    def steps_to_turn(self, angle: Vector) -> Vector:
        """Steps, not whole, that turning by angles (...), rad, on the spot takes."""
        return np.asarray(np.abs(angle) / self.turn)

    def steps_to_go(self, distance: Vector, direction: Vector) -> Vector:
        """Steps, not whole, that going straight takes.

        Args:
            distance: (...), m.
            direction: of travel against the robot's heading, (...), rad.
        """
        along, across = distance * np.cos(direction), distance * np.sin(direction)
        ahead = np.maximum(along / self.forward, -along / self.backward)
        return np.maximum(ahead, np.abs(across) / self.sideways)


def choose_headings(
    points: Vector, start_yaw: float, goal_yaw: float, reach: StepReach
) -> Vector:
    """The headings that take the fewest steps, turning on the spot at the corners.

    Each leg may be walked forwards, backwards or to either side, or with the heading
    of the start, of the goal or one that suits another leg; the best choice of all
    together is found leg by leg (dynamic programming).

    Args:
        points: the path's corners, (n, 2), m, none twice in a row.
        start_yaw: heading at the start, rad.
        goal_yaw: heading at the goal, rad.
        reach: what a step covers.

    Returns:
        Headings of the n - 1 legs, rad.
    """
    legs = np.diff(points, axis=0)
    if not len(legs):
        return np.zeros(0)
    length = np.linalg.norm(legs, axis=1)
    direction = np.arctan2(legs[:, 1], legs[:, 0])
    own = (direction[:, None] + np.array([0.0, 0.5, 1.0, 1.5]) * pi).ravel()
    # Forwards on each leg comes first, so that it is taken where others are no better.
    headings = np.concatenate([direction, [start_yaw, goal_yaw], own])
    turning = reach.steps_to_turn(_wrapped(headings[:, None] - headings[None, :]))
    going = reach.steps_to_go(length[:, None], direction[:, None] - headings)
    cost = reach.steps_to_turn(_wrapped(headings - start_yaw)) + going[0]
    before: list[np.ndarray[tuple[int], np.dtype[np.int64]]] = []
    for leg in going[1:]:
        whole = cost[:, None] + turning
        best = np.argmin(whole, axis=0)
        before.append(best)
        cost = whole[best, np.arange(len(headings))] + leg
    chosen = [int(np.argmin(cost + reach.steps_to_turn(_wrapped(headings - goal_yaw))))]
    for best in reversed(before):
        chosen.append(int(best[chosen[-1]]))
    return np.array([wrap(headings[index]) for index in reversed(chosen)])


def _wrapped(angles: Vector) -> Vector:
    return np.asarray((angles + pi) % (2.0 * pi) - pi)
