"""Normals of a cloud, and Filter 1: the points whose normal leans too far.

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4.1 and Algorithm 1, lines 1 to 8.
"""

import numpy as np
import small_gicp
from numpy.typing import NDArray
from pydrake.math import VectorToSkewSymmetric

from footfall.models.values.vector import Vector


def gravity_direction(gravity: Vector) -> Vector:
    """Computes the unit vector g along gravity, (3,): it points down, as in the paper.

    Args:
        gravity: gravity as an accelerometer would give it, (3,), any length.

    Raises:
        ValueError: gravity has no direction.
    """
    g = np.asarray(gravity, dtype=np.float64).reshape(-1)
    length = float(np.linalg.norm(g)) if g.shape == (3,) else 0.0
    if not (np.isfinite(length) and length > 1e-9):
        raise ValueError(f"gravity: must be a finite vector of 3 with length, got {g}")
    return np.asarray(g / length, dtype=np.float64)


def gravity_aligned_rotation(gravity: Vector) -> Vector:
    """Computes the smallest rotation R_GW, (3, 3), into a frame G whose z points up.

    Args:
        gravity: gravity in W, (3,), any length.
    """
    up = -gravity_direction(gravity)
    axis = np.cross(up, [0.0, 0.0, 1.0])
    cosine = float(up[2])
    if cosine < -1.0 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    cross: Vector = np.asarray(VectorToSkewSymmetric(axis))
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + cosine))


def estimate_normals(points: Vector, neighbors: int, threads: int) -> Vector:
    """Estimates unit normals from the covariance of the k nearest neighbours.

    Args:
        points: (n, 3), m.
        neighbors: k, the point itself included.
        threads: how many threads to use; the result does not depend on it.

    Returns:
        Normals of either sign, (n, 3); zero where fewer than five points are there.
    """
    if len(points) < 5:
        return np.zeros((len(points), 3))
    cloud = small_gicp.PointCloud(points)
    small_gicp.estimate_normals(cloud, num_neighbors=neighbors, num_threads=threads)
    return np.array(cloud.normals()[:, :3], dtype=np.float64)


def orient_normals(
    points: Vector, normals: Vector, g: Vector, viewpoint: Vector | None
) -> Vector:
    """Turns normals towards the viewpoint; upwards where there is none.

    Only with a viewpoint can a ceiling be told from a floor.

    Args:
        points: (n, 3), m.
        normals: unit normals of either sign, (n, 3).
        g: unit vector along gravity, (3,).
        viewpoint: where the points were seen from, (3,), m.

    Returns:
        (n, 3).
    """
    if viewpoint is None:
        away = normals @ g > 0.0
    else:
        away = np.einsum("ij,ij->i", normals, viewpoint - points) < 0.0
    return np.where(away[:, None], -normals, normals)


def normal_distance(a: Vector, b: Vector) -> Vector:
    """Computes the normal distance D_n = 1 - n_a . n_b (stair paper, Eq. 2), in [0, 2].

    Args:
        a: unit vectors, (..., 3).
        b: likewise.
    """
    return np.asarray(1.0 - np.sum(a * b, axis=-1), dtype=np.float64)


def filter_slopes(
    normals: Vector, g: Vector, slope_tolerance: float
) -> NDArray[np.bool]:
    """Keeps the points with D_n(n, g) >= T (Filter 1), T = 1 + cos(slope_tolerance).

    D_n(n, g) is 2 for an upright normal, g pointing down, and points below the
    threshold T = 1 + cos(slope_tolerance) are deleted.

    Args:
        normals: unit normals, (n, 3); zeros never pass.
        g: unit vector along gravity, (3,).
        slope_tolerance: rad.

    Returns:
        Mask of the points to keep, (n,).
    """
    threshold = 1.0 + np.cos(slope_tolerance)
    return np.asarray(normal_distance(normals, g) >= threshold)
