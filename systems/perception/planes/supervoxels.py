"""Supervoxels, their merging and Filter 3: the clusters smaller than a foot.

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4.2, Eqs. 1 and 2.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.normals import normal_distance


@dataclass(frozen=True, eq=False)
class Supervoxels:
    """An over-segmentation of voxels."""

    labels: NDArray[np.int64]
    """Supervoxel of each voxel, (m,); -1 for none."""
    center: Vector
    """Mean position of the members, (s, 3), m."""
    normal: Vector
    """Unit mean normal of the members, (s, 3)."""
    count: NDArray[np.int64]
    """Voxels in each supervoxel, (s,)."""


def supervoxel_distance(
    p_i: Vector,
    n_i: Vector,
    p_j: Vector,
    n_j: Vector,
    *,
    seed_resolution: float,
    influence: float,
) -> Vector:
    """Computes the distance D of voxels to supervoxel centres (stair paper, Eq. 1).

    D = sqrt(mu |p_i - p_j|^2 / (3 R_seed^2) + (1 - mu) D_n(n_i, n_j)^2), D_n of Eq. 2.

    Args:
        p_i: positions, (..., 3), m.
        n_i: unit normals, (..., 3).
        p_j: positions, (..., 3), m.
        n_j: unit normals, (..., 3).
        seed_resolution: R_seed, m.
        influence: mu, of the Euclidean distance against that of the normals.

    Returns:
        (...), without unit.
    """
    square = np.sum((p_i - p_j) ** 2, axis=-1)
    spatial = square / (3.0 * seed_resolution**2)
    angular = normal_distance(n_i, n_j) ** 2
    return np.asarray(np.sqrt(influence * spatial + (1.0 - influence) * angular))


def choose_seeds(
    points: Vector, seed_resolution: float, candidates: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Chooses a seed a cell of the coarse octree O_s: the voxel nearest its middle.

    Args:
        points: representative points, (m, 3), m.
        seed_resolution: R_seed, m.
        candidates: the voxels to choose from, (c,).

    Returns:
        Indices of the seeds, (s,).
    """
    p = points[candidates]
    cells = np.floor(p / seed_resolution).astype(np.int64)
    cells -= cells.min(axis=0)
    span = cells.max(axis=0) + 1
    keys = (cells[:, 0] * span[1] + cells[:, 1]) * span[2] + cells[:, 2]
    local = p / seed_resolution
    middle = np.sum((local - np.floor(local) - 0.5) ** 2, axis=1)
    order = np.lexsort((middle, keys))
    first = np.flatnonzero(np.diff(keys[order], prepend=-1))
    return np.asarray(candidates[order[first]])


def cluster_supervoxels(
    points: Vector,
    normals: Vector,
    pairs: NDArray[np.int64],
    *,
    seed_resolution: float,
    influence: float,
) -> Supervoxels:
    """Grows supervoxels from their seeds, all at once, a layer of voxels at a time.

    Each expansion reaches for the free neighbours within R_seed of a supervoxel's
    centre; a voxel goes to the centre with the least D (Eq. 1). Then the centres become
    the means of their members. Voxels that no seed reaches get seeds of their own,
    until there is no voxel left.

    Args:
        points: representative points of voxels, (m, 3), m.
        normals: their unit normals, (m, 3).
        pairs: adjacent voxels, (p, 2).
        seed_resolution: R_seed, m.
        influence: mu.
    """
    m = len(points)
    labels = np.full(m, -1, dtype=np.int64)
    features = np.hstack([points, normals])
    # A directed edge each way, so that an offer always runs from first to second.
    source = np.concatenate([pairs[:, 0], pairs[:, 1]])
    target = np.concatenate([pairs[:, 1], pairs[:, 0]])
    total = 0
    while (left := np.flatnonzero(labels < 0)).size:
        seeds = choose_seeds(points, seed_resolution, left)
        labels[seeds] = total + np.arange(len(seeds))
        total += len(seeds)
        _expand(labels, features, source, target, total, seed_resolution, influence)
    center, normal, count = _means(labels, features, total)
    return Supervoxels(labels=labels, center=center, normal=normal, count=count)


