"""Rest, from the true state alone."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.judge.evidence import Evidence
from footfall.diagrams.judge.ground import FLOOR, tread_ground
from footfall.diagrams.judge.rest import (
    at_rest,
    rest_faults,
    rest_figures,
    support_margin,
    true_dcm,
)
from footfall.models.values.vector import Vector
from tests.diagrams.judge.climb_evidence import SAMPLES, TREADS, WEIGHT, motion_of


def test_the_dcm_is_v_over_omega_ahead_of_the_com() -> None:
    """With the CoM's height above the soles, wherever these stand."""
    motion = motion_of(["step 1"] * 7, ["step 1"] * 7)
    velocity: Vector = np.tile([0.3, -0.1, 5.0], (SAMPLES, 1))
    dcm = true_dcm(replace(motion, com_velocity=velocity))
    ahead = np.sqrt(0.8 / 9.81)
    expected = motion.com[:, :2] + ahead * np.array([0.3, -0.1])
    np.testing.assert_allclose(dcm, expected, atol=1e-12)


def test_the_support_is_the_hull_of_both_soles() -> None:
    """Signed distances to its edges; what overhangs a tread is no part of it."""
    floor = motion_of(["floor"] * 7, ["floor"] * 7)
    points: Vector = np.tile([0.0, 0.0], (SAMPLES, 1))
    np.testing.assert_allclose(support_margin(points, floor, FLOOR), 0.075)
    aside = points + np.array([0.0, 0.2])
    np.testing.assert_allclose(support_margin(aside, floor, FLOOR), -0.058)
    top = tread_ground(TREADS[1], "the top tread")
    away = support_margin(points, floor, top)
    assert np.isneginf(away).all()


def test_rest_needs_to_know_the_loads() -> None:
    """Unknown ones are none."""
    motion = motion_of(["floor"] * 7, ["floor"] * 7)
    half = np.full(SAMPLES, 0.5 * WEIGHT)
    known = rest_figures(motion, {"left": half, "right": half}, WEIGHT, FLOOR)
    assert at_rest(known).all()
    assert rest_faults(known, FLOOR) == []
    assert not at_rest(rest_figures(motion, None, WEIGHT, FLOOR)).any()


@pytest.mark.parametrize("foot", ["left", "right"])
def test_both_feet_count(climb: Evidence, foot) -> None:
    """Each alone may spoil it."""
    half = np.full(SAMPLES, 0.5 * WEIGHT)
    loads = {"left": half, "right": half, foot: np.full(SAMPLES, 0.05 * WEIGHT)}
    top = tread_ground(TREADS[1], "the top tread")
    figures = rest_figures(climb.motion, loads, WEIGHT, top)
    fault = f"the {foot} sole bears 5 % of the weight alone"
    assert rest_faults(figures, top) == [fault]
