"""Rectangles of treads from the points of the cloud rather than from its voxels.

A tread's outline in voxels is quantised and eroded by the filters. Here its edges are
sought in the cloud: the front edge where the face below it stands, the back edge where
the next face stands, the ends and an edge without face where the points end.
All of it in a frame G whose z points up.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.levels import Sampling
from footfall.systems.perception.planes.planes import Patch, fit_plane

SLAB = 0.015
"""Points this near to a tread's plane belong to it, m: three times the range noise of
5 mm; where there is more noise, up to twice as much."""
BIN = 0.03
"""Width of the strips in which the end of a tread is looked for, m."""
CELL = 0.04
"""Cell in which points of one tread hang together, m: far lines are this far apart."""
PASSING = 0.2
"""How far beyond a tread's outline, on its plane, one looks for rays that pass, m."""
MAX_SPACING = 0.06
"""Farthest from a tread's end to the next ray beyond that tells where it ends, m."""
EDGE_SEEN = 0.2
"""Part of an end's strips that are enough to tell where it is."""
OVERHANG = 0.012
"""A tread that ends this far before the face below it overhangs it, m; less may be the
noise of its own end."""
FACE = 0.07
"""How far from a tread's plane its faces are looked at, m: short of the least rise of
a staircase, 10 cm, and of the noise of the tread there."""
SHADOW = 0.25
"""Widest shadow across a tread, m: of a leg."""
MIN_FACE_POINTS = 25
"""Fewer points do not make a face."""
CROSSING = 0.3
"""Share of a cell's points above and below a plane, of those on it, from which a face
runs through the plane there: a wall, a handrail, the side of the next step."""
LONELY = 0.2
"""Share of the usual number of points about a cell below which they are outliers."""
NEAR = 0.4
"""How far about its treads a flight is looked at, m."""
UNDER = 0.8
"""How much farther below them, m: to the floor under a table."""
BEHIND = 2.0
"""How far behind a last tread one looks for what its shadow leaves in view, m."""
BEFORE = (0.04, 0.25)
"""How far before a front edge one looks for what the tread rises from, m."""


@dataclass(frozen=True, eq=False)
class Tread:
    """A tread's rectangle in the staircase's frame S (x up the stairs, z up)."""

    low: Vector
    """Front right corner (x, y), (2,), m."""
    high: Vector
    """Back left corner (x, y), (2,), m."""
    point: Vector
    """A point of its plane in S, (3,), m."""
    normal: Vector
    """Unit normal in S, up, (3,)."""
    points: Vector
    """Supporting points in S, (n, 3), m."""
    drops: bool
    """Whether something lower was seen before its front edge."""
    ends: bool
    """Whether a face was seen at its back edge or, of the last tread, what lies behind
    it."""
    right: bool
    """Whether something else was seen beyond its right end."""
    left: bool
    """Whether something else was seen beyond its left end."""
    drop: float
    """Height over what was seen before its front edge, m; NaN where nothing was."""
    reach: float
    """How far from its plane its faces are looked at, m."""


@dataclass(frozen=True, eq=False)
class _Slab:
    """The points near a tread's plane, without those of faces and outliers."""

    points: Vector
    """In G, (n, 3), m."""
    noise: float
    """Their standard deviation off the plane, m."""
    thickness: float
    """Most that they lie off the plane, m."""
    reach: float
    """How far from the plane faces are looked at, m."""


def stair_rotation(yaw: float) -> Vector:
    """Computes R_GS of a staircase whose x is turned by `yaw` about G's z, (3, 3)."""
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def initial_yaw(
    patches: list[Patch],
    points: Vector,
    viewpoint: Vector | None,
    landings: Sequence[bool] = (),
) -> float:
    """Estimates the direction up the stairs from the patches' axes, rad.

    Args:
        patches: the treads, lowest first.
        points: the cloud near them, (n, 3), m.
        viewpoint: where it was seen from, (3,), m.
        landings: which of the treads are landings, whose short side may be across; not
            the first one. Empty for none.
    """
    axis = np.zeros(2)
    reference = patches[0].axes[:2, 0]
    for patch in _without(patches, landings):
        sign = 1.0 if patch.axes[:2, 0] @ reference >= 0.0 else -1.0
        axis += sign * len(patch.points) * patch.axes[:2, 0]
    if len(patches) > 1:
        up = (patches[-1].center - patches[0].center)[:2]
    elif viewpoint is not None:
        up = (patches[0].center - viewpoint)[:2]
    else:
        up = _away_from_face(patches[0], points)
    axis *= 1.0 if axis @ up >= 0.0 else -1.0
    return float(np.arctan2(axis[1], axis[0]))


