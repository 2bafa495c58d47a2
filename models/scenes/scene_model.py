"""A part of a scene from a file of one's own: a mesh, an SDF or a URDF model."""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.contact_geometry import GREATEST_FRICTION
from footfall.models.scenes.level_treads import level_treads, open_facets
from footfall.models.scenes.prisms import (
    Facet,
    Prism,
    cut_prisms,
    level_facets,
    open_edges,
)
from footfall.models.scenes.scene_files import Part, placed, read_parts
from footfall.models.scenes.solids import Hull, Rgba, Role
from footfall.models.scenes.tread import Tread
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector

COLOR: Rgba = (0.70, 0.66, 0.58, 1.0)
WHOLE = 1e-3
"""Prisms whose volume differs by less than this share are the whole of a surface."""
STAND_OFF = 0.005
"""Most that convex pieces may stand off the surface that they stand for, m, in the mean
over its area."""
VOXELS = 100_000
"""That a surface is filled with to be cut."""
PIECES = 32
"""Most convex pieces of a surface that is neither made of prisms nor convex."""


@dataclass(kw_only=True)
class SceneModelParams(Parameters):
    """A mesh (.stl, .obj, .gltf, ...), an SDF or a URDF model that stands in the room.

    It is immovable. What the robot touches is what its sensors see: closed surfaces
    with level and upright faces are cut into prisms exactly, convex ones are taken
    whole, others in convex pieces that stay within millimetres of them.
    """

    name: str = "model"
    """What it is called in contacts and messages, unique in its scene."""
    file: str = ""
    """The file, its path from the scenario's file (of --set from the working folder).
    """
    scale: float = number(1.0, least=1e-4, most=1e4)
    """Metres that a mesh file's unit is: 0.001 where it is in millimetres."""
    x: float = number(0.0, "m")
    """Where the file's origin is along x of W, m."""
    y: float = number(0.0, "m")
    """The same along y of W, m."""
    z: float = number(0.0, "m")
    """The same above the floor, m."""
    roll: float = number(0.0, "rad")
    """Turn about W's x, first, rad: pi / 2 for a file whose y points up."""
    pitch: float = number(0.0, "rad")
    """Turn about W's y, then, rad."""
    yaw: float = number(0.0, "rad")
    """Turn about W's z, last, rad."""
    friction: float = number(0.8, above=0.0, below=GREATEST_FRICTION)
    """Coulomb friction coefficient between its surface and a sole."""
    min_tread: float = number(0.15, "m", above=0.0)
    """Level facets that look up are treads where both sides are this long, m; what is
    narrower, a handrail's top, is nothing to stand on."""

    def validate(self) -> None:
        """Checks every field, and that the file can be used.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.name:
            raise ValueError("name: must not be empty")
        self._shape()

    def solids(self) -> tuple[Hull, ...]:
        """Makes its convex solids, "NAME/..." each; those under treads are stairs.

        Raises:
            ValueError: a field is wrong, or the file; see `validate`.
        """
        return tuple(
            Hull(
                f"{self.name}/{piece.name}", piece.vertices, self.friction, COLOR, role
            )
            for piece in self._shape().pieces
            for role in (piece.role,)
        )

    def treads(self) -> tuple[Tread, ...]:
        """Finds its treads: level facets that look up, joined where coplanar.

        Raises:
            ValueError: a field is wrong, or the file; see `validate`.
        """
        return self._shape().treads

    def _shape(self) -> "_Shape":
        file = Path(self.file)
        changed = file.stat().st_mtime_ns if file.is_file() else 0
        pose = (self.x, self.y, self.z, self.roll, self.pitch, self.yaw)
        return _shape(file, changed, self.scale, pose, self.min_tread, self.name)


class Piece(NamedTuple):
    """A convex piece of a model."""

    name: str
    vertices: Vector
    """In W, (n, 3), m."""
    role: Role


class _Shape(NamedTuple):
    """What a file comes to."""

    pieces: tuple[Piece, ...]
    treads: tuple[Tread, ...]


class _Body(NamedTuple):
    """A closed surface, cut."""

    name: str
    prisms: list[Prism]
    """The whole of it where there are any."""
    pieces: list[Vector]
    """Corners of convex pieces otherwise, (n, 3) each, m."""
    facets: list[Facet]
    """Level ones that look up."""


@lru_cache(maxsize=32)
def _shape(
    file: Path,
    changed: int,
    scale: float,
    pose: tuple[float, ...],
    min_tread: float,
    name: str,
) -> _Shape:
    """Reads, places and cuts a file, once for each time that it changed."""
    rotation = RollPitchYaw(*pose[3:])
    p_WM: Vector = np.array(pose[:3], dtype=np.float64)
    X_WM = RigidTransform(rotation, p_WM)
    bodies = [
        body
        for part in read_parts(file, scale)
        for body in _bodies(Part(part.name, placed(part.mesh, X_WM)), file)
    ]
    prisms = [prism for body in bodies for prism in body.prisms]
    facets = open_facets([f for body in bodies for f in body.facets], prisms)
    forward: Vector = X_WM.rotation().matrix()[:2, 0]
    treads = level_treads(facets, min_tread, forward, f"{name}/")
    heights = [tread.X_WR.translation()[2] for tread in treads]
    pieces = []
    for body in bodies:
        corners = [(p.vertices(), p.high) for p in body.prisms]
        corners += [(piece, float(piece[:, 2].max())) for piece in body.pieces]
        for index, (vertices, top) in enumerate(corners):
            trodden = bool(np.any(np.abs(np.array(heights) - top) < 1e-3))
            role: Role = "stairs" if trodden else "structure"
            pieces.append(Piece(f"{body.name}piece_{index + 1}", vertices, role))
    return _Shape(tuple(pieces), treads)


def _bodies(part: Part, file: Path) -> list[_Body]:
    """Cuts the surface of a part, at once where it is all prisms, else body by body.

    Raises:
        ValueError: it is not closed, or cannot be cut near enough.
    """
    what = f"file: {file}: {part.name}: " if part.name else f"file: {file}: "
    if missing := open_edges(part.mesh):
        raise ValueError(
            f"{what}must be a closed surface, so that there is an inside to stand on; "
            f"it is open along {missing} edges"
        )
    prefix = f"{part.name}/" if part.name else ""
    if (whole := _prism_body(part.mesh, prefix)) is not None:
        return [whole]
    bodies = []
    surfaces = part.mesh.split(only_watertight=False)
    for index, surface in enumerate(surfaces):
        name = f"{prefix}body_{index + 1}/" if len(surfaces) > 1 else prefix
        body = _prism_body(surface, name)
        if body is None:
            facets = level_facets(surface)
            body = _Body(name, [], _convex_pieces(surface, what), facets)
        bodies.append(body)
    return bodies


def _prism_body(surface: trimesh.Trimesh, name: str) -> _Body | None:
    """Cuts a surface into prisms; None where they are not the whole of it."""
    prisms = cut_prisms(surface)
    missing = surface.volume - sum(prism.volume for prism in prisms)
    if abs(missing) > WHOLE * abs(surface.volume):
        return None
    return _Body(name, prisms, [], level_facets(surface))


def _convex_pieces(surface: trimesh.Trimesh, what: str) -> list[Vector]:
    """Gives a convex surface whole, another one in pieces near to it."""
    if surface.is_convex:
        return [np.asarray(surface.vertices)]
    found = trimesh.decomposition.convex_decomposition(
        surface, maxConvexHulls=PIECES, resolution=VOXELS
    )
    hulls = [trimesh.convex.convex_hull(piece["vertices"]) for piece in found]
    excess = sum(hull.volume for hull in hulls) - surface.volume
    off = abs(excess) / surface.area
    if off > STAND_OFF:
        raise ValueError(
            f"{what}is neither convex nor all level and upright faces, and convex "
            f"pieces stand off it by {100.0 * off:.1f} cm in the mean; make it of "
            "convex bodies"
        )
    return [np.asarray(hull.vertices) for hull in hulls]
