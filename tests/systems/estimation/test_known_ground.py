"""Ground whose place is known takes back what the legs have drifted."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.estimation.base_estimate import (
    BaseEstimate,
    FootPose,
    initial_estimate,
)
from footfall.systems.estimation.filter_params import FilterParams, filter_model
from footfall.systems.estimation.invariant_ekf import hold_feet, propagate
from footfall.systems.estimation.known_ground import stand_on
from footfall.systems.estimation.rotations import exp_rotation

PELVIS = np.array([0.0, 0.0, 0.8])
UP = np.array([0.0, 0.0, 1.0])
PARAMS = FilterParams()
MODEL = filter_model(PARAMS)
BOTH = (True, True)
DEVIATION, GATE = 2e-3, 9.0


def drifted(offset: Vector) -> tuple[BaseEstimate, Vector]:
    """A robot that believes its feet to be off, and how far it knows it may be."""
    estimate = initial_estimate(np.eye(3), PELVIS + offset, PARAMS)
    estimate = estimate._replace(
        covariance=estimate.covariance + 1e-4 * np.eye(27),
    )
    feet = tuple(
        FootPose(np.array([0.0, y, -PELVIS[2]]), np.eye(3)) for y in (0.09, -0.09)
    )
    estimate = hold_feet(estimate, feet, BOTH, MODEL)  # type: ignore[arg-type]
    return estimate, estimate.p_WF[0]


@pytest.mark.parametrize("offset", [0.012, -0.008])
def test_the_height_comes_back_and_nothing_else_moves(offset: float) -> None:
    """Of a sole on a level floor: base and both feet by as much, but for the tilt."""
    estimate, _ = drifted(np.array([0.0, 0.0, offset]))
    after = stand_on(estimate, 0, UP, 0.0, DEVIATION, GATE)
    assert abs(after.p_WF[0, 2]) < 0.1 * abs(offset)
    assert abs(after.p_WF[1, 2]) < 0.3 * abs(offset)
    assert abs(after.p_WB[2] - PELVIS[2]) < 0.3 * abs(offset)
    np.testing.assert_allclose(after.p_WF[0, :2], estimate.p_WF[0, :2], atol=1e-3)
    turn = np.linalg.norm(after.R_WB - np.eye(3))
    assert turn < 5e-3


def test_the_covariance_shrinks_across_the_plane_alone() -> None:
    """As by a scalar measurement of that deviation: 1/P+ = 1/P + 1/N."""
    estimate, d = drifted(np.zeros(3))
    normal = exp_rotation(np.array([0.0, -0.14, 0.0])) @ UP
    H = np.zeros(27)
    H[:3], H[9:12] = np.cross(d, normal), normal
    before = H @ estimate.covariance @ H
    after = stand_on(estimate, 0, normal, float(normal @ d), DEVIATION, GATE)
    expected = 1.0 / (1.0 / before + 1.0 / DEVIATION**2)
    assert H @ after.covariance @ H == pytest.approx(expected, rel=1e-9)
    side = np.zeros(27)
    side[10] = 1.0
    assert side @ after.covariance @ side == pytest.approx(
        side @ estimate.covariance @ side, rel=1e-2
    )
    np.testing.assert_allclose(after.p_WF, estimate.p_WF, atol=1e-12)


def test_a_sole_that_is_too_far_off_stands_on_something_else() -> None:
    """A tread that is 10 cm higher says nothing of where the robot is."""
    estimate, _ = drifted(np.zeros(3))
    after = stand_on(estimate, 1, UP, 0.1, DEVIATION, GATE)
    assert after is estimate


def test_steps_on_known_ground_do_not_drift_in_height() -> None:
    """A tilt of half a degree lifts a walk of 12 m, but not on known ground."""
    slope = exp_rotation(np.array([0.0, np.radians(0.5), 0.0]))
    walks = []
    for known in (False, True):
        estimate = initial_estimate(slope, PELVIS, PARAMS)
        estimate = estimate._replace(accelerometer_bias=np.array([0.0856, 0.0, 0.0]))
        feet, pelvis, velocity = (
            np.array([[0.0, 0.09, 0.0], [0.0, -0.09, 0.0]]),
            PELVIS.copy(),
            np.array([0.3, 0.0, 0.0]),
        )
        estimate = estimate._replace(v_WB=velocity)
        for k in range(8000):
            standing = (k // 100 % 2 == 0, k // 100 % 2 == 1)
            stance, swing = (0, 1) if standing[0] else (1, 0)
            feet[swing, 0] += 2.0 * velocity[0] * 0.005
            pelvis = pelvis + velocity * 0.005
            force = np.array([0.0, 0.0, 9.81])
            estimate = propagate(estimate, np.zeros(3), force, 0.005, MODEL)
            seen = tuple(FootPose(foot - pelvis, np.eye(3)) for foot in feet)
            estimate = hold_feet(estimate, seen, standing, MODEL)  # type: ignore
            if known and k % 100 == 20:
                estimate = stand_on(estimate, stance, UP, 0.0, DEVIATION, GATE)
        walks.append(abs(estimate.p_WB[2] - PELVIS[2]))
    free, held = walks
    assert held < 5e-3
    assert free > 4.0 * held
