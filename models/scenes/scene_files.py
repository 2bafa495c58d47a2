"""Reads the files that a scene may be: meshes, and SDF or URDF models."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from pydrake.geometry import Box as BoxShape
from pydrake.geometry import (
    Capsule,
    Convex,
    Cylinder,
    Ellipsoid,
    Mesh,
    Role,
    SceneGraph,
    Shape,
    Sphere,
)
from pydrake.math import RigidTransform
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.link_geometry import Z_UP_TO_Y_UP
from footfall.models.values.vector import Vector

MESHES = (".stl", ".obj", ".gltf", ".glb", ".dae", ".ply")
"""Files that hold a mesh."""
MODELS = (".sdf", ".urdf")
"""Files that Drake's parser reads."""
SEGMENTS = 48
"""Sides of the prism that stands for a cylinder."""


class Part(NamedTuple):
    """A shape of a file."""

    name: str
    """"" for the only one of a mesh."""
    mesh: trimesh.Trimesh
    """Its surface, m."""


def read_parts(file: Path, scale: float) -> list[Part]:
    """Reads the shapes of a file, those that collide, in the file's own frame, z up.

    Args:
        file: a mesh, or an SDF or URDF model; its joints are where they are by default.
        scale: of a mesh file's lengths to metres; a model's are metres.

    Raises:
        ValueError: the file cannot be read, or holds nothing; in one line.
    """
    suffix = file.suffix.lower()
    if suffix not in (*MESHES, *MODELS):
        known = ", ".join((*MESHES, *MODELS))
        raise ValueError(f"file: must end with {known}, got {file.name!r}")
    if not file.is_file():
        raise ValueError(f"file: {file}: no such file")
    if suffix in MODELS:
        return _model_parts(file)
    return [Part("", _read_mesh(file, scale))]


def _read_mesh(file: Path, scale: float) -> trimesh.Trimesh:
    try:
        scene = trimesh.load_scene(file)
    except Exception as error:  # of whatever reader trimesh chooses
        reason = (str(error).splitlines() or [type(error).__name__])[0]
        raise ValueError(f"file: {file}: cannot be read: {reason}") from None
    if file.suffix.lower() in (".glb", ".gltf"):
        scene.apply_transform(Z_UP_TO_Y_UP.T)  # type: ignore[no-untyped-call]
    mesh = scene.to_geometry()
    if not isinstance(mesh, trimesh.Trimesh) or not len(mesh.faces):
        raise ValueError(f"file: {file}: has no triangles")
    mesh.apply_transform(np.diag([scale, scale, scale, 1.0]))
    mesh.merge_vertices()
    return mesh


def _model_parts(file: Path) -> list[Part]:
    plant, scene_graph = MultibodyPlant(0.0), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    parser = Parser(plant)
    try:
        models = parser.AddModels(file)
        plant.Finalize()
    except RuntimeError as error:
        reason = str(error).splitlines()[0]
        raise ValueError(f"file: {file}: cannot be read: {reason}") from None
    context = plant.CreateDefaultContext()
    inspector = scene_graph.model_inspector()
    parts = []
    for body in (b for m in models for b in plant.GetBodyIndices(m)):
        link = plant.get_body(body)
        frame = plant.GetBodyFrameIdOrThrow(body)
        X_WB = plant.EvalBodyPoseInWorld(context, link)
        for geometry in inspector.GetGeometries(frame, Role.kProximity):
            name = inspector.GetName(geometry).rpartition("::")[2]
            try:
                mesh = surface_of(inspector.GetShape(geometry))
            except ValueError as error:
                raise ValueError(f"file: {file}: {link.name()}: {error}") from None
            X_WG = X_WB.multiply(inspector.GetPoseInFrame(geometry))
            mesh.apply_transform(X_WG.GetAsMatrix4())
            parts.append(Part(f"{link.name()}/{name}", mesh))
    if not parts:
        raise ValueError(f"file: {file}: has no collision geometry")
    return parts


def surface_of(shape: Shape) -> trimesh.Trimesh:
    """Makes the surface of one of Drake's shapes about its own frame.

    Round ones are prisms and polyhedra of `SEGMENTS` sides.

    Raises:
        ValueError: it is a shape without a surface of its own, a half space, say.
    """
    for kind, make in _MAKERS.items():
        if isinstance(shape, kind):
            return make(shape)
    if isinstance(shape, Mesh | Convex):
        source = shape.source()
        if not source.is_path():
            raise ValueError("a mesh that is in no file cannot be taken")
        mesh = _read_plain(Path(source.path()))
        mesh.apply_transform(np.diag([*shape.scale3(), 1.0]))
        return mesh.convex_hull if isinstance(shape, Convex) else mesh
    raise ValueError(f"a {type(shape).__name__} cannot be taken")


def _read_plain(file: Path) -> trimesh.Trimesh:
    """Reads a mesh that a model names, as Drake does: no axes are turned but glTF's."""
    return _read_mesh(file, 1.0)


def _ellipsoid(shape: Ellipsoid) -> trimesh.Trimesh:
    mesh: trimesh.Trimesh = trimesh.creation.icosphere(3)
    axes: Vector = np.array([shape.a(), shape.b(), shape.c(), 1.0])
    mesh.apply_transform(np.diag(axes))
    return mesh


_MAKERS: dict[type, Callable[..., trimesh.Trimesh]] = {
    BoxShape: lambda s: trimesh.creation.box(s.size()),
    Cylinder: lambda s: trimesh.creation.cylinder(
        s.radius(), s.length(), sections=SEGMENTS
    ),
    Capsule: lambda s: trimesh.creation.capsule(
        s.length(), s.radius(), count=[SEGMENTS, SEGMENTS]
    ),
    Sphere: lambda s: trimesh.creation.icosphere(3, s.radius()),
    Ellipsoid: _ellipsoid,
}


def placed(mesh: trimesh.Trimesh, X_WM: RigidTransform) -> trimesh.Trimesh:
    """Gives a copy of a surface, put where its file's frame is in W."""
    copy: trimesh.Trimesh = mesh.copy()
    copy.apply_transform(X_WM.GetAsMatrix4())
    return copy
