"""The contacts that two soles make with the ground, heels lifted or not."""

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix

from footfall.models.robots.robot import Sole
from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import Contact, sole_contact

LIFTED = 1e-6
"""A sole that carries on this much less than its length has its heel lifted, m."""


def carrying_contact(
    pose: Vector, length: float, sole: Sole, friction: float
) -> Contact:
    """Makes the contact of the part of a sole that carries.

    Args:
        pose: of the sole frame F in W: x, y, z, m, then roll, pitch, yaw, rad, (6,).
        length: of the sole that carries, from the toe edge back, m. Where it is less
            than the whole the heel is lifted; the ground under the toes is level.
        sole: the sole.
        friction: mu of the four-sided pyramid.

    Returns:
        The contact. That of lifted toes stays while the heel rises.
    """
    position: Vector = pose[:3]
    angles: Vector = pose[3:]
    X_WF = RigidTransform(RollPitchYaw(angles), position)
    if length >= sole.length - LIFTED:
        return sole_contact(X_WF, sole.heel, sole.toe, sole.half_width, friction)
    p_FE: Vector = np.array([sole.toe, 0.0, 0.0])
    p_WE: Vector = np.asarray(X_WF.multiply(p_FE))
    X_WE = RigidTransform(RotationMatrix.MakeZRotation(pose[5]), p_WE)
    return sole_contact(X_WE, length, 0.0, sole.half_width, friction)


def moved_by(a: Contact, b: Contact) -> float:
    """Measures the largest distance of corners between two contacts of one size, m.

    Infinity where they differ in size or friction.
    """
    if (a.half_length, a.half_width, a.friction) != (
        b.half_length,
        b.half_width,
        b.friction,
    ):
        return float("inf")
    return float(np.linalg.norm(a.corners() - b.corners(), axis=1).max())
