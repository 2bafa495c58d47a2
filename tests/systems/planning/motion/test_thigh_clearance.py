"""A folded thigh keeps off the pelvis: the bow of the foot, the roll of the hips."""

import numpy as np
import pytest

from footfall.systems.planning.motion.thigh_clearance import (
    HighSwing,
    drawn_inwards,
    inward_bow,
    raised_hip,
)

STRAIGHT = np.column_stack([np.linspace(0.0, 1.0, 101), np.zeros((101, 2))])


def test_the_bow_sets_off_and_arrives_at_rest() -> None:
    """All of it in the middle."""
    u = np.linspace(0.0, 1.0, 1001)
    bow = inward_bow(u)
    assert bow[0] == bow[-1] == 0.0
    assert bow.argmax() == 500
    assert bow.max() == pytest.approx(1.0)
    rate = np.gradient(bow, u)
    assert abs(rate[[0, -1]]).max() < 0.02


@pytest.mark.parametrize(("foot", "side"), [("left", -1.0), ("right", 1.0)])
def test_a_foot_is_drawn_towards_the_other(foot, side) -> None:
    """To the right for the left one, across its heading; not up, not at the ends."""
    drawn = drawn_inwards(STRAIGHT, foot, 0.0, 0.07)
    np.testing.assert_allclose(drawn[:, [0, 2]], STRAIGHT[:, [0, 2]], atol=1e-12)
    assert drawn[50, 1] == pytest.approx(side * 0.07)
    np.testing.assert_allclose(drawn[[0, -1]], STRAIGHT[[0, -1]], atol=1e-12)
    turned = drawn_inwards(STRAIGHT, foot, np.pi / 2.0, 0.07)
    assert turned[50, 0] == pytest.approx(0.5 - side * 0.07)


def test_the_hip_of_the_foot_that_swings_is_raised() -> None:
    """Held over a high swing, level before, after and in a low one."""
    swings = [
        HighSwing("right", 1.0, 2.0, high=True),
        HighSwing("left", 2.5, 3.5, high=True),
        HighSwing("right", 4.0, 5.0, high=False),
    ]
    time = np.arange(601) * 0.01
    roll = raised_hip(time, swings, 6.0, 0.08)
    np.testing.assert_allclose(roll[(time >= 1.0) & (time <= 2.0)], -0.08)
    np.testing.assert_allclose(roll[(time >= 2.5) & (time <= 3.5)], 0.08)
    np.testing.assert_allclose(roll[time >= 4.0], 0.0, atol=1e-12)
    assert roll[0] == 0.0
    assert np.abs(np.diff(roll)).max() < 0.16 / 0.5 * 0.01 * 2.0
