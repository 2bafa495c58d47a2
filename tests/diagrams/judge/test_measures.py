"""What a run is measured by, on motions whose measures are known."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.diagrams.judge.measures import (
    Interval,
    contact_intervals,
    foot_slip,
    nosings,
    swing_clearance,
    zmp_margins,
)
from footfall.models.scenes.staircase import StaircaseParams

WEIGHT = 600.0
HEEL, TOE, HALF = 0.075, 0.15, 0.042
CORNERS_F = np.array(
    [[-HEEL, -HALF, 0], [TOE, -HALF, 0], [TOE, HALF, 0], [-HEEL, HALF, 0]]
)


def sole(
    x: float, y: float = 0.0, z: float = 0.0, pitch: float = 0.0, yaw: float = 0.0
):
    """Corners of a sole in W, (4, 3)."""
    X_WF = RigidTransform(RollPitchYaw(0.0, pitch, yaw), np.array([x, y, z]))
    return np.array(X_WF.multiply(CORNERS_F.T)).T


def test_contact_begins_loaded_and_ends_lifted() -> None:
    """Between the two thresholds a foot keeps the state it was in."""
    shares = np.array([0.1, 0.3, 0.1, 0.05, 0.3, 0.01, 0.1, 0.25])
    assert contact_intervals(shares * WEIGHT, WEIGHT) == [
        Interval(1, 5),
        Interval(7, 8),
    ]


def test_slip_is_measured_within_a_contact_only() -> None:
    """A step of 30 cm is no slip; 12 mm of sliding while loaded is."""
    x = np.concatenate([np.zeros(10), np.linspace(0.0, 0.3, 10), np.full(10, 0.3)])
    x[25:] += 0.012
    force = np.full(30, WEIGHT)
    force[10:20] = 0.0
    corners = np.stack([sole(value) for value in x])
    assert foot_slip(corners, force, WEIGHT) == pytest.approx(0.012)
    assert foot_slip(corners, np.zeros(30), WEIGHT) is None


def test_an_unloaded_touch_may_slide() -> None:
    """What a foot does while it hardly bears anything is not slip."""
    corners = np.stack([sole(0.0), sole(0.0), sole(0.05)])
    force = np.array([0.5, 0.5, 0.1]) * WEIGHT
    assert foot_slip(corners, force, WEIGHT) == 0.0


def test_rolling_over_the_toes_is_no_slip_but_turning_is() -> None:
    """A lifted heel swings about the toe edge; a yawing foot has no fixed edge."""
    pitches = np.linspace(0.0, 0.6, 20)
    rolling = np.stack(
        [sole(TOE * (1.0 - np.cos(p)), z=TOE * np.sin(p), pitch=p) for p in pitches]
    )
    force = np.full(20, WEIGHT)
    assert np.abs(rolling[:, 1, :] - rolling[0, 1, :]).max() < 1e-12
    assert foot_slip(rolling, force, WEIGHT) == pytest.approx(0.0, abs=1e-9)
    turning = np.stack([sole(0.0, yaw=p) for p in pitches])
    slip = foot_slip(turning, force, WEIGHT)
    assert slip == pytest.approx(2.0 * np.sin(0.3) * np.hypot(HEEL, HALF))


def test_turning_about_one_corner_is_slip() -> None:
    """One corner stays, but a foot does not stand on a point."""
    turned = np.stack([sole(0.0, yaw=angle) for angle in (0.0, 0.1)])
    turned[1] += turned[0, 0] - turned[1, 0]
    slip = foot_slip(turned, np.full(2, WEIGHT), WEIGHT)
    assert slip == pytest.approx(2.0 * np.sin(0.05) * 2.0 * HALF)


def test_margin_is_the_distance_to_the_edge_of_the_hull() -> None:
    """Positive inside, negative outside, of one sole or of both."""
    corners = tuple(sole(0.0, y)[None].repeat(4, axis=0) for y in (0.1, -0.1))
    zmp = np.array([[0.0, 0.1], [0.0, 0.0], [0.0, 0.0], [np.nan, np.nan]])
    left = np.array([1.0, 0.5, 1.0, 0.0]) * WEIGHT
    right = np.array([0.0, 0.5, 0.0, 0.0]) * WEIGHT
    margins = zmp_margins(zmp, corners, (left, right), WEIGHT)
    np.testing.assert_allclose(margins[:3], [HALF, HEEL, -(0.1 - HALF)], atol=1e-12)
    assert np.isnan(margins[3])


def test_lifted_corners_do_not_support() -> None:
    """A foot on its toes supports on its toe edge alone."""
    rolling = sole(0.0, pitch=0.3)[None]
    far = sole(9.0)[None]
    toe_x = float(rolling[0, 1, 0])
    margins = zmp_margins(
        np.array([[toe_x - 0.05, 0.0]]),
        (rolling, far),
        (np.array([WEIGHT]), np.zeros(1)),
        WEIGHT,
    )
    assert margins[0] == pytest.approx(-0.05)


def swing(height: float, landing: float) -> tuple[np.ndarray, np.ndarray]:
    """A flat sole that rises, passes the nosing at x = 0, z = 0.2 and comes down."""
    lift_off = -TOE - 0.05
    path = np.vstack(
        [
            np.linspace([lift_off, 0.0], [lift_off, height], 200),
            np.linspace([lift_off, height], [landing, height], 400)[1:],
            np.linspace([landing, height], [landing, 0.2], 200)[1:],
        ]
    )
    corners = np.stack([sole(x, z=z) for x, z in path])
    force = np.zeros(len(path))
    force[[0, -1]] = WEIGHT
    return corners, force


def test_clearance_over_a_nosing() -> None:
    """A sole that passes 3 cm above clears it by 3 cm, wherever it lands beyond."""
    edges = nosings(StaircaseParams(steps=1, x=0.0).treads())
    for landing in (0.1, 0.2):
        corners, force = swing(0.23, landing)
        clearance = swing_clearance(corners, force, WEIGHT, edges)
        assert clearance == pytest.approx(0.03, abs=1e-3)


def test_clearance_of_an_overhanging_landing_is_that_of_the_toes() -> None:
    """The heel stays before the edge, so the sole comes down onto the edge itself."""
    edges = nosings(StaircaseParams(steps=1, x=0.0).treads())
    corners, force = swing(0.23, 0.05)
    clearance = swing_clearance(corners, force, WEIGHT, edges)
    assert clearance == pytest.approx(0.03, abs=1e-3)


def test_a_foot_that_tumbles_over_an_edge_heel_first_has_no_clearance() -> None:
    """A robot that falls down the stairs is measured too."""
    edges = nosings(StaircaseParams(steps=1, x=0.0).treads())
    corners = np.stack([sole(0.1, z=0.3, yaw=np.pi), sole(0.3, z=0.3)])
    force = np.array([WEIGHT, WEIGHT])
    path = np.stack([corners[0], corners[0], corners[1], corners[1]])
    assert path[0, [1, 2], 0].max() < 0.0 < path[0, [0, 3], 0].min()
    loads = np.array([force[0], 0.0, 0.0, force[1]])
    assert swing_clearance(path, loads, WEIGHT, edges) is None


def test_passing_through_the_step_is_negative_and_passing_none_is_none() -> None:
    """2 cm below the nosing is -2 cm."""
    edges = nosings(StaircaseParams(steps=1, x=0.0).treads())
    corners, force = swing(0.18, 0.2)
    assert swing_clearance(corners, force, WEIGHT, edges) == pytest.approx(-0.02)
    assert swing_clearance(corners, force, WEIGHT, []) is None
    standing = np.stack([sole(-1.0)] * 3)
    assert swing_clearance(standing, np.full(3, WEIGHT), WEIGHT, edges) is None
