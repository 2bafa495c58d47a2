"""Voxels of a cloud and Filter 2: the voxels with too few neighbours.

Stair paper (Zhang, Caron, Nakamura 2016), Algorithm 1, lines 9 to 16.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from footfall.models.values.vector import Vector

FARTHEST = 1e4
"""No sensor of ours sees farther, m; beyond it the keys of voxels would overflow."""


FAR = 1000.0
"""A cloud farther from the origin than this, and smaller, is moved near it, m."""
SAMPLE = 2000
"""Points whose place and neighbours are looked at; more would tell the same."""
BLOCK = 0.5
"""Side of blocks of which some tell how dense a cloud is, m."""
MAX_SPARSE = 200_000
"""A larger cloud is taken for dense: to look would cost more than it tells."""
MAX_SPACING = 0.045
"""Points farther apart do not show a tread, m."""


@dataclass(frozen=True, eq=False)
class VoxelGrid:
    """The occupied voxels of a cloud, sorted by key."""

    index: NDArray[np.int64]
    """Integer coordinates, (m, 3)."""
    keys: NDArray[np.int64]
    """Scalar keys, (m,), ascending; neighbours along z have neighbouring keys."""
    strides: tuple[int, int]
    """Strides of the key in the first and the second coordinate."""
    mean: Vector
    """Mean of each voxel's points, (m, 3), m."""
    representative: NDArray[np.int64]
    """Index of the point nearest to the mean, (m,)."""
    count: NDArray[np.int64]
    """Points in each voxel, (m,)."""
    voxel_of_point: NDArray[np.int64]
    """Each point's voxel, (n,)."""


def usable_points(points: Vector) -> Vector:
    """Selects the points, (n, 3), that are finite and within 10 km of the origin."""
    good = np.ones(len(points), dtype=bool)
    with np.errstate(invalid="ignore"):
        for axis in range(3):
            good &= np.abs(points[:, axis]) < FARTHEST
    return points if good.all() else points[good]


