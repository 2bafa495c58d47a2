"""Rotations in plain numbers against Drake's and SciPy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from footfall.systems.estimation.rotations import (
    exp_rotation,
    left_jacobian,
    log_rotation,
    skew,
)

turns = st.lists(st.floats(-1.5, 1.5), min_size=3, max_size=3).map(np.array)


@given(turns)
def test_exp_and_log(turn: np.ndarray) -> None:
    """As SciPy has them, and each other's inverse."""
    R = exp_rotation(turn)
    np.testing.assert_allclose(R, Rotation.from_rotvec(turn).as_matrix(), atol=1e-12)
    np.testing.assert_allclose(log_rotation(R), turn, atol=1e-9)


@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-9, 1e-7])
def test_small_turns(size: float) -> None:
    """Nothing is divided by nothing."""
    turn = size * np.array([0.6, 0.0, -0.8])
    np.testing.assert_allclose(log_rotation(exp_rotation(turn)), turn, atol=1e-15)
    np.testing.assert_allclose(left_jacobian(turn), np.eye(3), atol=1e-6)


@given(turns)
def test_left_jacobian(turn: np.ndarray) -> None:
    """What exp of SE(3) does to a translation."""
    twist = np.zeros((4, 4))
    twist[:3, :3], twist[:3, 3] = skew(turn), (0.3, -0.2, 0.5)
    np.testing.assert_allclose(
        left_jacobian(turn) @ twist[:3, 3], expm(twist)[:3, 3], atol=1e-9
    )
