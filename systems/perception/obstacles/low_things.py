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
    shape = tuple(int(size) for size in index.max(axis=0) + 1)
    flat = index[:, 0] * shape[1] + index[:, 1]

    def around(chosen: NDArray[np.bool], weights: Vector | None = None) -> Vector:
        values = None if weights is None else weights[chosen]
        total = np.bincount(flat[chosen], values, int(np.prod(shape))).reshape(shape)
        window = ndimage.uniform_filter(total.astype(float), CELLS, mode="constant")
        return np.asarray(window * CELLS**2)

    # A running sum leaves rounding behind: a count is whole.
    count = np.maximum(np.rint(around(low)), 1.0)
    mean = around(low, height) / count
    noise = np.sqrt(np.maximum(around(low, deviation**2), 0.0)) / count
    tall = np.rint(around(height > limit)) > 0.0
    mean[tall] = 0.0
    edge = HALF * ndimage.maximum_filter(mean, 2 * CELLS + 1)
    high = mean > np.maximum(np.maximum(least, DEVIATIONS * noise), edge)
    raised[low] = high.ravel()[flat[low]]
    return raised
