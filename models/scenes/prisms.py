"""Upright prisms that a closed surface with level and upright faces is made of; pure.

Drake's contact takes convex shapes. A surface whose faces are all level or upright, as
of a staircase, is cut exactly: below each level facet that looks up lies a prism that
reaches down to the next one that looks down.
"""

from typing import NamedTuple

import numpy as np
import shapely  # type: ignore[import-untyped]
import trimesh

from footfall.models.values.vector import Vector

LEVEL = np.cos(np.deg2rad(0.5))
"""Cosine of the most that a level facet leans."""
SAME_HEIGHT = 5e-4
"""Facets that differ by less are at one height, m."""
SLIVER = 1e-6
"""Polygons of less area are rounding, m^2."""
GRID = 1e-6
"""Corners are put on a grid of this width, m, so that shared edges stay shared."""


class Facet(NamedTuple):
    """A level piece of a surface."""

    height: float
    """z, m."""
    outline: shapely.Geometry
    """Seen from above in W, a polygon or several, m."""


class Prism(NamedTuple):
    """An upright prism of convex base."""

    base: Vector
    """Corners seen from above, (n, 2), m, counter-clockwise."""
    low: float
    """z of its lower face, m."""
    high: float
    """z of its upper face, m."""

    @property
    def volume(self) -> float:
        """Its volume, m^3."""
        return float(shapely.Polygon(self.base).area) * (self.high - self.low)

    def vertices(self) -> Vector:
        """Computes its corners, (2 n, 3), m."""
        below = np.column_stack([self.base, np.full(len(self.base), self.low)])
        above = np.column_stack([self.base, np.full(len(self.base), self.high)])
        return np.vstack([below, above])


def level_facets(mesh: trimesh.Trimesh, up: bool = True) -> list[Facet]:
    """Finds the level facets of a surface, joined where they are coplanar.

    Args:
        mesh: in W, m.
        up: whether those that look up are wanted, or those that look down.

    Returns:
        Lowest first.
    """
    facing = mesh.face_normals[:, 2] * (1.0 if up else -1.0)
    triangles = np.asarray(mesh.triangles)[facing > LEVEL]
    heights = triangles[:, :, 2].mean(axis=1)
    order = np.argsort(heights)
    facets = []
    for group in np.split(
        order, np.flatnonzero(np.diff(heights[order]) > SAME_HEIGHT) + 1
    ):
        if not len(group):
            continue
        outline = shapely.union_all(
            shapely.polygons(triangles[group][:, :, :2]), grid_size=GRID
        )
        if outline.area > SLIVER:
            facets.append(Facet(float(np.mean(heights[group])), outline))
    return facets


def open_edges(mesh: trimesh.Trimesh) -> int:
    """Counts the edges by which a surface is not closed, 0 where it is.

    Bodies that touch may share an edge: it is closed where as many triangles run along
    it one way as the other.
    """
    ends = np.asarray(mesh.edges)
    forward = ends[:, 0] < ends[:, 1]
    pairs, of_pair = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    balance = np.bincount(of_pair.ravel(), np.where(forward, 1.0, -1.0), len(pairs))
    return int(np.count_nonzero(balance))


def cut_prisms(mesh: trimesh.Trimesh) -> list[Prism]:
    """Cuts a closed surface into upright prisms of convex base.

    Each level facet that looks up is the top of prisms that reach down to the facets
    that look down beneath it. Of a surface with other faces than level and upright ones
    they are not the whole, as their volume tells.

    Args:
        mesh: closed, in W, m.
    """
    tops, bottoms = level_facets(mesh), level_facets(mesh, up=False)
    prisms = []
    for top in tops:
        left = top.outline
        for bottom in sorted(bottoms, key=lambda facet: -facet.height):
            if bottom.height >= top.height - SAME_HEIGHT or left.is_empty:
                continue
            shared = shapely.intersection(left, bottom.outline, grid_size=GRID)
            left = shapely.difference(left, bottom.outline, grid_size=GRID)
            prisms += [
                Prism(base, bottom.height, top.height) for base in convex_parts(shared)
            ]
    return prisms


def convex_parts(area: shapely.Geometry) -> list[Vector]:
    """Cuts an area into convex polygons, (n, 2) each, m, counter-clockwise.

    Args:
        area: polygons; what has no area in it is left out.
    """
    parts = []
    for polygon in shapely.get_parts(area):
        if polygon.geom_type != "Polygon" or polygon.area < SLIVER:
            continue
        hull = shapely.convex_hull(polygon)
        pieces = (
            [hull]
            if hull.area - polygon.area < SLIVER
            else shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
        )
        for piece in pieces:
            if piece.area > SLIVER:
                plain = shapely.simplify(shapely.orient_polygons(piece), GRID)
                parts.append(np.asarray(plain.exterior.coords)[:-1])
    return parts
