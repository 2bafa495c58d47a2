"""How the rear foot leaves the ground: toe-off.

Foot poses are rows (x, y, z, roll, pitch, yaw) of the sole frame F in W; a positive
pitch lifts the heel over the toes.
"""

import numpy as np

from footfall.models.robots.robot import Sole
from footfall.models.values.vector import Vector


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
