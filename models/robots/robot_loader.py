"""From a robot's published description to a model that Drake can simulate.

URDFs come as they like: COLLADA, mirrored or no collision meshes, boxes for bodies,
transmissions or none, no rotor inertia. What is prepared here: meshes are converted
once into the user's cache folder; every body collides with the convex hulls of its
collision meshes, or of what is seen of it where it has none; the soles get contact
geometry; fingers are welded; every joint gets one actuator with its effort limit and a
servo.
"""

import hashlib
import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import cast

import numpy as np
import trimesh
from platformdirs import user_cache_path
from pydrake.common.eigen_geometry import AngleAxis
from pydrake.geometry import SceneGraph
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import JointActuator, ModelInstanceIndex, PdControllerGains
from scipy.spatial import QhullError
from trimesh.exchange.gltf import export_gltf

from footfall.models.robots.contact_geometry import (
    SOLE_THICKNESS,
    ContactModel,
    add_soles,
)
from footfall.models.robots.link_geometry import (
    Z_UP_TO_Y_UP,
    LinkShape,
    colour_of,
    link_shapes,
    material_colours,
)
from footfall.models.robots.mesh_cache import cached_files
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.self_collision import filter_neighbours
from footfall.models.robots.urdf import UrdfJoint, parse_xml, read_urdf, without_mass
from footfall.models.values.vector import Vector

CACHE_VERSION = "5"
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
    """Effort (Nm) and speed (rad/s) limit of every joint that moves."""
    return {name: (item.effort, item.speed) for name, item in robot.limits.items()}


def body_meshes(robot: RobotModel) -> tuple[BodyMesh, ...]:
    """Gives the surface of every body of which something is seen."""
    meshes = []
    for link, shapes in _links(robot, parse_xml(robot.urdf)):
        if not shapes.visuals:
            continue
        mesh = _joined([shape.mesh() for shape in shapes.visuals])
        meshes.append(
            BodyMesh(
                link.attrib["name"],
                np.asarray(mesh.vertices, dtype=np.float64),
                np.asarray(mesh.faces, dtype=np.int32),
            )
        )
    return tuple(meshes)


