"""The motion of the whole body against the plant's own kinematics."""

import numpy as np
import pytest

from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.balance.dynamic_filter import zmp_of_rates
from footfall.systems.planning.whole_body.whole_body_plan import (
    body_motion,
    body_zmp,
    quaternions,
    spins,
    waist_above_com,
    waist_over,
)
from tests.systems.planning.crossing.crossing_cases import body, scratch

N = 40
PERIOD = 0.01


def _swaying() -> tuple[Vector, Vector, Vector, Vector, Vector]:
    """CoM, waist height, orientation, feet and arms of a robot that sways."""
    u = np.linspace(0.0, 1.0, N)
    com = np.column_stack([0.035 + 0.02 * np.sin(3.0 * u), 0.03 * np.cos(2.0 * u)])
    rpy = np.column_stack([0.05 * u, 0.2 * u, 0.1 * np.sin(u)])
    feet: Vector = np.zeros((N, 2, 6))
    feet[:, 0, 1], feet[:, 1, 1] = 0.095, -0.095
    feet[:, 1, 0] = 0.1 * u
    feet[:, 1, 2] = 0.05 * u
    return com, 0.78 + 0.01 * u, rpy, feet, -0.4 * u


def test_com_feet_waist_and_arms_are_where_they_are_to_be() -> None:
    """Forward kinematics by the plant."""
    com, height, rpy, feet, arms = _swaying()
    plant, robot, context = body().plant, body().robot, scratch()
    motion = body_motion(body(), com, height, rpy, feet, arms, rounds=5)
    p_BF: Vector = np.array([0.0, 0.0, -robot.sole.ankle_height])
    for row in range(0, N, 13):
        plant.SetPositions(context, motion.q[row])
        p_WCom = plant.CalcCenterOfMassPositionInWorld(context)
        np.testing.assert_allclose(p_WCom[:2], com[row], atol=1e-5)
        np.testing.assert_allclose(p_WCom, motion.com[row], atol=1e-9)
        for i, foot in enumerate(FEET):
            X_WB = plant.GetBodyByName(robot.foot_bodies[foot]).EvalPoseInWorld(context)
            np.testing.assert_allclose(X_WB.multiply(p_BF), feet[row, i, :3], atol=1e-9)
        base = plant.GetBodyByName(robot.base_body).EvalPoseInWorld(context)
        assert base.translation()[2] == pytest.approx(height[row])
        np.testing.assert_allclose(
            base.rotation().ToRollPitchYaw().vector(), rpy[row], atol=1e-9
        )
        for name in robot.swing_joints:
            angle = plant.GetJointByName(name).GetOnePosition(context)  # type: ignore[attr-defined]
            assert angle == pytest.approx(robot.posture[name] + arms[row])
    assert motion.short.max() == 0.0


def test_a_leg_that_is_too_short_is_told() -> None:
    """By how much, and only that one."""
    com, height, rpy, feet, arms = _swaying()
    motion = body_motion(
        body(), com[:1], height[:1] + 0.2, 0.0 * rpy[:1], feet[:1], arms[:1]
    )
    assert (motion.short > 0.01).all()


def test_spins_are_those_of_the_plant() -> None:
    """Quaternion rates to angular velocities."""
    rng = np.random.default_rng(1)
    plant, context = body().plant, scratch()
    rpy = rng.uniform(-1.0, 1.0, (20, 3))
    q4 = quaternions(rpy)
    rate = rng.normal(size=(20, 4))
    rate -= (rate * q4).sum(axis=1)[:, None] * q4
    found = spins(q4, rate)
    for row in range(20):
        q: Vector = np.zeros(plant.num_positions())
        q[:4] = q4[row]
        plant.SetPositions(context, q)
        q_rate: Vector = np.zeros(plant.num_positions())
        q_rate[:4] = rate[row]
        v = plant.MapQDotToVelocity(context, q_rate)
        np.testing.assert_allclose(found[row], v[:3], atol=1e-9)


def test_the_zmp_of_a_robot_at_rest_is_under_its_com() -> None:
    """And moves against an acceleration of the whole body."""
    com, height, rpy, feet, _ = _swaying()
    still = [
        np.tile(value[:1], (9, *([1] * (value.ndim - 1)))) for value in (com, rpy, feet)
    ]
    ground = np.zeros(9)
    motion = body_motion(
        body(),
        still[0],
        np.full(9, height[0]),
        still[1],
        still[2],
        0.0,
        rounds=5,
    )
    p_MB = body_zmp(body(), motion.q, ground, PERIOD)
    np.testing.assert_allclose(p_MB, motion.com[:, :2], atol=1e-6)
    t = PERIOD * np.arange(9)
    q = motion.q.copy()
    q[:, 4] += 0.5 * 0.4 * t**2
    moved = motion.com.copy()
    moved[:, 0] += 0.5 * 0.4 * t**2
    mass = body().plant.CalcTotalMass(scratch())
    force: Vector = np.zeros((9, 3))
    force[:, 0] = mass * 0.4
    spin = np.cross(moved, force)
    want = zmp_of_rates(mass, moved, force, spin, ground)
    found = body_zmp(body(), q, ground, PERIOD)
    np.testing.assert_allclose(found[3:-3], want[3:-3], atol=1e-6)


def test_the_waist_is_below_the_com_in_the_posture() -> None:
    """By some centimetres on this robot."""
    assert -0.08 < waist_above_com(body()) < 0.0


def test_the_pelvis_is_found_for_a_com_that_rests() -> None:
    """The body put there has its CoM where it was asked for, height included."""
    feet: Vector = np.zeros((2, 6))
    feet[0, 1], feet[1, 1] = 0.095, -0.095
    com, rpy = np.array([0.03, 0.01, 0.82]), np.array([0.0, 0.1, 0.0])
    waist = waist_over(body(), com, feet, rpy)
    motion = body_motion(
        body(),
        com[None, :2],
        waist[None, 2],
        rpy[None],
        feet[None],
        0.0,
        (waist - com)[None, :2],
        rounds=0,
    )
    np.testing.assert_allclose(motion.com[0], com, atol=2e-3)
