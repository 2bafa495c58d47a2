"""Values about contact: where the CoM may be, and what has met what."""

from dataclasses import dataclass, field

import numpy as np

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector


@dataclass(frozen=True, eq=False)
class StancePolygon(Value):
    """Static-stability polygon: CoM positions in which the robot can stand still."""

    vertices: Vector = field(default_factory=lambda: np.zeros((0, 2)))
    """Counter-clockwise vertices (x, y) in W, (n, 2), m; empty where none exists."""
    status: str = "empty"
    """"ok", or why there is no polygon."""
    margin: float = float("nan")
    """Signed distance of the CoM to the nearest edge, m, positive inside."""


@dataclass(frozen=True, eq=False)
class Touch(Value):
    """Part of the robot that met part of the scene, or of itself."""

    body: str
    """The robot's body."""
    solid: str
    """The scene's solid, e.g. "staircase/step_2", or another of the robot's bodies."""
    duration: float
    """Total duration of their contact, s."""
    peak_force: float
    """The largest contact force between them, N."""


@dataclass(frozen=True, eq=False)
class Touches(Value):
    """Every pair that has met since the start."""

    touches: tuple[Touch, ...] = ()
    """One entry a pair, by body and then by solid."""
