"""Rectangles of treads from the points of the cloud rather than from its voxels.

A tread's outline in voxels is quantised and eroded by the filters. Here its edges are
sought in the cloud: the front edge where the face below it stands, the back edge where
the next face stands, the ends and an edge without face where the points end.
All of it in a frame G whose z points up.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.levels import Sampling
from footfall.systems.perception.planes.planes import Patch, fit_plane
from footfall.systems.perception.planes.tread_edges import (
    MIN_FACE_POINTS,
    find_face,
    pierced,
    strip_end,
)
from footfall.systems.perception.planes.tread_points import (
    CELL,
    NEAR,
    SLAB,
    TreadPoints,
    points_near,
    span,
    tread_points,
    within,
)

BIN = 0.03
"""Width of the strips in which the end of a tread is looked for, m."""
OVERHANG = 0.012
"""A tread that ends this far before the face below it overhangs it, m; less may be the
noise of its own end."""
RIM = 0.25
"""Part of a voxel by which noise may carry a point of a tread over its edge."""
MAX_TURNS = 3
"""Most often that the direction of a flight is improved."""
LEAST_TURN = 2e-4
"""A smaller improvement is none, rad."""
SHADOW = 0.25
"""Widest shadow across a tread, m: of a leg."""
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
    right: bool = False
    """Whether something else was seen beyond its right end."""
    left: bool = False
    """Whether something else was seen beyond its left end."""
    drop: float = np.nan
    """Height over what was seen before its front edge, m; NaN where nothing was."""


def stair_rotation(yaw: float) -> Vector:
    """Computes R_GS of a staircase whose x is turned by `yaw` about G's z, (3, 3)."""
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def voxel_area(tread: Tread, rotation: Vector, voxel_size: float) -> float:
    """Computes the area of the voxels of a tread's points within its edges, m^2.

    It is a n_i of the stair paper's Eq. 3, p = (a / A) sum_i n_i, along the tread's
    plane; a is a voxel's area, and A, the true one, is not known here.

    Args:
        tread: the tread, in S.
        rotation: R_GS, (3, 3).
        voxel_size: v, m.
    """
    margin = RIM * voxel_size
    points = within(tread.points, tread.low - margin, tread.high + margin)
    if not len(points):
        return 0.0
    cells = np.floor(points @ rotation.T[:, :2] * (1.0 / voxel_size)).astype(np.int64)
    cells -= span(cells)[0]
    occupied = np.zeros(span(cells)[1] + 1, dtype=bool)
    occupied[cells[:, 0], cells[:, 1]] = True
    count = int(np.count_nonzero(occupied))
    return count * voxel_size**2 / max(float(tread.normal[2]), 0.1)


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
    near = points_near(patches, cloud)
    yaw = initial_yaw(patches, near, viewpoint, landings)
    wide = list(landings) or [False] * len(patches)
    about = tread_points(patches, near, cloud, viewpoint, wide, sampling)
    # Faces tell the direction before anything else is known.
    treads = [_outlined(points, yaw) for points in about]
    yaw -= float(np.arctan(_common_slope(treads, about, yaw)))
    treads = [_bound(points, yaw, sampling, viewpoint) for points in about]
    for _ in range(MAX_TURNS):
        turn = float(np.arctan(_common_slope(treads, about, yaw)))
        if abs(turn) < LEAST_TURN:
            break
        yaw -= turn
        treads = [_bound(points, yaw, sampling, viewpoint) for points in about]
    return yaw, [
        _tell_surroundings(tread, points, yaw)
        for tread, points in zip(treads, about, strict=True)
    ]


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


def _outlined(about: TreadPoints, yaw: float) -> Tread:
    """Makes a tread of the rectangle of its outline, whose edges are not known."""
    rotation = stair_rotation(yaw)
    outline = about.patch.outline @ rotation
    return Tread(
        low=outline[:, :2].min(axis=0),
        high=outline[:, :2].max(axis=0),
        point=about.patch.plane.point @ rotation,
        normal=about.patch.plane.normal @ rotation,
        points=np.zeros((0, 3)),
        drops=False,
        ends=False,
    )


