"""A hand on a rail or a wall as a contact of the stance."""

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix

from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import Contact


def hand_contact(
    p_WHand: Vector,
    normal: Vector,
    friction: float,
    half_length: float = 0.0,
    half_width: float = 0.0,
) -> Contact:
    """Makes the contact of a hand that leans on a surface.

    A hand that closes around a rail can also pull; what it surely can do is push, and
    only that is counted.

    Args:
        p_WHand: where the hand's middle touches, (3,), m.
        normal: out of the surface towards the robot, (3,), of any length: up from the
            top of a rail, across from a wall.
        friction: mu of the four-sided pyramid.
        half_length: of the palm across the rail's horizontal direction, m; 0 for a
            point that exerts no torque.
        half_width: of the palm along that direction, m.

    Returns:
        The contact; its y is horizontal.

    Raises:
        ValueError: the normal has no length, or a size or the friction is negative.
    """
    length = float(np.linalg.norm(normal))
    if not (np.isfinite(length) and length > 0.0):
        raise ValueError(f"normal: must have a length, got {normal}")
    z: Vector = np.asarray(normal, dtype=np.float64) / length
    level = np.cross([0.0, 0.0, 1.0], z)
    if np.linalg.norm(level) < 1e-9:
        level = np.array([0.0, 1.0, 0.0])
    y = level / np.linalg.norm(level)
    R: Vector = np.column_stack([np.cross(y, z), y, z])
    p: Vector = np.asarray(p_WHand, dtype=np.float64)
    X_WC = RigidTransform(RotationMatrix(R), p)
    return Contact(X_WC, half_length, half_width, friction)
