"""JVRC-1: what we say of it agrees with its published description."""

import xml.etree.ElementTree as ET
from itertools import pairwise

import numpy as np
import pytest
from pydrake.geometry import SceneGraph
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot, body_meshes


@pytest.fixture(scope="module")
def plant() -> MultibodyPlant:
    """The robot alone."""
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    return plant


def described() -> set[str]:
    """The description's joints."""
    return {joint.attrib["name"] for joint in ET.parse(JVRC1.urdf).iter("joint")}


def test_names_exist(plant: MultibodyPlant) -> None:
    """Every joint and body that the model names."""
    joints = {
        *JVRC1.welded_joints,
        *JVRC1.knee_joints.values(),
        *JVRC1.posture,
        *JVRC1.working_range,
        *JVRC1.gains,
        *(name for leg in JVRC1.leg_joints.values() for name in leg),
    }
    assert joints <= described()
    for body in (
        JVRC1.base_body,
        JVRC1.torso_body,
        JVRC1.head_body,
        *JVRC1.foot_bodies.values(),
    ):
        assert plant.HasBodyNamed(body)


def test_legs_lead_from_pelvis_to_foot(plant: MultibodyPlant) -> None:
    """Each joint's child is the next one's parent; the last carries the sole."""
    for foot, leg in JVRC1.leg_joints.items():
        joints = [plant.GetJointByName(name) for name in leg]
        assert joints[0].parent_body().name() == JVRC1.base_body
        for joint, following in pairwise(joints):
            assert joint.child_body().name() == following.parent_body().name()
        assert joints[-1].child_body().name() == JVRC1.foot_bodies[foot]


def test_posture_lies_within_limits_and_working_range(plant: MultibodyPlant) -> None:
    """And the working range within the limits."""
    for name, angle in JVRC1.posture.items():
        joint = plant.GetJointByName(name)
        least, most = JVRC1.working_range.get(name, (-np.inf, np.inf))
        assert joint.position_lower_limits()[0] < angle < joint.position_upper_limits()
        assert least < angle < most
    for name, (least, most) in JVRC1.working_range.items():
        joint = plant.GetJointByName(name)
        assert joint.position_lower_limits()[0] <= least < most
        assert most <= joint.position_upper_limits()[0]


def test_posture_is_the_same_on_both_sides(plant: MultibodyPlant) -> None:
    """Joints about x and z turn the other way on the other side."""
    assert len(JVRC1.posture) >= 8
    for name, angle in JVRC1.posture.items():
        side, _, joint = name.partition("_")
        sign = 1.0 if joint.endswith(("_P", "KNEE")) else -1.0
        other = {"R": "L", "L": "R"}[side]
        assert JVRC1.posture[f"{other}_{joint}"] == sign * angle


def test_sole_is_the_underside_of_the_foot() -> None:
    """Its height is that of the ankle's origin over the mesh's lowest points."""
    for mesh in body_meshes(JVRC1):
        if mesh.body in JVRC1.foot_bodies.values():
            lowest = mesh.vertices[:, 2].min()
            assert lowest == pytest.approx(-JVRC1.sole.ankle_height, abs=1e-3)
            flat = mesh.vertices[mesh.vertices[:, 2] < lowest + 1e-3]
            assert flat[:, 0].min() == pytest.approx(-JVRC1.sole.heel, abs=0.02)
            assert flat[:, 0].max() == pytest.approx(JVRC1.sole.toe, abs=0.02)
            # No part of the rectangle sticks out beyond the foot.
            assert mesh.vertices[:, 0].min() < -JVRC1.sole.heel
            assert JVRC1.sole.toe < mesh.vertices[:, 0].max()
            assert JVRC1.sole.half_width <= np.abs(mesh.vertices[:, 1]).max()


def test_leg_reach_is_short_of_the_straight_leg(plant: MultibodyPlant) -> None:
    """Hip to knee and knee to ankle, in a line, are 0.746 m."""
    context = plant.CreateDefaultContext()
    points = [
        plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(name)).translation()
        for name in ("L_HIP_P_S", "L_KNEE_S", "L_ANKLE_P_S")
    ]
    straight = float(np.linalg.norm(points[2] - points[0]))
    assert straight == pytest.approx(0.389 + 0.357, abs=2e-3)
    assert 0.9 * straight < JVRC1.leg_reach < straight
