"""Plane geometry against closed forms."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from shapely import Polygon

from footfall.models.values.geometry import (
    direction,
    heading,
    rectangle_corners,
    rectangle_corners_world,
    rotate,
    wrap_angle,
)


@pytest.mark.parametrize("turns", [-2, -1, 0, 1, 3])
@pytest.mark.parametrize("angle", [-np.pi, -3.0, -0.5, 0.0, 1.0, 3.1])
def test_whole_turns_are_taken_off(angle: float, turns: int) -> None:
    """Whether a number or an array is given."""
    wound = angle + 2.0 * np.pi * turns
    assert np.exp(1j * wrap_angle(wound)) == pytest.approx(np.exp(1j * angle))
    wrapped = wrap_angle(np.full((2, 3), wound))
    assert wrapped.shape == (2, 3)
    assert np.all((wrapped >= -np.pi) & (wrapped < np.pi))


def test_half_a_turn_is_minus_pi() -> None:
    """The interval is half open, so that an angle has one name."""
    assert wrap_angle(np.pi) == wrap_angle(-np.pi) == -np.pi


@pytest.mark.parametrize("yaw", [-2.5, 0.0, 0.7, 3.0])
def test_heading_direction_and_rotation_agree(yaw: float) -> None:
    """All count yaw from x to y; a pitch of the frame leaves its heading."""
    X_WF = RigidTransform(RollPitchYaw(0.0, 0.4, yaw), [1.0, 2.0, 3.0])
    assert heading(X_WF) == pytest.approx(yaw)
    np.testing.assert_allclose(rotate(yaw, np.array([1.0, 0.0])), direction(yaw))
    many = rotate(yaw, np.array([[[1.0, 0.0]], [[0.0, 2.0]]]))
    np.testing.assert_allclose(many[1, 0], 2.0 * direction(yaw + np.pi / 2), atol=1e-12)


def test_a_rectangle_has_its_area_and_turns_left() -> None:
    """Counter-clockwise outlines have a positive area."""
    corners = rectangle_corners(np.array([0.4, 0.3]))
    np.testing.assert_array_equal(corners[0], [-0.2, -0.15])
    polygon = Polygon(corners)
    assert polygon.exterior.is_ccw
    assert polygon.area == pytest.approx(0.12)


def test_a_rectangle_in_the_world_keeps_its_plane_and_sides() -> None:
    """The corners lie in R's plane about its origin."""
    X_WR = RigidTransform(RollPitchYaw(0.2, -0.3, 1.0), [0.5, -1.0, 2.0])
    size: np.ndarray = np.array([0.4, 0.3])
    corners = rectangle_corners_world(X_WR, size)
    np.testing.assert_allclose(corners.mean(axis=0), X_WR.translation(), atol=1e-12)
    p_R = np.array(X_WR.inverse().multiply(corners.T)).T
    np.testing.assert_allclose(p_R[:, :2], rectangle_corners(size), atol=1e-12)
    np.testing.assert_allclose(p_R[:, 2], 0.0, atol=1e-12)
