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

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.estimation.rotations import (
    exp_rotation,
    left_jacobian,
    log_rotation,
    skew,
)

SIZE = 27
"""Elements of the error."""


class Rows:
    """Where each part of the error is."""

    R = slice(0, 3)
    """Of the base's orientation, rad."""
    v = slice(3, 6)
    """Of its velocity, m/s."""
    p = slice(6, 9)
    """Of its position, m."""
    d = (slice(9, 12), slice(15, 18))
    """Of the feet's positions, m."""
    C = (slice(12, 15), slice(18, 21))
    """Of their orientations, rad."""
    b_g = slice(21, 24)
    """Of the gyroscope's bias, rad/s."""
    b_a = slice(24, 27)
    """Of the accelerometer's, m/s^2."""


@dataclass(kw_only=True)
class FilterParams(Parameters):
    """How much the filter trusts its sensors, as standard deviations."""

    gyroscope: float = number(3e-4, "rad/s", least=1e-9)
    """White noise of the angular rate, rad/s per root Hz: twice the sensor's own, for
    what vibration adds."""
    accelerometer: float = number(2e-2, "m/s^2", least=1e-9)
    """White noise of the specific force, m/s^2 per root Hz: over the sensor's own, for
    a base that bends and for what is averaged over a tick."""
    gyroscope_walk: float = number(2e-5, "rad/s", least=0.0)
    """How its bias wanders, rad/s per root second."""
    accelerometer_walk: float = number(1e-4, "m/s^2", least=0.0)
    """The same of the accelerometer, m/s^2 per root second."""
    contact: float = number(2e-3, "m/s", least=0.0)
    """How a bearing sole creeps while the robot moves, m/s per root Hz."""
    contact_turn: float = number(3e-2, "rad/s", least=0.0)
    """How a bearing sole turns meanwhile, rad/s per root Hz: rubber yields and twists;
    the gyroscope knows better."""
    rest_contact: float = number(5e-4, "m/s", least=0.0)
    """How a bearing sole creeps while all joints are at rest, m/s per root Hz."""
    rest_contact_turn: float = number(2e-4, "rad/s", least=0.0)
    """How it turns meanwhile, rad/s per root Hz: hardly, which tells the gyroscope's
    bias."""
    rest_speed: float = number(0.03, "rad/s", least=0.0)
    """Joints that are slower than this, all of them, rad/s, are at rest."""
    foot_position: float = number(1e-3, "m", above=0.0)
    """Of a sole seen from the base by the encoders, m."""
    foot_turn: float = number(2e-3, "rad", above=0.0)
    """The same of its orientation, rad."""
    slip_gate: float = number(50.0, above=0.0)
    """Squared Mahalanobis distance of a foot's innovation (6 numbers) beyond which it
    is not where it stood: it slipped or rolled, and stands anew where it is."""
    lead: float = number(0.0025, "s", least=0.0, most=0.1)
    """How far the state is told ahead of the latest sample, s, base and joints going on
    as they go: by default the latency of the sensors."""
    start_tilt: float = number(0.01, "rad", least=0.0)
    """Of the tilt that it begins with, rad."""
    start_gyroscope_bias: float = number(5e-3, "rad/s", least=0.0)
    """What the gyroscope's bias may be at the start, rad/s."""
    start_accelerometer_bias: float = number(2e-2, "m/s^2", least=0.0)
    """What the accelerometer's bias may be at the start, m/s^2."""


class FootPose(NamedTuple):
    """A sole frame seen from the base, by the encoders."""

    p_BF: Vector
    """(3,), m."""
    R_BF: Vector
    """(3, 3)."""


@dataclass(frozen=True)
class BaseEstimate:
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
    standing: tuple[bool, bool]
    """Which of the feet the filter holds on to."""
    gyroscope_bias: Vector
    """(3,), rad/s."""
    accelerometer_bias: Vector
    """(3,), m/s^2."""
    covariance: Vector
    """Of the error, (27, 27)."""
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
    covariance: Vector = np.zeros((SIZE, SIZE))
    deviations: Vector = np.zeros(SIZE)
    deviations[Rows.R] = (params.start_tilt, params.start_tilt, 1e-6)
    deviations[Rows.v] = 1e-2
    deviations[Rows.p] = 1e-6
    deviations[Rows.b_g] = params.start_gyroscope_bias
    deviations[Rows.b_a] = params.start_accelerometer_bias
    covariance[np.diag_indices(SIZE)] = deviations**2
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
        standing=(False, False),
        gyroscope_bias=nothing,
        accelerometer_bias=nothing,
        covariance=covariance,
    )


