"""Where the beams of a scanner on a tilt servo go, and where their returns lie.

Frames: M, the base of the servo, x forward, y left, z up; L, the scanner, equal to M
but for the tilt about their common y. The beams fan out in L's xy-plane.
"""

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix

from footfall.models.values.vector import Vector


def beam_angles(field_of_view: float, resolution: float) -> Vector:
    """Directions of the beams about L's z, from right to left.

    Args:
        field_of_view: angle between the first and the last beam, rad.
        resolution: angle between neighbours, rad.

    Returns:
        Angles from L's x, symmetric about it, (n,), rad.
    """
    intervals = round(field_of_view / resolution)
    return np.linspace(-field_of_view / 2.0, field_of_view / 2.0, intervals + 1)


def tilt_pose(tilt: float) -> RigidTransform:
    """X_ML of a tilt, rad, positive looking down."""
    return RigidTransform(RotationMatrix.MakeYRotation(tilt))


def beam_directions(angles: Vector) -> Vector:
    """Unit vectors of the beams in L, (n, 3), for angles (n,), rad."""
    return np.column_stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)])


def line_to_points(ranges: Vector, angles: Vector, X_WL: RigidTransform) -> Vector:
    """Computes the points that a line of ranges saw.

    Args:
        ranges: measured ranges, (n,), m; inf and nan are no returns.
        angles: directions of the beams, (n,), rad.
        X_WL: pose of the scanner when the line was taken.

    Returns:
        Points in W, (k, 3), m, of the k finite ranges in their order.
    """
    seen = np.isfinite(ranges)
    p_L: Vector = ranges[seen, np.newaxis] * beam_directions(angles[seen])
    R_WL: Vector = X_WL.rotation().matrix()
    p_WL: Vector = X_WL.translation()
    return p_L @ R_WL.T + p_WL
