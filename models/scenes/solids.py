"""What scenes are built of: boxes and hulls, for contact, for rays, and by role."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from pydrake.geometry import Box as BoxShape
from pydrake.geometry import Convex, GeometryId, SceneGraphInspector, Shape
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant
from scipy.spatial import ConvexHull

from footfall.models.robots.contact_geometry import surface_properties
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector

Rgba: TypeAlias = tuple[float, float, float, float]
Role: TypeAlias = Literal["floor", "wall", "stairs", "box", "structure"]
"""What a solid is to the robot: the floor, a wall or the ceiling, what it climbs, an
obstacle or clutter, or anything else that stands there."""
GROUND: frozenset[Role] = frozenset({"floor", "stairs"})
"""What soles may touch; nothing else of a robot may, and soles nothing else."""


class TriangleMesh(NamedTuple):
    """Triangles in one frame."""

    vertices: Vector
    """Corners, (n, 3), m."""
    triangles: np.ndarray[Any, np.dtype[np.int64]]
    """Indices into `vertices`, (m, 3), counter-clockwise seen from outside."""


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
    role: Role = "structure"
    """What it is to the robot."""

    def place(self) -> tuple[Shape, RigidTransform]:
        """Gives Drake's shape and its pose in W."""
        return BoxShape(*self.size), self.X_WB

    def surface(self) -> TriangleMesh:
        """Computes its surface in W: 8 vertices and 12 triangles."""
        p_B: Vector = _CORNERS * self.size
        return TriangleMesh(np.array(self.X_WB.multiply(p_B.T)).T, _FACES)


@dataclass(frozen=True, eq=False)
class Hull(Value):
    """An immovable convex solid of the scene."""

    name: str
    """What it is, unique in its scene."""
    vertices: Vector
    """Its corners in W, (n, 3), m; their convex hull is the solid."""
    friction: float
    """Coulomb friction coefficient between its surface and a sole."""
    color: Rgba
    """Red, green, blue and opacity, each 0 to 1; for pictures alone."""
    role: Role = "structure"
    """What it is to the robot."""

    def place(self) -> tuple[Shape, RigidTransform]:
        """Gives Drake's shape and its pose in W."""
        middle: Vector = self.vertices.mean(axis=0)
        corners: Vector = (self.vertices - middle).T
        return Convex(corners, self.name), RigidTransform(middle)

    def surface(self) -> TriangleMesh:
        """Computes its surface in W, the faces of the convex hull."""
        hull = ConvexHull(self.vertices)
        triangles = hull.simplices.astype(np.int64)
        corners = hull.points[triangles]
        turn = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        inward = np.sum(turn * hull.equations[:, :3], axis=1) < 0.0
        triangles[inward] = triangles[inward][:, ::-1]
        return TriangleMesh(self.vertices, triangles)


Solid: TypeAlias = Box | Hull


def upright_pose(
    x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw: float = 0.0
) -> RigidTransform:
    """The pose of something upright at (x, y, z), m, turned by yaw, rad, about z."""
    p: Vector = np.array([x, y, z], dtype=np.float64)
    return RigidTransform(RollPitchYaw(0.0, 0.0, yaw), p)


def add_solids(plant: MultibodyPlant, solids: Iterable[Solid]) -> None:
    """Welds the solids to the world: contact and visual geometry of the same name.

    Args:
        plant: the plant, not yet finalized, registered with a scene graph.
        solids: what to add; names must be unique.
    """
    world = plant.world_body()
    for solid in solids:
        shape, X_WG = solid.place()
        surface = surface_properties(solid.friction)
        color: Vector = np.array(solid.color, dtype=np.float64)
        plant.RegisterCollisionGeometry(world, X_WG, shape, solid.name, surface)
        plant.RegisterVisualGeometry(world, X_WG, shape, solid.name, color)


def solid_name(inspector: SceneGraphInspector, geometry: GeometryId) -> str:
    """The name a geometry was given, without the model instance that Drake prepends.

    For a geometry made by `add_solids` this is the solid's own name, so a contact can
    be traced to e.g. "staircase/step_2".
    """
    return inspector.GetName(geometry).rsplit("::", maxsplit=1)[-1]


def triangle_mesh(solids: Iterable[Solid]) -> TriangleMesh:
    """Joins the surfaces of all solids, in W."""
    vertices: list[Vector] = []
    triangles: list[np.ndarray[Any, np.dtype[np.int64]]] = []
    count = 0
    for solid in solids:
        surface = solid.surface()
        vertices.append(surface.vertices)
        triangles.append(surface.triangles + count)
        count += len(surface.vertices)
    if not vertices:
        return TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    return TriangleMesh(np.vstack(vertices), np.vstack(triangles))