def _bound(
    about: TreadPoints, yaw: float, sampling: Sampling, viewpoint: Vector | None
) -> Tread:
    """Fits the rectangle of a tread.

    Args:
        about: the points that tell it, in G.
        yaw: of S in G, rad.
        sampling: of the cloud.
        viewpoint: where it was seen from in G, (3,), m.
    """
    rotation, thickness = stair_rotation(yaw), about.thickness
    plane = about.patch.plane
    core = about.patch.points @ rotation
    point, normal = plane.point @ rotation, plane.normal @ rotation
    size = max(CELL, 1.5 * sampling.spacing)
    slab = _hanging_together(about.slab @ rotation, core, size)
    x, y = slab[:, 0], slab[:, 1]
    strip = max(BIN, 1.5 * sampling.spacing)
    on, past, slant = slab[:, :2], np.zeros((0, 2)), 1.0
    if viewpoint is not None:
        eye = viewpoint @ rotation
        run, height = abs(float(np.median(x) - eye[0])), float(eye[2] - point[2])
        slant = run / max(abs(height), 0.1)
        on = pierced(slab, eye, point, normal)
        past = pierced(about.passing @ rotation, eye, point, normal)
    # A face below would draw the front towards the eye by the slab's thickness. Levels
    # that were drawn together are thin, and at their fronts drawn down.
    lowest = -0.3 * thickness if sampling.drawn else -0.5 * about.noise
    upper = (slab - point) @ normal >= lowest
    upper |= not upper.any()
    mirrored = np.array([1.0, -1.0])
    right = -strip_end(on * mirrored, past * mirrored, strip)[0]
    left = strip_end(on, past, strip)[0]
    on, past = on[:, ::-1], past[:, ::-1]
    front = -strip_end(on[upper] * mirrored, past * mirrored, strip)[0]
    back, ends = strip_end(on, past, strip)
    standing, found = find_face(_between(about.below @ rotation, right, left), front)
    # A nosing overhangs its riser: then the tread's own end counts.
    overhang = OVERHANG + 2.0 * slant * max(about.noise, sampling.noise)
    front = standing if found and front > standing - overhang else front
    standing, found = find_face(_between(about.above @ rotation, right, left), back)
    back, ends = (standing, True) if found else (back, ends)
    # The rim is mixed with points of the faces, which would tilt and lift the plane.
    rim = (x > front + 0.02) & (x < back - 0.02) & (y > right) & (y < left)
    if np.count_nonzero(rim) >= MIN_FACE_POINTS:
        point, normal = fit_plane(slab[rim])
    before = _between(about.lower @ rotation, right, left)
    before = before[before < front + BIN]
    return Tread(
        low=np.array([front, right]),
        high=np.array([back, left]),
        point=point,
        normal=normal,
        points=slab,
        drops=int(np.count_nonzero(before > front - 0.25)) >= MIN_FACE_POINTS,
        ends=ends,
    )


def _between(points: Vector, right: float, left: float) -> Vector:
    """Returns x of the points, (n, 3) in S, between a tread's ends but for a strip."""
    y = points[:, 1]
    return np.asarray(points[(y > right + BIN) & (y < left - BIN), 0])


def _tell_surroundings(tread: Tread, about: TreadPoints, yaw: float) -> Tread:
    """Adds what was seen before a tread and beyond its ends."""
    rotation = stair_rotation(yaw)
    (front, right), (back, left) = tread.low, tread.high
    plane = about.patch.plane
    point, normal = plane.point @ rotation, plane.normal @ rotation
    lower = about.lower @ rotation
    x, y = lower[:, 0], lower[:, 1]
    before = (x < front - BEFORE[0]) & (x > front - BEFORE[1])
    before &= (y > right + BIN) & (y < left - BIN)
    off = (lower[before] - point) @ normal
    # Through open risers one sees what lies below the step before as well.
    seen = len(off) >= MIN_FACE_POINTS
    drop = -float(np.percentile(off, 75.0)) if seen else np.nan
    others = about.others @ rotation
    beside = others[(others[:, 0] > front) & (others[:, 0] < back), 1]
    return replace(
        tread,
        right=_is_seen_beyond(right - beside),
        left=_is_seen_beyond(beside - left),
        drop=drop,
    )


def _is_seen_beyond(past: Vector) -> bool:
    """Tells whether points of other surfaces, so far past an end, are right beyond it.

    Args:
        past: how far each point lies past the end, (n,), m.
    """
    right_beyond = (past > -0.01) & (past < NEAR)
    return int(np.count_nonzero(right_beyond)) >= MIN_FACE_POINTS


def _hanging_together(slab: Vector, core: Vector, size: float) -> Vector:
    """Selects the points of a slab connected to the tread's core, in plan view.

    These are the pieces that hang together with the core, which may be in several where
    something hides the rest, and pieces beside it, behind the shadow of a leg, that
    are too small for a plane of their own.
    """
    both = np.concatenate([slab, core])[:, :2]
    cells = np.floor(both / size).astype(np.int64)
    cells -= span(cells)[0] - 1
    occupied = np.zeros(span(cells)[1] + 2, dtype=bool)
    occupied[cells[:, 0], cells[:, 1]] = True
    label, count = ndimage.label(occupied, np.ones((3, 3)))
    of_point = label[cells[:, 0], cells[:, 1]]
    wanted = np.bincount(of_point[len(slab) :], minlength=count + 1)
    own = wanted >= MIN_FACE_POINTS
    of_slab = of_point[: len(slab)]
    main = slab[own[of_slab]]
    if not len(main):
        return core
    (front, right), (back, left) = span(main[:, :2])
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


def _common_slope(treads: list[Tread], about: list[TreadPoints], yaw: float) -> float:
    """Fits dx/dy of all front faces together, by trimmed least squares."""
    rotation = stair_rotation(yaw)
    total, weight = 0.0, 0.0
    for tread, points in zip(treads, about, strict=True):
        low, high = tread.low, tread.high
        local = points.below @ rotation
        face = np.abs(local[:, 0] - low[0]) < 0.05
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
            y_mean, x_mean = y[kept].mean(), x[kept].mean()
            off = y[kept] - y_mean
            slope = float(off @ (x[kept] - x_mean) / max(off @ off, 1e-12))
            residual = np.abs(x - x_mean - slope * (y - y_mean))
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
