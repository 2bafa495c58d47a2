"""FTA: small corrections that keep the legs off the obstacle through the whole motion.

Obstacle paper, Sec. III-E. The feasibility unit looks at the double support alone; in
phase 3 the knee or the shin of the second leg may still meet the obstacle. Three
repairs, in the paper's order: the foot's way is moved to the rear, the waist is
raised, and last the foot yields by the penetration, through Jacobians (Eqs. 23 to 25).
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from footfall.models.values.feet import FEET, Foot
from footfall.models.values.obstacle import Obstacle, across
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.leg_clearance import Section, outline_gap
from footfall.systems.planning.whole_body.leg_model import (
    LegModel,
    outline_points,
    rotations,
)

SHIFT = 0.01
"""By which the foot's way is moved to the rear at a time, m."""
RAISE = 0.01
"""By which the waist is raised at a time, m."""
FAR = 0.3
"""From where on a leg's distance to an obstacle need not be exact, m."""
KNOTS = 25
"""Samples of a foot's way at which the third repair moves it."""


@dataclass(frozen=True, eq=False)
class Repairs(Value):
    """What was changed in a motion."""

    shift: float = 0.0
    """The second foot's way over the obstacle is moved to the rear by this, m."""
    raised: float = 0.0
    """The waist is raised by this in the middle of phases 1 and 3, m."""
    lowered: float = 0.0
    """The waist is lowered by this in phase 2, m, where a leg was out of reach."""
    path: Vector = field(default_factory=lambda: np.zeros(0))
    """Displacement of the second foot along the heading at equal shares of its step,
    m; empty for none."""


class LegPoses(NamedTuple):
    """The legs along a motion."""

    angles: Vector
    """Leg joints, left first, (n, 2, 6), rad."""
    soles: Vector
    """Sole poses, (n, 2, 6)."""


def leg_gaps(
    leg: LegModel,
    angles: Vector,
    soles: Vector,
    obstacles: tuple[Obstacle, ...],
    sections: tuple[Section, ...],
    shifts: list[float],
    ground: float,
) -> Vector:
    """Distances of both legs to every obstacle.

    Args:
        leg: the legs.
        angles: leg joints, left first, (n, 2, 6), rad.
        soles: sole poses, (n, 2, 6).
        obstacles: where they stand.
        sections: their sizes, or those with margins.
        shifts: how far each section's front is before the obstacle's, m.
        ground: height of the floor, m.

    Returns:
        (m, n, 2), m; see `outline_gap`; beyond `FAR` the distance along the heading,
        which is no more than the true one.
    """
    gaps = np.zeros((len(obstacles), len(angles), 2))
    for i, foot in enumerate(FEET):
        points, _ = outline_points(leg, foot, angles[:, i], soles[:, i])
        for k, (obstacle, section) in enumerate(zip(obstacles, sections, strict=True)):
            along = (points[:, :, :2] - obstacle.center) @ across(obstacle.yaw)
            x = along + obstacle.width / 2.0 + shifts[k]
            planar = np.stack([x, points[:, :, 2] - ground], axis=2)
            ahead = np.maximum(x.min(axis=1) - section.width, -x.max(axis=1))
            gaps[k, :, i] = ahead
            near = ahead < FAR
            gaps[k, near, i] = outline_gap(planar[near], section)
    return gaps


def adapt(
    poses_of: Callable[[Repairs], LegPoses],
    gaps_of: Callable[[LegPoses], Vector],
    second: Callable[[LegPoses, Repairs], Repairs | None],
    knees: tuple[Vector, Vector],
    room: float,
    tries: int,
) -> Repairs:
    """Finds repairs after which nothing meets the inflated obstacles, if it can.

    Args:
        poses_of: the legs' motion for given repairs.
        gaps_of: distances of the legs to the inflated obstacles, (m, n, 2), m.
        second: the third repair: by Jacobians, from poses and the repairs so far; None
            where it changes nothing.
        knees: least and largest knee angle of either leg, (2,) each, rad: the waist is
            lowered in phase 2 for the one and raised in phases 1 and 3 for the other.
        room: how far the waist can be raised over a straight stance leg, m.
        tries: how often each repair is tried.

    Returns:
        The repairs with the largest least gap that were found.
    """
    repairs = Repairs()
    poses = poses_of(repairs)
    for _ in range(tries):
        bent = poses.angles[:, :, 3]
        stretched = bool((bent.min(axis=0) < knees[0]).any())
        folded = bool((bent.max(axis=0) > knees[1]).any())
        folded &= repairs.raised + RAISE <= room
        if not (stretched or folded):
            break
        repairs = replace(
            repairs,
            lowered=repairs.lowered + RAISE * stretched,
            raised=repairs.raised + RAISE * folded,
        )
        poses = poses_of(repairs)
    best, gap = repairs, _least(gaps_of(poses))
    if gap > 0.0:
        return best
    for change in (
        lambda r: replace(r, shift=r.shift + SHIFT),
        lambda r: (
            replace(r, raised=r.raised + RAISE) if r.raised + RAISE <= room else None
        ),
        lambda r: second(poses_of(r), r),
    ):
        for _ in range(tries):
            repairs_next = change(best)
            if repairs_next is None:
                break
            poses = poses_of(repairs_next)
            found = _least(gaps_of(poses))
            if found <= gap + 1e-4:
                break
            best, gap = repairs_next, found
            if gap > 0.0:
                return best
    return best


