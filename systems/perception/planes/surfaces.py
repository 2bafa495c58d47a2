"""Level planes by the surfaces of columns: a multi-level surface map.

The cloud is cut into columns along gravity; what hangs together along a column is one
piece of surface (Triebel, Pfaff and Burgard 2006). A level surface makes short pieces,
a wall long ones, so that Filter 1 of the stair paper needs no normals and its voxels
no neighbours in space: short pieces of neighbouring columns at one height are one
cluster. It finds what the paper's supervoxels find in a twentieth of the time.
All of it in a frame G whose z points up.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from footfall.models.values.vector import Vector

GAP = 0.025
"""Points of a column farther apart along z are of different pieces, m: five times the
noise, and less than the least rise."""
SHORT = 0.04
"""Longest piece of a level surface, m: eight times the noise, and the least rise."""
Z_STEP = 2.5e-4
"""Heights are sorted to this, m."""
HALF = ((0, 1), (1, -1), (1, 0), (1, 1))
"""Neighbouring columns, each pair once."""
TABLE = 32
"""Places in a table of columns for each that is in it, at most: rooms are filled by a
third, a cloud of few points far apart needs a search."""
ALONE = 3
"""A piece with fewer level neighbours of eight bridges nothing."""
MIN_NOISE_POINTS = 3
"""Fewer points in a piece say nothing of the noise."""


@dataclass(frozen=True, eq=False)
class Surfaces:
    """The pieces of surface of a cloud, by column and by height within it."""

    order: NDArray[np.int64]
    """Indices of the cloud's points, piece by piece, (n,)."""
    first: NDArray[np.int64]
    """Where in `order` each of m pieces begins, and n, (m + 1,)."""
    column: NDArray[np.int64]
    """Key of each piece's column, (m,), ascending."""
    corner: tuple[int, int]
    """The column with key 0, by its x and y in sides of a column."""
    width: int
    """By how much the keys of columns differ that are neighbours along x."""
    cell: float
    """Side of a column, m."""
    mean: Vector
    """Mean of each piece's points, (m, 3), m."""
    low: Vector
    """Least height of each, (m,), m."""
    high: Vector
    """Greatest height of each, (m,), m."""

    @property
    def count(self) -> NDArray[np.int64]:
        """How many points each piece has, (m,)."""
        return np.diff(self.first)

    def points_of(self, pieces: NDArray[np.int64]) -> NDArray[np.int64]:
        """Returns the indices of the points of some pieces, (k,)."""
        begin, count = self.first[pieces], self.first[pieces + 1] - self.first[pieces]
        return self.order[spread(begin, count)]


def cut_columns(points: Vector, cell: float) -> Surfaces:
    """Cuts a cloud into columns and these into pieces of surface.

    Args:
        points: finite, (n, 3), m.
        cell: side of a column, m.
    """
    n = len(points)
    if n == 0:
        none = np.zeros(0, dtype=np.int64)
        empty = np.zeros(0)
        return Surfaces(
            order=none,
            first=np.zeros(1, np.int64),
            column=none,
            corner=(0, 0),
            width=1,
            cell=cell,
            mean=np.zeros((0, 3)),
            low=empty,
            high=empty,
        )
    x = np.floor(points[:, 0] * (1.0 / cell)).astype(np.int64)
    y = np.floor(points[:, 1] * (1.0 / cell)).astype(np.int64)
    # An empty column at either side keeps neighbours of the rim from wrapping around.
    corner = int(x.min()) - 1, int(y.min()) - 1
    x -= corner[0]
    y -= corner[1]
    width = int(y.max()) + 2
    z = points[:, 2]
    height = steps(z)
    order = np.lexsort((narrow(height - height.min()), narrow(y), narrow(x)))
    column, height = (x * width + y)[order], height[order]
    new = np.ones(n, dtype=bool)
    np.not_equal(column[1:], column[:-1], out=new[1:])
    new[1:] |= height[1:] - height[:-1] > round(GAP / Z_STEP)
    first = np.flatnonzero(new)
    ends = np.append(first, n)
    count = np.diff(ends)
    columns = np.ascontiguousarray(points.T)
    sums = [np.add.reduceat(values[order], first) for values in columns]
    return Surfaces(
        order=order,
        first=ends,
        column=column[first],
        corner=corner,
        width=width,
        cell=cell,
        mean=np.column_stack(sums) / count[:, None],
        low=z[order[first]],
        high=z[order[ends[1:] - 1]],
    )


def spread(begin: NDArray[np.int64], count: NDArray[np.int64]) -> NDArray[np.int64]:
    """Lists `count` numbers from each of some beginnings on, one list after another."""
    shift = np.repeat(begin - np.cumsum(count) + count, count)
    shift += np.arange(len(shift))
    return shift


def steps(z: Vector) -> NDArray[np.int64]:
    """Counts heights, (n,), m, in steps of `Z_STEP`."""
    return np.floor(z * (1.0 / Z_STEP)).astype(np.int64)


def narrow(values: NDArray[np.int64]) -> NDArray[np.integer]:
    """Stores numbers from 0 on in 16 bits if they fit: those are sorted by radix."""
    return values.astype(np.uint16) if values.max() < 1 << 16 else values


