"""Parameters of a motion: what is refused."""

import dataclasses

import numpy as np
import pytest

from footfall.systems.planning.motion.motion_params import MotionPlannerParams

ZERO_ALLOWED = {
    *("zmp_forward", "climb_zmp_forward", "zmp_inward", "lean", "max_toe_off"),
    *("toe_off_start", "climb_inward", "climb_roll", "knee_margin"),
}
# A sole's middle may lie behind its ankle.
SIGNED = {"zmp_forward", "climb_zmp_forward"}
NUMBERS = [
    field.name
    for field in dataclasses.fields(MotionPlannerParams)
    if field.type is float or field.type == "float"
]


def test_defaults_are_in_range() -> None:
    """And there are numbers to check."""
    MotionPlannerParams().validate()
    assert len(NUMBERS) >= 16


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("value", [-0.1, np.nan, np.inf])
def test_every_number_is_checked(name: str, value: float) -> None:
    """By name, with what it got."""
    params = MotionPlannerParams(**{name: value})
    if value < 0.0 and name in SIGNED:
        params.validate()
    else:
        with pytest.raises(ValueError, match=rf"^{name}: .* got {value}"):
            params.validate()


@pytest.mark.parametrize("name", NUMBERS)
def test_zero_is_refused_where_it_makes_no_sense(name: str) -> None:
    """A duration or a height of nothing."""
    params = MotionPlannerParams(**{name: 0.0})
    if name in ZERO_ALLOWED:
        params.validate()
    else:
        with pytest.raises(ValueError, match=rf"^{name}: must .*got 0"):
            params.validate()


def test_toe_off_starts_within_the_double_support() -> None:
    """Not at its end."""
    with pytest.raises(ValueError, match=r"^toe_off_start: must be less than 1"):
        MotionPlannerParams(toe_off_start=1.0).validate()


def test_the_swing_is_checked_too() -> None:
    """Its fields by their path."""
    params = MotionPlannerParams()
    params.swing.edge_clearance = -1.0
    with pytest.raises(ValueError, match=r"^swing\.edge_clearance: "):
        params.validate()
