"""A sweep that is cut into pieces of surface line by line, as a scanner takes it.

A piece of surface is what hangs together along a column, so the pieces of two clouds
together are those of each, joined where they come near: what is done when a line comes
need not be done after the last one.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.surfaces import (
    GAP,
    Z_STEP,
    Surfaces,
    cut_columns,
    narrow,
    spread,
    steps,
)
from footfall.systems.perception.planes.voxels import usable_points

BLOCK = 16
"""Lines that are gathered before they are joined to those before: to join costs as much
as cutting ten lines."""


@dataclass(frozen=True, eq=False)
class CutCloud(Value):
    """A cloud in a frame whose z points up, and its pieces of surface."""

    points: Vector
    """Those that are finite and lower than where they were seen from, (n, 3), m."""
    surfaces: Surfaces
    """Their pieces, in columns along z."""
    seen: int = 0
    """How many there were with those that are left out."""


@dataclass(frozen=True, eq=False)
class CutSweep(Value):
    """The lines of a sweep up to now."""

    whole: CutCloud
    """Lines that are joined."""
    lines: tuple[CutCloud, ...] = ()
    """Those since, fewer than `BLOCK`."""


def empty_cut(cell: float) -> CutCloud:
    """Makes a cut cloud without points, of columns with sides of `cell`, m."""
    points = np.zeros((0, 3))
    return CutCloud(points, cut_columns(points, cell))


def cut_cloud(points: Vector, eye_height: float, cell: float) -> CutCloud:
    """Cuts a cloud or a line of it.

    Args:
        points: in a frame whose z points up, (n, 3), m; not all need be finite.
        eye_height: z of where they were seen from, m: of what is higher one sees no
            upper side.
        cell: side of a column, m.
    """
    seen = len(points)
    points = usable_points(points)
    points = np.compress(points[:, 2] < eye_height, points, axis=0)
    return CutCloud(points, cut_columns(points, cell), seen)


def join_cuts(parts: Sequence[CutCloud]) -> CutCloud:
    """Joins cut clouds, at least one, to the one of all their points."""
    seen = sum(part.seen for part in parts)
    parts = [part for part in parts if len(part.points)] or list(parts[:1])
    if len(parts) == 1:
        return replace(parts[0], seen=seen)
    return CutCloud(
        np.concatenate([part.points for part in parts]),
        merge_surfaces([part.surfaces for part in parts]),
        seen,
    )


def add_line(sweep: CutSweep, line: CutCloud) -> CutSweep:
    """Adds a line to a sweep."""
    lines = (*sweep.lines, line)
    if len(lines) < BLOCK:
        return CutSweep(sweep.whole, lines)
    return CutSweep(join_cuts([sweep.whole, join_cuts(lines)]))


def finish_sweep(sweep: CutSweep) -> CutCloud:
    """Computes the cloud of all lines of a sweep."""
    return join_cuts([sweep.whole, *sweep.lines])


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
