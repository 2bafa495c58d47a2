"""Planes of clusters, their supporting points, outlines and rectangles.

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4.3. All of it in a frame G whose z
points up.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from footfall.models.values.vector import Vector

HYPOTHESES = 48
"""Planes tried by RANSAC at a time: finds a plane with half of the points inliers
with probability 1 - (1 - 0.5^3)^48 = 0.998."""
MANY_POINTS = 1000
"""Of fewer points the hull is found at once."""
MANY_HEIGHTS = 5000
"""Points that tell how high a plane is from below to above; more are the same."""
SCORED_POINTS = 1500
"""Points that judge a hypothesis; more would not change the choice."""


@dataclass(frozen=True, eq=False)
class FittedPlane:
    """A plane through some of the voxels."""

    point: Vector
    """A point of the plane, the mean of its inliers, (3,), m."""
    normal: Vector
    """Unit normal, up, (3,)."""
    inliers: NDArray[np.int64]
    """Indices of the voxels it was fitted to, (n,)."""


@dataclass(frozen=True, eq=False)
class Patch:
    """A bounded piece of plane with the points of the cloud that support it."""

    plane: FittedPlane
    points: Vector
    """Supporting points, (n, 3), m; of a large plane those at its rim alone."""
    support: int
    """How many points support it."""
    area: float
    """Area of the supporting voxels, m^2."""
    extent: Vector
    """Scales (dx, dy, dz) of the segment, the paper's V, (3,), m: dx and dy are the
    short and the long side of the rectangle, dz is measured along gravity."""
    center: Vector
    """Centre of the rectangle, (3,), m."""
    axes: Vector
    """Rotation R_GR of the rectangle, (3, 3): x along the short side, z the normal."""
    outline: Vector
    """Convex outline, (h, 3), m, counter-clockwise from above."""


def fit_plane(points: Vector) -> tuple[Vector, Vector]:
    """Fits the least-squares plane of (n, 3) points: mean and upward unit normal."""
    mean = np.ones(len(points)) @ points / len(points)
    offset = points - mean
    normal = np.linalg.eigh(offset.T @ offset)[1][:, 0]
    return mean, np.asarray(normal if normal[2] >= 0.0 else -normal)


def ransac_planes(
    points: Vector,
    clusters: NDArray[np.int64],
    *,
    tolerance: float,
    min_inliers: int,
    rng: np.random.Generator,
) -> tuple[FittedPlane, ...]:
    """Fits planes to each cluster, the best supported first, until points run out.

    Args:
        points: representative points of voxels, (m, 3), m.
        clusters: cluster of each voxel, (m,); -1 for none.
        tolerance: most that an inlier lies off the plane, m.
        min_inliers: least number of voxels of a plane.
        rng: chooses the hypotheses.
    """
    planes: list[FittedPlane] = []
    order = np.argsort(clusters, kind="stable")
    bounds = np.searchsorted(clusters[order], np.arange(clusters.max(initial=-1) + 2))
    for begin, end in pairwise(bounds):
        left = order[begin:end]
        while len(left) >= max(min_inliers, 3):
            plane = _best_plane(points, left, tolerance, rng)
            if len(plane.inliers) < min_inliers:
                break
            planes.append(plane)
            distance = (points[left] - plane.point) @ plane.normal
            # What is nearer than this is noise of the plane, not a plane beside it.
            left = left[np.abs(distance) > 2.0 * tolerance]
    return tuple(planes)


def _best_plane(
    points: Vector,
    members: NDArray[np.int64],
    tolerance: float,
    rng: np.random.Generator,
) -> FittedPlane:
    p = points[members]
    triple = p[rng.integers(0, len(p), (HYPOTHESES, 3))]
    normals = np.cross(triple[:, 1] - triple[:, 0], triple[:, 2] - triple[:, 0])
    length = np.linalg.norm(normals, axis=1)
    sound = length > 1e-9
    normals = normals[sound] / length[sound, None]
    origins = triple[sound, 0]
    judges = p[:: max(1, len(p) // SCORED_POINTS)]
    off = judges @ normals.T - np.sum(origins * normals, axis=1)
    score = np.count_nonzero(np.abs(off) <= tolerance, axis=0)
    if not len(score):
        point, normal = fit_plane(p)
    else:
        best = int(np.argmax(score))
        point, normal = origins[best], normals[best]
    inside = np.abs((p - point) @ normal) <= tolerance
    for _ in range(2):
        if inside.sum() < 3:
            break
        point, normal = fit_plane(p[inside])
        inside = np.abs((p - point) @ normal) <= tolerance
    normal = normal if normal[2] >= 0.0 else -normal
    return FittedPlane(point, np.asarray(normal), members[inside])


def assign_support(
    planes: tuple[FittedPlane, ...],
    voxel_of_member: NDArray[np.int64],
    mean: Vector,
    pairs: NDArray[np.int64],
    *,
    tolerance: float,
    rings: int,
) -> NDArray[np.int64]:
    """Gives each plane its voxels and the ones around them that lie on it.

    The filters erode the rim of a plane (fewer neighbours, bent normals); a tread's
    rim matters, so it is won back.

    Args:
        planes: planes whose inliers index voxels that passed the filters.
        voxel_of_member: index of each of those among all m voxels.
        mean: means of all voxels, (m, 3), m.
        pairs: pairs of adjacent voxels among all, (p, 2).
        tolerance: most that a voxel's mean lies off the plane, m.
        rings: how many times to add the neighbours.

    Returns:
        Plane of each voxel, (m,); -1 for none.
    """
    owner = np.full(len(mean), -1, dtype=np.int64)
    for number, plane in enumerate(planes):
        owner[voxel_of_member[plane.inliers]] = number
    if not planes:
        return owner
    normals = np.array([plane.normal for plane in planes])
    offsets = np.array([plane.point @ plane.normal for plane in planes])
    for _ in range(rings):
        a, b = owner[pairs[:, 0]], owner[pairs[:, 1]]
        rim = pairs[(a < 0) != (b < 0)]
        inner = np.where(owner[rim[:, 0]] >= 0, rim[:, 0], rim[:, 1])
        outer = np.where(owner[rim[:, 0]] >= 0, rim[:, 1], rim[:, 0])
        number = owner[inner]
        off = np.einsum("ij,ij->i", mean[outer], normals[number]) - offsets[number]
        near = np.abs(off) <= tolerance
        owner[outer[near]] = number[near]
    return owner


def make_patches(
    planes: tuple[FittedPlane, ...],
    owner: NDArray[np.int64],
    index: NDArray[np.int64],
    voxel_of_point: NDArray[np.int64],
    points: Vector,
    *,
    voxel_size: float,
    tolerance: float,
) -> tuple[Patch, ...]:
    """Bounds each plane by the points of the cloud that support it.

    Args:
        planes: planes, numbered as in `owner`.
        owner: plane of each voxel, (m,); -1 for none.
        index: integer coordinates of the voxels, (m, 3).
        voxel_of_point: each point's voxel, (n,).
        points: the cloud, (n, 3), m.
        voxel_size: v, m.
        tolerance: most that a point lies off its plane, m.
    """
    plane_of_point = owner[voxel_of_point]
    chosen = np.flatnonzero(plane_of_point >= 0)
    chosen = chosen[np.argsort(plane_of_point[chosen], kind="stable")]
    bounds = np.searchsorted(plane_of_point[chosen], np.arange(len(planes) + 1))
    patches = []
    for number, plane in enumerate(planes):
        support = points[chosen[bounds[number] : bounds[number + 1]]]
        off = (support - plane.point) @ plane.normal
        support = support[np.abs(off) <= tolerance]
        columns = index[owner == number, :2]
        width = columns[:, 1].max(initial=0) + 1
        area = len(np.unique(columns[:, 0] * width + columns[:, 1])) * voxel_size**2
        patch = bound_patch(plane, support, area / max(float(plane.normal[2]), 0.1))
        if patch is not None:
            patches.append(patch)
    return tuple(patches)


def bound_patch(
    plane: FittedPlane, support: Vector, area: float, count: int | None = None
) -> Patch | None:
    """Bounds a plane's points by hull and rectangle; None where they are in a line.

    Args:
        plane: the plane.
        support: its points, (n, 3), m.
        area: of the supporting voxels, m^2.
        count: how many points support it where `support` is not all of them.
    """
    if len(support) < 3:
        return None
    basis = plane_axes(plane.normal, np.array([1.0, 0.0, 0.0]))
    local = (support - plane.point) @ basis
    try:
        rim = outer_points(local[:, :2])
        corners = rim[ConvexHull(rim).vertices]
    except QhullError:
        return None
    angle, low, high = min_rectangle(corners)
    size = high - low
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    middle = turn @ ((low + high) / 2.0)
    flat = np.hstack([corners, np.zeros((len(corners), 1))])
    z = support[:: 1 + len(support) // MANY_HEIGHTS, 2]
    low_z, high_z = np.percentile(z, [2.0, 98.0])
    return Patch(
        plane=plane,
        points=support,
        support=len(support) if count is None else count,
        area=area,
        extent=np.array([size[0], size[1], high_z - low_z]),
        center=plane.point + basis @ np.append(middle, 0.0),
        axes=plane_axes(plane.normal, basis @ np.append(turn[:, 0], 0.0)),
        outline=plane.point + flat @ basis.T,
    )


def outer_points(points: Vector) -> Vector:
    """Leaves out points that are no corner of the convex hull (Akl and Toussaint 1978).

    These are the ones within the octagon of the farthest points to eight sides.

    Args:
        points: (n, 2), m.
    """
    if len(points) < MANY_POINTS:
        return points
    x, y = points[:, 0], points[:, 1]
    diagonal, other = x + y, x - y
    farthest = [
        np.argmin(side) if least else np.argmax(side)
        for side, least in (
            (x, False),
            (diagonal, False),
            (y, False),
            (other, True),
            (x, True),
            (diagonal, True),
            (y, True),
            (other, False),
        )
    ]
    octagon = points[farthest]
    inside = np.ones(len(points), dtype=bool)
    for a, b in zip(octagon, np.roll(octagon, -1, axis=0), strict=True):
        if np.array_equal(a, b):
            continue
        inside &= (b[0] - a[0]) * (y - a[1]) > (b[1] - a[1]) * (x - a[0])
    return points[~inside]


def plane_axes(normal: Vector, toward: Vector) -> Vector:
    """Computes R, (3, 3), with z along the normal and x as near `toward` as can be."""
    x = toward - normal * (normal @ toward)
    if np.linalg.norm(x) < 1e-9:
        x = np.cross(normal, [0.0, 1.0, 0.0])
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(normal, x), normal])


def min_rectangle(corners: Vector) -> tuple[float, Vector, Vector]:
    """Computes the least-area rectangle around a convex polygon, (h, 2), m.

    Returns:
        Angle of its x axis (along its short side), rad, and its low and high corners
        (2,) in the frame turned by that angle about the origin, m.
    """
    edges = np.roll(corners, -1, axis=0) - corners
    angles = np.unique(np.round(np.arctan2(edges[:, 1], edges[:, 0]) % (np.pi / 2), 9))
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x = corners[:, 0] * c + corners[:, 1] * s
    y = -corners[:, 0] * s + corners[:, 1] * c
    size = np.stack([np.ptp(x, axis=1), np.ptp(y, axis=1)], axis=1)
    best = int(np.argmin(size[:, 0] * size[:, 1]))
    angle = float(angles[best])
    low = np.array([x[best].min(), y[best].min()])
    high = np.array([x[best].max(), y[best].max()])
    if size[best, 0] > size[best, 1]:
        # Turned by a right angle, x runs along the former y.
        low, high = np.array([low[1], -high[0]]), np.array([high[1], -low[0]])
        angle += np.pi / 2
    return angle, low, high
