"""From the published description to a plant: limits in force, contact geometry, cache.

The cache of these tests is a folder of their own, converted once.
"""

import dataclasses
import os
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pydrake.geometry import Role, SceneGraph
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.models.robots import robot_loader
from footfall.models.robots.contact_geometry import is_sole
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import (
    SOLE_CLEARANCE,
    add_robot,
    body_meshes,
    joint_limits,
    prepared_urdf,
)
from footfall.models.values.feet import FEET


@dataclasses.dataclass(frozen=True)
class Loaded:
    """The robot alone, with its geometry."""

    plant: MultibodyPlant
    scene_graph: SceneGraph
    instance: ModelInstanceIndex


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Loaded]:
    """Loaded once; its meshes were converted just now, not by an older program."""
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robot_loader, "user_cache_path", lambda _: folder)
        plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
        plant.RegisterAsSourceForSceneGraph(scene_graph)
        instance = add_robot(plant, scene_graph, JVRC1)
        plant.Finalize()
        yield Loaded(plant, scene_graph, instance)


@pytest.fixture
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """An empty cache folder in the place of the user's."""
    monkeypatch.setattr(robot_loader, "user_cache_path", lambda _: tmp_path)
    return tmp_path


def described_limits() -> dict[str, tuple[float, float, float, float]]:
    """Effort, velocity, lower and upper of the description's joints that move."""
    limits = {}
    for joint in ET.parse(JVRC1.urdf).getroot().findall("joint"):
        limit = joint.find("limit")
        if joint.attrib["name"] not in JVRC1.welded_joints and limit is not None:
            limits[joint.attrib["name"]] = tuple(
                float(limit.attrib[key])
                for key in ("effort", "velocity", "lower", "upper")
            )
    return limits


def test_mass_and_joints(robot: Loaded) -> None:
    """62.4 kg and 32 joints on a floating base, the fingers welded."""
    context = robot.plant.CreateDefaultContext()
    assert robot.plant.CalcTotalMass(context) == pytest.approx(62.4, abs=0.05)
    assert robot.plant.num_positions() == 7 + 32
    assert robot.plant.num_actuators(robot.instance) == 32
    base = robot.plant.GetBodyByName(JVRC1.base_body)
    assert base.is_floating_base_body()
    assert base.floating_positions_start() == 0


def test_limits_of_the_description_are_on_actuators_and_joints(robot: Loaded) -> None:
    """Effort on the actuators, speed and range on the joints; rotor inertia beside."""
    limits = described_limits()
    assert {name: limit[:2] for name, limit in limits.items()} == joint_limits(JVRC1)
    indices = robot.plant.GetJointActuatorIndices(robot.instance)
    actuators = [robot.plant.get_joint_actuator(index) for index in indices]
    assert {item.joint().name() for item in actuators} == set(limits)
    for item in actuators:
        joint = item.joint()
        effort, speed, lower, upper = limits[joint.name()]
        assert effort == 100.0
        assert item.effort_limit() == effort
        assert joint.velocity_upper_limits()[0] == speed
        assert joint.velocity_lower_limits()[0] == -speed
        assert joint.position_lower_limits()[0] == lower
        assert joint.position_upper_limits()[0] == upper
        gains = JVRC1.gains[joint.name()]
        assert item.has_controller()
        assert item.get_controller_gains().p == gains.stiffness
        assert item.get_controller_gains().d == gains.damping
        assert item.default_reflected_inertia() == gains.reflected_inertia > 0.0


def test_effort_limits_hold_in_the_simulation() -> None:
    """However much feed-forward and servo ask for together."""
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(
        MultibodyPlantConfig(
            time_step=0.0025,
            contact_model="point",
            discrete_contact_approximation="lagged",
        ),
        builder,
    )
    instance = add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    na = plant.num_actuators(instance)
    asked = np.where(np.arange(na) % 2, 500.0, -500.0)
    plant.get_actuation_input_port(instance).FixValue(context, asked)
    plant.get_desired_state_input_port(instance).FixValue(
        context, np.concatenate([np.sign(asked), np.zeros(na)])
    )
    simulator.AdvanceTo(0.01)
    applied = plant.get_net_actuation_output_port(instance).Eval(context)
    assert np.abs(applied).max() == pytest.approx(100.0)


