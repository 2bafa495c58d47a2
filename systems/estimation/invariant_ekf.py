"""Contact-aided invariant filter: where the base is, by IMU and standing feet.

Hartley, Ghaffari, Eustice and Grizzle (2020), "Contact-aided invariant extended Kalman
filtering for robot state estimation": the right-invariant filter of its Sec. V with
the biases of its Sec. VI. Beside a foot's position d we keep its orientation C, since
a flat sole that stands does not turn either: by it the gyroscope's bias and the heading
are held while the robot stands.

The state is X = (R, v, p, d_1, d_2) in SE_4(3), C_1 and C_2 in SO(3), and the biases
b_g, b_a. Its error is right-invariant, in W: X_est X^-1 = exp(xi), C_est C^-1 =
exp(xi_C), b_est - b; its 27 elements are in the order of `Rows`.
"""

from typing import NamedTuple

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.estimation.filter_params import (
    SIZE,
    FilterModel,
    FilterParams,
    Rows,
)
from footfall.systems.estimation.rotations import (
    SKEWS,
    exp_rotation,
    left_jacobian,
    log_rotation,
    skew,
)


class FootPose(NamedTuple):
    """A sole frame seen from the base, by the encoders."""

    p_BF: Vector
    """(3,), m."""
    R_BF: Vector
    """(3, 3)."""


class BaseEstimate(NamedTuple):
    """What the filter believes, and how well it knows it."""

    R_WB: Vector
    """Orientation of the base, (3, 3)."""
    v_WB: Vector
    """Its velocity, (3,), m/s."""
    p_WB: Vector
    """Its position, (3,), m."""
    p_WF: Vector
    """Where the feet stand, left and right, (2, 3), m."""
    R_WF: Vector
    """How they stand, (2, 3, 3)."""
    gyroscope_bias: Vector
    """(3,), rad/s."""
    accelerometer_bias: Vector
    """(3,), m/s^2."""
    covariance: Vector
    """Of the error, (27, 27)."""
    standing: tuple[bool, bool] = (False, False)
    """Which of the feet the filter holds on to."""
    slips: tuple[int, int] = (0, 0)
    """How often each foot has been found away from where it stood."""


def initial_estimate(R_WB: Vector, p_WB: Vector, params: FilterParams) -> BaseEstimate:
    """Begins where W is laid: the robot stands still, its place and heading define W.

    Tilt and accelerometer bias cannot be told apart at rest; both are open.

    Args:
        R_WB: (3, 3).
        p_WB: (3,), m.
        params: deviations at the start.
    """
    deviations: Vector = np.zeros(SIZE)
    deviations[Rows.R] = (params.start_tilt, params.start_tilt, 1e-6)
    deviations[Rows.v] = 1e-2
    deviations[Rows.p] = 1e-6
    deviations[Rows.b_g] = params.start_gyroscope_bias
    deviations[Rows.b_a] = params.start_accelerometer_bias
    covariance: Vector = np.diag(deviations**2)
    # The tilt is about the base, not about W's origin: xi_p = -[xi_R]p is kept small.
    lever = skew(p_WB)
    turn = covariance[Rows.R, Rows.R]
    covariance[Rows.p, Rows.R] = lever @ turn
    covariance[Rows.R, Rows.p] = covariance[Rows.p, Rows.R].T
    covariance[Rows.p, Rows.p] += lever @ turn @ lever.T
    nothing: Vector = np.zeros(3)
    return BaseEstimate(
        R_WB=R_WB,
        v_WB=nothing,
        p_WB=p_WB,
        p_WF=np.zeros((2, 3)),
        R_WF=np.stack([np.eye(3)] * 2),
        gyroscope_bias=nothing,
        accelerometer_bias=nothing,
        covariance=covariance,
    )


