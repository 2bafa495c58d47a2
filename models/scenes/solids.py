"""Boxes: what scenes are built of, as contact geometry and as a mesh for rays."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from pydrake.geometry import Box as BoxShape
from pydrake.geometry import GeometryId, SceneGraphInspector
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.contact_geometry import surface_properties
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector

Rgba: TypeAlias = tuple[float, float, float, float]


class TriangleMesh(NamedTuple):
    """Triangles in one frame."""

    vertices: Vector
    """Corners, (n, 3), m."""
    triangles: np.ndarray[Any, np.dtype[np.int64]]
    """Indices into `vertices`, (m, 3), counter-clockwise seen from outside."""


@dataclass(frozen=True, eq=False)
class Box(Value):
    """An immovable box of the scene."""

    name: str
    """What it is, unique in its scene, e.g. "staircase/step_2"."""
    X_WB: RigidTransform
    """Pose of its centre."""
    size: Vector
    """Side lengths along B's axes, (3,), m."""
    friction: float
    """Coulomb friction coefficient between its surface and a sole, static and dynamic
    alike."""
    color: Rgba
    """Red, green, blue and opacity, each 0 to 1; for pictures alone."""


def upright_pose(
    x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw: float = 0.0
) -> RigidTransform:
    """The pose of something upright at (x, y, z), m, turned by yaw, rad, about z."""
    p: Vector = np.array([x, y, z], dtype=np.float64)
    return RigidTransform(RollPitchYaw(0.0, 0.0, yaw), p)


def add_solids(plant: MultibodyPlant, solids: Iterable[Box]) -> None:
    """Welds the solids to the world: contact and visual geometry of the same name.

    Args:
        plant: the plant, not yet finalized, registered with a scene graph.
        solids: what to add; names must be unique.
    """
    world = plant.world_body()
    for solid in solids:
        shape = BoxShape(*solid.size)
        surface = surface_properties(solid.friction)
        color: Vector = np.array(solid.color, dtype=np.float64)
        plant.RegisterCollisionGeometry(world, solid.X_WB, shape, solid.name, surface)
        plant.RegisterVisualGeometry(world, solid.X_WB, shape, solid.name, color)


def solid_name(inspector: SceneGraphInspector, geometry: GeometryId) -> str:
    """The name a geometry was given, without the model instance that Drake prepends.

    For a geometry made by `add_solids` this is the solid's own name, so a contact can
    be traced to e.g. "staircase/step_2".
    """
    return inspector.GetName(geometry).rsplit("::", maxsplit=1)[-1]


_CORNERS: Vector = np.array(
    [[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
)
_FACES = np.array(
    [
        *([0, 1, 3], [0, 3, 2]),
        *([4, 6, 7], [4, 7, 5]),
        *([0, 4, 5], [0, 5, 1]),
        *([2, 3, 7], [2, 7, 6]),
        *([0, 2, 6], [0, 6, 4]),
        *([1, 5, 7], [1, 7, 3]),
    ]
)


def triangle_mesh(solids: Iterable[Box]) -> TriangleMesh:
    """The surfaces of all solids in W: 8 vertices and 12 triangles a box."""
    vertices: list[Vector] = []
    triangles: list[np.ndarray[Any, np.dtype[np.int64]]] = []
    for index, solid in enumerate(solids):
        p_B: Vector = _CORNERS * solid.size
        vertices.append(np.array(solid.X_WB.multiply(p_B.T)).T)
        triangles.append(_FACES + len(_CORNERS) * index)
    if not vertices:
        return TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    return TriangleMesh(np.vstack(vertices), np.vstack(triangles))
