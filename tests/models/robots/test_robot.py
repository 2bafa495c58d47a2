"""The few derived figures of a robot."""

import pytest

from footfall.models.robots.robot import Sole


def test_sole_length_is_from_heel_to_toe() -> None:
    """Not from the ankle."""
    sole = Sole(heel=0.1, toe=0.15, half_width=0.05, ankle_height=0.1)
    assert sole.length == pytest.approx(0.25)