def propagate(
    estimate: BaseEstimate,
    angular_rate: Vector,
    specific_force: Vector,
    duration: float,
    params: FilterParams,
    gravity: float,
    at_rest: bool = False,
) -> BaseEstimate:
    """Carries the estimate on by what the IMU felt (Sec. V-B, VI-B).

    Args:
        estimate: before.
        angular_rate: mean of the gyroscope, in B, (3,), rad/s.
        specific_force: mean of the accelerometer, in B, (3,), m/s^2.
        duration: for how long, s.
        params: noise.
        gravity: m/s^2.
        at_rest: whether no joint moves.
    """
    R, v, p = estimate.R_WB, estimate.v_WB, estimate.p_WB
    turn: Vector = (angular_rate - estimate.gyroscope_bias) * duration
    force = specific_force - estimate.accelerometer_bias
    R_mid = R @ exp_rotation(0.5 * turn)
    acceleration = R_mid @ force
    acceleration[2] -= gravity
    # A = [0 0 0 .. -R 0; [g] 0 0 .. -[v]R -R; 0 I 0 .. -[p]R 0; 0 .. -[d]R 0; ..].
    transition: Vector = np.eye(SIZE)
    g_x: Vector = np.array([0.0, 0.0, -gravity])
    transition[Rows.v, Rows.R] = skew(g_x) * duration
    transition[Rows.p, Rows.R] = skew(g_x) * (0.5 * duration**2)
    transition[6, 3] = transition[7, 4] = transition[8, 5] = duration
    carried = -duration * R
    transition[Rows.R, Rows.b_g] = carried
    transition[Rows.v, Rows.b_a] = carried
    levers = (
        (Rows.v, v),
        (Rows.p, p),
        (Rows.d[0], estimate.p_WF[0]),
        (Rows.d[1], estimate.p_WF[1]),
    )
    spread: Vector = np.zeros((SIZE, 6))
    spread[Rows.R, :3] = R
    spread[Rows.v, 3:] = R
    for rows, at in levers:
        moved = skew(at) @ R
        transition[rows, Rows.b_g] = -duration * moved
        spread[rows, :3] = moved
    covariance = transition @ estimate.covariance @ transition.T
    spread[:, :3] *= params.gyroscope * duration**0.5
    spread[:, 3:] *= params.accelerometer * duration**0.5
    covariance += spread @ spread.T
    covariance[_DIAGONAL] += _wander(params, at_rest) * duration
    return replace(
        estimate,
        R_WB=_orthonormal(R @ exp_rotation(turn)),
        v_WB=v + acceleration * duration,
        p_WB=p + v * duration + acceleration * (0.5 * duration**2),
        covariance=covariance,
    )


def hold_feet(
    estimate: BaseEstimate,
    feet: tuple[FootPose, FootPose],
    standing: tuple[bool, bool],
    params: FilterParams,
) -> BaseEstimate:
    """Corrects the estimate by the feet that stand where they stood (Sec. V-C, V-D).

    A foot that begins to stand is taken in where the estimate sees it; one that ends
    is let go; one whose innovation is beyond `slip_gate` is taken in anew.

    Args:
        estimate: carried on to now.
        feet: the soles seen from the base, left and right.
        standing: which of them bear load.
        params: noise and gate.
    """
    held, slips = [], list(estimate.slips)
    for i in range(2):
        if not standing[i]:
            continue
        if not estimate.standing[i]:
            estimate = _take_in(estimate, i, feet[i], params)
            continue
        z = _innovation(estimate, i, feet[i])
        S = _difference(estimate.covariance, [i])
        S[np.diag_indices(6)] += _noise(params)
        if float(z @ np.linalg.solve(S, z)) > params.slip_gate:
            slips[i] += 1
            estimate = _take_in(estimate, i, feet[i], params)
            continue
        held.append(i)
    estimate = replace(estimate, standing=standing, slips=(slips[0], slips[1]))
    return _correct(estimate, held, feet, params) if held else estimate