def _without(patches: list[Patch], landings: Sequence[bool]) -> list[Patch]:
    """Leaves the landings out."""
    wide = landings or [False] * len(patches)
    return [patch for patch, landing in zip(patches, wide, strict=True) if not landing]


def _away_from_face(patch: Patch, points: Vector) -> Vector:
    """Up the stairs for a lone tread: its back is hidden, its front face is not."""
    local = (points - patch.center) @ patch.axes
    half = patch.extent[:2] / 2.0
    below = (np.abs(local[:, 1]) < half[1]) & (local[:, 2] < -SLAB)
    below &= np.abs(np.abs(local[:, 0]) - half[0]) < BIN
    front = np.count_nonzero(below & (local[:, 0] < 0.0))
    back = np.count_nonzero(below & (local[:, 0] > 0.0))
    sign = 1.0 if front >= back else -1.0
    return np.asarray(sign * patch.axes[:2, 0])


def refine_treads(
    patches: list[Patch],
    cloud: Vector,
    viewpoint: Vector | None,
    landings: Sequence[bool] = (),
    sampling: Sampling | None = None,
) -> tuple[float, list[Tread]]:
    """Fits the rectangles of a flight of treads.

    Args:
        patches: the treads, lowest first, at least one.
        cloud: the cloud, (n, 3), m.
        viewpoint: where it was seen from, (3,), m.
        landings: as of `initial_yaw`.
        sampling: of the cloud; None where nothing is known of it.

    Returns:
        Yaw of S in G, rad, and the treads in S (which has G's origin).
    """
    sampling = sampling or Sampling()
    near = _near(patches, cloud)
    yaw = initial_yaw(patches, near, viewpoint, landings)
    wide = landings or [False] * len(patches)
    slabs = [
        _slab(patch, near, _face_reach(patches, i), landing, sampling)
        for i, (patch, landing) in enumerate(zip(patches, wide, strict=True))
    ]
    passing = _passing(patches, cloud, viewpoint)

    def bound(yaw: float) -> tuple[list[Tread], Vector]:
        rotation = stair_rotation(yaw)
        local = near @ rotation
        eye = None if viewpoint is None else viewpoint @ rotation
        treads = [
            _bound(patch, slab, local, others @ rotation, rotation, sampling, eye)
            for patch, slab, others in zip(patches, slabs, passing, strict=True)
        ]
        return treads, local

    for _ in range(3):
        yaw = float(yaw - np.arctan(_common_slope(*bound(yaw))))
    return yaw, bound(yaw)[0]


def _passing(
    patches: list[Patch], cloud: Vector, viewpoint: Vector | None
) -> list[Vector]:
    """Selects the points of the cloud whose rays pass by each tread, lower than it.

    Args:
        patches: the treads.
        cloud: the cloud, (n, 3), m.
        viewpoint: where it was seen from, (3,), m.
    """
    if viewpoint is None:
        return [np.zeros((0, 3))] * len(patches)
    cloud = cloud[cloud[:, 2] < viewpoint[2] - PASSING]
    slant = (cloud[:, :2] - viewpoint[:2]) / (viewpoint[2] - cloud[:, 2])[:, None]
    chosen = []
    for patch in patches:
        height = viewpoint[2] - patch.outline[:, 2]
        if height.min() <= PASSING:
            chosen.append(np.zeros((0, 3)))
            continue
        rim = (patch.outline[:, :2] - viewpoint[:2]) / height[:, None]
        margin = PASSING / height.min()
        low, high = rim.min(axis=0) - margin, rim.max(axis=0) + margin
        near = np.all((slant > low) & (slant < high), axis=1)
        off = (cloud[near] - patch.plane.point) @ patch.plane.normal
        chosen.append(cloud[near][off < -SLAB])
    return chosen


