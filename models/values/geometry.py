"""Plane geometry that more than one package needs: angles, headings, rectangles."""

from math import atan2, cos, pi, sin
from typing import overload

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.values.vector import Vector

_RECTANGLE: Vector = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_RECTANGLE.setflags(write=False)


@overload
def wrap_angle(angle: float) -> float: ...


@overload
def wrap_angle(angle: Vector) -> Vector: ...


def wrap_angle(angle: float | Vector) -> float | Vector:
    """Wraps angles of any shape to [-pi, pi), rad."""
    return (angle + pi) % (2.0 * pi) - pi


def heading(X_WF: RigidTransform) -> float:
    """Computes the yaw of a frame's x axis in W, rad."""
    x_W = X_WF.rotation().matrix()[:, 0]
    return atan2(x_W[1], x_W[0])


def direction(yaw: float) -> Vector:
    """Computes the horizontal unit vector (cos yaw, sin yaw), (2,)."""
    return np.array([np.cos(yaw), np.sin(yaw)])


def rotate(angle: float, points: Vector) -> Vector:
    """Rotates horizontal points (..., 2), m, by `angle`, rad, about the origin."""
    c, s = cos(angle), sin(angle)
    rotated: Vector = points @ np.array([[c, s], [-s, c]])
    return rotated


def rectangle_corners(size: Vector) -> Vector:
    """Computes the corners of a rectangle in its frame R.

    Args:
        size: side lengths along R's x and y, (2,), m; R's origin is at the centre.

    Returns:
        (4, 2), m, counter-clockwise from (-x, -y).
    """
    corners: Vector = _RECTANGLE * (np.asarray(size) / 2.0)
    return corners


def rectangle_corners_world(X_WR: RigidTransform, size: Vector) -> Vector:
    """Computes the corners of a rectangle in W.

    Args:
        X_WR: pose of its frame R: origin at its centre, z along its normal.
        size: side lengths along R's x and y, (2,), m.

    Returns:
        (4, 3), m, counter-clockwise about the normal from (-x, -y).
    """
    p_R: Vector = np.column_stack([rectangle_corners(size), np.zeros(4)])
    return np.array(X_WR.multiply(p_R.T)).T
