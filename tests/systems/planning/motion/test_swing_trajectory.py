"""Swing feet over stairs, up and down, and over flat ground."""

import dataclasses

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import sole_corners
from footfall.systems.planning.motion.swing_trajectory import (
    SwingParams,
    SwingTrajectory,
    quintic,
    swing_trajectory,
)

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)
PARAMS = SwingParams()
PERIOD, DURATION = 0.005, 0.85


def poses(swing: SwingTrajectory) -> list[RigidTransform]:
    """The sole frame at each row."""
    rows = zip(swing.positions, swing.rpy, strict=True)
    return [RigidTransform(RollPitchYaw(*rpy), p) for p, rpy in rows]


def distances(swing: SwingTrajectory, edge: Vector) -> Vector:
    """From an edge (x, z) to the sole seen from the side, (n,), m."""
    found = []
    for X_WF in poses(swing):
        heel, toe = (
            X_WF.multiply(np.array([x, 0.0, 0.0]))[[0, 2]]
            for x in (-SOLE.heel, SOLE.toe)
        )
        along = np.clip((edge - heel) @ (toe - heel) / SOLE.length**2, 0.0, 1.0)
        found.append(np.linalg.norm(heel + along * (toe - heel) - edge))
    return np.array(found)


def check_profile(
    swing: SwingTrajectory, edge_x: float, before: float, beyond: float
) -> None:
    """No corner of the sole below the ground, which steps from before to beyond."""
    for X_WF in poses(swing):
        corners = sole_corners(X_WF, SOLE)
        ground = np.where(corners[:, 0] < edge_x, before, beyond)
        assert (corners[:, 2] - ground).min() > -1e-9


def lifted(X_WF: RigidTransform, pitch: float) -> RigidTransform:
    """The foot with its heel lifted about the toe edge."""
    p_FT = [SOLE.toe, 0.0, 0.0]
    X_FT = RigidTransform(p_FT)
    turn = RigidTransform(RollPitchYaw(0.0, pitch, 0.0), np.zeros(3))
    return X_WF @ X_FT @ turn @ X_FT.inverse()


@pytest.mark.parametrize("rise", [0.02, 0.06, 0.12, 0.18, 0.24])
@pytest.mark.parametrize("run", [0.26, 0.29, 0.32])
@pytest.mark.parametrize("toes", [0.0175, 0.05])
@pytest.mark.parametrize("pitch", [0.0, 0.6])
def test_going_up_keeps_off_the_nosing(
    rise: float, run: float, toes: float, pitch: float
) -> None:
    """From toes this far before the riser to the middle of the tread."""
    X_WStart = lifted(RigidTransform([-SOLE.toe - toes, 0.1, 0.0]), pitch)
    x = run / 2.0 - (SOLE.toe - SOLE.heel) / 2.0
    X_WEnd = RigidTransform([x, 0.1, rise])
    edges = np.array([[0.0, 0.0, rise]])
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, PERIOD, edges, SOLE, PARAMS)
    assert swing.status == "ok"
    check_profile(swing, 0.0, 0.0, rise)
    apart = distances(swing, np.array([0.0, rise]))
    heel = x - SOLE.heel
    assert apart.min() > 0.9 * min(PARAMS.edge_clearance, toes, heel)
    assert 0.65 * apart.min() <= swing.clearance <= 1.1 * apart.min()
    toe_z = swing.positions[:, 2] - SOLE.toe * np.sin(swing.rpy[:, 1])
    toe_x = swing.positions[:, 0] + SOLE.toe * np.cos(swing.rpy[:, 1])
    rising = np.arange(len(toe_z)) < toe_z.argmax()
    assert (
        toe_x[rising & (toe_z < rise)].max() <= -min(PARAMS.edge_clearance, toes) + 1e-3
    )


@pytest.mark.parametrize("drop", [0.02, 0.1, 0.18, 0.24])
@pytest.mark.parametrize("run", [0.26, 0.29, 0.32])
def test_going_down_keeps_off_the_edge_left_behind(drop: float, run: float) -> None:
    """The same staircase, the heel clearing the tread's own front edge."""
    middle = run / 2.0 - (SOLE.toe - SOLE.heel) / 2.0
    X_WStart = RigidTransform([middle - run, 0.1, 0.0])
    X_WEnd = RigidTransform([middle + 0.01, 0.1, -drop])
    edges = np.zeros((1, 3))
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, PERIOD, edges, SOLE, PARAMS)
    assert swing.status == "ok"
    check_profile(swing, 0.0, 0.0, -drop)
    apart = distances(swing, np.zeros(2))
    toes, heel = run - middle - SOLE.toe, middle + 0.01 - SOLE.heel
    assert apart.min() > min(PARAMS.edge_clearance, toes, heel) - 1e-3


