"""Whether and when a robot fell, from what truly happened; pure."""

from typing import NamedTuple

import numpy as np

from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector

FALLEN_HEIGHT = 0.6
"""A robot has fallen when its base is lower above the lower foot than this share of
where it began."""
FALLEN_TILT = np.deg2rad(60.0)
"""A robot has fallen when its torso leans more than this, rad."""
BEARS_WEIGHT = 0.1
"""A robot has fallen when this share of its weight is borne by something else than its
soles."""


class Fall(NamedTuple):
    """The first sign of a fall."""

    time: float
    """s."""
    how: str
    """In a few words."""


def base_height(motion: TrueMotion) -> Vector:
    """Height of the base above the lower foot, (n,), m."""
    feet = np.stack([motion.X_WF[foot][:, 2, 3] for foot in FEET])
    height: Vector = motion.base[:, 2] - feet.min(axis=0)
    return height


def fall_sign(
    height: float, initial_height: float, torso_up: float, other_support: float
) -> str | None:
    """Says in a few words by what a robot has fallen; None where it has not.

    Args:
        height: of the base above the lower foot, m.
        initial_height: the same at the start, m.
        torso_up: cosine of the torso's angle to the vertical.
        other_support: share of the weight that something else than the soles bears.
    """
    if height < FALLEN_HEIGHT * initial_height:
        return f"its base sank to {height:.2f} m above its feet"
    if torso_up < np.cos(FALLEN_TILT):
        tilt = np.degrees(np.arccos(np.clip(torso_up, -1.0, 1.0)))
        return f"its torso leaned by {tilt:.0f} deg"
    if other_support >= BEARS_WEIGHT:
        return f"something else than its soles bore {other_support:.0%} of its weight"
    return None


def find_fall(
    motion: TrueMotion, support_time: Vector, other_support: Vector
) -> Fall | None:
    """Finds the first sign of a fall in a run; None where there is none.

    Args:
        motion: n samples.
        support_time: (m,), s.
        other_support: then, share of the weight that something else than the soles
            bore, (m,).
    """
    height = base_height(motion)
    lies = (height < FALLEN_HEIGHT * height[0]) | (
        motion.torso_up < np.cos(FALLEN_TILT)
    )
    signs = []
    for index in np.flatnonzero(lies)[:1]:
        how = fall_sign(height[index], height[0], motion.torso_up[index], 0.0)
        signs.append(Fall(float(motion.time[index]), str(how)))
    for index in np.flatnonzero(other_support >= BEARS_WEIGHT)[:1]:
        how = fall_sign(1.0, 0.0, 1.0, other_support[index])
        signs.append(Fall(float(support_time[index]), str(how)))
    return min(signs, default=None)
