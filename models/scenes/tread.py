"""The true upper face of a step: what the judge measures against."""

from dataclasses import dataclass

from pydrake.math import RigidTransform

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector


@dataclass(frozen=True, eq=False)
class Tread(Value):
    """The true upper face of one step, or of a landing."""

    name: str
    """What it is, e.g. "staircase/step_2"."""
    X_WR: RigidTransform
    """Pose of the rectangle: origin at its centre, x up the stairs, z out of it."""
    size: Vector
    """Depth along x and width along y, (2,), m."""
    outline: Vector | None = None
    """Where it is no rectangle its true outline in W seen from above, (n, 2), m."""
