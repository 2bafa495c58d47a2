"""Noise of a cloud, and its level surfaces drawn together where there is much of it.

Range noise of 15 mm and more makes of a tread a layer as thick as a low rise: normals
of single voxels no longer tell level from steep. A mean shift along gravity (Comaniciu
and Meer 2002, flat kernel) draws each level surface together and leaves walls as they
are, for along a wall points are spread evenly.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.vector import Vector

COLUMN = 0.05
"""Side of the columns that a shift looks at, three by three of them, m."""
SLICE = 0.005
"""Height of the slices that points are counted in, m."""
SHIFTS = 4
"""Shifts: the means stand still to a millimetre by then."""


@dataclass(frozen=True)
class Sampling:
    """How a cloud samples its surfaces."""

    spacing: float = 0.0
    """Between the points of a sparse cloud, m; 0 where they are dense."""
    noise: float = 0.0
    """Standard deviation of level surfaces along z, m, as the sensor gave it."""
    drawn: bool = False
    """Whether its level surfaces were drawn together, so that `noise` is gone."""


def draw_levels_together(points: Vector, reach: float) -> Vector:
    """Shifts points along z to the mean of those about them, until they stand still.

    Args:
        points: finite, in a frame whose z points up, (n, 3), m.
        reach: how far up and down a shift looks, m: less than half a rise.

    Returns:
        The points, (n, 3), with x and y as they were.
    """
    cells = np.floor(points / [COLUMN, COLUMN, SLICE]).astype(np.int64)
    half = max(1, round(reach / SLICE))
    cells -= cells.min(axis=0)
    # Room above and below keeps what a shift looks at from reaching the next column.
    height = int(cells[:, 2].max()) + 2 * half + 2
    width = int(cells[:, 1].max()) + 3
    column = (cells[:, 0] + 1) * width + cells[:, 1] + 1
    key = column * height + cells[:, 2] + half
    keys, of_point = np.unique(key, return_inverse=True)
    count = np.bincount(of_point).astype(np.float64)
    total = np.bincount(of_point, points[:, 2])
    counts = np.concatenate([[0.0], np.cumsum(count)])
    totals = np.concatenate([[0.0], np.cumsum(total)])
    base = float(np.floor(points[:, 2].min() / SLICE)) * SLICE
    mean = total / count
    own = keys // height
    for _ in range(SHIFTS):
        slot = np.floor((mean - base) / SLICE).astype(np.int64) + half
        many, sum_z = np.zeros(len(keys)), np.zeros(len(keys))
        for step in (-1, 0, 1):
            for side in (-1, 0, 1):
                centre = (own + step * width + side) * height + slot
                low = np.searchsorted(keys, centre - half)
                high = np.searchsorted(keys, centre + half, side="right")
                many += counts[high] - counts[low]
                sum_z += totals[high] - totals[low]
        mean = np.where(many > 0.0, sum_z / np.maximum(many, 1.0), mean)
    shifted = points.copy()
    shifted[:, 2] = mean[of_point]
    return shifted
