"""Rotations and small turns as arrays of three, in plain numbers: a tick is short."""

import math

import numpy as np

from footfall.models.values.vector import Vector

_IDENTITY: Vector = np.eye(3)
_SMALL = 1e-8
"""Below this, rad, a turn is its own first order."""


SKEWS: Vector = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
)
"""Makes of vectors, (n, 3), all their `skew` at once, each row by row: (n, 9)."""


def skew(a: Vector) -> Vector:
    """Makes the matrix that takes b to a x b, (3, 3)."""
    x, y, z = a.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def exp_rotation(turn: Vector) -> Vector:
    """The rotation about an axis by its length (Rodrigues), (3, 3).

    Args:
        turn: axis times angle, (3,), rad.
    """
    x, y, z = turn.tolist()
    square = x * x + y * y + z * z
    angle = math.sqrt(square)
    if angle < _SMALL:
        s, c = 1.0, 0.5
    else:
        s, c = math.sin(angle) / angle, (1.0 - math.cos(angle)) / square
    xy, xz, yz = c * x * y, c * x * z, c * y * z
    return np.array(
        [
            [1.0 - c * (y * y + z * z), xy - s * z, xz + s * y],
            [xy + s * z, 1.0 - c * (x * x + z * z), yz - s * x],
            [xz - s * y, yz + s * x, 1.0 - c * (x * x + y * y)],
        ]
    )


def log_rotation(R: Vector) -> Vector:
    """The turn of a rotation, axis times angle, (3,), rad: inverse of `exp_rotation`.

    Args:
        R: (3, 3); turns by less than half a revolution.
    """
    (a, b, c), (d, e, f), (g, h, i) = R.tolist()
    axis: Vector = 0.5 * np.array([h - f, c - g, d - b])
    sine = math.sqrt(float(axis @ axis))
    angle = math.atan2(sine, 0.5 * (a + e + i - 1.0))
    if sine < _SMALL:
        return axis
    return axis * (angle / sine)


def left_jacobian(turn: Vector) -> Vector:
    """The left Jacobian of SO(3) at a turn, (3, 3): how exp carries vectors along.

    Args:
        turn: axis times angle, (3,), rad.
    """
    square = float(turn @ turn)
    angle = math.sqrt(square)
    matrix = skew(turn)
    if angle < 1e-4:
        # The second order is below 1e-9.
        J: Vector = _IDENTITY + 0.5 * matrix
        return J
    first = (1.0 - math.cos(angle)) / square
    second = (angle - math.sin(angle)) / (square * angle)
    J = _IDENTITY + first * matrix + second * (matrix @ matrix)
    return J
