"""A mean over a stretch of time that does not depend on the step."""

import numpy as np
import pytest

from footfall.systems.sensing.moving_mean import window_weights


@pytest.mark.parametrize(
    ("step", "expected"),
    [
        (0.005, [0.5, 0.5]),
        (0.0025, [0.25] * 4),
        (0.01, [1.0]),
        (0.02, [1.0]),
        (0.004, [0.4, 0.4, 0.2]),
    ],
)
def test_weights_fill_the_window(step: float, expected: list[float]) -> None:
    """The oldest sample counts with what of its step lies inside."""
    np.testing.assert_allclose(window_weights(0.01, step), expected)


def test_the_same_impulse_has_the_same_largest_mean_at_every_step() -> None:
    """Whether a step holds all of it or twenty share it."""
    for step in (0.0005, 0.001, 0.0025, 0.005, 0.01):
        steps = round(0.005 / step) or 1
        force = np.zeros(round(0.05 / step))
        force[:steps] = 3.0 / (steps * step)
        weights = window_weights(0.01, step)
        mean = np.convolve(force, weights)
        assert mean.max() == pytest.approx(300.0, rel=1e-9), step
