"""How a foot leaves the ground, swings and lands: toe-off and swing trajectories.

Foot poses are rows (x, y, z, roll, pitch, yaw) of the sole frame F in W; a positive
pitch lifts the heel over the toes.
"""

import numpy as np

from models.robot import Sole
from systems.ports import Vector


def quintic(u: Vector | float) -> Vector:
    """The minimum-jerk blend 10 u^3 - 15 u^4 + 6 u^5 from 0 to 1, clamped outside."""
    clamped: Vector = np.clip(u, 0.0, 1.0)
    blend: Vector = clamped**3 * (10.0 - 15.0 * clamped + 6.0 * clamped**2)
    return blend


def heading(yaw: Vector | float) -> Vector:
    """The horizontal unit vector in direction yaw, (..., 2)."""
    return np.stack([np.cos(yaw), np.sin(yaw)], axis=-1)


def lift_heel(pose: Vector, pitch: Vector, sole: Sole) -> Vector:
    """Poses of a level foot whose heel is lifted about its resting toe edge.

    Args:
        pose: the level foot, (6,).
        pitch: angles of the sole, (n,), rad.
        sole: of this foot.

    Returns:
        Poses, (n, 6).
    """
    poses = np.tile(pose, (len(pitch), 1))
    poses[:, :2] += sole.toe * (1.0 - np.cos(pitch))[:, None] * heading(pose[5])
    poses[:, 2] += sole.toe * np.sin(pitch)
    poses[:, 4] = pitch
    return poses


def toe_off_pitch(
    pose: Vector, p_WHip: Vector, reach: float, largest: float, sole: Sole
) -> float:
    """The least pitch with which a foot's ankle comes within reach of the hip.

    Args:
        pose: the level foot, (6,).
        p_WHip: the hip, (3,), m; what it is beside the foot's sagittal plane is
            ignored.
        reach: greatest distance from hip to ankle, m.
        largest: no pitch beyond this is taken, rad.
        sole: of this foot.

    Returns:
        The pitch, rad; 0 where the level foot is within reach.
    """
    pitch = np.linspace(0.0, largest, 64)
    forward = float((p_WHip[:2] - pose[:2]) @ heading(pose[5]))
    up = p_WHip[2] - pose[2]
    ankle_x = sole.toe * (1.0 - np.cos(pitch)) + sole.ankle_height * np.sin(pitch)
    ankle_z = sole.toe * np.sin(pitch) + sole.ankle_height * np.cos(pitch)
    within = np.hypot(forward - ankle_x, up - ankle_z) <= reach
    return float(pitch[np.argmax(within)]) if within.any() else largest


def swing(
    start: Vector,
    end: Vector,
    pitch: float,
    clearance: float,
    retraction: float,
    u: Vector,
    sole: Sole,
) -> Vector:
    """A foot's poses from lift-off to touch-down, at rest at both ends.

    The toe edge leads: when it climbs it first rises clear of the next tread's edge,
    drawing back a little, then moves over; the heel comes down beneath it.

    Args:
        start: the level pose it stood in, (6,).
        end: the pose it is to stand in, (6,).
        pitch: of the foot at lift-off, after toe-off, rad.
        clearance: of the toe over the higher of both grounds, m.
        retraction: how far the toe draws back from a riser, m; climbing only.
        u: share of the swing that has passed, (n,), 0 to 1.
        sole: of this foot.

    Returns:
        Poses, (n, 6).
    """
    climbing = end[2] - start[2] > 0.5 * clearance
    apex, begin, finish = (0.55, 0.25, 0.85) if climbing else (0.45, 0.08, 0.92)
    top = max(start[2], end[2]) + clearance
    along = quintic((u - begin) / (finish - begin))[:, None]
    toe_start = start[:2] + sole.toe * heading(start[5])
    toe_end = end[:2] + sole.toe * heading(end[5])
    toe = toe_start + along * (toe_end - toe_start)
    if climbing:
        back = quintic(u / 0.2) * (1.0 - quintic((u - 0.2) / 0.3))
        toe -= retraction * back[:, None] * heading(start[5])
    toe_z = np.where(
        u < apex,
        start[2] + (top - start[2]) * quintic(u / apex),
        top + (end[2] - top) * quintic((u - apex) / (1.0 - apex)),
    )
    poses = start + along * (end - start)
    poses[:, 4] += pitch * (1.0 - quintic(u / 0.7))
    tilt = poses[:, 4]
    poses[:, :2] = toe - sole.toe * np.cos(tilt)[:, None] * heading(poses[:, 5])
    poses[:, 2] = toe_z + sole.toe * np.sin(tilt)
    return poses