def is_something_behind(tread: Tread, cloud: Vector) -> bool:
    """Tests whether anything lower was seen behind a tread, (n, 3) points in S.

    Without a viewpoint it hints that the tread's end is not that of the view; through
    open risers one sees what lies behind as well.
    """
    behind = (cloud[:, 0] > tread.high[0] + 0.01) & (
        cloud[:, 0] < tread.high[0] + BEHIND
    )
    behind &= (cloud[:, 1] > tread.low[1]) & (cloud[:, 1] < tread.high[1])
    behind &= (cloud - tread.point) @ tread.normal < -SLAB
    return int(np.count_nonzero(behind)) >= MIN_FACE_POINTS


def _near(patches: list[Patch], cloud: Vector) -> Vector:
    outline = np.concatenate([patch.outline for patch in patches])
    low, high = outline.min(axis=0) - NEAR, outline.max(axis=0) + NEAR
    low[2] -= UNDER
    return cloud[np.all((cloud > low) & (cloud < high), axis=1)]


def _face_reach(patches: list[Patch], number: int) -> float:
    """Computes how far from a tread's plane its faces can be told from its neighbours.

    Of low steps the next tread is nearer than `FACE`.
    """
    height = float(patches[number].center[2])
    rises = [abs(float(patch.center[2]) - height) for patch in patches]
    least = min((rise for rise in rises if rise > SLAB), default=np.inf)
    return min(FACE, max(least - SLAB, 2.0 * SLAB))


def _slab(
    patch: Patch, near: Vector, reach: float, landing: bool, sampling: Sampling
) -> _Slab:
    """Selects the points of a tread from the cloud near it, (n, 3), in G."""
    point, normal = patch.plane.point, patch.plane.normal
    off = (near - point) @ normal
    noise = 1.4826 * float(np.median(np.abs((patch.points - point) @ normal)))
    thickness = min(max(3.0 * noise, SLAB), 2.0 * SLAB)
    reach = max(reach, thickness + 0.01)
    about = np.abs(off) < reach
    off, near = off[about], near[about]
    if not len(near):
        return _Slab(near, noise, thickness, reach)
    size = max(CELL, 1.5 * sampling.spacing)
    cells = np.floor(near[:, :2] / size).astype(np.int64)
    # From the tread, not from the world's origin: the grid is no larger than it.
    origin = cells.min(axis=0)
    shape = cells.max(axis=0) - origin + 1
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
    return _Slab(near[kept], noise, thickness, reach)


def _bound(
    patch: Patch,
    flat: _Slab,
    local: Vector,
    passing: Vector,
    rotation: Vector,
    sampling: Sampling,
    eye: Vector | None,
) -> Tread:
    """Fits the rectangle of a tread.

    Args:
        patch: the tread, in G.
        flat: its points, in G.
        local: the cloud about the flight in S, (n, 3), m.
        passing: points in S whose rays pass by the tread, (k, 3), m.
        rotation: R_GS, (3, 3).
        sampling: of the cloud.
        eye: viewpoint in S, (3,), m.
    """
    core = patch.points @ rotation
    point, normal = patch.plane.point @ rotation, patch.plane.normal @ rotation
    off = (local - point) @ normal
    thickness, reach = flat.thickness, flat.reach
    slab = _hanging_together(
        flat.points @ rotation, core, max(CELL, 1.5 * sampling.spacing)
    )
    x, y = slab[:, 0], slab[:, 1]
    strip = max(BIN, 1.5 * sampling.spacing)
    on, past, slant = slab[:, :2], np.zeros((0, 2)), 1.0
    if eye is not None:
        run, height = abs(float(np.median(x) - eye[0])), float(eye[2] - point[2])
        slant = run / max(abs(height), 0.1)
        on = _pierced(slab, eye, point, normal)
        past = _pierced(passing, eye, point, normal)
    # A face below would draw the front towards the eye by the slab's thickness. Levels
    # that were drawn together are thin, and at their fronts drawn down.
    lowest = -0.3 * thickness if sampling.drawn else -0.5 * flat.noise
    upper = (slab - point) @ normal >= lowest
    right = -_strip_end(on * [1.0, -1.0], past * [1.0, -1.0], strip)[0]
    left = _strip_end(on, past, strip)[0]
    on, past = on[:, ::-1], past[:, ::-1]
    front = -_strip_end(on[upper] * [1.0, -1.0], past * [1.0, -1.0], strip)[0]
    back, ends = _strip_end(on, past, strip)
    inside = (local[:, 1] > right + BIN) & (local[:, 1] < left - BIN)
    face = inside & (off < -thickness) & (off > -reach)
    standing, found = _face(local[face, 0], front)
    # A nosing overhangs its riser: then the tread's own end counts.
    overhang = OVERHANG + 2.0 * slant * max(flat.noise, sampling.noise)
    front = standing if found and front > standing - overhang else front
    riser = inside & (off > thickness) & (off < reach)
    standing, found = _face(local[riser, 0], back)
    back, ends = (standing, True) if found else (back, ends)
    before = inside & (off < -0.03) & (local[:, 0] < front + BIN)
    drops = np.count_nonzero(before & (local[:, 0] > front - 0.25)) >= MIN_FACE_POINTS
    lower = before & (local[:, 0] < front - BEFORE[0])
    lower &= local[:, 0] > front - BEFORE[1]
    seen = np.count_nonzero(lower) >= MIN_FACE_POINTS
    # Through open risers one sees what lies below the step before as well.
    drop = -float(np.percentile(off[lower], 75.0)) if seen else np.nan
    y_all = local[:, 1]
    beside = (np.abs(off) > thickness) & (local[:, 0] > front) & (local[:, 0] < back)
    # The rim is mixed with points of the faces, which would tilt and lift the plane.
    rim = (x > front + 0.02) & (x < back - 0.02) & (y > right) & (y < left)
    if np.count_nonzero(rim) >= MIN_FACE_POINTS:
        point, normal = fit_plane(slab[rim])
    return Tread(
        low=np.array([front, right]),
        high=np.array([back, left]),
        point=point,
        normal=normal,
        points=slab,
        drops=bool(drops),
        ends=bool(ends),
        right=_is_seen_beyond(right - y_all, beside),
        left=_is_seen_beyond(y_all - left, beside),
        drop=drop,
        reach=reach,
    )


