"""The questions that are put to a gravito-inertial wrench cone, one form for all.

Each asks for which points of a horizontal plane some wrench lies in the cone, and the
wrench is affine in the point: w(p) = w_0 + W p. Wrenches are per weight (force 1, not
m g) about a point Q near the contacts, and p is measured from Q; both keep numbers
near one, without which double description in floats is unreliable.
"""

from dataclasses import dataclass

import numpy as np
from pydrake.math import VectorToSkewSymmetric

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import GRAVITY


@dataclass(frozen=True, eq=False)
class WrenchSlice:
    """The wrench w_0 + W p that the contacts exert, per weight, about Q, in W."""

    w_0: Vector
    """Wrench (force, torque) at p = 0, (6,), 1 and m."""
    W: Vector
    """Derivative of the wrench by p, (6, 2), 1/m and 1."""

    def at(self, points: Vector) -> Vector:
        """Computes the wrenches at points, (n, 2), m from Q; (n, 6)."""
        return np.asarray(self.w_0 + points @ self.W.T)


def static_slice() -> WrenchSlice:
    """Makes the slice of a CoM above p, at rest: w = (0, 0, 1; p x e_z)."""
    return accelerated_slice(np.zeros(3), 0.0)


def accelerated_slice(acceleration: Vector, height: float) -> WrenchSlice:
    """Makes the slice of a CoM above p that accelerates, with L_G constant.

    Args:
        acceleration: a_WCom, (3,), m/s^2.
        height: of the CoM over Q, m.

    Returns:
        The slice; p is the CoM's horizontal position from Q.
    """
    f_x, f_y, f_z = np.array([0.0, 0.0, 1.0]) + acceleration / GRAVITY
    w_0 = np.array([f_x, f_y, f_z, -height * f_y, height * f_x, 0.0])
    W = np.zeros((6, 2))
    W[4, 0], W[5, 0] = -f_z, f_y
    W[3, 1], W[5, 1] = f_z, -f_x
    return WrenchSlice(w_0, W)


def zmp_slice(p_QCom: Vector, plane_height: float) -> WrenchSlice:
    """Makes the slice of a ZMP at p, the force pointing at a CoM of constant height.

    Args:
        p_QCom: CoM from Q, (3,), m.
        plane_height: of the plane in which the ZMP is taken, over Q, m.

    Returns:
        The slice; p is the ZMP's horizontal position from Q.

    Raises:
        ValueError: the CoM lies in the plane.
    """
    x, y, z = p_QCom
    lever = z - plane_height
    if lever == 0.0:
        raise ValueError(f"plane_height: must differ from the CoM's, got {z} m")
    cross = VectorToSkewSymmetric(p_QCom)
    force = np.array([x / lever, y / lever, 1.0])
    turn = np.zeros((3, 2))
    turn[0, 0] = turn[1, 1] = -1.0 / lever
    return WrenchSlice(
        np.concatenate([force, cross @ force]), np.vstack([turn, cross @ turn])
    )
