"""Contact-aided invariant filter: where the base is, by IMU and standing feet.

Hartley, Ghaffari, Eustice and Grizzle (2020), "Contact-aided invariant extended Kalman
filtering for robot state estimation": the right-invariant filter of its Sec. V with
the biases of its Sec. VI. Beside a foot's position d we keep its orientation C, since
a flat sole that stands does not turn either: by it the gyroscope's bias and the heading
are held while the robot stands.

The state is X = (R, v, p, d_1, d_2) in SE_4(3), C_1 and C_2 in SO(3), and the biases
b_g, b_a. Its error is right-invariant, in W: X_est X^-1 = exp(xi), C_est C^-1 =
exp(xi_C), b_est - b; its 27 elements are in the order of `Rows`.

Mostly the gain hardly changes from one tick to the next. It is computed when a foot
comes, goes or slips, when a robot at rest begins to move or comes to rest, in the tick
after one in which it changed, and else every `gain_time`, and kept in between; the
covariance, which is carried on only then, is that of the filter with the gain that it
used (Joseph's form).
"""

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.estimation.base_estimate import BaseEstimate, FootPose
from footfall.systems.estimation.filter_covariance import (
    BASE_ROWS,
    FOOT_ROWS,
    MOVED_ROWS,
    OBSERVED,
    OF_FOOT,
    carried_covariance,
    diagonal,
)
from footfall.systems.estimation.filter_params import SIZE, FilterModel, Rows
from footfall.systems.estimation.rotations import (
    exp_rotation,
    left_jacobian,
    log_rotation,
)

_SAME = 0.3
"""A gain is kept if no row of it changed by more than this part of its largest."""


def propagate(
    estimate: BaseEstimate,
    angular_rate: Vector,
    specific_force: Vector,
    duration: float,
    model: FilterModel,
) -> BaseEstimate:
    """Carries the estimate, not yet its covariance, on by what the IMU felt (Sec. V-B).

    Args:
        estimate: before.
        angular_rate: mean of the gyroscope, in B, (3,), rad/s.
        specific_force: mean of the accelerometer, in B, (3,), m/s^2.
        duration: for how long, s; of a tick.
        model: of which gravity is.
    """
    R, v, p = estimate[:3]
    half = exp_rotation((0.5 * duration) * (angular_rate - estimate.gyroscope_bias))
    R_mid = R @ half
    gained = R_mid @ (specific_force - estimate.accelerometer_bias)
    gained[2] -= model.gravity
    gained *= duration
    return estimate._replace(
        R_WB=_orthonormal(R_mid @ half),
        v_WB=v + gained,
        p_WB=p + duration * (v + 0.5 * gained),
        ticks=estimate.ticks + 1,
        since=estimate.since + duration,
    )


def carried(estimate: BaseEstimate, model: FilterModel) -> BaseEstimate:
    """Brings the covariance up to now (Sec. V-B, VI-B).

    Args:
        estimate: carried on, and corrected after every tick if by anything.
        model: noise and gravity since the covariance was last carried on; before
            another one applies this has to be done.
    """
    covariance = carried_covariance(estimate, model, corrected=True)
    return estimate._replace(covariance=covariance, ticks=0, since=0.0)


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
        model: noise, gate and how long a gain is kept.
    """
    before = estimate.standing
    held = [i for i in range(2) if standing[i] and before[i]]
    z = _innovations(estimate, feet, held)
    # z S^-1 z <= z N^-1 z, as S = H P H^T + N: most ticks need no solution.
    far = ((z * z).reshape(2, 6) @ (1.0 / model.foot)).max() > model.slip_gate
    changed = standing != before or model.at_rest != estimate.at_rest
    due = estimate.since >= model.gain_time or not estimate.settled
    if far or changed or due:
        return _hold_anew(estimate, feet, standing, z, far, model)
    return moved(estimate, -(estimate.gain @ z)) if held else estimate


def _hold_anew(
    estimate: BaseEstimate,
    feet: tuple[FootPose, FootPose],
    standing: tuple[bool, bool],
    z: Vector,
    far: bool,
    model: FilterModel,
) -> BaseEstimate:
    """What `hold_feet` does when a gain is due: from the covariance, carried on."""
    P = carried_covariance(estimate, model, corrected=False)
    before = estimate.standing
    held = [i for i in range(2) if standing[i] and before[i]]
    kept = estimate.gain
    estimate = estimate._replace(
        covariance=P,
        gain=np.zeros((SIZE, 12)),
        settled=False,
        at_rest=model.at_rest,
        ticks=0,
        since=0.0,
        standing=standing,
    )
    for i in range(2):
        if standing[i] and not before[i]:
            estimate = _take_in(estimate, i, feet[i], model)
    slipped = [i for i in held if far and _distance(P, i, z, model) > model.slip_gate]
    if slipped:
        slips = list(estimate.slips)
        for i in slipped:
            slips[i] += 1
            estimate = _take_in(estimate, i, feet[i], model)
        estimate = estimate._replace(slips=(slips[0], slips[1]))
        held = [i for i in held if i not in slipped]
    if not held:
        return estimate
    rows = np.concatenate([OF_FOOT[i] for i in held])
    H, noise = OBSERVED[rows], np.tile(model.foot, len(held))
    HP = H @ estimate.covariance
    S = HP @ H.T
    diagonal(S)[:] += noise
    K = np.linalg.solve(S, HP).T
    gain = np.zeros((SIZE, 12))
    gain[:, rows] = K
    estimate = shifted(estimate, -(K @ z[rows]), K @ HP)
    return estimate._replace(gain=gain, settled=_much_the_same(gain, kept))


def _much_the_same(gain: Vector, before: Vector) -> bool:
    """Tells whether each number of the error is corrected as it was."""
    change = np.abs(gain - before).max(axis=1)
    return bool((change <= _SAME * np.abs(gain).max(axis=1)).all())


def _innovations(
    estimate: BaseEstimate, feet: tuple[FootPose, FootPose], held: list[int]
) -> Vector:
    """How far the feet are from where they stood, (12,); zero of those not held.

    Of each z = R p_BF - (d - p), then Log(R R_BF C^T).
    """
    z = np.zeros(12)
    R = estimate.R_WB
    for i in held:
        z[6 * i : 6 * i + 3] = R @ feet[i].p_BF - estimate.p_WF[i] + estimate.p_WB
        z[6 * i + 3 : 6 * i + 6] = log_rotation(R @ feet[i].R_BF @ estimate.R_WF[i].T)
    return z


def _distance(covariance: Vector, i: int, z: Vector, model: FilterModel) -> float:
    """Squared Mahalanobis distance of one foot's innovation by itself."""
    rows = OF_FOOT[i]
    H, own = OBSERVED[rows], z[rows]
    S = H @ covariance @ H.T + np.diag(model.foot)
    return float(own @ np.linalg.solve(S, own))