def test_every_mesh_of_the_body_collides(robot: Loaded) -> None:
    """Shins, knees, thighs, arms and torso, not only the soles."""
    inspector = robot.scene_graph.model_inspector()
    with_hull = set()
    for index in robot.plant.GetBodyIndices(robot.instance):
        body = robot.plant.get_body(index)
        for geometry in robot.plant.GetCollisionGeometriesForBody(body):
            if not is_sole(inspector.GetName(geometry)):
                with_hull.add(body.name())
    assert with_hull == {mesh.body for mesh in body_meshes(JVRC1)}
    limbs = ("HIP_Y_S", "KNEE_S", "ANKLE_P_S", "SHOULDER_P_S", "ELBOW_P_S", "WRIST_Y_S")
    assert {f"{side}_{limb}" for side in "LR" for limb in limbs} <= with_hull
    assert {JVRC1.base_body, JVRC1.torso_body} <= with_hull


def test_feet_hulls_end_above_the_sole(robot: Loaded) -> None:
    """So that the sole alone meets the ground, but all above it collides."""
    plant, inspector = robot.plant, robot.scene_graph.model_inspector()
    meshes = {mesh.body: mesh for mesh in body_meshes(JVRC1)}
    for foot in FEET:
        body = plant.GetBodyByName(JVRC1.foot_bodies[foot])
        (hull,) = (
            geometry
            for geometry in plant.GetCollisionGeometriesForBody(body)
            if not is_sole(inspector.GetName(geometry))
        )
        assert inspector.GetPoseInFrame(hull).IsNearlyIdentity(1e-12)
        vertices = meshes[body.name()].vertices
        cut = SOLE_CLEARANCE - JVRC1.sole.ankle_height
        heights = hull_vertices(inspector, hull)[:, 2]
        assert heights.min() == pytest.approx(cut, abs=1e-6)
        assert heights.max() == pytest.approx(vertices[:, 2].max(), abs=1e-6)
        above = vertices[vertices[:, 2] > cut]
        np.testing.assert_allclose(
            hull_vertices(inspector, hull)[:, :2].max(axis=0),
            above[:, :2].max(axis=0),
            atol=5e-3,
        )


def hull_vertices(inspector: object, geometry: object) -> np.ndarray:
    """Vertices of a convex hull, (n, 3), m."""
    surface = inspector.GetConvexHull(geometry)
    return np.array([surface.vertex(i) for i in range(surface.num_vertices())])


def test_hulls_enclose_what_is_seen(robot: Loaded) -> None:
    """The picture and the physics are at the same place, also where a visual is turned.

    Each visual mesh's vertices lie inside the hull of its body.
    """
    plant, inspector = robot.plant, robot.scene_graph.model_inspector()
    feet = set(JVRC1.foot_bodies.values())
    for mesh in body_meshes(JVRC1):
        if mesh.body in feet:
            continue
        body = plant.GetBodyByName(mesh.body)
        hulls = plant.GetCollisionGeometriesForBody(body)
        vertices = np.vstack([hull_vertices(inspector, hull) for hull in hulls])
        tolerance = 1e-5 if len(hulls) == 1 else 2e-3
        np.testing.assert_allclose(
            vertices.max(axis=0), mesh.vertices.max(axis=0), atol=tolerance
        )
        np.testing.assert_allclose(
            vertices.min(axis=0), mesh.vertices.min(axis=0), atol=tolerance
        )


def test_legs_meshes_hang_below_their_joints(robot: Loaded) -> None:
    """The thigh reaches from hip to knee: its visual is turned as the URDF says."""
    meshes = {mesh.body: mesh.vertices for mesh in body_meshes(JVRC1)}
    for side in "LR":
        thigh, shin = meshes[f"{side}_HIP_Y_S"], meshes[f"{side}_KNEE_S"]
        assert thigh[:, 2].min() < -0.3
        assert shin[:, 2].min() < -0.25


