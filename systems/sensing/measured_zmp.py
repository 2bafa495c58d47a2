"""The measured ZMP, defined once."""

from collections.abc import Sequence

import numpy as np

from footfall.models.values.vector import Vector

MIN_FORCE = 1.0
"""With less upward force on all feet there is no ZMP, N."""


def measured_zmp(
    X_WF: Vector, wrenches_F: Vector, min_force: float = MIN_FORCE
) -> Vector:
    """Computes the ZMP of the feet's wrenches, p_WZmp, (..., 3), m; nan without any.

    It lies at the mean height of the feet, weighted by the upward force on each, where
    the net moment about both horizontal axes vanishes: with net force f and moment m
    about W's origin, x = (z f_x - m_y) / f_z and y = (z f_y + m_x) / f_z.

    Args:
        X_WF: poses of the sole frames, (..., feet, 4, 4).
        wrenches_F: force then moment about F's origin, in F, (..., feet, 6), N and Nm.
        min_force: upward force on all feet below which there is none, N.
    """
    R_WF, p_WF = X_WF[..., :3, :3], X_WF[..., :3, 3]
    f_W = (R_WF @ wrenches_F[..., :3, None])[..., 0]
    about_F = (R_WF @ wrenches_F[..., 3:, None])[..., 0]
    # The first two rows of p x f; np.cross takes longer than all the rest.
    m_x = about_F[..., 0] + p_WF[..., 1] * f_W[..., 2] - p_WF[..., 2] * f_W[..., 1]
    m_y = about_F[..., 1] + p_WF[..., 2] * f_W[..., 0] - p_WF[..., 0] * f_W[..., 2]
    force = f_W.sum(axis=-2)
    felt = force[..., 2] >= min_force
    lift = np.where(felt, force[..., 2], np.nan)
    z = (f_W[..., 2] * p_WF[..., 2]).sum(axis=-1) / lift
    x = (z * force[..., 0] - m_y.sum(axis=-1)) / lift
    y = (z * force[..., 1] + m_x.sum(axis=-1)) / lift
    return np.stack([x, y, z], axis=-1)


def zmp_now(
    frames: Sequence[tuple[Vector, Vector]],
    wrenches_F: Vector,
    min_force: float = MIN_FORCE,
) -> Vector:
    """Computes `measured_zmp` of one moment in plain numbers, in a fifth of the time.

    Args:
        frames: R_WF, (3, 3), and p_WF, (3,), m, of each sole.
        wrenches_F: as there, (feet, 6).
        min_force: as there, N.

    Returns:
        p_WZmp, (3,), m; nan without upward force.
    """
    f_x = f_y = f_z = m_x = m_y = height = 0.0
    for (R_WF, p_WF), wrench in zip(frames, wrenches_F, strict=True):
        x, y, z = p_WF.tolist()
        a, b, c = (R_WF @ wrench[:3]).tolist()
        about_x, about_y, _ = (R_WF @ wrench[3:]).tolist()
        f_x, f_y, f_z = f_x + a, f_y + b, f_z + c
        m_x += about_x + y * c - z * b
        m_y += about_y + z * a - x * c
        height += c * z
    if f_z < min_force:
        return np.full(3, np.nan)
    z = height / f_z
    return np.array([(z * f_x - m_y) / f_z, (z * f_y + m_x) / f_z, z])
