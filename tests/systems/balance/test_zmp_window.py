"""The analytic window against its own equations and against Kajita's preview."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    ZmpPreviewParams,
    generate,
    preview_gains,
)
from footfall.systems.balance.zmp_window import generate_by_window, window_gains

PARAMS = ZmpPreviewParams(period=0.01)


def _steps() -> Vector:
    zmp: Vector = np.zeros((800, 2))
    zmp[300:, 0] = 0.2
    zmp[380:, 0] = 0.5
    zmp[300:380, 1] = 0.1
    return zmp


def test_the_window_predicts_the_zmp() -> None:
    """Eq. 16: P_x and P_u against the motion itself."""
    gains = window_gains(PARAMS)
    motion = generate_by_window(gains, _steps(), PARAMS)
    k, n = 250, len(gains.P_x)
    state = np.stack([motion.com[k], motion.velocity[k], motion.acceleration[k]])
    predicted = gains.P_x @ state + gains.P_u @ motion.jerk[k : k + n]
    np.testing.assert_allclose(predicted, motion.zmp[k + 1 : k + n + 1], atol=1e-9)


def test_the_first_jerk_is_the_minimiser() -> None:
    """Eq. 18 solves Eq. 17: any other first jerk costs more."""
    gains = window_gains(PARAMS)
    n = len(gains.P_x)
    state = np.array([0.01, 0.05, -0.1])
    wanted = np.linspace(0.0, 0.2, n)
    jerk = -(state @ gains.K_x + gains.K_p @ wanted)

    def min_cost(first: float) -> float:
        rest = wanted - gains.P_x @ state - gains.P_u[:, 0] * first
        A = np.vstack([gains.P_u[:, 1:], np.sqrt(PARAMS.jerk_weight) * np.eye(n - 1)])
        b = np.concatenate([rest, np.zeros(n - 1)])
        solution, *_ = np.linalg.lstsq(A, b, rcond=None)
        error = A @ solution - b
        return float(error @ error + PARAMS.jerk_weight * first**2)

    assert min_cost(jerk) < min_cost(jerk + 0.05)
    assert min_cost(jerk) < min_cost(jerk - 0.05)


def test_it_moves_the_com_like_kajitas_preview() -> None:
    """Two forms of one idea: within millimetres of each other."""
    window = generate_by_window(window_gains(PARAMS), _steps(), PARAMS)
    kajita = generate(preview_gains(PARAMS), _steps())
    assert np.abs(window.com - kajita.com).max() < 0.01
    assert np.abs(window.zmp - _steps())[450:].max() < 2e-3
    with pytest.raises(ValueError, match="zmp_ref"):
        generate_by_window(window_gains(PARAMS), np.zeros((0, 2)), PARAMS)
