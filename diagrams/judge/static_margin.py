"""How far inside the static-stability polygon the true CoM was; pure."""

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix

from footfall.diagrams.judge.measures import LIFTED, LIFTED_CORNER
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import Contact, sole_contact
from footfall.systems.balance.convex_polygon import signed_margin
from footfall.systems.balance.sole_contacts import moved_by
from footfall.systems.balance.stability_polygon import static_polygon

TICK = 0.025
"""Between the postures that are looked at, s."""
UNMOVED = 1e-3
"""A stance whose soles moved less than this keeps its polygon, m."""
NARROW = 1e-4
"""Length that carries of a sole that stands on its edge, m."""


def true_contact(X_WF: Vector, corners: Vector, friction: float) -> Contact:
    """Computes the part of a sole on the ground: all of it, or its edge where it rolls.

    Args:
        X_WF: pose of the sole frame, (4, 4).
        corners: of the sole: heel right, toe right, toe left, heel left, (4, 3), m.
        friction: mu.
    """
    heights = corners[:, 2]
    low = heights < heights.min() + LIFTED_CORNER
    X = RigidTransform(X_WF)
    # To a nanometre, so that the same sole has the same size in every posture.
    p_F: Vector = np.round(np.array(X.inverse().multiply(corners.T)).T, 9)
    heel, toe, half_width = -float(p_F[0, 0]), float(p_F[1, 0]), float(p_F[2, 1])
    if low.all():
        return sole_contact(X, heel, toe, half_width, friction)
    on_toes = heights[[1, 2]].mean() < heights[[0, 3]].mean()
    ends = corners[[1, 2]] if on_toes else corners[[0, 3]]
    yaw = float(np.arctan2(X_WF[1, 0], X_WF[0, 0]))
    p_WE: Vector = ends.mean(axis=0)
    X_WE = RigidTransform(RotationMatrix.MakeZRotation(yaw), p_WE)
    return sole_contact(X_WE, NARROW, NARROW, half_width, friction)


def static_margins(
    motion: TrueMotion, loads: dict[Foot, Vector], weight: float, friction: float
) -> Vector:
    """Signed distance of the true CoM to the polygon's edge, (k,), m, every `TICK`.

    The contacts are the true ones: of every foot that bears weight, the sole, or the
    edge that it rolls over. Minus infinity where the robot cannot stand still.

    Args:
        motion: n samples.
        loads: upward force on each foot, (n,), N.
        weight: of the robot, N.
        friction: mu between sole and ground.
    """
    steps = np.diff(motion.time)
    step = max(1, round(TICK / float(np.median(steps)))) if len(steps) else 1
    held: tuple[tuple[Contact, ...], Vector] | None = None
    margins = []
    for row in range(0, len(motion.time), step):
        stance = tuple(
            true_contact(
                motion.X_WF[foot][row], motion.sole_corners[foot][row], friction
            )
            for foot in FEET
            if loads[foot][row] > LIFTED * weight
        )
        if held is None or not _same(stance, held[0]):
            vertices = static_polygon(stance).vertices if stance else np.zeros((0, 2))
            held = (stance, vertices)
        margins.append(signed_margin(held[1], motion.com[row, :2]))
    return np.array(margins)


def _same(a: tuple[Contact, ...], b: tuple[Contact, ...]) -> bool:
    return len(a) == len(b) and all(
        moved_by(one, other) <= UNMOVED for one, other in zip(a, b, strict=True)
    )
