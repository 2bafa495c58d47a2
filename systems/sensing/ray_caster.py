"""What a fan of beams meets: a fixed scene, and rigid meshes that move through it."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.scenes.solids import TriangleMesh
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector

# Open3D takes as long to import as all else together; who casts no ray needs none.
if TYPE_CHECKING:
    from footfall.systems.open3d_loader import open3d as o3d

Beams: TypeAlias = slice | np.ndarray[Any, np.dtype[np.int64]]
"""Some of the beams, by their place among all."""


@dataclass(frozen=True, eq=False)
class BodyMesh(Value):
    """The surface of a rigid body that the beams can meet."""

    body_index: int
    """Where the body's pose is in the plant's `body_poses`."""
    vertices: Vector
    """Corners in the body's frame, (n, 3), m."""
    triangles: np.ndarray[Any, np.dtype[np.int64]]
    """Indices into `vertices`, (m, 3)."""


class RayCaster:
    """Casts fans of beams; it is built once and never changes.

    Every body has its own bounding-volume tree in its own frame, so nothing is rebuilt
    when it moves: the beams are carried into its frame. Only those beams are cast
    against a body that pass through its bounding sphere.
    """

    def __init__(self, scene: TriangleMesh, bodies: Sequence[BodyMesh]) -> None:
        """Builds the trees.

        Args:
            scene: what does not move, in W.
            bodies: what moves.
        """
        self._scene = _tree(scene.vertices, scene.triangles)
        self._bodies = tuple(_Body(mesh) for mesh in bodies)

    def cast(
        self,
        X_WL: RigidTransform,
        angles: Vector,
        directions: Vector,
        body_poses: Sequence[RigidTransform],
    ) -> Vector:
        """Distances to the nearest surface along the beams of a fan.

        Args:
            X_WL: pose of the fan; its beams leave the origin in the xy-plane.
            angles: directions of the beams about z, ascending, (n,), rad.
            directions: the same as unit vectors in L, (n, 3).
            body_poses: X_WB of every body, indexed by `BodyMesh.body_index`.

        Returns:
            True distances, (n,), m; inf where nothing is met.
        """

        def in_sphere(p_LC: Vector, radius: float) -> Iterable[Beams]:
            ranges = _beams_in_sphere(p_LC, radius, angles)
            return (slice(first, last) for first, last in ranges)

        # One thread: a fan is so small that handing it out costs more than casting.
        return self.cast_beams(X_WL, directions, body_poses, in_sphere, threads=1)

    def cast_beams(
        self,
        X_WL: RigidTransform,
        directions: Vector,
        body_poses: Sequence[RigidTransform],
        in_sphere: Callable[[Vector, float], Iterable[Beams]],
        *,
        threads: int,
    ) -> Vector:
        """Distances to the nearest surface along beams in any directions.

        Args:
            X_WL: pose of the sensor, from whose origin the beams leave.
            directions: where they go, in L, (n, 3). Where these are no unit vectors,
                distances are in units of their lengths.
            body_poses: X_WB of every body, indexed by `BodyMesh.body_index`.
            in_sphere: the beams that may pass through a sphere, by its centre in L,
                (3,), m, and its radius, m; no beam more than once.
            threads: how many threads to cast on; 0 for all there are.

        Returns:
            True distances, (n,); inf where nothing is met.
        """
        distances = _hit(self._scene, X_WL, directions, threads)
        X_LW = X_WL.inverse()
        for body in self._bodies:
            X_LB = X_LW.multiply(body_poses[body.index])
            X_BL = X_LB.inverse()
            for beams in in_sphere(np.array(X_LB.multiply(body.centre)), body.radius):
                near = _hit(body.tree, X_BL, directions[beams], threads)
                distances[beams] = np.minimum(distances[beams], near)
        return distances


class _Body:
    """A body's tree and the sphere about it."""

    def __init__(self, mesh: BodyMesh) -> None:
        self.index = mesh.body_index
        self.tree = _tree(mesh.vertices, mesh.triangles)
        corners = mesh.vertices[np.unique(mesh.triangles)]
        centre: Vector = (corners.min(axis=0) + corners.max(axis=0)) / 2.0
        self.centre = centre
        self.radius = float(np.linalg.norm(corners - centre, axis=1).max())


def _tree(
    vertices: Vector, triangles: np.ndarray[Any, np.dtype[np.int64]]
) -> "o3d.t.geometry.RaycastingScene":
    """Gives the tree of a mesh; equal meshes have one tree between them.

    A process that holds about a thousand trees crashes in Embree, and Drake never lets
    go of a System whose callbacks are its own methods, nor so of the robot's trees.
    """
    return _shared_tree(
        np.ascontiguousarray(vertices, dtype=np.float32).tobytes(),
        np.ascontiguousarray(triangles, dtype=np.uint32).tobytes(),
    )


@lru_cache(maxsize=128)
def _shared_tree(vertices: bytes, triangles: bytes) -> "o3d.t.geometry.RaycastingScene":
    from footfall.systems.open3d_loader import open3d as o3d

    tree = o3d.t.geometry.RaycastingScene(nthreads=1)
    corners = np.frombuffer(vertices, dtype=np.float32).reshape(-1, 3)
    faces = np.frombuffer(triangles, dtype=np.uint32).reshape(-1, 3)
    # Open3D's stubs take an array's shape for its element type.
    tree.add_triangles(
        o3d.core.Tensor(corners),  # type: ignore[call-overload]
        o3d.core.Tensor(faces),  # type: ignore[call-overload]
    )
    return tree


def _hit(
    tree: "o3d.t.geometry.RaycastingScene",
    X_TL: RigidTransform,
    directions: Vector,
    threads: int,
) -> Vector:
    """Distances along directions in L, (n, 3), to a tree whose frame is T."""
    from footfall.systems.open3d_loader import open3d as o3d

    rays = np.empty((len(directions), 6), dtype=np.float32)
    rays[:, :3] = X_TL.translation()
    rays[:, 3:] = directions @ X_TL.rotation().matrix().T
    cast = tree.cast_rays(o3d.core.Tensor.from_numpy(rays), nthreads=threads)
    distances: Vector = cast["t_hit"].numpy().astype(np.float64)
    return distances


def _beams_in_sphere(
    p_LC: Vector, radius: float, angles: Vector
) -> tuple[tuple[int, int], ...]:
    """Ranges [first, last) of the beams that may pass through a sphere.

    Args:
        p_LC: the sphere's centre, (3,), m.
        radius: its radius, m.
        angles: directions of the beams in the xy-plane, ascending, (n,), rad.
    """
    if abs(p_LC[2]) >= radius:
        return ()
    in_plane = np.sqrt(radius**2 - p_LC[2] ** 2)
    distance = float(np.hypot(p_LC[0], p_LC[1]))
    if distance <= in_plane:
        return ((0, len(angles)),)
    middle = np.arctan2(p_LC[1], p_LC[0])
    half = np.arcsin(in_plane / distance)
    found = []
    # The angles may reach to either side of +-pi, where the sphere's own wrap round.
    for turn in (-2.0 * np.pi, 0.0, 2.0 * np.pi):
        first = int(np.searchsorted(angles, middle + turn - half, side="left"))
        last = int(np.searchsorted(angles, middle + turn + half, side="right"))
        if last > first:
            found.append((first, last))
    return tuple(found)