def level_noise(surfaces: Surfaces, points: Vector) -> float:
    """Estimates the standard deviation of level surfaces along z, m; 0 of too few.

    Args:
        surfaces: pieces of a cloud.
        points: the cloud, (n, 3), m.
    """
    count = surfaces.count
    chosen = (count >= MIN_NOISE_POINTS) & (surfaces.high - surfaces.low < 2.0 * SHORT)
    pieces = np.flatnonzero(chosen)
    if len(pieces) < MIN_NOISE_POINTS:
        return 0.0
    z = points[surfaces.points_of(pieces), 2]
    off = z - np.repeat(surfaces.mean[pieces, 2], count[pieces])
    first = np.cumsum(count[pieces]) - count[pieces]
    variance = np.add.reduceat(off * off, first) / (count[pieces] - 1)
    return float(np.sqrt(np.median(variance)))


def neighbours(
    surfaces: Surfaces, level: NDArray[np.int64], offset: float
) -> NDArray[np.int64]:
    """Finds pairs of level pieces of neighbouring columns at about one height.

    Args:
        surfaces: the pieces.
        level: indices of the level ones, (m,), ascending.
        offset: most that the means of two differ in height, m.

    Returns:
        Places in `level`, (p, 2), each pair once.
    """
    z, column = surfaces.mean[level, 2], surfaces.column[level]
    beside = np.array([dx * surfaces.width + dy for dx, dy in HALF])[:, None]
    starts = find_columns(column, column + beside)
    column = np.append(column, -1)
    goes_on = column[1:] == column[:-1]
    first, second = [], []
    for at, shift in zip(starts, beside, strict=True):
        here = np.flatnonzero(column[at] == column[:-1] + shift)
        at = at[here]
        while len(here):
            above = z[at] - z[here]
            near = np.abs(above) <= offset
            first.append(here[near])
            second.append(at[near])
            # The pieces of a column are from low to high: the next may be near too.
            more = np.flatnonzero((above <= offset) & goes_on[at])
            at, here = at[more] + 1, here[more]
    pairs = np.zeros((2, sum(map(len, first))), dtype=np.int64)
    if first:
        np.concatenate(first, out=pairs[0])
        np.concatenate(second, out=pairs[1])
    return pairs.T


def find_columns(
    columns: NDArray[np.int64], sought: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Finds where columns begin in a list of them: `np.searchsorted`, by a table.

    Args:
        columns: keys, (m,), ascending and maybe repeated.
        sought: keys, of any shape.

    Returns:
        Place of the first of the m keys that is no less than each sought one.
    """
    if not len(columns) or columns[-1] - columns[0] > TABLE * (len(columns) + 1000):
        return np.searchsorted(columns, sought)
    least, most = int(columns[0]), int(columns[-1])
    counts = np.bincount(columns - least, minlength=most - least + 2)
    table = np.cumsum(counts) - counts
    return np.asarray(table[np.clip(sought, least, most + 1) - least])


def cluster_surfaces(
    surfaces: Surfaces, eye: Vector | None, *, offset: float, min_area: float
) -> NDArray[np.int64]:
    """Clusters level pieces that hang together, those smaller than a foot left out.

    Args:
        surfaces: the pieces.
        eye: where they were seen from, (3,), m: what is above it shows its underside.
        offset: most that neighbours differ in height, m.
        min_area: least area of a cluster, m^2 (Filter 3).

    Returns:
        Cluster of each piece, (m,); -1 for none.
    """
    short = surfaces.high - surfaces.low <= SHORT
    if eye is not None:
        short &= surfaces.high < eye[2]
    level = np.flatnonzero(short)
    if not len(level):
        return np.full(len(surfaces.column), -1, dtype=np.int64)
    pairs = neighbours(surfaces, level, offset)
    return connect_pieces(surfaces, level, pairs, min_area)


def connect_pieces(
    surfaces: Surfaces,
    level: NDArray[np.int64],
    pairs: NDArray[np.int64],
    min_area: float,
) -> NDArray[np.int64]:
    """Numbers what hangs together and is no smaller than a foot.

    Args:
        surfaces: the pieces.
        level: indices of those that may belong to a cluster, (k,), ascending.
        pairs: places in `level` that are linked, (p, 2).
        min_area: least area of a cluster, m^2.

    Returns:
        Cluster of each piece, (m,); -1 for none.
    """
    result = np.full(len(surfaces.column), -1, dtype=np.int64)
    a, b = pairs[:, 0], pairs[:, 1]
    degree = np.bincount(a, minlength=len(level)) + np.bincount(b, minlength=len(level))
    linked = degree >= ALONE
    kept = linked[a] & linked[b]
    label = _connected(a[kept], b[kept], len(level))
    large = np.bincount(label[linked], minlength=len(level)) * surfaces.cell**2
    kept = linked & (large[label] >= min_area)
    number = np.cumsum(np.bincount(label[kept], minlength=len(level)) > 0) - 1
    result[level[kept]] = number[label[kept]]
    return result


def _connected(
    a: NDArray[np.int64], b: NDArray[np.int64], count: int
) -> NDArray[np.int64]:
    """Numbers what hangs together by pairs (a, b) of `count` things, (count,).

    Things that follow each other and are linked are one before the others are looked
    at: of the links among rows of columns few are left.
    """
    follows = np.zeros(count, dtype=bool)
    follows[b[b == a + 1]] = True
    run = np.cumsum(~follows) - 1
    a, b = run[a], run[b]
    new = a != b
    new[1:] &= (a[1:] != a[:-1]) | (b[1:] != b[:-1])
    a, b = a[new], b[new]
    graph = coo_array(
        (np.ones(len(a), dtype=np.int8), (a, b)), shape=(run[-1] + 1, run[-1] + 1)
    )
    return np.asarray(connected_components(graph, directed=False)[1][run])