def _is_seen_beyond(past: Vector, others: NDArray[np.bool]) -> bool:
    """Tells whether points of other surfaces were seen right beyond an end.

    Args:
        past: how far each point lies past the end, (n,), m.
        others: which points are not of the tread, (n,).
    """
    right_beyond = others & (past > -0.01) & (past < NEAR)
    return int(np.count_nonzero(right_beyond)) >= MIN_FACE_POINTS


def _hanging_together(slab: Vector, core: Vector, size: float) -> Vector:
    """Selects the points of a slab connected to the tread's core, in plan view.

    These are the pieces that hang together with the core, which may be in several where
    something hides the rest, and pieces beside it, behind the shadow of a leg, that
    are too small for a plane of their own.
    """
    both = np.concatenate([slab, core])[:, :2]
    cells = np.floor(both / size).astype(np.int64)
    cells -= cells.min(axis=0) - 1
    occupied = np.zeros(cells.max(axis=0) + 2, dtype=bool)
    occupied[cells[:, 0], cells[:, 1]] = True
    label, count = ndimage.label(occupied, np.ones((3, 3)))
    of_point = label[cells[:, 0], cells[:, 1]]
    wanted = np.bincount(of_point[len(slab) :], minlength=count + 1)
    own = wanted >= MIN_FACE_POINTS
    of_slab = of_point[: len(slab)]
    main = slab[own[of_slab]]
    if not len(main):
        return core
    (front, right), (back, left) = main[:, :2].min(axis=0), main[:, :2].max(axis=0)
    for number in np.unique(of_slab[~own[of_slab]]):
        piece = slab[of_slab == number, :2]
        if len(piece) < MIN_FACE_POINTS:
            continue
        low, high = piece.min(axis=0), piece.max(axis=0)
        between = max(low[1] - left, right - high[1])
        fits = low[0] > front - BIN and high[0] < back + BIN
        if fits and between <= SHADOW and high[0] - low[0] > 0.5 * (back - front):
            own[number] = True
    return np.asarray(slab[own[of_slab]])


def _pierced(points: Vector, eye: Vector, point: Vector, normal: Vector) -> Vector:
    """Finds where the rays to points pierce a plane, (k, 2), m, of those that do.

    Noise of ranges moves no point of these.

    Args:
        points: (n, 3), m.
        eye: where they were seen from, (3,), m.
        point: a point of the plane, (3,), m.
        normal: its unit normal, (3,).
    """
    height = float((eye - point) @ normal)
    drop = height - (points - point) @ normal
    if height <= 0.0:
        return points[:, :2]
    good = drop > 0.1 * height
    part = height / drop[good]
    return np.asarray(eye[:2] + part[:, None] * (points[good, :2] - eye[:2]))


