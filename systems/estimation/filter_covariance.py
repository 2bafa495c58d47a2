"""How the covariance of the base estimator's filter goes on from tick to tick."""

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.estimation.base_estimate import BaseEstimate
from footfall.systems.estimation.filter_params import SIZE, FilterModel, Rows
from footfall.systems.estimation.rotations import SKEWS

_IDENTITY: Vector = np.eye(SIZE)
BASE_ROWS = np.array([6, 7, 8, 0, 1, 2])
"""Rows of the base's position and orientation, as an innovation has them."""
FOOT_ROWS = np.array([[9, 10, 11, 12, 13, 14], [15, 16, 17, 18, 19, 20]])
"""Rows of each foot's."""
MOVED_ROWS = np.array([3, 4, 5, 6, 7, 8, 9, 10, 11, 15, 16, 17])
"""Rows of velocity and positions, which a turn about W's origin moves."""
OF_FOOT = (np.arange(6), np.arange(6, 12))
"""Rows of the innovations that are of each foot."""
OBSERVED: Vector = np.vstack(
    [_IDENTITY[BASE_ROWS] - _IDENTITY[feet] for feet in FOOT_ROWS]
)
"""H of both feet's innovations, (12, 27): z = xi_p - xi_d, then xi_R - xi_C."""


def _transition(estimate: BaseEstimate, duration: float, model: FilterModel) -> Vector:
    """How the error goes on, exp(A t), (27, 27), of a time in which it hardly turns."""
    # A = [0 0 0 .. -R 0; [g] 0 0 .. -[v]R -R; 0 I 0 .. -[p]R 0; 0 .. -[d]R 0; ..].
    F = _IDENTITY.copy()
    pull = model.gravity * duration
    F[3, 1], F[4, 0] = pull, -pull
    F[6, 1], F[7, 0] = 0.5 * duration * pull, -0.5 * duration * pull
    F[6, 3] = F[7, 4] = F[8, 5] = duration
    carried_on = -duration * estimate.R_WB
    F[Rows.R, Rows.b_g] = carried_on
    F[Rows.v, Rows.b_a] = carried_on
    F[MOVED_ROWS, Rows.b_g] = -duration * _swept(estimate)
    return F


def _process_noise(
    estimate: BaseEstimate, duration: float, model: FilterModel
) -> Vector:
    """What the covariance gains in a time, (27, 27)."""
    spread = np.zeros((SIZE, 6))
    spread[Rows.R, :3] = estimate.R_WB
    spread[Rows.v, 3:] = estimate.R_WB
    spread[MOVED_ROWS, :3] = _swept(estimate)
    spread *= duration**0.5 * model.inertial
    noise: Vector = spread @ spread.T
    diagonal(noise)[:] += duration * model.wander
    return noise


def _swept(estimate: BaseEstimate) -> Vector:
    """[v]R, [p]R, [d_1]R, [d_2]R, row below row, (12, 3)."""
    vectors = np.concatenate([estimate.v_WB, estimate.p_WB, estimate.p_WF.ravel()])
    swept: Vector = (vectors.reshape(4, 3) @ SKEWS).reshape(12, 3) @ estimate.R_WB
    return swept


def carried_covariance(
    estimate: BaseEstimate, model: FilterModel, corrected: bool
) -> Vector:
    """The covariance after the ticks since it was carried on last, (27, 27).

    With the gain that was kept, L = I - K H, a tick is
    P <- L (F P F^T + Q) L^T + K N K^T.

    Args:
        estimate: carried on to now.
        model: noise of the ticks.
        corrected: whether the gain has been applied in the last tick, too; if not its
            covariance is the predicted one.
    """
    P = estimate.covariance
    if estimate.ticks <= 0:
        return P
    step = estimate.since / estimate.ticks
    F, Q = _transition(estimate, step, model), _process_noise(estimate, step, model)
    K = estimate.gain
    kept = _IDENTITY - K @ OBSERVED
    A, noise = kept @ F, kept @ Q @ kept.T + (K * np.tile(model.foot, 2)) @ K.T
    for _ in range(estimate.ticks if corrected else estimate.ticks - 1):
        P = A @ P @ A.T + noise
    return P if corrected else F @ P @ F.T + Q


def diagonal(matrix: Vector) -> Vector:
    """Gives the diagonal to be written to, (n,), however the matrix lies in memory."""
    view: Vector = np.einsum("ii->i", matrix)
    return view