def test_visual_meshes_stand_in_the_plant_as_in_the_scanner(robot: Loaded) -> None:
    """The y of glTF points up; what Drake reads back agrees with `body_meshes`."""
    plant, inspector = robot.plant, robot.scene_graph.model_inspector()
    for mesh in body_meshes(JVRC1):
        body = plant.GetBodyByName(mesh.body)
        (visual,) = plant.GetVisualGeometriesForBody(body)
        shape = inspector.GetShape(visual)
        scene = trimesh.load_scene(shape.source().path())
        points = np.asarray(scene.to_geometry().vertices)
        z_up = np.column_stack([points[:, 0], -points[:, 2], points[:, 1]])
        X_BG = inspector.GetPoseInFrame(visual)
        placed = np.array(X_BG.multiply(z_up.T)).T
        np.testing.assert_allclose(
            placed.max(axis=0), mesh.vertices.max(axis=0), atol=1e-5
        )
        np.testing.assert_allclose(
            placed.min(axis=0), mesh.vertices.min(axis=0), atol=1e-5
        )


def test_scanner_and_camera_see_every_visual(robot: Loaded) -> None:
    """Each has the role that a renderer looks for."""
    inspector = robot.scene_graph.model_inspector()
    for mesh in body_meshes(JVRC1):
        body = robot.plant.GetBodyByName(mesh.body)
        for geometry in robot.plant.GetVisualGeometriesForBody(body):
            assert inspector.GetProperties(geometry, Role.kPerception) is not None


def test_meshes_are_converted_once(cache: Path, monkeypatch) -> None:
    """The second time nothing is written; the files are the same."""
    first = prepared_urdf(JVRC1)
    (folder,) = cache.iterdir()
    written = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    more = sum(pieces - 1 for pieces in JVRC1.convex_pieces.values())
    files = 2 * len(body_meshes(JVRC1)) + more
    assert len(written) == 2 * files  # each with its digest
    monkeypatch.delattr(robot_loader.trimesh, "load_scene")
    assert prepared_urdf(JVRC1) == first
    after = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    assert after == written


def test_a_conversion_that_breaks_off_leaves_nothing(cache: Path, monkeypatch) -> None:
    """No file that is taken for a mesh; the next attempt succeeds."""
    replace = Path.replace

    def broken(path: Path, target: Path) -> Path:
        raise OSError("disk full")

    monkeypatch.setattr(Path, "replace", broken)
    with pytest.raises(OSError, match="disk full"):
        prepared_urdf(JVRC1)
    assert [*cache.rglob("*.obj"), *cache.rglob("*.gltf")] == []
    monkeypatch.setattr(Path, "replace", replace)
    prepared_urdf(JVRC1)
    assert len([*cache.rglob("*.gltf")]) == len(body_meshes(JVRC1))


def test_processes_do_not_write_to_the_same_file(cache: Path, monkeypatch) -> None:
    """What is being written bears the process's number."""
    partial: set[str] = set()
    write = Path.write_bytes

    def spied(path: Path, data: bytes) -> int:
        partial.add(path.name)
        return write(path, data)

    monkeypatch.setattr(Path, "write_bytes", spied)
    prepared_urdf(JVRC1)
    assert partial
    assert all(name.endswith(f".{os.getpid()}.partial") for name in partial)
    assert not list(cache.rglob("*.partial"))


@pytest.mark.parametrize("name", ["ä b", "50%20 & 'more'"])
def test_the_cache_may_lie_anywhere(tmp_path: Path, monkeypatch, name: str) -> None:
    """Drake opens every mesh, wherever the user's folder is."""
    monkeypatch.setattr(robot_loader, "user_cache_path", lambda _: tmp_path / name)
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    instance = add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    inspector = scene_graph.model_inspector()
    body = plant.GetBodyByName(JVRC1.base_body, instance)
    (visual,) = plant.GetVisualGeometriesForBody(body)
    path = inspector.GetShape(visual).source().path()
    assert Path(path).is_relative_to(tmp_path / name)
    assert Path(path).is_file()
    (hull, *_) = plant.GetCollisionGeometriesForBody(body)
    assert inspector.GetConvexHull(hull).num_vertices() > 3


def test_another_description_has_another_cache(cache: Path, tmp_path: Path) -> None:
    """Meshes of an old version of the package are not taken for the new one's."""
    prepared_urdf(JVRC1)
    edited = tmp_path / "edited.urdf"
    edited.write_bytes(JVRC1.urdf.read_bytes() + b"\n<!-- another -->\n")
    prepared_urdf(dataclasses.replace(JVRC1, urdf=edited))
    assert len([path for path in cache.iterdir() if path.is_dir()]) == 2