def propagate(
    estimate: BaseEstimate,
    angular_rate: Vector,
    specific_force: Vector,
    duration: float,
    model: FilterModel,
) -> BaseEstimate:
    """Carries the estimate on by what the IMU felt (Sec. V-B, VI-B).

    Args:
        estimate: before.
        angular_rate: mean of the gyroscope, in B, (3,), rad/s.
        specific_force: mean of the accelerometer, in B, (3,), m/s^2.
        duration: for how long, s.
        model: noise and gravity.
    """
    R, v, p, p_WF = estimate[:4]
    half = exp_rotation((0.5 * duration) * (angular_rate - estimate.gyroscope_bias))
    R_mid = R @ half
    acceleration = R_mid @ (specific_force - estimate.accelerometer_bias)
    acceleration[2] -= model.gravity
    # A = [0 0 0 .. -R 0; [g] 0 0 .. -[v]R -R; 0 I 0 .. -[p]R 0; 0 .. -[d]R 0; ..].
    # [v]R, [p]R, [d_1]R, [d_2]R, row below row.
    moved = (np.concatenate([v, p, p_WF.ravel()]).reshape(4, 3) @ SKEWS).reshape(12, 3)
    moved = moved @ R
    transition = _IDENTITY.copy()
    pull = model.gravity * duration
    transition[3, 1], transition[4, 0] = pull, -pull
    transition[6, 1], transition[7, 0] = 0.5 * duration * pull, -0.5 * duration * pull
    transition[6, 3] = transition[7, 4] = transition[8, 5] = duration
    carried = -duration * R
    transition[Rows.R, Rows.b_g] = carried
    transition[Rows.v, Rows.b_a] = carried
    transition[_MOVED, Rows.b_g] = -duration * moved
    spread = np.zeros((SIZE, 6))
    spread[Rows.R, :3] = R
    spread[Rows.v, 3:] = R
    spread[_MOVED, :3] = moved
    spread *= duration**0.5 * model.inertial
    covariance = transition @ estimate.covariance @ transition.T + spread @ spread.T
    _diagonal(covariance)[:] += duration * model.wander
    return estimate._replace(
        R_WB=_orthonormal(R_mid @ half),
        v_WB=v + duration * acceleration,
        p_WB=p + duration * v + (0.5 * duration**2) * acceleration,
        covariance=covariance,
    )


def hold_feet(
    estimate: BaseEstimate,
    feet: tuple[FootPose, FootPose],
    standing: tuple[bool, bool],
    model: FilterModel,
) -> BaseEstimate:
    """Corrects the estimate by the feet that stand where they stood (Sec. V-C, V-D).

    A foot that begins to stand is taken in where the estimate sees it; one that ends
    is let go; one whose innovation is beyond the gate is taken in anew.

    Args:
        estimate: carried on to now.
        feet: the soles seen from the base, left and right.
        standing: which of them bear load.
        model: noise and gate.
    """
    before = estimate.standing
    estimate = estimate._replace(standing=standing)
    held = [i for i in range(2) if standing[i] and before[i]]
    innovations = [_innovation(estimate, i, feet[i]) for i in held]
    for i in range(2):
        if standing[i] and not before[i]:
            estimate = _take_in(estimate, i, feet[i], model)
    if not held:
        return estimate
    HP, S = _innovation_covariance(estimate.covariance, held, model)
    slipped = [False] * len(held)
    # z S^-1 z <= z N^-1 z, as S = H P H^T + N: most ticks need no solution.
    if any(float(z @ (z / model.foot)) > model.slip_gate for z in innovations):
        slipped = [far > model.slip_gate for far in _distances(innovations, S)]
    if any(slipped):
        slips = list(estimate.slips)
        for i, slip in zip(held, slipped, strict=True):
            if slip:
                slips[i] += 1
                estimate = _take_in(estimate, i, feet[i], model)
        estimate = estimate._replace(slips=(slips[0], slips[1]))
        kept = [k for k in range(len(held)) if not slipped[k]]
        if not kept:
            return estimate
        held = [held[k] for k in kept]
        innovations = [innovations[k] for k in kept]
        HP, S = _innovation_covariance(estimate.covariance, held, model)
    # K z and K H P by one solution, with P H^T = (H P)^T.
    known = np.empty((6 * len(held), 1 + SIZE))
    known[:, 0] = np.concatenate(innovations)
    known[:, 1:] = HP
    gained = HP.T @ np.linalg.solve(S, known)
    return shifted(estimate, -gained[:, 0], gained[:, 1:])


_IDENTITY: Vector = np.eye(SIZE)
_BASE = np.array([6, 7, 8, 0, 1, 2])
"""Rows of the base's position and orientation, as an innovation has them."""
_FEET = np.array([[9, 10, 11, 12, 13, 14], [15, 16, 17, 18, 19, 20]])
"""Rows of each foot's."""
_MOVED = np.array([3, 4, 5, 6, 7, 8, 9, 10, 11, 15, 16, 17])
"""Rows of velocity and positions, which a turn about W's origin moves."""
_BASES = (_BASE, np.tile(_BASE, 2))
"""The base's rows beside those of one foot, and of two."""
_BOTH = _FEET.ravel()


