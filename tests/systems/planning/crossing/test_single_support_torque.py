"""Joint torques of a planned motion on one foot."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.quasi_static_check import worst_torque
from footfall.systems.planning.crossing.single_support_torque import (
    single_support_torque,
)
from footfall.systems.planning.whole_body.whole_body_plan import body_motion
from tests.systems.planning.crossing.crossing_cases import body, scratch

PERIOD = 0.01
N = 9


def _on_right(height: Vector) -> tuple[Vector, Vector]:
    """Postures with the CoM over the right sole, (n, nq), and the feet."""
    n = len(height)
    feet: Vector = np.zeros((n, 2, 6))
    feet[:, 0, 1], feet[:, 1, 1] = 0.095, -0.095
    feet[:, 0, 2] = 0.05
    com = np.tile([0.03, -0.09], (n, 1))
    rpy: Vector = np.zeros((n, 3))
    motion = body_motion(body(), com, height, rpy, feet, 0.0, rounds=6)
    return motion.q, feet


RIGHT: Vector = np.tile([0.0, 1.0], (N, 1))


def test_at_rest_it_is_what_standing_takes() -> None:
    """As the quasi-static check finds it, which distributes the wrench."""
    q, feet = _on_right(np.full(N, 0.72))
    share, joint, _ = single_support_torque(body(), scratch(), q, PERIOD, RIGHT)
    expected, name, _ = worst_torque(body(), scratch(), q, feet, RIGHT, 0.6)
    assert joint == name == "R_KNEE"
    assert share == pytest.approx(expected, rel=1e-3)


def test_a_body_that_is_pushed_up_takes_more() -> None:
    """In the measure of its acceleration and of the turning legs, less if it falls."""
    time = PERIOD * (np.arange(N) - N // 2)
    shares = {}
    for acceleration in (-3.0, 0.0, 3.0):
        q, _ = _on_right(0.72 + 0.5 * acceleration * time**2)
        middle = RIGHT.copy()
        middle[np.arange(N) != N // 2] = 1.0
        shares[acceleration], _, row = single_support_torque(
            body(), scratch(), q, PERIOD, middle
        )
        assert row == N // 2
    more, less = shares[3.0] - shares[0.0], shares[0.0] - shares[-3.0]
    assert 1.0 < more / (shares[0.0] * 3.0 / 9.81) < 1.25
    assert less == pytest.approx(more, rel=0.05)


def test_with_both_feet_down_nothing_is_told() -> None:
    """The load can be shared in many ways."""
    q, _ = _on_right(np.full(N, 0.72))
    both = np.ones((N, 2))
    assert single_support_torque(body(), scratch(), q, PERIOD, both) == (0.0, "", 0)


def test_the_foot_that_carries_counts() -> None:
    """Were the left one to carry, its hip would have the whole weight aside."""
    q, _ = _on_right(np.full(N, 0.72))
    left = RIGHT[:, ::-1]
    _, joint, _ = single_support_torque(body(), scratch(), q, PERIOD, left)
    assert joint.startswith("L_")
