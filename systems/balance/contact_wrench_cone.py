"""Contact wrench cone of a rectangular contact, as inequalities and as generators.

A wrench is w = (f, tau), force first, of the ground on the robot, (6,), N and N m. A
contact frame C has its origin at the rectangle's centre, x along the half length X,
y along the half width Y and z along the normal out of the ground. Friction is the
four-sided pyramid |f_x| <= mu f_z, |f_y| <= mu f_z in the axes of C, as in Caron,
Pham and Nakamura, "Stability of surface contacts for humanoid robots" (ICRA 2015):
mu is the pyramid's coefficient; the pyramid inside Coulomb's cone has mu / sqrt(2).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.math import RigidTransform, VectorToSkewSymmetric

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector

_SIGNS = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])


@dataclass(frozen=True, eq=False)
class Contact(Value):
    """A rectangle (a line or a point, where a half length is 0) that may push."""

    X_WC: RigidTransform
    """Pose of the contact frame C."""
    half_length: float
    """X, half the side along C's x, m; 0 for a point."""
    half_width: float
    """Y, half the side along C's y, m; 0 for a point."""
    friction: float
    """mu of the four-sided pyramid; 0 for ice."""

    def __post_init__(self) -> None:
        """Refuses what is no contact.

        Raises:
            ValueError: a size or the friction is negative or not finite.
        """
        _check(self.half_length, self.half_width, self.friction)

    def corners(self) -> Vector:
        """Computes the corners p_WCorner, (4, 3), m, counter-clockwise from above."""
        p_C = np.zeros((3, 4))
        p_C[:2] = (_SIGNS * [self.half_length, self.half_width]).T
        return np.asarray(self.X_WC.multiply(p_C).T)


def point_contact(X_WC: RigidTransform, friction: float) -> Contact:
    """Makes a contact that exerts no torque at its point: a hand, a fist."""
    return Contact(X_WC, 0.0, 0.0, friction)


def sole_contact(
    X_WF: RigidTransform, heel: float, toe: float, half_width: float, friction: float
) -> Contact:
    """Makes the contact of a sole whose frame F is not at the rectangle's centre.

    Args:
        X_WF: pose of the sole frame F (origin under the ankle, x to the toes).
        heel: distance from F back to the heel, m.
        toe: distance from F forward to the toes, m.
        half_width: Y, m.
        friction: mu of the pyramid.

    Returns:
        The contact; its frame C is F moved to the centre of the sole.
    """
    p_FC: Vector = np.array([0.5 * (toe - heel), 0.0, 0.0])
    X_WC = X_WF.multiply(RigidTransform(p_FC))
    return Contact(X_WC, 0.5 * (toe + heel), half_width, friction)


def contact_wrench_cone(half_length: float, half_width: float, mu: float) -> Vector:
    """Computes A of the cone A w <= 0 in closed form (Caron 2015, Eqs. 8 to 13).

    |f_x|, |f_y| <= mu f_z; f_z >= 0; |tau_x| <= Y f_z; |tau_y| <= X f_z;
    tau_min <= tau_z <= tau_max, of a sole of half-lengths X, Y.

    Rows: four of friction, four of the centre of pressure, eight of the yaw torque.
    With half_length = half_width = 0 they say that a point exerts no torque.

    Args:
        half_length: X, m.
        half_width: Y, m.
        mu: friction of the pyramid.

    Returns:
        A, (16, 6): the contact holds exactly where A w <= 0, w = (f, tau) in C.

    Raises:
        ValueError: an argument is negative or not finite.
    """
    _check(half_length, half_width, mu)
    X, Y = half_length, half_width
    k = (X + Y) * mu
    return np.array(
        [
            [-1, 0, -mu, 0, 0, 0],
            [1, 0, -mu, 0, 0, 0],
            [0, -1, -mu, 0, 0, 0],
            [0, 1, -mu, 0, 0, 0],
            [0, 0, -Y, -1, 0, 0],
            [0, 0, -Y, 1, 0, 0],
            [0, 0, -X, 0, -1, 0],
            [0, 0, -X, 0, 1, 0],
            [-Y, -X, -k, mu, mu, -1],
            [-Y, X, -k, mu, -mu, -1],
            [Y, -X, -k, -mu, mu, -1],
            [Y, X, -k, -mu, -mu, -1],
            [Y, X, -k, mu, mu, 1],
            [Y, -X, -k, mu, -mu, 1],
            [-Y, X, -k, -mu, mu, 1],
            [-Y, -X, -k, -mu, -mu, 1],
        ],
        dtype=np.float64,
    )


