"""Where moving boxes are to be: smoothly from start to end, at their time."""

import numpy as np
import pytest

from footfall.systems.disturbance.box_mover import BoxMotion, BoxMover, box_motion

MOTION = BoxMotion((0.8, -1.8), (0.8, 0.2), 5.0, 2.0)


@pytest.mark.parametrize(
    ("time", "y"), [(0.0, -1.8), (5.0, -1.8), (6.0, -0.8), (7.0, 0.2), (60.0, 0.2)]
)
def test_a_box_moves_once(time: float, y: float) -> None:
    """It waits, is half-way in the middle of its time, and stays where it came to."""
    position, velocity = box_motion(MOTION, time)
    np.testing.assert_allclose(position, [0.8, y], atol=1e-12)
    if time != 6.0:
        np.testing.assert_array_equal(velocity, np.zeros(2))


def test_velocity_is_the_derivative() -> None:
    """By central differences, and without a jump at either end."""
    step = 1e-5
    for time in np.linspace(4.9, 7.1, 23):
        ahead, behind = box_motion(MOTION, time + step), box_motion(MOTION, time - step)
        rate = (ahead[0] - behind[0]) / (2.0 * step)
        np.testing.assert_allclose(box_motion(MOTION, time)[1], rate, atol=1e-6)


def test_positions_come_first_then_rates() -> None:
    """As the plant's servos take them."""
    other = BoxMotion((0.0, 0.0), (1.0, 0.0), 5.5, 1.0)
    mover = BoxMover([MOTION, other])
    context = mover.CreateDefaultContext()
    context.SetTime(6.0)
    state = mover.GetOutputPort("desired_state").Eval(context)
    np.testing.assert_allclose(
        state, [0.8, -0.8, 0.5, 0.0, 0.0, 1.875, 1.875, 0.0], atol=1e-12
    )
