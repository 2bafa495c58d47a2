"""The filter against closed forms, and its covariance against errors it makes."""

import numpy as np
import pytest
from scipy.stats import chi2

from footfall.models.values.vector import Vector
from footfall.systems.estimation.base_estimate import (
    BaseEstimate,
    FootPose,
    deviations,
    initial_estimate,
)
from footfall.systems.estimation.filter_params import (
    SIZE,
    FilterParams,
    Rows,
    filter_model,
)
from footfall.systems.estimation.invariant_ekf import carried, hold_feet, propagate
from footfall.systems.estimation.rotations import exp_rotation, log_rotation

G = 9.81
H = 0.005
BOTH = (True, True)
PARAMS = FilterParams()
MODEL = filter_model(PARAMS, G)
REST = filter_model(PARAMS, G, at_rest=True)
FEET_W = np.array([[0.0, 0.09, 0.0], [0.0, -0.09, 0.0]])
UPRIGHT = np.eye(3)
PELVIS = np.array([0.01, 0.0, 0.8])


def begin(params: FilterParams = PARAMS) -> BaseEstimate:
    """The robot stands upright, its feet under it."""
    return initial_estimate(UPRIGHT, PELVIS, params)


def seen(R: Vector, p: Vector, feet: Vector = FEET_W) -> tuple[FootPose, FootPose]:
    """Level soles as a base sees them."""
    left, right = (FootPose(R.T @ (foot - p), R.T) for foot in feet)
    return left, right


def test_free_fall() -> None:
    """Nothing is felt: p falls by g t^2 / 2, whatever the steps."""
    estimate = begin()
    for _ in range(100):
        estimate = propagate(estimate, np.zeros(3), np.zeros(3), H, MODEL)
    np.testing.assert_allclose(estimate.v_WB, [0.0, 0.0, -G * 0.5], atol=1e-12)
    fallen = PELVIS - np.array([0.0, 0.0, 0.5 * G * 0.25])
    np.testing.assert_allclose(estimate.p_WB, fallen, atol=1e-12)


def test_pure_rotation() -> None:
    """A base that spins in place feels gravity turn; it stays where it is."""
    rate = np.array([0.4, -0.3, 1.0])
    estimate = begin()
    for k in range(200):
        R_mid = exp_rotation(rate * (k + 0.5) * H)
        force = R_mid.T @ np.array([0.0, 0.0, G])
        estimate = propagate(estimate, rate, force, H, MODEL)
    np.testing.assert_allclose(estimate.R_WB, exp_rotation(rate), atol=1e-9)
    np.testing.assert_allclose(estimate.p_WB, PELVIS, atol=1e-9)
    R = estimate.R_WB
    np.testing.assert_allclose(R.T @ R, np.eye(3), atol=1e-14)


def test_standing_robot_learns_the_gyroscope_bias() -> None:
    """Feet that stand tell it; heading and place stay."""
    bias = np.array([2e-3, -1e-3, 3e-3])
    estimate = begin()
    for _ in range(2000):
        force = np.array([0.0, 0.0, G])
        estimate = propagate(estimate, bias, force, H, REST)
        estimate = hold_feet(estimate, seen(UPRIGHT, PELVIS), BOTH, REST)
    np.testing.assert_allclose(estimate.gyroscope_bias, bias, atol=1e-4)
    np.testing.assert_allclose(estimate.p_WB, PELVIS, atol=1e-3)
    assert np.linalg.norm(log_rotation(estimate.R_WB)) < np.radians(0.1)
    assert estimate.slips == (0, 0)


