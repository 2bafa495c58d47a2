"""Euclidean clusters of the points above the floor (room paper, Sec. 2.3.1)."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from footfall.models.values.vector import Vector


def cluster_points(points: Vector, radius: float, cell: float) -> NDArray[np.int64]:
    """Groups points that are linked by gaps of less than a radius, seen from above.

    The paper's algorithm floods from point to point through a k-d tree; the groups are
    the connected components of the graph of near pairs. Where the paper takes
    distances in space, here only the horizontal distance counts: obstacles become boxes
    that stand on the floor, so what overlaps seen from above is one obstacle, and a
    box's top and its foot belong together though the camera sees nothing between them.
    Points are first gathered in columns, which leaves the graph small.

    Args:
        points: (n, 3), m.
        radius: gap that separates two clusters, m.
        cell: edge of a column, m; well below the radius.

    Returns:
        Cluster of each point, (n,), numbered from 0 in the order of the points.
    """
    if not len(points):
        return np.zeros(0, dtype=np.int64)
    index = np.floor(points[:, :2] / cell).astype(np.int64)
    index -= index.min(axis=0)
    keys = index[:, 0] * (index[:, 1].max() + 1) + index[:, 1]
    _, column, count = np.unique(keys, return_inverse=True, return_counts=True)
    middle = np.column_stack(
        [np.bincount(column, weights=points[:, axis]) / count for axis in (0, 1)]
    )
    pairs = cKDTree(middle).query_pairs(radius, output_type="ndarray")
    shape = (len(middle), len(middle))
    near = coo_array((np.ones(len(pairs), np.int8), (pairs[:, 0], pairs[:, 1])), shape)
    found = connected_components(near, directed=False)[1][column]
    # Numbered anew by their first points.
    _, first, label = np.unique(found, return_index=True, return_inverse=True)
    order = np.empty(len(first), dtype=np.int64)
    order[np.argsort(first)] = np.arange(len(first))
    return np.asarray(order[label])