def solid_points(robot: RobotModel) -> dict[str, Vector]:
    """Points of what each body collides with, (n, 3), m, in the body's frame."""
    points = {}
    for link, shapes in _links(robot, bare_urdf(robot)):
        solid = shapes.collisions or shapes.visuals
        if solid:
            meshes = [shape.mesh().vertices for shape in solid]
            points[link.attrib["name"]] = np.vstack(meshes).astype(np.float64)
    return points


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
    for index in plant.GetJointIndices(instance):
        joint = plant.get_joint(index)
        if joint.num_velocities() != 1:
            continue
        gains = robot.gains[joint.name()]
        actuator: JointActuator = plant.AddJointActuator(
            joint.name(), joint, robot.limits[joint.name()].effort
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
    """Writes the robot's URDF as Drake is given it.

    Its meshes are those of the cache, its fingers are welded, frames without mass and
    transmissions are gone: every joint has one actuator, which `add_robot` makes.

    Raises:
        RobotError: the file is no URDF.
        ValueError: a link's geometry cannot be read; the link is named.
    """
    root = bare_urdf(robot)
    folder = _cache_folder(robot)
    for link, shapes in _links(robot, root):
        _prepare_link(robot, folder, link, shapes)
    root.set("xmlns:drake", "http://drake.mit.edu")
    return ET.tostring(root, encoding="unicode")


def bare_urdf(robot: RobotModel) -> ET.Element:
    """Keeps the links and joints that Drake is given, their geometry as published."""
    root, tree = parse_xml(robot.urdf), read_urdf(robot.urdf)
    dropped = without_mass(tree, named_bodies(robot))
    _spell_out_materials(root)
    for link in root.findall("link"):
        if link.attrib["name"] in dropped:
            root.remove(link)
    for element in root.findall("joint"):
        joint = tree.joints[element.attrib["name"]]
        if {joint.parent, joint.child} & dropped:
            root.remove(element)
        elif joint.name in robot.welded_joints:
            _weld(element, joint, robot.welded_at.get(joint.name, 0.0))
        elif joint.name in robot.limits:
            _limit(element, robot.limits[joint.name].speed)
    for element in root.findall("transmission"):
        root.remove(element)
    for dynamics in root.iterfind("joint/dynamics[@friction]"):
        del dynamics.attrib["friction"]  # Drake would warn that it has none.
    return root


def _spell_out_materials(root: ET.Element) -> None:
    """Gives every visual the colour that its material's name means.

    Drake refuses names with two colours, and names whose definition was in a link that
    is gone.
    """
    colours = material_colours(root)
    given: dict[str, tuple[float, float, float, float]] = {}
    for number, visual in enumerate(root.iterfind("link/visual")):
        for material in visual.findall("material"):
            name = material.get("name", "")
            rgba = colour_of(material) or colours.get(name)
            visual.remove(material)
            if rgba is None:
                continue
            if given.setdefault(name, rgba) != rgba:
                name = f"{name}_{number}"
            spelt = ET.SubElement(visual, "material", {"name": name})
            text = " ".join(f"{value:g}" for value in rgba)
            ET.SubElement(spelt, "color", {"rgba": text})
    for material in root.findall("material"):
        root.remove(material)


def named_bodies(robot: RobotModel) -> frozenset[str]:
    """Finds the bodies that the robot's model names."""
    named = {robot.base_body, robot.torso_body, *robot.foot_bodies.values()}
    return frozenset(named | ({robot.head_body} if robot.head_body else set()))


@dataclass(frozen=True)
class _Shapes:
    """What is seen of a link, and what its URDF lets collide."""

    visuals: list[LinkShape]
    collisions: list[LinkShape]


def _links(robot: RobotModel, root: ET.Element) -> Iterator[tuple[ET.Element, _Shapes]]:
    colours = material_colours(root)
    for link in root.findall("link"):
        visuals, collisions = (
            link_shapes(link, use, robot.urdf, robot.packages, colours)
            for use in ("visual", "collision")
        )
        yield link, _Shapes(visuals, collisions)


def _prepare_link(
    robot: RobotModel, folder: Path, link: ET.Element, shapes: _Shapes
) -> None:
    """Names the files of the cache, made where they are missing, in a link's shapes."""
    name = link.attrib["name"]
    stem = re.sub(r"[^\w.-]", "_", name)
    for number, shape in enumerate(shapes.visuals):
        if shape.source is None:
            continue
        suffix = f"-{number}" if number else ""
        (file,) = cached_files(folder, (f"{stem}{suffix}.gltf",), partial(_gltf, shape))
        _point_to(shape.element, file)
    solid = shapes.collisions or shapes.visuals
    foot = name in robot.foot_bodies.values()
    pieces = robot.convex_pieces.get(name, 1)
    if foot or pieces > 1:
        groups = [solid] if solid else []
    else:
        groups = [[shape] for shape in solid if shape.source is not None]
    for element in link.findall("collision"):
        primitive = element.find("geometry/mesh") is None
        if foot or pieces > 1 or not primitive:
            link.remove(element)
    count = 0
    for group in groups:
        names = [f"{stem}_{count + i}.obj" for i in range(pieces)]
        count += pieces
        lowest = SOLE_CLEARANCE - robot.sole.ankle_height if foot else -np.inf
        make = partial(_hulls, group, pieces, lowest)
        for file in cached_files(folder, names, make):
            if not file.stat().st_size:
                continue
            collision = ET.SubElement(link, "collision", {"name": f"{file.stem}_hull"})
            geometry = ET.SubElement(collision, "geometry")
            hull = ET.SubElement(geometry, "mesh", {"filename": _uri(file)})
            ET.SubElement(hull, "drake:declare_convex")
    if not shapes.collisions and not foot and pieces == 1:
        for shape in shapes.visuals:
            if shape.source is None:
                _add_primitive(link, shape.element)


def _add_primitive(link: ET.Element, visual: ET.Element) -> None:
    """Lets a box, cylinder or sphere that is seen collide as well."""
    collision = ET.SubElement(link, "collision")
    for part in visual:
        if part.tag in ("origin", "geometry"):
            collision.append(part)


def _point_to(visual: ET.Element, file: Path) -> None:
    mesh = visual.find("geometry/mesh")
    assert mesh is not None
    mesh.set("filename", _uri(file))
    mesh.attrib.pop("scale", None)


def _uri(path: Path) -> str:
    """As Drake reads it: `Path.as_uri` writes %20 for a blank, which stays a %20."""
    return f"file://{path}"


def _weld(element: ET.Element, joint: UrdfJoint, position: float) -> None:
    """Fixes a joint at a position."""
    element.set("type", "fixed")
    for mimic in element.findall("mimic"):
        element.remove(mimic)
    if position == 0.0 or not joint.moves:
        return
    if joint.kind == "prismatic":
        along: Vector = position * joint.axis
        move = RigidTransform(along)
    else:
        turn = RotationMatrix(AngleAxis(position, joint.axis))
        nowhere: Vector = np.zeros(3)
        move = RigidTransform(turn, nowhere)
    X = joint.X_PC.multiply(move)
    for origin in element.findall("origin"):
        element.remove(origin)
    rpy = RollPitchYaw(X.rotation()).vector()
    xyz = " ".join(repr(float(x)) for x in X.translation())
    angles = " ".join(repr(float(x)) for x in rpy)
    ET.SubElement(element, "origin", {"xyz": xyz, "rpy": angles})


def _limit(element: ET.Element, speed: float) -> None:
    """Gives a joint its speed limit where that is not the URDF's own."""
    limit = element.find("limit")
    if limit is None:
        limit = ET.SubElement(element, "limit", {"effort": "0", "velocity": "0"})
    if float(limit.get("velocity", "0")) != speed:
        limit.set("velocity", repr(speed))


def _cache_folder(robot: RobotModel) -> Path:
    """Names a folder by the state of the URDF, its meshes and what is made of them."""
    digest = hashlib.sha256(robot.urdf.read_bytes())
    made_with = [robot.sole.ankle_height, sorted(robot.convex_pieces.items())]
    digest.update(repr([made_with, sorted(robot.foot_bodies.values())]).encode())
    for _, shapes in _links(robot, parse_xml(robot.urdf)):
        for shape in (*shapes.visuals, *shapes.collisions):
            if shape.source is not None:
                state = shape.source.file.stat()
                digest.update(
                    f"{shape.source.file} {state.st_size} {state.st_mtime_ns}".encode()
                )
    name = re.sub(r"[^\w.-]", "_", robot.name)
    return (
        user_cache_path("footfall")
        / f"{name}-{CACHE_VERSION}-{digest.hexdigest()[:12]}"
    )


def _gltf(shape: LinkShape) -> list[bytes]:
    """Writes a mesh as glTF to be seen."""
    scene = shape.scene()
    scene.apply_transform(Z_UP_TO_Y_UP)  # type: ignore[no-untyped-call]
    files = export_gltf(scene, embed_buffers=True)  # type: ignore[no-untyped-call]
    return [_opaque(files["model.gltf"])]


def _hulls(shapes: list[LinkShape], pieces: int, lowest: float) -> list[bytes]:
    """Convex pieces of shapes as OBJ to be met.

    Args:
        shapes: of one link.
        pieces: how many; one is the hull of all.
        lowest: what lies below this height in the link's frame is cut off, m.

    Returns:
        As many files; empty ones where nothing is left, or all of it is flat.
    """
    mesh = _joined([shape.mesh() for shape in shapes])
    if pieces > 1:
        if np.isfinite(lowest):
            mesh = mesh.slice_plane([0.0, 0.0, lowest], [0.0, 0.0, 1.0])
        hulls = _pieces(mesh, pieces)
    else:
        vertices = np.asarray(mesh.vertices)
        if np.isfinite(lowest):
            above = vertices[vertices[:, 2] >= lowest]
            vertices = np.vstack([above, _cut(mesh, lowest)])
        try:
            hulls = [trimesh.convex.convex_hull(vertices)]
        except (QhullError, ValueError):
            hulls = []
    files = [str(hull.export(file_type="obj")).encode() for hull in hulls]
    return files + [b""] * (pieces - len(files))


def _joined(meshes: list[trimesh.Trimesh]) -> trimesh.Trimesh:
    if len(meshes) == 1:
        return meshes[0]
    parts = [trimesh.Trimesh(mesh.vertices, mesh.faces) for mesh in meshes]
    return cast(trimesh.Trimesh, trimesh.util.concatenate(parts))


def _pieces(mesh: trimesh.Trimesh, count: int) -> list[trimesh.Trimesh]:
    """Convex hulls that together follow a concave surface within about a millimetre."""
    pieces = trimesh.decomposition.convex_decomposition(
        mesh, maxConvexHulls=count, resolution=VOXELS
    )
    return [trimesh.convex.convex_hull(piece["vertices"]) for piece in pieces]


def _opaque(gltf: bytes) -> bytes:
    """Makes the materials of a glTF opaque.

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
    """Computes where the mesh's edges cross the plane z = height, (n, 3)."""
    ends = mesh.vertices[mesh.edges_unique]
    z = ends[:, :, 2]
    crossing = (z[:, 0] - height) * (z[:, 1] - height) < 0.0
    a, b = ends[crossing, 0], ends[crossing, 1]
    share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    cut: Vector = a + share[:, None] * (b - a)
    return cut
