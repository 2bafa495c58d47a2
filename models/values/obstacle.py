"""Values on the ports of an obstacle crossing: obstacles and key configurations.

As all of `footfall.models.values`: frozen, comparable, each with a JSON form. W: z up.
"""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector


@dataclass(frozen=True, eq=False)
class Obstacle(Value):
    """A rectangular obstacle on the floor, as the robot sees it."""

    center: Vector
    """Middle of its footprint in W, (2,), m."""
    yaw: float
    """Direction across it (its thin side) about z of W, within half a turn of the
    direction it was seen from, rad."""
    width: float
    """o_w, along that direction, m (obstacle paper, Sec. III)."""
    height: float
    """o_h, above the floor, m."""
    length: float
    """Across that direction, m."""
    support_count: int = 0
    """Number of points that it was fitted to."""


@dataclass(frozen=True, eq=False)
class ObstacleMap(Value):
    """Obstacles and floor that the scans have shown."""

    obstacles: tuple[Obstacle, ...] = ()
    """Nearest first."""
    floor_height: float = float("nan")
    """Height of the floor they stand on, in W, m; nan where no floor was seen."""
    status: Literal["none", "ok", "no floor"] = "none"
    """"none" before the first scan."""
    floor_outline: Vector = field(default_factory=lambda: np.zeros((0, 2)))
    """Corners of the hull of the floor that was seen, in W, (n, 2), m."""
    sensed_at: float | None = None
    """Time at which the work on its sweep began, s; None for a cloud without a time."""


@dataclass(frozen=True, eq=False)
class KeyConfiguration(Value):
    """The double support over an obstacle (obstacle paper, Fig. 1 and Eq. 22)."""

    X_ads: float
    """Step length, ankle to ankle, m."""
    X_hds: float
    """Rear ankle to waist, m."""
    Z_hds: float
    """Height of the waist (the hips) above the ground, m."""
    front: float
    """Rear ankle to the front face of the obstacle, m."""
    X_end: float | None = None
    """Rear ankle to waist as phase 2 ends, m: a quasi-static one takes the CoM from the
    rear foot (X_hds, Z_hds) to the front one; None where the waist hardly moves."""
    Z_end: float | None = None
    """Height of the waist then, m."""


@dataclass(frozen=True, eq=False)
class Feasibility(Value):
    """The answer of the feasibility unit."""

    key: KeyConfiguration | None = None
    constraint: str = ""
    """The constraint that fails, in one line; empty where there is a key."""


def across(yaw: float) -> Vector:
    """Computes the horizontal unit vector (cos yaw, sin yaw), (2,)."""
    return np.array([np.cos(yaw), np.sin(yaw)])