def test_a_base_that_sways_over_standing_feet() -> None:
    """Position and velocity follow it within a millimetre and 2 mm/s."""
    estimate, worst = begin(), np.zeros(2)
    omega, size = 2.0 * np.pi * 0.8, 0.05
    for k in range(1, 800):
        t, mid = k * H, (k - 0.5) * H
        y, rate = size * (1 - np.cos(omega * t)), size * omega * np.sin(omega * t)
        force = np.array([0.0, size * omega**2 * np.cos(omega * mid), G])
        estimate = propagate(estimate, np.zeros(3), force, H, MODEL)
        p = PELVIS + np.array([0.0, y, 0.0])
        estimate = hold_feet(estimate, seen(UPRIGHT, p), BOTH, MODEL)
        errors = estimate.p_WB - p, estimate.v_WB - np.array([0.0, rate, 0.0])
        worst = np.maximum(worst, [np.abs(error).max() for error in errors])
    assert worst[0] < 1e-3
    assert worst[1] < 2e-3


def test_steps_are_counted_by_the_feet() -> None:
    """Feet that are set down in turn carry the estimate with them."""
    estimate, feet = begin(), FEET_W.copy()
    p, velocity = PELVIS.copy(), np.array([0.3, 0.0, 0.0])
    estimate = estimate._replace(v_WB=velocity)
    for k in range(800):
        standing = (k // 100 % 2 == 0, k // 100 % 2 == 1)
        swing = int(standing[0])
        feet[swing, 0] += 2.0 * velocity[0] * H
        p = p + velocity * H
        force = np.array([0.0, 0.0, G])
        estimate = propagate(estimate, np.zeros(3), force, H, MODEL)
        estimate = hold_feet(estimate, seen(UPRIGHT, p, feet), standing, MODEL)
    np.testing.assert_allclose(estimate.p_WB, p, atol=2e-3)
    assert estimate.p_WB[0] > 1.1
    assert estimate.slips == (0, 0)


def test_a_foot_that_jumps_is_let_go() -> None:
    """The base stays where the other foot and the IMU say that it is."""
    estimate, feet = begin(), FEET_W.copy()
    for k in range(200):
        if k == 100:
            feet[1, 0] += 0.05
        force = np.array([0.0, 0.0, G])
        estimate = propagate(estimate, np.zeros(3), force, H, MODEL)
        estimate = hold_feet(estimate, seen(UPRIGHT, PELVIS, feet), BOTH, MODEL)
    assert estimate.slips == (0, 1)
    np.testing.assert_allclose(estimate.p_WB, PELVIS, atol=1e-3)
    np.testing.assert_allclose(estimate.p_WF, feet, atol=2e-3)


def test_without_feet_the_filter_knows_that_it_drifts() -> None:
    """The deviation of the place grows; a foot alone takes its growth away."""
    estimate = begin()
    for _ in range(200):
        force = np.array([0.0, 0.0, G])
        estimate = propagate(estimate, np.zeros(3), force, H, MODEL)
    assert deviations(carried(estimate, MODEL))[6] > 0.02


def drawn_walk(seed: int, params: FilterParams) -> tuple[BaseEstimate, Vector]:
    """A walk drawn from the filter's own model, and the error at its end, (27,)."""
    rng, model = np.random.default_rng(seed), filter_model(params, G)
    first = begin(params)
    # The truth is off from where the filter begins by a draw of its own covariance.
    chance = np.linalg.eigh(first.covariance)
    root = chance[1] * np.sqrt(np.maximum(chance[0], 0.0))
    xi = root @ rng.standard_normal(SIZE)
    turn = exp_rotation(-xi[Rows.R])
    R, p = turn @ first.R_WB, turn @ first.p_WB - xi[Rows.p]
    v = -xi[Rows.v]
    b_g, b_a = -xi[Rows.b_g], -xi[Rows.b_a]
    feet, turns = FEET_W.copy(), np.stack([np.eye(3)] * 2)
    estimate = first
    white, root_h = rng.standard_normal, np.sqrt(H)
    for k in range(300):
        rate = np.array([0.3 * np.sin(0.01 * k), 0.2, -0.3 * np.cos(0.02 * k)])
        pull = np.array([np.sin(0.05 * k), -np.cos(0.04 * k), 0.3])
        R_mid = R @ exp_rotation(0.5 * rate * H)
        force = R_mid.T @ (pull + np.array([0.0, 0.0, G]))
        felt_rate = rate + b_g + params.gyroscope * white(3) / root_h
        felt_force = force + b_a + params.accelerometer * white(3) / root_h
        estimate = propagate(estimate, felt_rate, felt_force, H, model)
        p = p + v * H + 0.5 * H**2 * pull
        v = v + pull * H
        R = R @ exp_rotation(rate * H)
        b_g = b_g + params.gyroscope_walk * root_h * white(3)
        b_a = b_a + params.accelerometer_walk * root_h * white(3)
        standing = (k % 100 < 60, k % 100 >= 40)
        poses = []
        for i in range(2):
            feet[i] += params.contact * root_h * white(3)
            turns[i] = exp_rotation(params.contact_turn * root_h * white(3)) @ turns[i]
            noise = exp_rotation(params.foot_turn * white(3))
            p_BF = R.T @ (feet[i] - p + params.foot_position * white(3))
            poses.append(FootPose(p_BF, R.T @ noise @ turns[i]))
        estimate = hold_feet(estimate, (poses[0], poses[1]), standing, model)
    turn_error = log_rotation(estimate.R_WB @ R.T)
    carried = exp_rotation(turn_error)
    error = np.zeros(SIZE)
    error[Rows.R] = turn_error
    error[Rows.v] = estimate.v_WB - carried @ v
    error[Rows.p] = estimate.p_WB - carried @ p
    error[Rows.b_g] = estimate.gyroscope_bias - b_g
    error[Rows.b_a] = estimate.accelerometer_bias - b_a
    return estimate, error


@pytest.mark.parametrize("gain_time", [0.0, FilterParams().gain_time])
def test_covariance_holds_on_its_own_model(gain_time: float) -> None:
    """NEES of base and biases over 100 seeds is within its 95 % bounds."""
    params = FilterParams(slip_gate=1e6, gain_time=gain_time)
    rows = np.r_[0:9, 21:27]
    nees = []
    for seed in range(100):
        estimate, error = drawn_walk(seed, params)
        P = carried(estimate, filter_model(params, G)).covariance[np.ix_(rows, rows)]
        nees.append(error[rows] @ np.linalg.solve(P, error[rows]))
    low, high = chi2.ppf([0.025, 0.975], 100 * len(rows)) / 100.0
    assert low < np.mean(nees) < high


def test_a_gain_that_is_kept_loses_little() -> None:
    """Beside one of every tick, base and biases are known as well but for 5 %."""
    spread = {}
    for gain_time in (0.0, 0.04):
        params = FilterParams(slip_gate=1e6, gain_time=gain_time)
        estimate = carried(drawn_walk(0, params)[0], filter_model(params, G))
        spread[gain_time] = np.sqrt(np.diag(estimate.covariance))[np.r_[0:9, 21:27]]
    ratio = spread[0.04] / spread[0.0]
    assert ratio.min() > 0.999
    assert ratio.max() < 1.05


def test_a_kept_gain_is_computed_anew_when_a_foot_lifts() -> None:
    """In the same tick; its rows of the foot that left are zero."""
    estimate, left = begin(), (True, False)
    for standing in (*(BOTH,) * 60, left):
        force = np.array([0.0, 0.0, G])
        estimate = propagate(estimate, np.zeros(3), force, H, MODEL)
        estimate = hold_feet(estimate, seen(UPRIGHT, PELVIS), standing, MODEL)
        if standing == BOTH:
            assert estimate.ticks < 8
    assert estimate.ticks == 0
    assert not estimate.gain[:, 6:].any()
    assert estimate.gain[:, :6].any()


@pytest.mark.parametrize("field", ["foot_position", "foot_turn", "slip_gate"])
def test_parameters_out_of_range_are_refused(field: str) -> None:
    """By name."""
    with pytest.raises(ValueError, match=f"^{field}: must"):
        FilterParams(**{field: 0.0}).validate()