def _strip_end(on: Vector, past: Vector, width: float) -> tuple[float, bool]:
    """Finds where points end, by strips across, m.

    Where rays pass right beyond, the end is half way to them. Without a viewpoint it
    is the upper third: strips that something hides end early and draw the median in.

    Args:
        on: place across and along of the points, (n, 2), m.
        past: the same of where rays pass by, (k, 2), m.
        width: of a strip, m.

    Returns:
        The end, m, and whether rays were seen to pass it.
    """
    low = float(np.floor(on[:, 0].min() / width))
    strip = np.floor(on[:, 0] / width).astype(np.int64) - int(low)
    ends = np.full(int(strip.max()) + 1, -np.inf)
    np.maximum.at(ends, strip, on[:, 1])
    beyond = np.floor(past[:, 0] / width).astype(np.int64) - int(low)
    inside = (beyond >= 0) & (beyond < len(ends))
    beyond, along = beyond[inside], past[inside, 1]
    ahead = along > ends[beyond]
    first = np.full(len(ends), np.inf)
    np.minimum.at(first, beyond[ahead], along[ahead])
    used = np.isfinite(ends)
    ends, first = ends[used], first[used]
    seen = first - ends < PASSING
    if np.count_nonzero(seen) >= max(2.0, EDGE_SEEN * len(ends)):
        ends, first = ends[seen], first[seen]
        between = np.where(first - ends < MAX_SPACING, (ends + first) / 2.0, ends)
        return float(np.median(between)), True
    # Where the sweep ends askew, what is in view ends at the middle of its strips.
    askew = len(past) and np.ptp(np.quantile(ends, [0.1, 0.9])) > width
    return float(np.quantile(ends, 0.5 if askew else 0.6)), False


def _face(x: Vector, edge: float) -> tuple[float, bool]:
    """Finds a vertical face near an edge, and its place."""
    for reach in (0.05, 0.02):
        x = x[np.abs(x - edge) < reach]
        if len(x) < MIN_FACE_POINTS:
            return edge, False
        edge = float(np.median(x))
    return edge, True


def _common_slope(treads: list[Tread], local: Vector) -> float:
    """Fits dx/dy of all front faces together, by trimmed least squares."""
    total, weight = 0.0, 0.0
    for tread in treads:
        low, high = tread.low, tread.high
        off = (local - tread.point) @ tread.normal
        face = (off < -SLAB) & (off > -tread.reach)
        face &= np.abs(local[:, 0] - low[0]) < 0.05
        face &= (local[:, 1] > low[1]) & (local[:, 1] < high[1])
        if np.count_nonzero(face) >= MIN_FACE_POINTS:
            x, y = local[face, 0], local[face, 1]
        elif tread.drops:
            x, y = _front_line(tread)
        else:
            # It ends along a line of the scanner, not along its edge.
            continue
        kept = np.ones(len(x), dtype=bool)
        slope = 0.0
        for _ in range(4):
            if np.count_nonzero(kept) < 4 or np.ptp(y[kept]) < 0.1:
                break
            slope, offset = np.polyfit(y[kept], x[kept], 1)
            residual = np.abs(x - offset - slope * y)
            kept = residual <= max(2.5 * float(np.median(residual)), 0.002)
        spread = float(np.sum((y[kept] - y[kept].mean()) ** 2)) if kept.any() else 0.0
        total += spread * slope
        weight += spread
    return total / weight if weight > 0.0 else 0.0


def _front_line(tread: Tread) -> tuple[Vector, Vector]:
    """Finds the first points of a tread in strips along x."""
    x, y = tread.points[:, 0], tread.points[:, 1]
    strip = np.floor(y / BIN).astype(np.int64)
    strip -= strip.min()
    count = int(strip.max()) + 1
    first = np.full(count, np.inf)
    np.minimum.at(first, strip, x)
    used = np.isfinite(first)
    middle = (np.arange(count) + 0.5) * BIN + np.floor(y.min() / BIN) * BIN
    return first[used], middle[used]