def test_a_heel_may_hang_over_the_edge_it_lands_on() -> None:
    """By 2 cm; the toes clear the edge all the same on the way."""
    X_WEnd = RigidTransform([SOLE.heel - 0.02, 0.0, 0.2])
    edges = np.array([[0.0, 0.0, 0.2]])
    X_WStart = RigidTransform([-0.2, 0.0, 0.0])
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, PERIOD, edges, SOLE, PARAMS)
    assert swing.status == "ok"
    check_profile(swing, 0.0, 0.0, 0.2)
    toe_x = swing.positions[:, 0] + SOLE.toe
    passing = toe_x < 0.02
    apart = distances(swing, np.array([0.0, 0.2]))
    assert apart[passing].min() > PARAMS.edge_clearance - 1e-3


@pytest.mark.parametrize("turn", [0.0, 0.26])
@pytest.mark.parametrize("step", [(0.6, 0.0), (0.0, 0.1), (0.0, 0.0), (-0.15, -0.05)])
def test_a_flat_step_peaks_at_the_apex_clearance(
    step: tuple[float, float], turn: float
) -> None:
    """Whatever its direction."""
    X_WStart = RigidTransform(RollPitchYaw(0.0, 0.0, 1.0), np.array([1.0, 2.0, 0.3]))
    X_WEnd = RigidTransform(
        RollPitchYaw(0.0, 0.0, 1.0 + turn),
        np.array([1.0 + step[0], 2.0 + step[1], 0.3]),
    )
    swing = swing_trajectory(
        X_WStart, X_WEnd, DURATION, PERIOD, np.zeros((0, 3)), SOLE, PARAMS
    )
    assert swing.status == "ok"
    assert swing.clearance == np.inf
    z = swing.positions[:, 2] - 0.3
    assert z.max() == pytest.approx(PARAMS.apex_clearance, abs=1e-3)
    assert z.min() > -1e-12
    low = (np.arange(len(z)) > z.argmax()) & (z < PARAMS.touch_down_height)
    toes = [X_WF.multiply(np.array([SOLE.toe, 0.0, 0.0])) for X_WF in poses(swing)]
    assert np.linalg.norm(np.array(toes)[low, :2] - toes[-1][:2], axis=1).max() < 0.004
    for row, X_WF in ((0, X_WStart), (-1, X_WEnd)):
        assert poses(swing)[row].IsNearlyEqualTo(X_WF, 1e-9)


def test_the_motion_is_smooth_and_feels_for_the_ground_coming_straight_down() -> None:
    """At rest but for an even way down at the end; no jump of the acceleration."""
    X_WStart = lifted(RigidTransform([-0.2, 0.1, 0.0]), 0.5)
    X_WEnd = RigidTransform([0.1, 0.1, 0.2])
    edges = np.array([[0.0, 0.0, 0.2]])
    period = 0.001
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, period, edges, SOLE, PARAMS)
    rows = np.hstack([swing.positions, swing.rpy])
    velocity = np.diff(rows, axis=0) / period
    acceleration = np.diff(velocity, axis=0) / period
    feels = round(PARAMS.landing_time / period)
    speed = PARAMS.landing_speed
    np.testing.assert_allclose(velocity[2 - feels :, 2], -speed, rtol=1e-6)
    velocity[:, 2] += np.where(np.arange(len(velocity)) > len(velocity) / 2, speed, 0.0)
    for end in (0, -1):
        assert np.abs(velocity[end]).max() < 2e-3
        assert np.abs(acceleration[end]).max() < 1.5
    jump = np.abs(np.diff(acceleration, axis=0)).max()
    assert jump < 0.05 * np.abs(acceleration).max()
    height = swing.positions[:, 2] - 0.2
    falling = np.arange(len(height)) > np.argmax(height)
    low = falling & (height < PARAMS.touch_down_height)
    ahead = np.linalg.norm(swing.positions[low, :2] - [0.1, 0.1], axis=1)
    assert ahead.max() < 0.003
    down = -velocity[low[1:], 2]
    assert (np.diff(down[down.argmax() :]) < 1e-9).all()
    assert down.argmax() < 0.3 * len(down)


