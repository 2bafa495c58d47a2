"""A URDF with whatever URDFs come with becomes a plant with one motor a joint."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pydrake.geometry import SceneGraph
from pydrake.multibody.plant import MultibodyPlant

from footfall.diagrams.robots.robot_files import load_robot
from footfall.models.robots.collision_hulls import collision_hulls
from footfall.models.robots.contact_geometry import is_sole
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import (
    SOLE_CLEARANCE,
    add_robot,
    body_meshes,
)
from tests.models.robots.biped import ANKLE, write_biped


def plant_of(robot: RobotModel) -> tuple[MultibodyPlant, SceneGraph]:
    """The robot alone, finalised."""
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    add_robot(plant, scene_graph, robot)
    plant.Finalize()
    return plant, scene_graph


@pytest.mark.parametrize("transmissions", [False, True])
def test_every_joint_has_one_motor(tmp_path: Path, transmissions: bool) -> None:
    """With transmissions and without; the world and its joint are gone."""
    robot = load_robot(write_biped(tmp_path, transmissions=transmissions))
    plant, _ = plant_of(robot)
    assert plant.num_actuators() == len(robot.gains) == plant.num_velocities() - 6
    assert plant.GetBodyByName("pelvis").is_floating_base_body()
    assert not plant.HasBodyNamed("unused")
    shoulder = plant.GetJointByName("l_shoulder")
    assert shoulder.position_upper_limits()[0] == np.inf
    assert shoulder.velocity_upper_limits()[0] == 8.0


def test_named_frames_without_mass_are_kept(tmp_path: Path) -> None:
    """The scanner's mount, say."""
    robot = replace(load_robot(write_biped(tmp_path)), head_body="eye")
    assert plant_of(robot)[0].HasBodyNamed("eye")


def test_boxes_and_mirrored_meshes_are_seen_and_met(tmp_path: Path) -> None:
    """What has no collision geometry meets with what is seen of it."""
    robot = load_robot(write_biped(tmp_path))
    plant, scene_graph = plant_of(robot)
    inspector = scene_graph.model_inspector()
    for body in ("torso", "l_arm", "l_finger_link", "l_knee_link", "l_ankle_p_link"):
        shapes = plant.GetCollisionGeometriesForBody(plant.GetBodyByName(body))
        assert any(not is_sole(inspector.GetName(shape)) for shape in shapes)
    meshes = {mesh.body: mesh.vertices for mesh in body_meshes(robot)}
    hulls = {hull.body: hull.vertices for hull in collision_hulls(robot)}
    for points in (meshes, hulls):
        left, right = (points[f"{side}_knee_link"] for side in "lr")
        assert left[:, 1].max() == pytest.approx(0.045, abs=1e-6)
        assert right[:, 1].min() == pytest.approx(-0.045, abs=1e-6)
    lowest = hulls["l_ankle_p_link"][:, 2].min()
    assert lowest == pytest.approx(SOLE_CLEARANCE - ANKLE, abs=1e-6)


def test_given_collision_geometry_is_used(tmp_path: Path) -> None:
    """In place of what is seen."""
    file = write_biped(tmp_path)
    urdf = tmp_path / "biped.urdf"
    small = '<collision><geometry><box size="0.01 0.01 0.01"/></geometry></collision>'
    text = urdf.read_text("utf-8")
    shape = '<visual><origin xyz="0 0 0.2"/>'
    assert shape in text
    urdf.write_text(text.replace(shape, small + shape), encoding="utf-8")
    hulls = {hull.body: hull.vertices for hull in collision_hulls(load_robot(file))}
    assert np.ptp(hulls["torso"], axis=0) == pytest.approx([0.01] * 3)


def test_a_joint_is_welded_where_the_posture_has_it(tmp_path: Path) -> None:
    """As if it had been turned there."""
    robot = load_robot(write_biped(tmp_path))
    bent, _ = plant_of(
        replace(
            robot,
            welded_joints=(*robot.welded_joints, "waist"),
            welded_at={"waist": 0.5},
        )
    )
    moving, _ = plant_of(robot)
    context = moving.CreateDefaultContext()
    moving.GetJointByName("waist").set_angle(context, 0.5)
    poses = [
        plant.GetBodyByName("l_arm").EvalPoseInWorld(at).GetAsMatrix4()
        for plant, at in ((bent, bent.CreateDefaultContext()), (moving, context))
    ]
    np.testing.assert_allclose(*poses, atol=1e-9)


def test_a_changed_mesh_is_converted_anew(tmp_path: Path) -> None:
    """The cache knows the mesh files, not the URDF alone."""
    import trimesh

    robot = load_robot(write_biped(tmp_path))
    collision_hulls(robot)
    trimesh.creation.box([0.3, 0.3, 0.35]).export(tmp_path / "meshes/shank.stl")
    hulls = {hull.body: hull.vertices for hull in collision_hulls(robot)}
    assert np.ptp(hulls["l_knee_link"][:, 0]) == pytest.approx(0.3)