def _orthonormal(R: Vector) -> Vector:
    """Takes out what rounding adds to a rotation over many ticks (Newton's step)."""
    nearer: Vector = 1.5 * R - 0.5 * (R @ (R.T @ R))
    return nearer


def _innovation(estimate: BaseEstimate, i: int, foot: FootPose) -> Vector:
    """How far a foot is from where it stood, (6,): z = xi_p - xi_d, then xi_R - xi_C.

    z = R p_BF - (d - p), then Log(R R_BF C^T).
    """
    R = estimate.R_WB
    z = np.empty(6)
    z[:3] = R @ foot.p_BF - estimate.p_WF[i] + estimate.p_WB
    z[3:] = log_rotation(R @ foot.R_BF @ estimate.R_WF[i].T)
    return z


def _innovation_covariance(
    covariance: Vector, held: list[int], model: FilterModel
) -> tuple[Vector, Vector]:
    """H P, (6 k, 27), and H P H^T + N, (6 k, 6 k), of k feet."""
    count = len(held)
    base, feet = _BASES[count - 1], _BOTH if count == 2 else _FEET[held[0]]
    HP: Vector = covariance[base] - covariance[feet]
    S: Vector = HP[:, base] - HP[:, feet]
    diagonal = _diagonal(S)
    for k in range(count):
        diagonal[6 * k : 6 * k + 6] += model.foot
    return HP, S


def _diagonal(matrix: Vector) -> Vector:
    """Gives the diagonal to be written to, (n,), however the matrix lies in memory."""
    view: Vector = np.einsum("ii->i", matrix)
    return view


def _distances(innovations: list[Vector], S: Vector) -> list[float]:
    """Squared Mahalanobis distance of each foot's innovation by itself."""
    z = np.stack(innovations)
    own = np.stack([S[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] for k in range(len(z))])
    solved = np.linalg.solve(own, z[:, :, None])[:, :, 0]
    distances: list[float] = np.einsum("ki,ki->k", z, solved).tolist()
    return distances


def shifted(estimate: BaseEstimate, delta: Vector, known: Vector) -> BaseEstimate:
    """Moves the estimate by an error, X+ = exp(delta) X, and lessens the covariance.

    Args:
        estimate: before.
        delta: (27,); of the biases it is added.
        known: what the covariance loses, (27, 27).
    """
    turn = delta[Rows.R]
    G, J = exp_rotation(turn), left_jacobian(turn)
    covariance = estimate.covariance - known
    covariance = 0.5 * (covariance + covariance.T)
    R_WF = estimate.R_WF.copy()
    for i in range(2):
        if estimate.standing[i]:
            R_WF[i] = exp_rotation(delta[Rows.C[i]]) @ R_WF[i]
    # Velocity, position and both feet, a row each.
    moved = np.concatenate([estimate.v_WB, estimate.p_WB, estimate.p_WF.ravel()])
    moved = moved.reshape(4, 3) @ G.T + delta[_MOVED].reshape(4, 3) @ J.T
    return estimate._replace(
        R_WB=G @ estimate.R_WB,
        v_WB=moved[0],
        p_WB=moved[1],
        p_WF=moved[2:],
        R_WF=R_WF,
        gyroscope_bias=estimate.gyroscope_bias + delta[Rows.b_g],
        accelerometer_bias=estimate.accelerometer_bias + delta[Rows.b_a],
        covariance=covariance,
    )


def _take_in(
    estimate: BaseEstimate, i: int, foot: FootPose, model: FilterModel
) -> BaseEstimate:
    """Lets a foot stand where the estimate sees it: d = p + R p_BF, C = R R_BF."""
    p_WF, R_WF = estimate.p_WF.copy(), estimate.R_WF.copy()
    p_WF[i] = estimate.p_WB + estimate.R_WB @ foot.p_BF
    R_WF[i] = estimate.R_WB @ foot.R_BF
    # xi_d = xi_p + noise and xi_C = xi_R + noise: rows and columns of the base's.
    order = np.arange(SIZE)
    order[_FEET[i]] = _BASE
    covariance = estimate.covariance[order][:, order]
    covariance[_FEET[i], _FEET[i]] += model.foot
    return estimate._replace(p_WF=p_WF, R_WF=R_WF, covariance=covariance)
