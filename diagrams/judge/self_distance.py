"""How near the robot's own bodies truly came to each other."""

from dataclasses import dataclass

import numpy as np

from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.vector import Vector

TICK = 0.025
"""Between the postures that are looked at, s."""
REACH = 0.1
"""Bodies farther apart than this are not measured, m."""
TOUCH = 1e-3
"""Once two bodies have met, so far is looked for others that are deeper in each other,
m."""


@dataclass(frozen=True)
class NearestApproach:
    """The nearest that two bodies of a robot came to each other."""

    distance: float
    """m; negative where they were inside each other."""
    bodies: tuple[str, str]
    """Which two, in alphabetical order."""
    time: float
    """s."""


def nearest_approach(
    meter: SelfDistanceMeter, time: Vector, positions: Vector
) -> NearestApproach | None:
    """Finds the least distance between two of a robot's bodies that may collide.

    Args:
        meter: of the robot.
        time: (n,), s.
        positions: q of the robot, (n, nq).

    Returns:
        The nearest pair; None where no two bodies came within `REACH`.
    """
    step = max(1, round(TICK / float(np.median(np.diff(time))))) if len(time) > 1 else 1
    best: NearestApproach | None = None
    for row in range(0, len(time), step):
        reach = REACH if best is None else max(best.distance, TOUCH)
        found = meter.nearest(positions[row], reach)
        if found.bodies[0] and (best is None or found.distance < best.distance):
            best = NearestApproach(found.distance, found.bodies, float(time[row]))
    return best
