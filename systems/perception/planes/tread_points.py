"""Points of a cloud that tell where a tread is: its own, its faces', rays that pass.

All of it in a frame G whose z points up, whatever way the stairs go.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.levels import Sampling
from footfall.systems.perception.planes.planes import Patch

SLAB = 0.015
"""Points this near to a tread's plane belong to it, m: three times the range noise of
5 mm; where there is more noise, up to twice as much."""
CELL = 0.04
"""Cell in which points of one tread hang together, m: far lines are this far apart."""
PASSING = 0.2
"""How far beyond a tread's outline, on its plane, one looks for rays that pass, m."""
FACE = 0.07
"""How far from a tread's plane its faces are looked at, m: short of the least rise of
a staircase, 10 cm, and of the noise of the tread there."""
CROSSING = 0.3
"""Share of a cell's points above and below a plane, of those on it, from which a face
runs through the plane there: a wall, a handrail, the side of the next step."""
LONELY = 0.2
"""Share of the usual number of points about a cell below which they are outliers."""
NEAR = 0.4
"""How far about its treads a flight is looked at, m."""
UNDER = 0.8
"""How much farther below them, m: to the floor under a table."""
LOWER = 0.03
"""What is lower than a tread by more than this is something else, m."""


@dataclass(frozen=True, eq=False)
class TreadPoints:
    """What tells where a tread is, in G."""

    patch: Patch
    """The tread as its plane was found."""
    slab: Vector
    """Points on its plane without those of faces and outliers, (n, 3), m."""
    noise: float
    """Their standard deviation off the plane, m."""
    thickness: float
    """Most that they lie off the plane, m."""
    reach: float
    """How far from the plane faces are looked at, m."""
    below: Vector
    """Points under the slab within reach: of the face below, (k, 3), m."""
    above: Vector
    """Points over it within reach: of the next face, (k, 3), m."""
    lower: Vector
    """Points lower than the plane by more than `LOWER`, (k, 3), m."""
    others: Vector
    """All points about it that are not on its plane, (k, 3), m."""
    passing: Vector
    """Points whose rays pass by it, lower than it, (k, 3), m."""


def within(points: Vector, low: Vector, high: Vector) -> Vector:
    """Selects the points strictly between two corners, of the first columns of each.

    Args:
        points: (n, 3), m.
        low: least corner, (2,) or (3,), m.
        high: greatest corner, likewise.
    """
    inside = np.ones(len(points), dtype=bool)
    for axis, (least, most) in enumerate(zip(low, high, strict=True)):
        inside &= (points[:, axis] > least) & (points[:, axis] < most)
    return np.compress(inside, points, axis=0)