def test_sideways_way_roll_and_yaw_are_blended_like_the_way_ahead() -> None:
    """All by one share, the quintic blend, which is at rest at both ends."""
    X_WStart = RigidTransform(RollPitchYaw(0.05, 0.0, -0.2), np.zeros(3))
    X_WEnd = RigidTransform(RollPitchYaw(0.0, 0.0, 0.3), np.array([0.3, 0.12, 0.1]))
    period = 0.001
    swing = swing_trajectory(
        X_WStart, X_WEnd, DURATION, period, np.zeros((0, 3)), SOLE, PARAMS
    )
    toes = np.array([X.multiply(np.array([SOLE.toe, 0.0, 0.0])) for X in poses(swing)])
    travelled = toes - toes[0]
    shares = np.column_stack(
        [
            travelled[:, :2] / travelled[-1, :2],
            (swing.rpy[:, 0] - 0.05) / -0.05,
            (swing.rpy[:, 2] + 0.2) / 0.5,
        ]
    )
    for share in shares.T[1:]:
        np.testing.assert_allclose(share, shares[:, 0], atol=1e-9)
    speed = np.diff(shares, axis=0) / period
    moving = np.flatnonzero(speed[:, 0] > 1e-9)
    span = period * (moving[-1] - moving[0] + 1)
    # Of the blend, 15/8 of the mean speed half-way and none at the ends.
    np.testing.assert_allclose(speed.max(axis=0), 1.875 / span, rtol=0.02)
    np.testing.assert_allclose(speed[[0, -1]], 0.0, atol=1e-3)


@pytest.mark.parametrize("yaw", [-0.5, 0.35])
def test_the_corner_of_a_turned_sole_is_what_comes_near(yaw: float) -> None:
    """A foot that leaves askew before a riser: the distance is that of its corners."""
    ahead = max(
        np.cos(yaw) * x - np.sin(yaw) * y
        for x in (-SOLE.heel, SOLE.toe)
        for y in (-SOLE.half_width, SOLE.half_width)
    )
    X_WStart = RigidTransform(
        RollPitchYaw(0.0, 0.0, yaw), np.array([-ahead - 0.02, 0.0, 0.0])
    )
    X_WEnd = RigidTransform([0.12, 0.0, 0.2])
    edges = np.array([[0.0, 0.0, 0.2]])
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, PERIOD, edges, SOLE, PARAMS)
    assert swing.status == "ok"
    check_profile(swing, 0.0, 0.0, 0.2)
    assert swing.clearance <= 0.02 + 1e-9
    assert swing.clearance == pytest.approx(0.02, abs=2e-3)


def test_the_toes_may_be_lifted_and_the_foot_drawn_back() -> None:
    """Both over within the swing; the sole keeps its clearances."""
    params = SwingParams(swing_pitch=-0.2, retraction=0.015)
    X_WStart, X_WEnd = RigidTransform([-0.2, 0, 0]), RigidTransform([0.1, 0, 0.2])
    edges = np.array([[0.0, 0.0, 0.2]])
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, PERIOD, edges, SOLE, params)
    assert swing.status == "ok"
    check_profile(swing, 0.0, 0.0, 0.2)
    assert swing.rpy[:, 1].min() == pytest.approx(-0.2, abs=1e-3)
    assert swing.positions[:, 0].min() < -0.205
    np.testing.assert_allclose(swing.rpy[[0, -1]], 0.0, atol=1e-12)


def test_a_swing_that_cannot_keep_off_says_so() -> None:
    """An edge that the toes already touch at half height, with too low an apex."""
    params = SwingParams(apex_clearance=0.03, swing_pitch=0.5)
    X_WStart, X_WEnd = RigidTransform([-0.2, 0, 0]), RigidTransform([0.1, 0, 0.0])
    edges = np.array([[-0.1, 0.0, 0.1]])
    swing = swing_trajectory(X_WStart, X_WEnd, DURATION, PERIOD, edges, SOLE, params)
    assert swing.status.startswith("the sole comes 0.")


def test_the_blend_is_at_rest_at_both_ends() -> None:
    """Value, velocity and acceleration; symmetric about the middle."""
    u = np.array([-1.0, 0.0, 1e-3, 0.5, 1.0 - 1e-3, 1.0, 2.0])
    np.testing.assert_allclose(quintic(u), [0, 0, 1e-8, 0.5, 1, 1, 1], atol=1.1e-8)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("edge_clearance", -0.1),
        ("touch_down_height", float("nan")),
        ("apex_clearance", 0.01),
        ("swing_pitch", 2.0),
    ],
)
def test_a_parameter_out_of_range_is_named(field: str, value: float) -> None:
    """Before anything is planned."""
    with pytest.raises(ValueError, match=f"^{field}: "):
        dataclasses.replace(PARAMS, **{field: value}).validate()


def test_arguments_of_the_wrong_kind_are_named() -> None:
    """Durations and shapes."""
    X = RigidTransform()
    none = np.zeros((0, 3))
    with pytest.raises(ValueError, match=r"duration and period .* got 0\.0 s"):
        swing_trajectory(X, X, 0.0, PERIOD, none, SOLE, PARAMS)
    with pytest.raises(ValueError, match=r"edges: expected shape \(m, 3\), got \(2,\)"):
        swing_trajectory(X, X, 1.0, PERIOD, np.zeros(2), SOLE, PARAMS)