def cloud_origin(points: Vector) -> Vector:
    """Chooses where a cloud is worked on from, (3,), m: whole metres, or the origin.

    Args:
        points: (n, 3), m; those that are not finite do not count.
    """
    sample = points[:: max(1, len(points) // SAMPLE)]
    sample = sample[np.all(np.isfinite(sample), axis=1)]
    if not len(sample):
        return np.zeros(3)
    middle = np.median(sample, axis=0)
    far = np.linalg.norm(middle) > FAR and np.ptp(sample, axis=0).max() < FAR
    return np.round(middle) if far else np.zeros(3)


def point_spacing(points: Vector) -> float:
    """Measures the median distance of points to their nearest neighbours, m.

    Repeated points, as of an elevation grid's cells, count once.

    Args:
        points: finite, (n, 3), m.
    """
    if len(points) < 2:
        return 0.0
    points = _some_blocks(points)
    chosen = points[:: -(-len(points) // SAMPLE)]
    distance = np.asarray(cKDTree(points).query(chosen, k=min(6, len(points)))[0])
    distance[distance < 1e-6] = np.inf
    nearest = distance.min(axis=1)
    nearest = nearest[np.isfinite(nearest)]
    return float(np.median(nearest)) if len(nearest) else 0.0


def sparse_spacing(points: Vector, voxel_size: float) -> float:
    """Measures how far apart the points of a sparse cloud are, m; 0 for a dense one.

    Args:
        points: finite, (n, 3), m.
        voxel_size: v, m.
    """
    spacing = point_spacing(points)
    return spacing if 0.75 * voxel_size < spacing <= MAX_SPACING else 0.0


def _some_blocks(points: Vector) -> Vector:
    """Selects the points of some blocks of a large cloud, as dense as they were."""
    if len(points) < 10 * SAMPLE:
        return points
    block = np.floor(points[:, 0] / BLOCK) + 3.0 * np.floor(points[:, 1] / BLOCK)
    share = max(2, len(points) // (4 * SAMPLE))
    chosen = points[np.mod(block, share) == 0.0]
    return chosen if len(chosen) >= SAMPLE else points


def voxelize(points: Vector, size: float) -> VoxelGrid:
    """Sorts points into voxels.

    Args:
        points: finite, (n, 3), m.
        size: edge v of a voxel, m.
    """
    cells = np.floor(points / size).astype(np.int64)
    low = cells.min(axis=0, initial=np.iinfo(np.int32).max)
    # One empty cell at either end keeps neighbours of the rim from wrapping around.
    cells -= low - 1 if len(cells) else 0
    span = cells.max(axis=0, initial=0) + 2
    strides = (int(span[1] * span[2]), int(span[2]))
    keys = cells[:, 0] * strides[0] + cells[:, 1] * strides[1] + cells[:, 2]
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    first = np.flatnonzero(np.diff(keys, prepend=-1))
    count = np.diff(first, append=len(keys))
    voxel = np.repeat(np.arange(len(first)), count)
    ordered = points[order]
    mean = np.add.reduceat(ordered, first, axis=0) if len(first) else np.zeros((0, 3))
    mean = mean / count[:, None]
    offset = ordered - mean[voxel]
    square = np.einsum("ij,ij->i", offset, offset)
    least = np.minimum.reduceat(square, first) if len(first) else np.zeros(0)
    nearest = np.flatnonzero(square == least[voxel])
    # Of points equally near the first counts.
    chosen = nearest[np.flatnonzero(np.diff(voxel[nearest], prepend=-1))]
    voxel_of_point = np.empty(len(points), dtype=np.int64)
    voxel_of_point[order] = voxel
    return VoxelGrid(
        index=cells[order[first]],
        keys=keys[first],
        strides=strides,
        mean=mean,
        representative=order[chosen],
        count=count,
        voxel_of_point=voxel_of_point,
    )


def adjacent_voxels(grid: VoxelGrid) -> NDArray[np.int64]:
    """Finds pairs of occupied voxels that touch by a face, an edge or a corner.

    Returns:
        (p, 2), each pair once.
    """
    keys, n = grid.keys, len(grid.keys)
    nodes = np.arange(n)
    above = nodes[:-1][np.diff(keys) == 1]
    pairs = [np.column_stack([above, above + 1])]
    stride_x, stride_y = grid.strides
    for column in (stride_y, stride_x - stride_y, stride_x, stride_x + stride_y):
        # The three cells of a neighbouring column have consecutive keys.
        target = keys + column - 1
        start = np.searchsorted(keys, target)
        for step in range(3):
            at = np.minimum(start + step, n - 1)
            near = (start + step < n) & (keys[at] - target <= 2)
            pairs.append(np.column_stack([nodes[near], at[near]]))
    return np.concatenate(pairs)


def filter_sparse(
    pairs: NDArray[np.int64], voxel_count: int, min_neighbors: int
) -> NDArray[np.bool]:
    """Keeps the voxels with more than n_t occupied neighbours (Filter 2).

    The paper's text speaks of points in a voxel, its Algorithm 1 (line 12) of the
    "adjacency size"; the latter is what a single sweep can satisfy.

    Args:
        pairs: pairs of adjacent voxels, (p, 2).
        voxel_count: how many voxels there are.
        min_neighbors: n_t.

    Returns:
        Mask of the voxels to keep, (voxel_count,).
    """
    degree = np.bincount(pairs.ravel(), minlength=voxel_count)
    return np.asarray(degree > min_neighbors)


def keep_pairs(pairs: NDArray[np.int64], kept: NDArray[np.bool]) -> NDArray[np.int64]:
    """Keeps the pairs among the voxels that are kept, renumbered, (q, 2)."""
    number = np.cumsum(kept) - 1
    inside = kept[pairs[:, 0]] & kept[pairs[:, 1]]
    return np.asarray(number[pairs[inside]])