def _orthonormal(R: Vector) -> Vector:
    """Takes out what rounding adds to a rotation over many ticks (Newton's step)."""
    nearer: Vector = R @ (1.5 * np.eye(3) - 0.5 * (R.T @ R))
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


def _noise(params: FilterParams) -> Vector:
    """Variances of an innovation, (6,)."""
    return np.repeat([params.foot_position**2, params.foot_turn**2], 3)


_DIAGONAL = np.diag_indices(SIZE)
_BASE = np.array([6, 7, 8, 0, 1, 2])
"""Rows of the base's position and orientation, as an innovation has them."""
_FEET = np.array([[9, 10, 11, 12, 13, 14], [15, 16, 17, 18, 19, 20]])
"""Rows of each foot's."""


def _wander(params: FilterParams, at_rest: bool) -> Vector:
    """Variances that feet and biases gain in a second, (27,)."""
    wander = np.zeros(SIZE)
    creep = params.rest_contact if at_rest else params.contact
    turn = params.rest_contact_turn if at_rest else params.contact_turn
    for i in range(2):
        wander[Rows.d[i]] = creep**2
        wander[Rows.C[i]] = turn**2
    wander[Rows.b_g] = params.gyroscope_walk**2
    wander[Rows.b_a] = params.accelerometer_walk**2
    return wander


def _rows_difference(covariance: Vector, held: list[int]) -> Vector:
    """H P, (6 k, 27), of k feet: rows of the base less those of the feet."""
    base = covariance[_BASE]
    return np.vstack([base - covariance[_FEET[i]] for i in held])


def _difference(covariance: Vector, held: list[int]) -> Vector:
    """H P H^T, (6 k, 6 k), of k feet."""
    rows = _rows_difference(covariance, held)
    return np.hstack([rows[:, _BASE] - rows[:, _FEET[i]] for i in held])


def _correct(
    estimate: BaseEstimate,
    held: list[int],
    feet: tuple[FootPose, FootPose],
    params: FilterParams,
) -> BaseEstimate:
    z = np.concatenate([_innovation(estimate, i, feet[i]) for i in held])
    HP = _rows_difference(estimate.covariance, held)
    S = np.hstack([HP[:, _BASE] - HP[:, _FEET[i]] for i in held])
    S[np.diag_indices(6 * len(held))] += np.tile(_noise(params), len(held))
    # K z and K H P by one solution, with P H^T = (H P)^T.
    solved = np.linalg.solve(S, np.column_stack([z, HP]))
    return _shifted(estimate, -(HP.T @ solved[:, 0]), HP.T @ solved[:, 1:])


def _shifted(estimate: BaseEstimate, delta: Vector, known: Vector) -> BaseEstimate:
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
    p_WF = estimate.p_WF @ G.T
    R_WF = np.empty((2, 3, 3))
    for i in range(2):
        p_WF[i] += J @ delta[Rows.d[i]]
        R_WF[i] = exp_rotation(delta[Rows.C[i]]) @ estimate.R_WF[i]
    return replace(
        estimate,
        R_WB=G @ estimate.R_WB,
        v_WB=G @ estimate.v_WB + J @ delta[Rows.v],
        p_WB=G @ estimate.p_WB + J @ delta[Rows.p],
        p_WF=p_WF,
        R_WF=R_WF,
        gyroscope_bias=estimate.gyroscope_bias + delta[Rows.b_g],
        accelerometer_bias=estimate.accelerometer_bias + delta[Rows.b_a],
        covariance=covariance,
    )


def _take_in(
    estimate: BaseEstimate, i: int, foot: FootPose, params: FilterParams
) -> BaseEstimate:
    """Lets a foot stand where the estimate sees it: d = p + R p_BF, C = R R_BF."""
    p_WF, R_WF = estimate.p_WF.copy(), estimate.R_WF.copy()
    p_WF[i] = estimate.p_WB + estimate.R_WB @ foot.p_BF
    R_WF[i] = estimate.R_WB @ foot.R_BF
    # xi_d = xi_p + noise and xi_C = xi_R + noise: rows and columns of the base's.
    order = np.arange(SIZE)
    order[_FEET[i]] = _BASE
    covariance = estimate.covariance[order][:, order]
    covariance[_FEET[i], _FEET[i]] += _noise(params)
    return replace(estimate, p_WF=p_WF, R_WF=R_WF, covariance=covariance)
