"""What the base estimator believes, how well it knows it, and both as plain numbers."""

from typing import NamedTuple

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.estimation.filter_params import SIZE, FilterParams, Rows
from footfall.systems.estimation.rotations import skew


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
    """Of the error, (27, 27), `ticks` ago; `carried` brings it up to now."""
    gain: Vector
    """K, from the innovations of both feet to the error, (27, 12); of a foot that the
    filter does not hold on to its columns are zero."""
    settled: bool = False
    """Whether the gain was much the same when it was computed before."""
    at_rest: bool = False
    """Whether it is that of a robot at rest."""
    ticks: int = 0
    """How often the estimate was carried on since."""
    since: float = 0.0
    """For how long in all, s."""
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
        gain=np.zeros((SIZE, 12)),
    )


_MEAN = (
    ("R_WB", (3, 3)),
    ("v_WB", (3,)),
    ("p_WB", (3,)),
    ("p_WF", (2, 3)),
    ("R_WF", (2, 3, 3)),
    ("gyroscope_bias", (3,)),
    ("accelerometer_bias", (3,)),
)
_KNOWN = (("covariance", (27, 27)), ("gain", (27, 12)))
"""What changes only when the gain does, in a group of the state by itself."""


def _places(
    fields: tuple[tuple[str, tuple[int, ...]], ...], start: int
) -> tuple[tuple[str, slice, tuple[int, ...]], ...]:
    """Says where each field lies behind `start` numbers, and its shape."""
    places = []
    for name, shape in fields:
        end = start + int(np.prod(shape))
        places.append((name, slice(start, end), shape))
        start = end
    return tuple(places)


_PLACES = _places(_MEAN, 8), _places(_KNOWN, 0)


def pack(estimate: BaseEstimate) -> Vector:
    """Lays out as numbers what changes with every tick, discrete state of the System.

    The other group is what `pack_known` gives.
    """
    counts = (
        *(estimate.settled, estimate.at_rest, estimate.ticks, estimate.since),
        *(*estimate.standing, *estimate.slips),
    )
    parts = [getattr(estimate, name).ravel() for name, _ in _MEAN]
    return np.concatenate([counts, *parts], dtype=np.float64)


def pack_known(estimate: BaseEstimate) -> Vector:
    """Lays out covariance and gain, (1053,)."""
    return np.concatenate([estimate.covariance.ravel(), estimate.gain.ravel()])


def unpack(values: Vector, known: Vector) -> BaseEstimate:
    """Reads what `pack` and `pack_known` wrote."""
    parts = {
        name: numbers[rows].reshape(shape)
        for numbers, places in zip((values, known), _PLACES, strict=True)
        for name, rows, shape in places
    }
    settled, at_rest, ticks, since, *feet = values[:8].tolist()
    left, right, slips_left, slips_right = feet
    return BaseEstimate(
        settled=settled > 0.5,
        at_rest=at_rest > 0.5,
        ticks=int(ticks),
        since=since,
        standing=(left > 0.5, right > 0.5),
        slips=(int(slips_left), int(slips_right)),
        **parts,
    )


def deviations(estimate: BaseEstimate) -> Vector:
    """Standard deviations of orientation, velocity and position, about W's axes, (9,).

    The filter's error of velocity and position turns about W's origin with that of the
    orientation; here each is what it is at the base: rad, m/s, m. They are as old as
    the covariance.
    """
    P = estimate.covariance
    variances = np.empty(9)
    variances[:3] = np.diag(P[Rows.R, Rows.R])
    for rows, at in ((Rows.v, estimate.v_WB), (Rows.p, estimate.p_WB)):
        lever = skew(at)
        cross = lever @ P[Rows.R, rows]
        total = P[rows, rows] - cross - cross.T + lever @ P[Rows.R, Rows.R] @ lever.T
        variances[rows] = np.diag(total)
    return np.sqrt(np.maximum(variances, 0.0))
