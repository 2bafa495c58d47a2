"""Planes of clusters of level pieces of surface, split where they bend, and bounded.

All of it in a frame G whose z points up.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import (
    FittedPlane,
    Patch,
    bound_patch,
    fit_plane,
    ransac_planes,
)
from footfall.systems.perception.planes.surfaces import (
    Surfaces,
    connect_pieces,
    find_columns,
    neighbours,
)

FLAT = 0.9
"""Part of a cluster that lies on its plane from which on it is one plane."""
MANY_PIECES = 2500
"""Of a plane of more pieces only those at its rim bound it: it is a floor."""
ROUGH = 0.006
"""Standard deviation off its plane from which on a neighbourhood is not flat, m."""


def fit_surfaces(
    surfaces: Surfaces,
    clusters: NDArray[np.int64],
    *,
    offset: float,
    angle: float,
    tolerance: float,
    slope_tolerance: float,
    min_area: float,
    seed: int,
) -> tuple[FittedPlane, ...]:
    """Fits a plane to each cluster; one that is not flat is split where it bends first.

    Args:
        surfaces: the pieces.
        clusters: cluster of each, (m,); -1 for none.
        offset: most that neighbours differ in height, m.
        angle: most that the normals of neighbours differ, rad.
        tolerance: most that an inlier lies off its plane, m.
        slope_tolerance: steepest plane, rad.
        min_area: least area of a plane, m^2.
        seed: of RANSAC, for what is uneven without a bend.

    Returns:
        Planes whose inliers index pieces.
    """
    planes, uneven = _fit_flat(surfaces, clusters, tolerance)
    if np.any(uneven >= 0):
        smooth = split_at_bends(
            surfaces,
            np.flatnonzero(uneven >= 0),
            offset=offset,
            angle=angle,
            slope_tolerance=slope_tolerance,
            min_area=min_area,
        )
        flat, uneven = _fit_flat(surfaces, smooth, tolerance)
        planes += flat
    if np.any(uneven >= 0):
        planes.extend(
            ransac_planes(
                surfaces.mean,
                uneven,
                tolerance=tolerance,
                min_inliers=int(np.ceil(min_area / surfaces.cell**2)),
                rng=np.random.default_rng(seed),
            )
        )
    upright = np.cos(slope_tolerance)
    return tuple(plane for plane in planes if plane.normal[2] >= upright)


def _fit_flat(
    surfaces: Surfaces, clusters: NDArray[np.int64], tolerance: float
) -> tuple[list[FittedPlane], NDArray[np.int64]]:
    """Fits planes by least squares; returns the clusters that have none as well."""
    planes: list[FittedPlane] = []
    uneven = np.full(len(clusters), -1, dtype=np.int64)
    # The few numbers of clusters are sorted by radix.
    few = clusters.max(initial=-1) < np.iinfo(np.int16).max
    order = np.argsort(clusters.astype(np.int16) if few else clusters, kind="stable")
    bounds = np.searchsorted(clusters[order], np.arange(clusters.max(initial=-1) + 2))
    for begin, end in pairwise(bounds):
        members = order[begin:end]
        mean = surfaces.mean[members]
        point, normal = fit_plane(mean)
        inside = np.abs((mean - point) @ normal) <= tolerance
        if np.count_nonzero(inside) < FLAT * len(members):
            uneven[members] = clusters[members]
            continue
        point, normal = fit_plane(np.compress(inside, mean, axis=0))
        inside = np.abs((mean - point) @ normal) <= tolerance
        planes.append(FittedPlane(point, normal, members[inside]))
    return planes, uneven


def split_at_bends(
    surfaces: Surfaces,
    level: NDArray[np.int64],
    *,
    offset: float,
    angle: float,
    slope_tolerance: float,
    min_area: float,
) -> NDArray[np.int64]:
    """Clusters pieces anew, those whose normals differ from their neighbours' apart.

    Normals are those of the planes through a piece and its neighbours; pieces that are
    too steep (Filter 1) or about which it is not flat belong to none.

    Args:
        surfaces: the pieces.
        level: indices of those to be clustered, (m,), ascending.
        offset: most that neighbours differ in height, m.
        angle: most that the normals of neighbours differ, rad.
        slope_tolerance: steepest surface, rad.
        min_area: least area of a cluster, m^2.

    Returns:
        Cluster of each of all pieces; -1 for none.
    """
    pairs = neighbours(surfaces, level, offset)
    slope, rough = _local_slopes(surfaces.mean[level], pairs)
    smooth = (np.hypot(*slope.T) <= np.tan(slope_tolerance)) & (rough <= ROUGH)
    a, b = pairs[:, 0], pairs[:, 1]
    alike = np.hypot(*(slope[a] - slope[b]).T) <= angle
    pairs = pairs[smooth[a] & smooth[b] & alike]
    return connect_pieces(surfaces, level, pairs, min_area)


def _local_slopes(mean: Vector, pairs: NDArray[np.int64]) -> tuple[Vector, Vector]:
    """Fits planes through pieces and their neighbours.

    Args:
        mean: of each piece, (m, 3), m.
        pairs: neighbours, (p, 2).

    Returns:
        Slopes dz/dx and dz/dy, (m, 2), and standard deviations off the plane, (m,), m.
    """
    a, b, m = pairs[:, 0], pairs[:, 1], len(mean)
    d = mean[b] - mean[a]

    def total(values: Vector, odd: bool) -> Vector:
        own = np.bincount(a, values, minlength=m)
        other = np.bincount(b, values, minlength=m)
        return np.asarray(own - other if odd else own + other, dtype=np.float64)

    n = 1.0 + np.bincount(pairs.ravel(), minlength=m)
    first = np.stack([total(d[:, k], odd=True) for k in range(3)])
    second = {
        (i, k): total(d[:, i] * d[:, k], odd=False) - first[i] * first[k] / n
        for i in range(3)
        for k in range(i, 3)
    }
    xx, xy, yy = second[0, 0] + 1e-9, second[0, 1], second[1, 1] + 1e-9
    xz, yz = second[0, 2], second[1, 2]
    determinant = np.maximum(xx * yy - xy * xy, 1e-18)
    x, y = (yy * xz - xy * yz) / determinant, (xx * yz - xy * xz) / determinant
    left = np.maximum(second[2, 2] - x * xz - y * yz, 0.0)
    return np.column_stack([x, y]), np.sqrt(left / n)


def grow_rims(
    surfaces: Surfaces, planes: tuple[FittedPlane, ...], tolerance: float
) -> tuple[list[NDArray[np.int64]], NDArray[np.bool]]:
    """Gives each plane its pieces, and those about them that cross it.

    Columns at the rim of a plane hold a face as well, so that they are not level; such
    a piece may cross a plane above and one below.

    Args:
        surfaces: the pieces.
        planes: the planes.
        tolerance: most that a plane passes beside a piece, m.

    Returns:
        The pieces of each plane, ascending, and which pieces have others of their plane
        on all four sides, (m,).
    """
    column, total = surfaces.column, len(surfaces.column)
    level, inside = np.zeros(total, dtype=bool), np.zeros(total, dtype=bool)
    for plane in planes:
        level[plane.inliers] = True
    others = np.flatnonzero(~level)
    of_planes = []
    for plane in planes:
        own = column[plane.inliers]
        if len(own) > MANY_PIECES:
            inside[plane.inliers] = _inner_columns(own, surfaces.width)
        offset = surfaces.mean[others, :2] - plane.point[:2]
        z = plane.point[2] - offset @ plane.normal[:2] / plane.normal[2]
        crossed = (surfaces.low[others] <= z + tolerance) & (
            surfaces.high[others] >= z - tolerance
        )
        rim = others[crossed]
        rim = rim[_touch(column[rim], own, surfaces.width)]
        both = np.concatenate([plane.inliers, rim])
        of_planes.append(np.sort(both, kind="stable"))
    return of_planes, inside


def _inner_columns(columns: NDArray[np.int64], width: int) -> NDArray[np.bool]:
    """Tells which columns have others of them on all four sides, (k,).

    Args:
        columns: keys, (k,), ascending and maybe repeated.
        width: by how much those of neighbours along x differ.
    """
    new = np.diff(columns, prepend=-1) > 0
    cells, place = columns[new], np.cumsum(new) - 1
    inner = np.zeros(len(cells), dtype=bool)
    inner[1:-1] = cells[2:] - cells[:-2] == 2
    sides = cells + np.array([[-width], [width]])
    inner &= np.all(_are_among(sides, cells), axis=0)
    return np.asarray(inner[place])


def _touch(
    columns: NDArray[np.int64], cells: NDArray[np.int64], width: int
) -> NDArray[np.bool]:
    """Tells which columns, (k,), are beside some of the cells and none of them."""
    # The three neighbours of a row have keys that follow each other.
    rows = columns + np.array([[-width], [0], [width]])
    at = find_columns(cells, np.stack([rows - 1, rows]).reshape(6, -1))
    there = np.append(cells, np.iinfo(np.int64).max)[at]
    beside = np.any(there[:3] <= rows + 1, axis=0)
    return np.asarray(beside & (there[4] != columns))


def _are_among(
    columns: NDArray[np.int64], cells: NDArray[np.int64]
) -> NDArray[np.bool]:
    """Tells which columns, of any shape, are some of the cells, (c,), ascending."""
    at = np.minimum(find_columns(cells, columns), len(cells) - 1)
    return np.asarray(cells[at] == columns)


def bound_surfaces(
    surfaces: Surfaces,
    planes: tuple[FittedPlane, ...],
    points: Vector,
    tolerance: float,
) -> tuple[Patch, ...]:
    """Bounds each plane by the points of the cloud that support it.

    Args:
        surfaces: the pieces of the cloud.
        planes: the planes, whose inliers index pieces.
        points: the cloud, (n, 3), m.
        tolerance: most that a point lies off its plane, m.
    """
    of_planes, inside = grow_rims(surfaces, planes, tolerance)
    patches = []
    for plane, pieces in zip(planes, of_planes, strict=True):
        columns = 1 + np.count_nonzero(np.diff(surfaces.column[pieces]))
        area = columns * surfaces.cell**2 / max(float(plane.normal[2]), 0.1)
        count = int(surfaces.count[pieces].sum())
        large = len(pieces) > MANY_PIECES
        if large:
            pieces = pieces[~inside[pieces]]
        support = np.take(points, surfaces.points_of(pieces), axis=0)
        near = np.abs((support - plane.point) @ plane.normal) <= tolerance
        patch = bound_patch(
            plane, np.compress(near, support, axis=0), area, count if large else None
        )
        if patch is not None:
            patches.append(patch)
    return tuple(patches)
