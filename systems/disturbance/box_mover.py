"""Moves boxes: where their slides are to be, over time."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.ports import set_vector
from footfall.systems.timing import timed


@dataclass(frozen=True)
class BoxMotion:
    """Straight motion of one box."""

    start: tuple[float, float]
    """Position before the motion, m."""
    end: tuple[float, float]
    """Position after the motion, m."""
    time: float
    """Time at which it begins to move, s."""
    duration: float
    """Duration of the motion, s."""


def box_motion(motion: BoxMotion, time: float) -> tuple[Vector, Vector]:
    """Computes minimum-jerk position and velocity at a time, (2,) each, m and m/s."""
    u = float(np.clip((time - motion.time) / motion.duration, 0.0, 1.0))
    way = np.subtract(motion.end, motion.start)
    position = motion.start + way * (u**3 * (10.0 - 15.0 * u + 6.0 * u**2))
    rate = 30.0 * u**2 * (1.0 - u) ** 2 / motion.duration
    return position, way * rate


class BoxMover(LeafSystem):
    """Tells the servos of moving boxes where to be.

    .. pydrake_system::

        name: BoxMover
        output_ports:
        - desired_state

    - `desired_state`: x, y of each box, then their rates, (4 n,), m and m/s.
    """

    def __init__(self, motions: Sequence[BoxMotion]) -> None:
        """Declares the port.

        Args:
            motions: one a box, in the order of the plant's actuators.
        """
        super().__init__()
        self._motions = tuple(motions)
        self.DeclareVectorOutputPort(
            "desired_state",
            4 * len(self._motions),
            timed(self, self._calc),
            prerequisites_of_calc={self.time_ticket()},
        )

    def _calc(self, context: Context, output: BasicVector) -> None:
        states = [box_motion(motion, context.get_time()) for motion in self._motions]
        positions = [position for position, _ in states]
        velocities = [velocity for _, velocity in states]
        set_vector(output, np.concatenate([*positions, *velocities]))
