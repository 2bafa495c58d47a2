"""Conversion of patches and treads in the frame G to plane segments in W."""

from dataclasses import replace

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from scipy.spatial import ConvexHull

from footfall.models.values.perceived import (
    PlaneSegment,
    PlaneSegmentation,
    SeenEdges,
    Staircase,
)
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import (
    Patch,
    outer_points,
    plane_axes,
)
from footfall.systems.perception.planes.treads import (
    Tread,
    stair_rotation,
    voxel_area,
)


def patch_segment(patch: Patch, R_GW: Vector, yaw: float | None = None) -> PlaneSegment:
    """Converts a patch in G to a plane segment in W.

    Args:
        patch: the patch, in G.
        R_GW: rotation from W to G, (3, 3).
        yaw: where given, the rectangle is the one along a staircase with this yaw in
            G, rad, with x up the stairs.
    """
    axes, center, size = patch.axes, patch.center, patch.extent[:2]
    if yaw is not None:
        axes = plane_axes(patch.plane.normal, stair_rotation(yaw)[:, 0])
        local = (patch.outline - center) @ axes
        low, high = local.min(axis=0), local.max(axis=0)
        size = (high - low)[:2]
        center = center + axes[:, :2] @ (low + high)[:2] / 2.0
    return _segment(patch.outline, center, axes, size, patch.area, patch.support, R_GW)


def tread_segment(
    tread: Tread, yaw: float, voxel_size: float, R_GW: Vector
) -> PlaneSegment:
    """Converts a tread in G to a plane segment in W.

    Args:
        tread: the tread, in its staircase's frame S.
        yaw: of S in G, rad.
        voxel_size: v, m, of the voxels that its area counts (Eq. 3).
        R_GW: rotation from W to G, (3, 3).
    """
    rotation = stair_rotation(yaw)
    axes = plane_axes(tread.normal, np.array([1.0, 0.0, 0.0]))

    def on_plane(xy: Vector) -> Vector:
        """Lifts (n, 2) points onto the tread's plane."""
        slope = tread.normal[:2] / tread.normal[2]
        z = tread.point[2] - (xy - tread.point[:2]) @ slope
        return np.column_stack([xy, z])

    inside = np.clip(tread.points[:, :2], tread.low, tread.high)
    inside = outer_points(inside)
    outline = inside[ConvexHull(inside).vertices]
    area = voxel_area(tread, rotation, voxel_size)
    middle = on_plane((tread.low + tread.high)[None] / 2.0)[0]
    size = (tread.high - tread.low) / np.array([axes[0, 0], 1.0])
    return _segment(
        on_plane(outline) @ rotation.T,
        rotation @ middle,
        rotation @ axes,
        size,
        area,
        len(tread.points),
        R_GW,
        SeenEdges(
            front=tread.drops, back=tread.ends, right=tread.right, left=tread.left
        ),
    )


def winding_segments(
    patches: tuple[Patch, ...], chosen: list[int], R_GW: Vector
) -> dict[int, PlaneSegment]:
    """Converts the treads of a winding flight to plane segments in W.

    A wedge's polygon is its outline; its rectangle is the largest within it whose x
    points to the next tread.

    Args:
        patches: all patches, in G.
        chosen: indices of the treads' patches, lowest first, two at least.
        R_GW: rotation from W to G, (3, 3).
    """
    segments = {}
    for place, number in enumerate(chosen):
        patch = patches[number]
        lower = patches[chosen[max(place - 1, 0)]]
        upper = patches[chosen[min(place + 1, len(chosen) - 1)]]
        axes = plane_axes(patch.plane.normal, upper.center - lower.center)
        local = (patch.outline - patch.center) @ axes
        low, high = inscribed_rectangle(local[:, :2])
        segments[number] = _segment(
            patch.outline,
            patch.center + axes[:, :2] @ (low + high) / 2.0,
            axes,
            high - low,
            patch.area,
            patch.support,
            R_GW,
        )
    return segments


def inscribed_rectangle(outline: Vector) -> tuple[Vector, Vector]:
    """Finds the largest rectangle along the axes within a convex polygon.

    Args:
        outline: its corners in order, (n, 2).

    Returns:
        Its low and its high corner, (2,) each, to a fiftieth of the polygon's length.
    """
    x = np.linspace(outline[:, 0].min(), outline[:, 0].max(), 51)
    bottom, top = np.full(len(x), np.inf), np.full(len(x), -np.inf)
    for a, b in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        (x0, y0), (x1, y1) = (a, b) if a[0] <= b[0] else (b, a)
        along = (x >= x0) & (x <= x1)
        part = (x[along] - x0) / max(x1 - x0, 1e-12)
        y = y0 + part * (y1 - y0)
        bottom[along] = np.minimum(bottom[along], y)
        top[along] = np.maximum(top[along], y)
    # Between two cuts of a convex polygon it is no narrower than at both.
    lower = np.maximum(bottom[:, None], bottom[None])
    upper = np.minimum(top[:, None], top[None])
    area = np.maximum(x[None] - x[:, None], 0.0) * np.maximum(upper - lower, 0.0)
    i, j = np.unravel_index(int(np.argmax(area)), area.shape)
    return np.array([x[i], lower[i, j]]), np.array([x[j], upper[i, j]])


def shift_segmentation(
    segmentation: PlaneSegmentation, offset: Vector
) -> PlaneSegmentation:
    """Moves all segments of a segmentation by an offset, (3,), m."""
    moved: dict[int, PlaneSegment] = {}

    def move(segment: PlaneSegment) -> PlaneSegment:
        X = segment.X_WR
        return moved.setdefault(
            id(segment),
            replace(
                segment,
                polygon=segment.polygon + offset,
                X_WR=RigidTransform(X.rotation(), X.translation() + offset),
            ),
        )

    def move_all(staircase: Staircase) -> Staircase:
        floor = staircase.floor
        return Staircase(
            treads=tuple(move(tread) for tread in staircase.treads),
            floor=None if floor is None else move(floor),
        )

    return replace(
        segmentation,
        planes=tuple(move(plane) for plane in segmentation.planes),
        staircase=move_all(segmentation.staircase),
        flights=tuple(move_all(flight) for flight in segmentation.flights),
    )


def _segment(
    outline: Vector,
    center: Vector,
    axes: Vector,
    size: Vector,
    area: float,
    support: int,
    R_GW: Vector,
    edges: SeenEdges | None = None,
) -> PlaneSegment:
    rotation: Vector = R_GW.T @ axes
    translation: Vector = R_GW.T @ center
    return PlaneSegment(
        polygon=outline @ R_GW,
        X_WR=RigidTransform(
            RotationMatrix.ProjectToRotationMatrix(rotation), translation
        ),
        size=np.array(size),
        normal=rotation[:, 2].copy(),
        area=float(area),
        support_count=int(support),
        edges=edges,
    )
