"""Parts of a cluster that are as high as one another: each is an obstacle of its own.

What stands close together is one cluster (room paper, Sec. 2.3.1), and a box about it
is as high as its highest part and as large as all of them. A camera above tells them
apart by the heights of their tops. Columns at the sides of a thing show any height
below its top; they are as thin as a column or two, so that a lower part must be
thicker than that to be one.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from footfall.models.values.vector import Vector

MIN_COLUMNS = 12
"""Fewer columns of one height are no part."""
MIN_CORE = 4
"""Least columns of a part whose eight neighbours are of it as well, unless none about
it is taller: a chair's back is thin."""
MAX_TALLER = 2
"""Most taller columns about a thin part; more make a side, or a slope, of it."""
RISING = 0.5
"""A part that rises by more of the window from end to end is no top: of noise alone it
would by a tenth."""
AROUND = np.ones((3, 3), dtype=bool)


def split_by_tops(
    points: Vector, cell: float, window: float, min_points: int
) -> list[NDArray[np.int64]]:
    """Splits a cluster where the heights of its columns jump.

    Args:
        points: of the cluster, (n, 3), m.
        cell: side of a column, m.
        window: heights that differ by less are the same, m.
        min_points: least points of a part.

    Returns:
        Indices of the points of each part, the highest first; all of them where it is
        one.
    """
    whole = [np.arange(len(points))]
    index = np.floor(points[:, :2] / cell).astype(np.int64)
    index -= index.min(axis=0) - 1
    shape = tuple(index.max(axis=0) + 2)
    flat = np.ravel_multi_index((index[:, 0], index[:, 1]), shape)
    height = _column_heights(points[:, 2], flat, int(np.prod(shape)), window)
    height = _smooth(height.reshape(shape))
    parts = _parts(height, window)
    if len(parts) < 2:
        return whole
    owner = np.full(shape, -1)
    for number, part in enumerate(parts):
        owner[part] = number
    for number, part in enumerate(parts):
        # Noise carries points of a top over its edge.
        rim = ndimage.binary_dilation(part, AROUND) & (owner < 0)
        owner[rim] = number
    of_point = owner.ravel()[flat]
    found = [np.flatnonzero(of_point == number) for number in range(len(parts))]
    found = [part for part in found if len(part) >= min_points]
    return found if len(found) > 1 else whole


def _column_heights(
    z: Vector, column: NDArray[np.int64], count: int, window: float
) -> Vector:
    """Computes the mean of each column's topmost points, (count,), m; NaN of none."""
    top = np.full(count, -np.inf)
    np.maximum.at(top, column, z)
    upper = z > top[column] - window
    number = np.bincount(column[upper], minlength=count)
    total = np.bincount(column[upper], z[upper], minlength=count)
    return np.where(number > 0, total / np.maximum(number, 1), np.nan)


def _smooth(height: Vector) -> Vector:
    """Takes the median of each column and its neighbours; NaN stays NaN."""
    padded = np.pad(height, 1, constant_values=np.nan)
    rows, columns = height.shape
    around = np.stack(
        [padded[i : i + rows, k : k + columns] for i in range(3) for k in range(3)]
    )
    smooth = np.full(height.shape, np.nan)
    used = np.isfinite(height)
    smooth[used] = np.nanmedian(around[:, used], axis=0)
    return smooth


def _parts(height: Vector, window: float) -> list[NDArray[np.bool]]:
    """Finds the parts of a map of heights, the highest first, as masks."""
    left = np.isfinite(height)
    candidates = []
    while np.count_nonzero(left) >= MIN_COLUMNS:
        z = np.sort(height[left])
        first = np.searchsorted(z, z - window, side="left")
        last = np.searchsorted(z, z + window, side="right")
        best = int(np.argmax(last - first))
        if last[best] - first[best] < MIN_COLUMNS:
            break
        level = float(z[first[best] : last[best]].mean())
        members = left & (np.abs(height - level) <= window)
        left &= ~members
        label, count = ndimage.label(members, AROUND)
        sizes = np.bincount(label.ravel(), minlength=count + 1)
        for number in np.flatnonzero(sizes[1:] >= MIN_COLUMNS) + 1:
            candidates.append((level, label == number))
    candidates.sort(key=lambda item: -item[0])
    parts: list[NDArray[np.bool]] = []
    for level, part in candidates:
        core = ndimage.binary_erosion(part, AROUND)
        if np.count_nonzero(core) < MIN_CORE:
            around = ndimage.binary_dilation(part, AROUND, iterations=2) & ~part
            taller = np.isfinite(height) & (height > level + window)
            if np.count_nonzero(around & taller) > MAX_TALLER:
                continue
        if not _slopes(height, part, window):
            parts.append(part)
    return parts


def _slopes(height: Vector, part: NDArray[np.bool], window: float) -> bool:
    """Tells whether a part rises from end to end: where the picture cuts a wall off."""
    cells = np.argwhere(part)
    z = height[part]
    design = np.column_stack([cells, np.ones(len(cells))])
    plane = design @ np.linalg.lstsq(design, z, rcond=None)[0]
    return bool(np.ptp(plane) > RISING * window)