def span(points: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Computes the least and greatest of each column of (n, k) numbers, (k,) each.

    One column after another: a tenth of what `min(axis=0)` needs for a few columns.
    """
    columns = [points[:, k] for k in range(points.shape[1])]
    return np.array([c.min() for c in columns]), np.array([c.max() for c in columns])


def points_near(patches: list[Patch], cloud: Vector) -> Vector:
    """Selects the points of a cloud, (n, 3), that are about a flight."""
    outline = np.concatenate([patch.outline for patch in patches])
    low, high = outline.min(axis=0) - NEAR, outline.max(axis=0) + NEAR
    low[2] -= UNDER
    return within(cloud, low, high)


def tread_points(
    patches: list[Patch],
    near: Vector,
    cloud: Vector,
    viewpoint: Vector | None,
    landings: list[bool],
    sampling: Sampling,
) -> list[TreadPoints]:
    """Selects what tells where each tread of a flight is.

    Args:
        patches: the treads.
        near: the points about the flight, (n, 3), m.
        cloud: the whole cloud, (n, 3), m.
        viewpoint: where it was seen from, (3,), m.
        landings: which of the treads are landings.
        sampling: of the cloud.
    """
    passing = _passing(patches, cloud, viewpoint)
    return [
        _about_tread(patch, near, others, _reach(patches, i), landings[i], sampling)
        for i, (patch, others) in enumerate(zip(patches, passing, strict=True))
    ]


def _about_tread(
    patch: Patch,
    near: Vector,
    passing: Vector,
    reach: float,
    landing: bool,
    sampling: Sampling,
) -> TreadPoints:
    point, normal = patch.plane.point, patch.plane.normal
    outline = patch.outline[:, :2]
    near = within(near, outline.min(axis=0) - NEAR, outline.max(axis=0) + NEAR)
    off = (near - point) @ normal
    noise = 1.4826 * float(np.median(np.abs((patch.points - point) @ normal)))
    thickness = min(max(3.0 * noise, SLAB), 2.0 * SLAB)
    reach = max(reach, thickness + 0.01)
    about = np.abs(off) < reach
    return TreadPoints(
        patch=patch,
        slab=_slab(near[about], off[about], thickness, landing, sampling),
        noise=noise,
        thickness=thickness,
        reach=reach,
        below=near[about & (off < -thickness)],
        above=near[about & (off > thickness)],
        lower=np.compress(off < -LOWER, near, axis=0),
        others=np.compress(np.abs(off) > thickness, near, axis=0),
        passing=passing,
    )


def _passing(
    patches: list[Patch], cloud: Vector, viewpoint: Vector | None
) -> list[Vector]:
    """Selects the points of the cloud whose rays pass by each tread, lower than it."""
    if viewpoint is None:
        return [np.zeros((0, 3))] * len(patches)
    drop = viewpoint[2] - cloud[:, 2]
    # Where a ray goes is told by its slopes; those that do not go down pass nothing.
    with np.errstate(divide="ignore", invalid="ignore"):
        x = (cloud[:, 0] - viewpoint[0]) / drop
        y = (cloud[:, 1] - viewpoint[1]) / drop
    chosen = []
    for patch in patches:
        height = viewpoint[2] - patch.outline[:, 2]
        if height.min() <= PASSING:
            chosen.append(np.zeros((0, 3)))
            continue
        rim = (patch.outline[:, :2] - viewpoint[:2]) / height[:, None]
        margin = PASSING / height.min()
        low, high = rim.min(axis=0) - margin, rim.max(axis=0) + margin
        near = (drop > height.min()) & (x > low[0]) & (x < high[0])
        near &= (y > low[1]) & (y < high[1])
        points = np.compress(near, cloud, axis=0)
        off = (points - patch.plane.point) @ patch.plane.normal
        chosen.append(points[off < -SLAB])
    return chosen


def _reach(patches: list[Patch], number: int) -> float:
    """Computes how far from a tread's plane its faces can be told from its neighbours.

    Of low steps the next tread is nearer than `FACE`.
    """
    height = float(patches[number].center[2])
    rises = [abs(float(patch.center[2]) - height) for patch in patches]
    least = min((rise for rise in rises if rise > SLAB), default=np.inf)
    return min(FACE, max(least - SLAB, 2.0 * SLAB))


def _slab(
    near: Vector, off: Vector, thickness: float, landing: bool, sampling: Sampling
) -> Vector:
    """Selects the points on a plane where no face runs through it.

    Args:
        near: points near the plane, (n, 3), m.
        off: how far they are over it, (n,), m.
        thickness: most that points on it are off it, m.
        landing: whether it is a landing's.
        sampling: of the cloud.
    """
    if not len(near):
        return near
    size = max(CELL, 1.5 * sampling.spacing)
    cells = np.floor(near[:, :2] / size).astype(np.int64)
    # From the tread, not from the world's origin: the grid is no larger than it.
    origin, most = span(cells)
    shape = most - origin + 1
    key = (cells[:, 0] - origin[0]) * shape[1] + cells[:, 1] - origin[1]

    def count(chosen: NDArray[np.bool]) -> Vector:
        return np.bincount(key[chosen], minlength=int(np.prod(shape))).astype(float)

    on = np.abs(off) <= thickness
    number = count(on)
    faces = np.minimum(count(off > thickness), count(off < -thickness))
    number[faces >= np.maximum(CROSSING * number, 3.0)] = 0.0
    about_cell = 9.0 * ndimage.uniform_filter(
        number.reshape(shape), size=3, mode="constant"
    )
    usual = float(np.median(about_cell.ravel()[key[on]])) if on.any() else 0.0
    # Far points of a landing are much farther apart than near ones.
    least = (LONELY / 10.0 if landing else LONELY) * usual
    kept = on & (number[key] > 0.0) & (about_cell.ravel()[key] >= least)
    return np.asarray(near[kept])
