"""Vector signals that are logged, and what their columns are called."""

from collections.abc import Sequence
from typing import NamedTuple

from footfall.models.values.feet import FEET

XYZ = ("x", "y", "z")
WRENCH = ("fx", "fy", "fz", "mx", "my", "mz")
WRENCH_UNITS = ("N",) * 3 + ("N m",) * 3
_UNITS = {
    "qw": "1",
    "qx": "1",
    "qy": "1",
    "qz": "1",
    "x": "m",
    "y": "m",
    "z": "m",
    "q": "rad",
    "w": "rad/s",
    "wx": "rad/s",
    "wy": "rad/s",
    "wz": "rad/s",
    "vx": "m/s",
    "vy": "m/s",
    "vz": "m/s",
}
"""By the suffixes that Drake gives the elements of a plant's state."""


class LoggedVector(NamedTuple):
    """A vector port that is logged."""

    name: str
    """Of the signal."""
    port: str
    """"SYSTEM.PORT"."""
    columns: tuple[str, ...]
    units: tuple[str, ...] | str


def both_feet(names: Sequence[str]) -> tuple[str, ...]:
    """Names the columns of both feet."""
    return tuple(f"{side}_{name}" for side in FEET for name in names)


def state_units(names: Sequence[str]) -> tuple[str, ...]:
    """Gives the units of a plant's state by the names of its elements."""
    return tuple(_UNITS[name.rpartition("_")[2]] for name in names)