def _means(
    labels: NDArray[np.int64], features: Vector, total: int
) -> tuple[Vector, Vector, NDArray[np.int64]]:
    member = labels >= 0
    of = labels[member]
    count = np.bincount(of, minlength=total)
    sums = np.stack(
        [np.bincount(of, features[member, k], minlength=total) for k in range(6)],
        axis=1,
    )
    center = sums[:, :3] / np.maximum(count, 1)[:, None]
    length = np.linalg.norm(sums[:, 3:], axis=1, keepdims=True)
    return center, sums[:, 3:] / np.maximum(length, 1e-12), count


def _expand(
    labels: NDArray[np.int64],
    features: Vector,
    source: NDArray[np.int64],
    target: NDArray[np.int64],
    total: int,
    seed_resolution: float,
    influence: float,
) -> None:
    """Grows the supervoxels in `labels` until no voxel within reach is left."""
    while True:
        free = labels[target] < 0
        source, target = source[free], target[free]
        center, normal, _ = _means(labels, features, total)
        offered = labels[source] >= 0
        voxel, label = target[offered], labels[source[offered]]
        offset = features[voxel, :3] - center[label]
        near = np.einsum("ij,ij->i", offset, offset) <= seed_resolution**2
        voxel, label = voxel[near], label[near]
        if not len(voxel):
            return
        distance = supervoxel_distance(
            features[voxel, :3],
            features[voxel, 3:],
            center[label],
            normal[label],
            seed_resolution=seed_resolution,
            influence=influence,
        )
        # Of what is written to one place the last stays: the nearest goes last.
        order = np.argsort(-distance, kind="stable")
        labels[voxel[order]] = label[order]


def merge_supervoxels(
    supervoxels: Supervoxels,
    pairs: NDArray[np.int64],
    *,
    angle: float,
    offset: float,
) -> NDArray[np.int64]:
    """Clusters adjacent supervoxels that lie on one plane.

    Args:
        supervoxels: the over-segmentation of m voxels.
        pairs: adjacent voxels, (p, 2).
        angle: most that the normals of neighbours may differ, rad.
        offset: most that a centre may lie off its neighbour's plane, m.

    Returns:
        Cluster of each voxel, (m,); -1 for none.
    """
    labels, total = supervoxels.labels, len(supervoxels.count)
    a, b = labels[pairs[:, 0]], labels[pairs[:, 1]]
    border = (a != b) & (a >= 0) & (b >= 0)
    keys = np.unique(
        np.minimum(a, b)[border] * max(total, 1) + np.maximum(a, b)[border]
    )
    a, b = keys // max(total, 1), keys % max(total, 1)
    between = supervoxels.center[b] - supervoxels.center[a]
    normal = supervoxels.normal[a] + supervoxels.normal[b]
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    alike = normal_distance(supervoxels.normal[a], supervoxels.normal[b])
    joined = (alike <= 1.0 - np.cos(angle)) & (
        np.abs(np.sum(between * normal, axis=1)) <= offset
    )
    graph = coo_array(
        (np.ones(int(joined.sum())), (a[joined], b[joined])), shape=(total, total)
    )
    cluster = connected_components(graph, directed=False)[1].astype(np.int64)
    return np.asarray(
        np.where(labels >= 0, cluster[np.maximum(labels, 0)], -1) if total else labels
    )


def filter_small(
    clusters: NDArray[np.int64], voxel_size: float, min_area: float
) -> NDArray[np.int64]:
    """Drops the clusters that are smaller than a foot (Filter 3).

    Args:
        clusters: cluster of each voxel, (m,); -1 for none.
        voxel_size: v, m.
        min_area: area of a foot, m^2.

    Returns:
        Clusters renumbered from 0, (m,); -1 for voxels of dropped clusters.
    """
    inside = clusters >= 0
    count = np.bincount(clusters[inside])
    large = count * voxel_size**2 >= min_area
    number = np.where(large, np.cumsum(large) - 1, -1)
    result = np.full(len(clusters), -1, dtype=np.int64)
    result[inside] = number[clusters[inside]]
    return result