def contact_wrench_generators(
    half_length: float, half_width: float, mu: float
) -> Vector:
    """Computes the cone's generators G: the edges of the corners' friction pyramids.

    Args:
        half_length: X, m.
        half_width: Y, m.
        mu: friction of the pyramid.

    Returns:
        G, (6, 16): the contact holds exactly where w = G l, l >= 0. Four columns a
        corner, each with f_z = 1; a point (X = Y = 0) has its four, (6, 4).

    Raises:
        ValueError: an argument is negative or not finite.
    """
    _check(half_length, half_width, mu)
    corners = _SIGNS * [half_length, half_width]
    if half_length == 0.0 and half_width == 0.0:
        corners = corners[:1]
    x, y = np.repeat(corners, 4, axis=0).T
    f_x, f_y = np.tile(mu * _SIGNS, (len(corners), 1)).T
    one = np.ones_like(x)
    return np.array([f_x, f_y, one, y, -x, x * f_y - y * f_x])


def wrench_transform(X_WC: RigidTransform, p_WQ: Vector | None = None) -> Vector:
    """Computes the matrix that carries a wrench at C, in C, to one about Q, in W.

    Args:
        X_WC: pose of the contact frame.
        p_WQ: point that the torque is taken about, (3,), m; the world's origin if None.

    Returns:
        T, (6, 6): (f_W, tau_WQ) = T (f_C, tau_C).
    """
    R, lever = _rotation_and_lever(X_WC, p_WQ)
    T = np.zeros((6, 6))
    T[:3, :3] = T[3:, 3:] = R
    T[3:, :3] = lever @ R
    return T


def contact_wrench_cone_world(contact: Contact, p_WQ: Vector | None = None) -> Vector:
    """Computes the cone's inequalities on the wrench in W, A_W w <= 0.

    Args:
        contact: the contact.
        p_WQ: point that the torque is taken about, (3,), m; the world's origin if None.

    Returns:
        A_W, (16, 6): A_W w <= 0 for w = (f_W, tau_WQ).
    """
    A = contact_wrench_cone(contact.half_length, contact.half_width, contact.friction)
    R, lever = _rotation_and_lever(contact.X_WC, p_WQ)
    T_inverse = np.zeros((6, 6))
    T_inverse[:3, :3] = T_inverse[3:, 3:] = R.T
    T_inverse[3:, :3] = -R.T @ lever
    return np.asarray(A @ T_inverse)


def contact_wrench_generators_world(
    contact: Contact, p_WQ: Vector | None = None
) -> Vector:
    """Computes the cone's generators in W.

    Args:
        contact: the contact.
        p_WQ: point that the torque is taken about, (3,), m; the world's origin if None.

    Returns:
        G_W, (6, 16), of a point (6, 4): w = (f_W, tau_WQ) = G_W l, l >= 0.
    """
    G = contact_wrench_generators(
        contact.half_length, contact.half_width, contact.friction
    )
    return np.asarray(wrench_transform(contact.X_WC, p_WQ) @ G)


def stance_generators(
    contacts: Sequence[Contact], p_WQ: Vector | None = None
) -> Vector:
    """Computes the generators of the stance's wrench cone: those of every contact.

    The stair paper's Eqs. 4 and 5: what all contacts together can exert is the sum of
    their cones, so its generators are theirs, side by side.

    Args:
        contacts: the stance; may be empty.
        p_WQ: point that the torque is taken about, (3,), m; the world's origin if None.

    Returns:
        G, (6, m): the total wrench about Q, in W, is G l with l >= 0.
    """
    blocks = [contact_wrench_generators_world(contact, p_WQ) for contact in contacts]
    return np.hstack([np.zeros((6, 0)), *blocks])


def _rotation_and_lever(
    X_WC: RigidTransform, p_WQ: Vector | None
) -> tuple[Vector, Vector]:
    """Computes R_WC and the cross-product matrix of p_QC in W."""
    p_QC = X_WC.translation() - (np.zeros(3) if p_WQ is None else p_WQ)
    return np.asarray(X_WC.rotation().matrix()), VectorToSkewSymmetric(p_QC)


def _check(half_length: float, half_width: float, mu: float) -> None:
    for name, value in (
        ("half_length", half_length),
        ("half_width", half_width),
        ("friction", mu),
    ):
        if not 0.0 <= value < np.inf:
            raise ValueError(f"{name}: must be finite and not negative, got {value}")
