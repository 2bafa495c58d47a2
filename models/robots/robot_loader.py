"""From a robot's published description to a model that Drake can simulate.

The stock URDF of JVRC-1 does not load: COLLADA collision meshes, no transmissions, no
rotor inertia. What is prepared here: visual meshes are converted once into the user's
cache folder, every part of the body gets the convex hull of its mesh as collision
geometry, the soles get contact spheres, fingers are welded, every joint gets an
actuator with the URDF's effort limit and a servo.
"""

import hashlib
import json
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import trimesh
from platformdirs import user_cache_path
from pydrake.geometry import SceneGraph
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import JointActuator, ModelInstanceIndex, PdControllerGains
from trimesh.exchange.gltf import export_gltf

from footfall.models.robots.contact_geometry import (
    SOLE_THICKNESS,
    ContactModel,
    add_soles,
)
from footfall.models.robots.mesh_cache import cached_files
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.self_collision import filter_neighbours
from footfall.models.values.vector import Vector

CACHE_VERSION = "4"
_Z_UP_TO_Y_UP = np.array(
    [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
)
"""glTF's y points up; readers turn it back."""
SOLE_CLEARANCE = SOLE_THICKNESS + 0.002
"""The foot's hull is cut off this far above the sole, m, so that the sole alone meets
the ground it stands on."""
VOXELS = 400_000
"""With so many a concave surface is cut into convex pieces."""


@dataclass(frozen=True)
class BodyMesh:
    """The visible surface of one body."""

    body: str
    vertices: Vector
    """(n, 3), m, in the body's frame."""
    triangles: np.ndarray[tuple[int, int], np.dtype[np.int32]]
    """Indices into `vertices`, (m, 3)."""


def joint_limits(robot: RobotModel) -> dict[str, tuple[float, float]]:
    """Effort (Nm) and speed (rad/s) limit of every joint that moves, from the URDF."""
    limits = {}
    for joint in ET.parse(robot.urdf).getroot().findall("joint"):
        limit = joint.find("limit")
        name = joint.attrib["name"]
        if limit is not None and name not in robot.welded_joints:
            limits[name] = (
                float(limit.attrib["effort"]),
                float(limit.attrib["velocity"]),
            )
    return limits


def body_meshes(robot: RobotModel) -> tuple[BodyMesh, ...]:
    """The visual mesh of every body that has one."""
    meshes = []
    for link, visual in _visuals(ET.parse(robot.urdf).getroot()):
        mesh = _load(robot, visual)
        mesh.apply_transform(_origin(visual))
        meshes.append(
            BodyMesh(
                link.attrib["name"],
                np.asarray(mesh.vertices, dtype=np.float64),
                np.asarray(mesh.faces, dtype=np.int32),
            )
        )
    return tuple(meshes)


def add_robot(
    plant: MultibodyPlant,
    scene_graph: SceneGraph,
    robot: RobotModel,
    contact_model: ContactModel = "hydroelastic",
) -> ModelInstanceIndex:
    """Adds the robot with a floating base, actuators, servos and contact geometry.

    Args:
        plant: not finalised yet.
        scene_graph: the one that the plant is registered with.
        robot: which robot.
        contact_model: of the plant; it decides what the soles are made of.

    Returns:
        Its model instance.
    """
    parser = Parser(plant)
    (instance,) = parser.AddModelsFromString(prepared_urdf(robot), "urdf")
    limits = joint_limits(robot)
    for index in plant.GetJointIndices(instance):
        joint = plant.get_joint(index)
        if joint.num_velocities() != 1:
            continue
        gains = robot.gains[joint.name()]
        actuator: JointActuator = plant.AddJointActuator(
            joint.name(), joint, limits[joint.name()][0]
        )
        actuator.set_default_rotor_inertia(gains.reflected_inertia)
        actuator.set_default_gear_ratio(1.0)
        actuator.set_controller_gains(
            PdControllerGains(p=gains.stiffness, d=gains.damping)
        )
    add_soles(plant, instance, robot, contact_model)
    filter_neighbours(plant, scene_graph, instance)
    return instance


def prepared_urdf(robot: RobotModel) -> str:
    """The robot's URDF with cached meshes, welded fingers and no massless frames."""
    root = ET.parse(robot.urdf).getroot()
    massless = {
        link.attrib["name"]
        for link in root.findall("link")
        if link.find("inertial") is None
    }
    for link in root.findall("link"):
        if link.attrib["name"] in massless:
            root.remove(link)
    for joint in root.findall("joint"):
        ends = {joint.find(end).attrib["link"] for end in ("parent", "child")}  # type: ignore[union-attr]
        if ends & massless:
            root.remove(joint)
        elif joint.attrib["name"] in robot.welded_joints:
            joint.set("type", "fixed")
            for mimic in joint.findall("mimic"):
                joint.remove(mimic)
    folder = _cache_folder(robot)
    for link, visual in _visuals(root):
        name = link.attrib["name"]
        pieces = range(robot.convex_pieces.get(name, 1))
        visual_file, *hull_files = cached_files(
            folder,
            (f"{name}.gltf", *(f"{name}_{piece}.obj" for piece in pieces)),
            partial(_convert, robot, name, visual),
        )
        _mesh(visual).set("filename", _uri(visual_file))
        collision = link.find("collision")
        if collision is not None:
            link.remove(collision)
        for file in hull_files:
            collision = ET.SubElement(link, "collision", {"name": f"{file.stem}_hull"})
            geometry = ET.SubElement(collision, "geometry")
            hull = ET.SubElement(geometry, "mesh", {"filename": _uri(file)})
            ET.SubElement(hull, "drake:declare_convex")
    root.set("xmlns:drake", "http://drake.mit.edu")
    return ET.tostring(root, encoding="unicode")


def _uri(path: Path) -> str:
    """As Drake reads it: `Path.as_uri` writes %20 for a blank, which stays a %20."""
    return f"file://{path}"


def _visuals(root: ET.Element) -> Iterator[tuple[ET.Element, ET.Element]]:
    for link in root.findall("link"):
        visual = link.find("visual")
        if visual is not None:
            yield link, visual


def _mesh(visual: ET.Element) -> ET.Element:
    mesh = visual.find("geometry/mesh")
    if mesh is None:
        raise ValueError("a visual without a mesh")
    return mesh


def _load(robot: RobotModel, visual: ET.Element) -> trimesh.Trimesh:
    mesh = trimesh.load_scene(_source(robot, visual)).to_geometry()
    if not isinstance(mesh, trimesh.Trimesh):
        raise ValueError(f"{_source(robot, visual)}: not a triangle mesh")
    return mesh


def _source(robot: RobotModel, visual: ET.Element) -> Path:
    uri = _mesh(visual).attrib["filename"]
    return robot.package_path / uri.removeprefix("package://").partition("/")[2]


def _origin(visual: ET.Element) -> Vector:
    origin = visual.find("origin")
    if origin is None:
        return np.eye(4)
    rpy: Vector = np.array(origin.get("rpy", "0 0 0").split(), dtype=np.float64)
    xyz: Vector = np.array(origin.get("xyz", "0 0 0").split(), dtype=np.float64)
    matrix: Vector = RigidTransform(RollPitchYaw(rpy), xyz).GetAsMatrix4()
    return matrix


def _cache_folder(robot: RobotModel) -> Path:
    digest = hashlib.sha256(robot.urdf.read_bytes()).hexdigest()[:12]
    return user_cache_path("footfall") / f"{robot.name}-{CACHE_VERSION}-{digest}"


def _convert(robot: RobotModel, name: str, visual: ET.Element) -> list[bytes]:
    """The mesh of a body as glTF to be seen, and its convex pieces as OBJ to be met."""
    scene = trimesh.load_scene(_source(robot, visual))
    scene.apply_transform(_Z_UP_TO_Y_UP)  # type: ignore[no-untyped-call]
    files = export_gltf(scene, embed_buffers=True)  # type: ignore[no-untyped-call]
    mesh = _load(robot, visual)
    mesh.apply_transform(_origin(visual))
    vertices = np.asarray(mesh.vertices)
    if name in robot.foot_bodies.values():
        lowest = -robot.sole.ankle_height + SOLE_CLEARANCE
        vertices = np.vstack([vertices[vertices[:, 2] >= lowest], _cut(mesh, lowest)])
    count = robot.convex_pieces.get(name, 1)
    hulls = [trimesh.convex.convex_hull(vertices)]
    if count > 1:
        hulls = _pieces(mesh, count)
    return [
        _opaque(files["model.gltf"]),
        *(hull.export(file_type="obj").encode() for hull in hulls),
    ]


def _pieces(mesh: trimesh.Trimesh, count: int) -> list[trimesh.Trimesh]:
    """Convex hulls that together follow a concave surface within about a millimetre."""
    pieces = trimesh.decomposition.convex_decomposition(
        mesh, maxConvexHulls=count, resolution=VOXELS
    )
    return [trimesh.convex.convex_hull(piece["vertices"]) for piece in pieces]


def _opaque(gltf: bytes) -> bytes:
    """The same glTF with opaque materials.

    COLLADA's transparency is read as an alpha of 0 where it means that nothing is
    transparent; Meshcat does not mind, VTK then draws nothing.
    """
    data = json.loads(gltf)
    for material in data.get("materials", []):
        factor = material.get("pbrMetallicRoughness", {}).get("baseColorFactor")
        if factor is not None:
            factor[3] = 1.0
    return json.dumps(data).encode()


def _cut(mesh: trimesh.Trimesh, height: float) -> Vector:
    """Where the mesh's edges cross the plane z = height, (n, 3)."""
    ends = mesh.vertices[mesh.edges_unique]
    z = ends[:, :, 2]
    crossing = (z[:, 0] - height) * (z[:, 1] - height) < 0.0
    a, b = ends[crossing, 0], ends[crossing, 1]
    share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    cut: Vector = a + share[:, None] * (b - a)
    return cut