def shifted(estimate: BaseEstimate, delta: Vector, known: Vector) -> BaseEstimate:
    """Moves the estimate by an error, X+ = exp(delta) X, and lessens the covariance.

    Args:
        estimate: before, its covariance up to now.
        delta: (27,); of the biases it is added.
        known: what the covariance loses, (27, 27).
    """
    covariance = estimate.covariance - known
    covariance = 0.5 * (covariance + covariance.T)
    estimate = moved(estimate, delta)
    return estimate._replace(
        R_WF=np.stack([_orthonormal(R_WF) for R_WF in estimate.R_WF]),
        covariance=covariance,
    )


def moved(estimate: BaseEstimate, delta: Vector) -> BaseEstimate:
    """Moves the estimate by an error, X+ = exp(delta) X.

    Args:
        estimate: before.
        delta: (27,); of the biases it is added.
    """
    turn = delta[Rows.R]
    G, J = exp_rotation(turn), left_jacobian(turn)
    R_WF = estimate.R_WF.copy()
    for i in range(2):
        if estimate.standing[i]:
            R_WF[i] = exp_rotation(delta[Rows.C[i]]) @ R_WF[i]
    # Velocity, position and both feet, a row each.
    vectors = np.concatenate([estimate.v_WB, estimate.p_WB, estimate.p_WF.ravel()])
    vectors = vectors.reshape(4, 3) @ G.T + delta[MOVED_ROWS].reshape(4, 3) @ J.T
    return estimate._replace(
        R_WB=G @ estimate.R_WB,
        v_WB=vectors[0],
        p_WB=vectors[1],
        p_WF=vectors[2:],
        R_WF=R_WF,
        gyroscope_bias=estimate.gyroscope_bias + delta[Rows.b_g],
        accelerometer_bias=estimate.accelerometer_bias + delta[Rows.b_a],
    )


def _orthonormal(R: Vector) -> Vector:
    """Takes out what rounding adds to a rotation over many ticks (Newton's step)."""
    nearer: Vector = 1.5 * R - 0.5 * (R @ (R.T @ R))
    return nearer


def _take_in(
    estimate: BaseEstimate, i: int, foot: FootPose, model: FilterModel
) -> BaseEstimate:
    """Lets a foot stand where the estimate sees it: d = p + R p_BF, C = R R_BF."""
    p_WF, R_WF = estimate.p_WF.copy(), estimate.R_WF.copy()
    p_WF[i] = estimate.p_WB + estimate.R_WB @ foot.p_BF
    R_WF[i] = estimate.R_WB @ foot.R_BF
    # xi_d = xi_p + noise and xi_C = xi_R + noise: rows and columns of the base's.
    order = np.arange(SIZE)
    order[FOOT_ROWS[i]] = BASE_ROWS
    covariance = estimate.covariance[np.ix_(order, order)]
    covariance[FOOT_ROWS[i], FOOT_ROWS[i]] += model.foot
    return estimate._replace(p_WF=p_WF, R_WF=R_WF, covariance=covariance)
