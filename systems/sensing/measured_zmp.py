"""The measured ZMP, defined once."""

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
    f_W = np.einsum("...ij,...j->...i", R_WF, wrenches_F[..., :3])
    about_F = np.einsum("...ij,...j->...i", R_WF, wrenches_F[..., 3:])
    moment = (about_F + np.cross(p_WF, f_W)).sum(axis=-2)
    force = f_W.sum(axis=-2)
    felt = force[..., 2] >= min_force
    lift = np.where(felt, force[..., 2], np.nan)
    z = (f_W[..., 2] * p_WF[..., 2]).sum(axis=-1) / lift
    x = (z * force[..., 0] - moment[..., 1]) / lift
    y = (z * force[..., 1] + moment[..., 0]) / lift
    return np.stack([x, y, z], axis=-1)
