"""The static margin of true contacts."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.diagrams.judge.static_margin import static_margins, true_contact
from footfall.diagrams.judge.true_motion import sole_corners_F
from footfall.models.robots.jvrc1 import JVRC1
from tests.diagrams.judge.climb_evidence import SAMPLES, WEIGHT, motion_of

SOLE = JVRC1.sole


def posed(pitch: float) -> tuple[np.ndarray, np.ndarray]:
    """Pose of a sole that rolls, and its corners."""
    X_WF = RigidTransform(RollPitchYaw(0.0, pitch, 0.3), np.array([1.0, 2.0, 0.1]))
    return X_WF.GetAsMatrix4(), np.array(X_WF.multiply(sole_corners_F(SOLE).T)).T


def test_a_flat_sole_is_the_whole_contact() -> None:
    """Its corners are the sole's."""
    X_WF, corners = posed(0.0)
    contact = true_contact(X_WF, corners, 0.8)
    for corner in contact.corners():
        assert np.linalg.norm(corners - corner, axis=1).min() < 1e-8
    assert contact.half_length == pytest.approx(SOLE.length / 2.0)


@pytest.mark.parametrize(("pitch", "edge"), [(0.2, [1, 2]), (-0.2, [0, 3])])
def test_a_sole_that_rolls_stands_on_its_edge(pitch: float, edge: list[int]) -> None:
    """Toes or heel."""
    X_WF, corners = posed(pitch)
    contact = true_contact(X_WF, corners, 0.8)
    for corner in contact.corners():
        assert np.linalg.norm(corners[edge] - corner, axis=1).min() < 2e-4


def test_margins_are_those_of_the_feet_that_bear() -> None:
    """Between both feet it is 7.5 cm to the heels; over one alone it is outside."""
    motion = motion_of(["floor"] * 7, ["floor"] * 7)
    half = np.full(SAMPLES, 0.5 * WEIGHT)
    both = static_margins(motion, {"left": half, "right": half}, WEIGHT, 0.8)
    np.testing.assert_allclose(both, 0.075, atol=1e-6)
    loads = {"left": half, "right": np.zeros(SAMPLES)}
    alone = static_margins(motion, loads, WEIGHT, 0.8)
    np.testing.assert_allclose(alone, -(0.1 - 0.042), atol=1e-6)
    nothing = {"left": np.zeros(SAMPLES), "right": np.zeros(SAMPLES)}
    assert np.isneginf(static_margins(motion, nothing, WEIGHT, 0.8)).all()