def _least(gaps: Vector) -> float:
    return float(gaps.min()) if gaps.size else np.inf


def ankle_displacement(
    leg: LegModel, foot: Foot, angles: Vector, p_K: Vector, depth: float
) -> float:
    """Computes the ankle's displacement dP for one dS of a shank point (Eqs. 23 to 25).

    dS = J_s dq (23), dP = J_p dq (24), so dP = J_p J_s^+ dS (25), with both Jacobians
    (3 x 4) of hip pitch, roll, yaw and knee in a frame attached to the waist; dS is
    horizontal. The paper takes J_s at the point where the leg meets the boundary of
    the obstacle; here a point half-way down the shank stands for it.

    Args:
        leg: the legs.
        foot: which.
        angles: of the leg, (6,), rad.
        p_K: the point in the shank's sagittal plane, from the knee, (x, z), m.
        depth: horizontal length of dS, m.

    Returns:
        Horizontal part of dP along dS, m.
    """
    axes, origins, R_PK, p_PKnee = _shank_chain(leg, foot, angles)
    p_PS = p_PKnee + R_PK @ np.array([p_K[0], 0.0, p_K[1]])
    p_PAnkle = p_PKnee + R_PK @ np.array([leg.shank[0], 0.0, leg.shank[1]])
    J_s = np.cross(axes, p_PS - origins).T
    J_p = np.cross(axes, p_PAnkle - origins).T
    dS = np.array([depth, 0.0, 0.0])
    return float((J_p @ np.linalg.pinv(J_s) @ dS)[0])


def _shank_chain(
    leg: LegModel, foot: Foot, angles: Vector
) -> tuple[Vector, Vector, Vector, Vector]:
    """Axes and origins of hip pitch, roll, yaw and knee in P, (4, 3); pose of K."""
    zero = 0.0
    pitch = rotations(np.array([[zero, angles[0], zero]]))[0]
    roll = rotations(np.array([[angles[1], zero, zero]]))[0]
    yaw = rotations(np.array([[zero, zero, angles[2]]]))[0]
    knee = rotations(np.array([[zero, angles[3], zero]]))[0]
    hip = leg.hips[foot]
    R_PT = pitch @ roll @ yaw
    p_PKnee = hip + R_PT @ np.array([leg.thigh[0], 0.0, leg.thigh[1]])
    axes = np.array([[0.0, 1.0, 0.0], pitch[:, 0], (pitch @ roll)[:, 2], R_PT[:, 1]])
    return axes, np.array([hip, hip, hip, p_PKnee]), R_PT @ knee, p_PKnee


def penetration_path(
    depth: Vector, share: Vector, leverage: Vector, path: Vector
) -> Vector | None:
    """Plans the third repair: a smooth displacement of the second foot's trajectory.

    The paper displaces by dP (Eq. 25) where the leg penetrates; here the deepest
    penetrations of phase 3 set a curve over the whole of it, so that the foot goes
    smoothly.

    Args:
        depth: how deep the leg is in the inflated obstacle at each row of phase 3,
            (n,), m; 0 where it is not.
        share: of phase 3 that has passed at each row, (n,).
        leverage: horizontal displacement of the ankle per penetration (Eq. 25), (n,).
        path: displacement so far at `KNOTS` equal shares, or empty.

    Returns:
        The new displacement, (KNOTS,), m, negative to the rear; None without depth.
    """
    if not (depth > 0.0).any():
        return None
    knots = np.linspace(0.0, 1.0, KNOTS)
    wanted = np.zeros(KNOTS)
    width = 3.0 / (KNOTS - 1)
    for u, d, k in zip(share, depth, leverage, strict=True):
        if d > 0.0:
            shape = np.exp(-0.5 * ((knots - u) / width) ** 2)
            wanted = np.minimum(wanted, -min(k * d + 0.002, 0.03) * shape)
    ends = np.clip(np.minimum(knots, 1.0 - knots) / 0.15, 0.0, 1.0)
    total: Vector = (path if path.size else 0.0) + wanted * ends
    return total
