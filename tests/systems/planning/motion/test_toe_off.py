"""Toe-off: a heel that lifts about the toe edge until the leg reaches."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.toe_off import heading, lift_heel, toe_off_pitch

SOLE = JVRC1.sole
POSE = np.array([0.5, -0.2, 0.3, 0.0, 0.0, 0.7])


def in_world(pose: Vector, p_F: Vector) -> Vector:
    """A point of the foot."""
    return RigidTransform(RollPitchYaw(pose[3:]), pose[:3]).multiply(p_F)


def test_heading_is_the_direction_of_yaw() -> None:
    """Of one or of many."""
    np.testing.assert_allclose(heading(np.pi / 2.0), [0.0, 1.0], atol=1e-15)
    many = heading(np.array([0.0, np.pi]))
    np.testing.assert_allclose(many, [[1.0, 0.0], [-1.0, 0.0]], atol=1e-15)


def test_the_toe_edge_rests_while_the_heel_lifts() -> None:
    """Both its corners, at every angle; the heel rises."""
    poses = lift_heel(POSE, np.linspace(0.0, 0.7, 8), SOLE)
    np.testing.assert_array_equal(poses[0], POSE)
    for side in (-SOLE.half_width, SOLE.half_width):
        toe = np.array([SOLE.toe, side, 0.0])
        for pose in poses:
            np.testing.assert_allclose(
                in_world(pose, toe), in_world(POSE, toe), atol=1e-12
            )
    heel = np.array([-SOLE.heel, 0.0, 0.0])
    assert (np.diff([in_world(pose, heel)[2] for pose in poses]) > 0.0).all()


def ankle_to_hip(pitch: float, p_WHip: Vector) -> float:
    """Distance in the foot's sagittal plane, m."""
    (pose,) = lift_heel(POSE, np.array([pitch]), SOLE)
    ankle = in_world(pose, np.array([0.0, 0.0, SOLE.ankle_height]))
    way = p_WHip - ankle
    return float(np.hypot(way[:2] @ heading(POSE[5]), way[2]))


@pytest.mark.parametrize("forward", [0.2, 0.3, 0.35])
def test_pitch_brings_the_ankle_just_within_reach(forward: float) -> None:
    """No less would do; what the hip is beside the foot's plane does not count."""
    p_WHip = POSE[:3] + np.array([*forward * heading(POSE[5]), 0.82])
    p_WHip[:2] += 0.1 * heading(POSE[5] + np.pi / 2.0)
    pitch = toe_off_pitch(POSE, p_WHip, 0.72, 1.2, SOLE)
    assert 0.0 < pitch < 1.2
    assert ankle_to_hip(pitch, p_WHip) <= 0.72
    assert ankle_to_hip(pitch - 1.2 / 63.0, p_WHip) > 0.72


def test_a_foot_within_reach_stays_flat() -> None:
    """Nothing is lifted without need."""
    p_WHip = POSE[:3] + np.array([0.0, 0.0, 0.70])
    assert toe_off_pitch(POSE, p_WHip, 0.72, 0.7, SOLE) == 0.0


def test_no_pitch_beyond_the_largest() -> None:
    """Even where it does not suffice."""
    p_WHip = POSE[:3] + np.array([0.0, 0.0, 2.0])
    assert toe_off_pitch(POSE, p_WHip, 0.72, 0.7, SOLE) == 0.7
