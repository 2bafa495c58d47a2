"""Soles on rectangles, above all on turned ones."""

from math import radians

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.geometry import rotate
from footfall.models.values.perceived import PlaneSegment
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import (
    Refusal,
    foothold_x,
    front_edge,
    lateral_interval,
    min_width,
    plane_height,
    sole_outline,
)
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)
PARAMS = FootstepPlannerParams()
YAW = 0.7


def turned_tread(turn: float, depth: float, width: float) -> PlaneSegment:
    """A level tread at (1, 2, 0.2) that is turned from the staircase by `turn`, deg."""
    size = np.array([depth, width])
    X_WR = RigidTransform(
        RollPitchYaw(0.0, 0.0, YAW + radians(turn)), np.array([1.0, 2.0, 0.2])
    )
    normal = np.array([0.0, 0.0, 1.0])
    return PlaneSegment(np.zeros((0, 3)), X_WR, size, normal, depth * width, 100)


def outline_on_tread(tread: PlaneSegment, x: float, y: float) -> Vector:
    """The corners in R of a sole at (x, y) in the stair frame, (4, 2), m."""
    p_W = rotate(YAW, sole_outline(SOLE) + np.array([x, y]))
    p_WR = tread.X_WR.translation()[:2]
    turn = RollPitchYaw(tread.X_WR.rotation()).yaw_angle()
    return rotate(-turn, p_W - p_WR)


@pytest.mark.parametrize("turn", [-9.0, -3.0, 0.0, 4.0, 9.0])
@pytest.mark.parametrize("bias", [-0.1, 0.0, 0.1])
@pytest.mark.parametrize("depth", [0.29, 0.45])
def test_both_soles_stay_inside_a_turned_tread(
    turn: float, bias: float, depth: float
) -> None:
    """At either end of the lateral interval and whatever the bias asks for."""
    tread = turned_tread(turn, depth, 0.6)
    params = FootstepPlannerParams(foothold_bias=bias)
    low, high = lateral_interval(tread, YAW, SOLE, params.side_margin)
    for y in (low, high):
        x = foothold_x(tread, None, YAW, y, (low + high) / 2.0, SOLE, params)
        assert not isinstance(x, Refusal)
        room = tread.size / 2.0 - np.abs(outline_on_tread(tread, x, y)).max(axis=0)
        assert room[0] >= params.edge_margin - 1e-9
        assert params.side_margin - 1e-9 <= room[1] < params.side_margin + 0.07


@pytest.mark.parametrize("turn", [-3.0, 0.0, 3.0])
def test_the_feet_are_side_by_side_where_the_tread_has_room(turn: float) -> None:
    """The x of both is the middle of the tread between them."""
    tread = turned_tread(turn, 0.35, 0.8)
    y = rotate(-YAW, tread.X_WR.translation()[:2])[1]
    feet = [
        foothold_x(tread, None, YAW, y + side, y, SOLE, PARAMS)
        for side in (-0.095, 0.095)
    ]
    assert feet[0] == pytest.approx(feet[1], abs=1e-9)


@pytest.mark.parametrize("turn", [-8.0, 0.0, 8.0])
def test_the_front_edge_is_where_the_rectangle_begins(turn: float) -> None:
    """A point on it has x = -depth/2 in R."""
    tread = turned_tread(turn, 0.3, 0.8)
    y = rotate(-YAW, tread.X_WR.translation()[:2])[1] + 0.2
    p_W = rotate(YAW, np.array([front_edge(tread, YAW, y), y]))
    p_R = tread.X_WR.inverse().multiply(np.array([*p_W, 0.2]))
    assert p_R[0] == pytest.approx(-0.15)


@pytest.mark.parametrize("turn", [-0.26, -0.1, 0.0, 0.1, 0.26])
def test_feet_at_the_least_width_are_apart_by_the_gap(turn: float) -> None:
    """The nearest corner of the moved sole is `gap` off the stance sole's side."""
    width = min_width(turn, "left", SOLE, 0.03)
    corners = rotate(turn, sole_outline(SOLE)) + np.array([0.0, width])
    assert corners[:, 1].min() - SOLE.half_width == pytest.approx(0.03)
    assert min_width(-turn, "right", SOLE, 0.03) == pytest.approx(width)


def test_the_height_of_a_tilted_plane_is_that_of_its_points() -> None:
    """Any point of the plane, taken horizontally, gives its own height."""
    X_WR = RigidTransform(RollPitchYaw(0.1, -0.2, 0.5), np.array([1.0, 2.0, 0.3]))
    normal: Vector = X_WR.rotation().matrix()[:, 2]
    plane = PlaneSegment(np.zeros((0, 3)), X_WR, np.ones(2), normal, 1.0, 10)
    p_W = X_WR.multiply(np.array([0.4, -0.7, 0.0]))
    assert plane_height(plane, p_W[:2]) == pytest.approx(p_W[2])
