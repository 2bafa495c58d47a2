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
from footfall.systems.perception.planes.merged_surfaces import merge_surfaces
from footfall.systems.perception.planes.surfaces import (
    Surfaces,
    cut_columns,
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
