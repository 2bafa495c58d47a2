"""A pinhole camera: where its pixels look, and which of them may see a sphere.

Camera frame C: origin at the pinhole, x to the right of the picture, y down, z into
the picture. The optical axis passes through the middle of the picture.
"""

import math
from functools import lru_cache
from typing import Any

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix

from footfall.models.values.vector import Vector


@lru_cache(maxsize=4)
def pixel_rays(rows: int, columns: int, focal_length: float) -> Vector:
    """Computes where the pixels look, row by row.

    Args:
        rows: height of the picture, pixels.
        columns: width of the picture, pixels.
        focal_length: pixels.

    Returns:
        Vectors in C with z = 1, (rows * columns, 3): times its depth each is a
        pixel's point. Read-only, as it is kept for the next frame.
    """
    x = (np.arange(columns) + 0.5 - columns / 2.0) / focal_length
    y = (np.arange(rows) + 0.5 - rows / 2.0) / focal_length
    rays = np.empty((rows, columns, 3))
    rays[..., 0], rays[..., 1], rays[..., 2] = x, y[:, np.newaxis], 1.0
    rays.flags.writeable = False
    return rays.reshape(-1, 3)


def pixels_of_sphere(
    p_CS: Vector, radius: float, rows: int, columns: int, focal_length: float
) -> np.ndarray[Any, np.dtype[np.int64]]:
    """Finds the pixels that may see a sphere: the rectangle around its picture.

    Args:
        p_CS: its centre, (3,), m.
        radius: m.
        rows: height of the picture, pixels.
        columns: width of the picture, pixels.
        focal_length: pixels.

    Returns:
        Indices into `pixel_rays`, (n,); all where the pinhole is inside the sphere.
    """
    left, right = _span(p_CS[0], p_CS[2], radius, columns, focal_length)
    top, bottom = _span(p_CS[1], p_CS[2], radius, rows, focal_length)
    inside = np.arange(top, bottom)[:, np.newaxis] * columns + np.arange(left, right)
    return inside.ravel()


def _span(
    across: float, ahead: float, radius: float, count: int, focal_length: float
) -> tuple[int, int]:
    """First pixel and the one after the last, of `count`, that may see the sphere."""
    distance = math.hypot(across, ahead)
    if distance <= radius:
        return 0, count
    middle, half = math.atan2(across, ahead), math.asin(radius / distance)
    if middle - half >= math.pi / 2.0 or middle + half <= -math.pi / 2.0:
        return 0, 0
    low, high = 0.0, float(count)
    if middle - half > -math.pi / 2.0:
        low = math.tan(middle - half) * focal_length + count / 2.0 - 1.0
    if middle + half < math.pi / 2.0:
        high = math.tan(middle + half) * focal_length + count / 2.0 + 1.0
    first = int(min(max(math.floor(low), 0), count))
    return first, int(min(max(math.ceil(high), first), count))


def looking_at(p_WC: Vector, p_WTarget: Vector) -> RigidTransform:
    """Pose of a camera that looks at a point with its picture upright.

    Straight down or up, the top of the picture points along x of W.

    Args:
        p_WC: where the camera is, (3,), m.
        p_WTarget: what it looks at, (3,), m.

    Raises:
        ValueError: the two are the same point.
    """
    z_W = p_WTarget - p_WC
    distance = float(np.linalg.norm(z_W))
    if not distance > 0.0:
        raise ValueError(f"camera and target must differ, both are at {p_WC} m")
    z_W = z_W / distance
    x_W = np.cross(z_W, [0.0, 0.0, 1.0])
    if np.linalg.norm(x_W) < 1e-6:
        x_W = np.array([0.0, -1.0, 0.0])
        x_W = x_W if z_W[2] < 0.0 else -x_W
    x_W = x_W / np.linalg.norm(x_W)
    R_WC: Vector = np.column_stack([x_W, np.cross(z_W, x_W), z_W])
    return RigidTransform(RotationMatrix(R_WC), p_WC)
