"""Things on the floor that are lower than single points can tell from its noise."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from footfall.models.values.vector import Vector

CELLS = 3
"""Cells along the side of a patch."""
DEVIATIONS = 5.0
"""A patch is raised by so many deviations of its mean at least."""
HALF = 0.5
"""Part of the height about it at which a thing ends: there half of a patch is its."""


def patch_sums(
    flat: NDArray[np.int64], shape: tuple[int, int], weights: Vector | None = None
) -> Vector:
    """Adds up points over the patch about each cell, of `CELLS` by `CELLS` cells.

    Args:
        flat: cell of each point in the flattened grid, (n,).
        shape: of the grid.
        weights: what is added, (n,); None counts the points.

    Returns:
        Sums, of the grid's shape. A running sum leaves rounding behind: a count is
        whole only when rounded.
    """
    total = np.bincount(flat, weights, shape[0] * shape[1]).reshape(shape)
    window = ndimage.uniform_filter(
        total.astype(np.float64) * CELLS**2, CELLS, mode="constant"
    )
    return np.asarray(window, dtype=np.float64)


def raised_points(
    points: Vector,
    height: Vector,
    limit: Vector,
    deviation: Vector,
    *,
    patch: float,
    least: float,
) -> NDArray[np.bool]:
    """Selects the points of patches whose mean is over the floor by more than noise.

    A patch with points over the limit belongs to something high, which single points
    tell.

    Args:
        points: (n, 3), m.
        height: over the floor, (n,), m.
        limit: up to which height a point counts, (n,), m.
        deviation: standard deviation of the heights, (n,), m.
        patch: side of a patch, m.
        least: what is lower on the mean is the floor, m.
    """
    raised = np.zeros(len(points), dtype=bool)
    low = np.abs(height) <= limit
    if not low.any():
        return raised
    index = np.floor(points[:, :2] * (CELLS / patch)).astype(np.int64)
    index -= index.min(axis=0)
    shape = (int(index[:, 0].max()) + 1, int(index[:, 1].max()) + 1)
    flat = index[:, 0] * shape[1] + index[:, 1]
    count = np.maximum(np.rint(patch_sums(flat[low], shape)), 1.0)
    mean = patch_sums(flat[low], shape, height[low]) / count
    noise = (
        np.sqrt(np.maximum(patch_sums(flat[low], shape, deviation[low] ** 2), 0.0))
        / count
    )
    tall = np.rint(patch_sums(flat[height > limit], shape)) > 0.0
    mean[tall] = 0.0
    edge = HALF * ndimage.maximum_filter(mean, 2 * CELLS + 1)
    high = mean > np.maximum(np.maximum(least, DEVIATIONS * noise), edge)
    raised[low] = high.ravel()[flat[low]]
    return raised
