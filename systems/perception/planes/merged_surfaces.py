"""Pieces of surface of several clouds merged to those of one."""

from collections.abc import Sequence

import numpy as np

from footfall.systems.perception.planes.surfaces import (
    GAP,
    Z_STEP,
    Surfaces,
    narrow,
    spread,
    steps,
)


def merge_surfaces(parts: Sequence[Surfaces]) -> Surfaces:
    """Merges the pieces of several clouds to those of one.

    They are those that `cut_columns` would find in all points together: along a column
    each is an interval without gaps, and intervals that come near are one piece. Only
    the order of the points within a piece is another.

    Args:
        parts: pieces of clouds with points, at least one, with columns of one size.

    Returns:
        The pieces, of points numbered through the clouds.
    """
    index = [np.divmod(part.column, part.width) for part in parts]
    x = np.concatenate(
        [i + p.corner[0] for (i, _), p in zip(index, parts, strict=True)]
    )
    y = np.concatenate(
        [i + p.corner[1] for (_, i), p in zip(index, parts, strict=True)]
    )
    corner = int(x.min()) - 1, int(y.min()) - 1
    x -= corner[0]
    y -= corner[1]
    width = int(y.max()) + 2
    mean = np.concatenate([part.mean for part in parts])
    low = np.concatenate([part.low for part in parts])
    high = np.concatenate([part.high for part in parts])
    count = np.concatenate([part.count for part in parts])
    points = np.cumsum([0] + [len(part.order) for part in parts])
    source = np.concatenate(
        [part.order + n for part, n in zip(parts, points[:-1], strict=True)]
    )
    start = np.cumsum(count) - count
    bottom, top = steps(low), steps(high)
    least = int(bottom.min())
    bottom -= least
    top -= least
    by_column = np.lexsort((narrow(bottom), narrow(y), narrow(x)))
    column = (x * width + y)[by_column]
    new = np.ones(len(column), dtype=bool)
    np.not_equal(column[1:], column[:-1], out=new[1:])
    # How far up the pieces of this column reach so far; columns are set apart by more
    # than any height.
    apart = (np.cumsum(new) - 1) * (int(top.max()) + 1)
    reach = np.maximum.accumulate(top[by_column] + apart)
    new[1:] |= (bottom[by_column] + apart)[1:] - reach[:-1] > round(GAP / Z_STEP)
    first = np.flatnonzero(new)
    weight = count[by_column]
    total = np.add.reduceat(weight, first)
    sums = [np.add.reduceat(mean[by_column, axis] * weight, first) for axis in range(3)]
    # Of highest points at one step the last one counts, as where all are sorted.
    number = len(column)
    highest = np.maximum.reduceat(top[by_column] * number + by_column, first) % number
    return Surfaces(
        order=source[spread(start[by_column], weight)],
        first=np.append(0, np.cumsum(total)),
        column=column[first],
        corner=corner,
        width=width,
        cell=parts[0].cell,
        mean=np.column_stack(sums) / total[:, None],
        low=low[by_column[first]],
        high=high[highest],
    )
