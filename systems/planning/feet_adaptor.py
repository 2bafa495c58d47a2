"""FTA: small corrections that keep the legs off the obstacle through the whole motion.

Obstacle paper, Sec. III-E. The feasibility unit looks at the double support alone; in
phase 3 the knee or the shin of the second leg may still meet the obstacle. Three
repairs, in the paper's order: the foot's way is moved to the rear, the waist is
raised, and last the foot yields by the penetration, through Jacobians (Eqs. 23 to 25).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from systems.obstacle_values import Obstacle, across
from systems.planning.crossing_timing import TimedStep
from systems.planning.leg_clearance import Section, outline_gap
from systems.planning.leg_model import LegModel, outline_points
from systems.ports import Vector
from systems.values import FEET

M = TypeVar("M")
SHIFT = 0.01
"""By which the foot's way is moved to the rear at a time, m."""
RAISE = 0.01
"""By which the waist is raised at a time, m."""
KNOTS = 25
"""Samples of a foot's way at which the third repair moves it."""


@dataclass(frozen=True, eq=False)
class Repairs:
    """What was changed in a motion."""

    shift: float = 0.0
    """The second foot's way over the obstacle is moved to the rear by this, m."""
    raised: float = 0.0
    """The waist is raised by this in phase 3, m."""
    lowered: float = 0.0
    """The waist is lowered by this in phase 2, m, where a leg was out of reach."""
    path: Vector = field(default_factory=lambda: np.zeros(0))
    """Displacement of the second foot along the heading at equal shares of its step,
    m; empty for none."""


def leg_gaps(
    leg: LegModel,
    angles: Vector,
    soles: Vector,
    obstacles: tuple[Obstacle, ...],
    sections: tuple[Section, ...],
    shifts: list[float],
    ground: float,
) -> Vector:
    """Distances of both legs to every obstacle.

    Args:
        leg: the legs.
        angles: leg joints, left first, (n, 2, 6), rad.
        soles: sole poses, (n, 2, 6).
        obstacles: where they stand.
        sections: their sizes, or those with margins.
        shifts: how far each section's front is before the obstacle's, m.
        ground: height of the floor, m.

    Returns:
        (m, n, 2), m; see `outline_gap`.
    """
    gaps = np.zeros((len(obstacles), len(angles), 2))
    for i, foot in enumerate(FEET):
        points, _ = outline_points(leg, foot, angles[:, i], soles[:, i])
        for k, (obstacle, section) in enumerate(zip(obstacles, sections, strict=True)):
            along = (points[:, :, :2] - obstacle.center) @ across(obstacle.yaw)
            x = along + obstacle.width / 2.0 + shifts[k]
            planar = np.stack([x, points[:, :, 2] - ground], axis=2)
            gaps[k, :, i] = outline_gap(planar, section)
    return gaps


def adapt(
    motion_of: Callable[[Repairs], tuple[M, object, Vector]],
    gaps_of: Callable[[M, Vector], Vector],
    time: Vector,
    steps: tuple[TimedStep, ...],
    tries: int,
) -> tuple[Repairs, tuple[M, object, Vector]]:
    """Repairs a motion until nothing meets the inflated obstacles, or tries run out."""
    repairs = Repairs()
    best = motion_of(repairs)
    return repairs, best
