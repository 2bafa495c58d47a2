"""Beams and their returns, in closed form."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.systems.sensing.scan_geometry import (
    beam_angles,
    beam_directions,
    line_to_points,
    tilt_pose,
)


def test_hokuyo_has_1081_beams() -> None:
    """270 deg by 0.25 deg, symmetric about straight ahead, from right to left."""
    angles = beam_angles(np.radians(270.0), np.radians(0.25))
    assert len(angles) == 1081
    np.testing.assert_allclose(np.degrees(angles[[0, 540, 1080]]), [-135, 0, 135])
    np.testing.assert_allclose(np.degrees(np.diff(angles)), 0.25)


def test_positive_tilt_looks_down_and_keeps_the_sides_level() -> None:
    """The servo turns about the axis that points to the left."""
    directions = beam_directions(np.array([0.0, np.pi / 2.0]))
    ahead, left = (tilt_pose(np.radians(30.0)).multiply(d) for d in directions)
    np.testing.assert_allclose(ahead, [np.cos(np.pi / 6), 0.0, -0.5], atol=1e-12)
    np.testing.assert_allclose(left, [0.0, 1.0, 0.0], atol=1e-12)


def test_points_lie_where_the_ranges_say() -> None:
    """Every finite range becomes one point, at that range, along its beam."""
    angles = beam_angles(np.radians(270.0), np.radians(1.0))
    ranges = np.random.default_rng(1).uniform(0.2, 9.0, len(angles))
    ranges[3], ranges[7] = np.nan, np.inf
    X_WL = RigidTransform(
        RollPitchYaw(0.1, 0.7, -0.4), np.array([1.0, 2.0, 1.6])
    ).multiply(tilt_pose(0.3))
    points = line_to_points(ranges, angles, X_WL)
    seen = np.isfinite(ranges)
    assert points.shape == (len(angles) - 2, 3)
    p_L = X_WL.inverse().multiply(points.T).T
    np.testing.assert_allclose(np.linalg.norm(p_L, axis=1), ranges[seen])
    np.testing.assert_allclose(np.arctan2(p_L[:, 1], p_L[:, 0]), angles[seen])
    assert p_L[:, 2] == pytest.approx(0.0, abs=1e-12)
