"""The points, directions and angles that commands on point clouds take."""

import math
from typing import TYPE_CHECKING

from footfall.diagrams.cli.errors import OptionError

if TYPE_CHECKING:
    from footfall.models.values.vector import Vector


def parse_direction(text: str) -> "Vector":
    """Reads --gravity.

    Raises:
        OptionError: it is no direction.
    """
    direction = _parse_vector(text)
    if direction is None or not direction.any():
        raise OptionError(
            f"--gravity: must be three numbers X,Y,Z, not all zero, got {text!r}"
        )
    return direction


def parse_viewpoint(text: str) -> "Vector":
    """Reads --viewpoint.

    Raises:
        OptionError: it is no point.
    """
    point = _parse_vector(text)
    if point is None:
        raise OptionError(f"--viewpoint: must be three numbers X,Y,Z, got {text!r}")
    return point


def _parse_vector(text: str) -> "Vector | None":
    """Reads X,Y,Z; None where it is no three finite numbers."""
    import numpy as np

    try:
        numbers = np.array([float(part) for part in text.split(",")])
    except ValueError:
        return None
    return numbers if numbers.shape == (3,) and np.isfinite(numbers).all() else None


def parse_slope(degrees: float) -> float:
    """Reads --slope, in degrees, as rad.

    Raises:
        OptionError: it is no slope.
    """
    if not 0.0 < degrees < 90.0:
        raise OptionError(
            f"--slope: must lie between 0 and 90 degrees, got {degrees:g}"
        )
    return math.radians(degrees)
