"""Closed meshes of staircases, made as one would find them in files."""

from itertools import pairwise

import numpy as np
import shapely
import trimesh
from numpy.typing import ArrayLike


def box(low: ArrayLike, high: ArrayLike) -> trimesh.Trimesh:
    """An upright box from corner to corner, m."""
    return trimesh.creation.box(bounds=np.array([low, high], dtype=float))


def joined(*meshes: trimesh.Trimesh) -> trimesh.Trimesh:
    """Several in one, as a file without parts holds them."""
    mesh = trimesh.util.concatenate(list(meshes))
    mesh.merge_vertices()
    return mesh


def block_steps(
    count: int = 3, rise: float = 0.2, run: float = 0.27
) -> trimesh.Trimesh:
    """A block a step, side by side, each down to the floor."""
    return joined(
        *(
            box([n * run, -0.25, 0.0], [(n + 1) * run, 0.25, (n + 1) * rise])
            for n in range(count)
        )
    )


def profile_steps(rises: list[float], runs: list[float]) -> trimesh.Trimesh:
    """One surface: the profile of a flight, pulled across by 50 cm."""
    x, z = np.cumsum([0.0, *runs]), np.cumsum([0.0, *rises])
    corners = [(0.0, 0.0)]
    for n in range(len(rises)):
        corners += [(x[n], z[n + 1]), (x[n + 1], z[n + 1])]
    corners.append((x[-1], 0.0))
    profile = shapely.orient_polygons(shapely.Polygon(corners))
    triangles = []
    for part in shapely.get_parts(shapely.constrained_delaunay_triangles(profile)):
        a, b, c = np.asarray(shapely.orient_polygons(part).exterior.coords)[:3]
        for side, order in ((-0.25, (a, b, c)), (0.25, (a, c, b))):
            triangles.append([(p[0], side, p[1]) for p in order])
    ring = np.asarray(profile.exterior.coords)
    for p, q in pairwise(ring):
        near_p, near_q = (p[0], -0.25, p[1]), (q[0], -0.25, q[1])
        far_p, far_q = (p[0], 0.25, p[1]), (q[0], 0.25, q[1])
        triangles += [[near_p, far_q, near_q], [near_p, far_p, far_q]]
    corners_of = np.array(triangles).reshape(-1, 3)
    mesh = trimesh.Trimesh(corners_of, np.arange(len(corners_of)).reshape(-1, 3))
    mesh.merge_vertices()
    return mesh
