"""Conversion of patches and treads in the frame G to plane segments in W."""

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from scipy.spatial import ConvexHull

from footfall.models.values.perceived import PlaneSegment
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import Patch, plane_axes
from footfall.systems.perception.planes.treads import Tread, stair_rotation


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
    return _segment(
        patch.outline, center, axes, size, patch.area, len(patch.points), R_GW
    )


def tread_segment(tread: Tread, yaw: float, area: float, R_GW: Vector) -> PlaneSegment:
    """Converts a tread in G to a plane segment in W.

    Args:
        tread: the tread, in its staircase's frame S.
        yaw: of S in G, rad.
        area: of its supporting voxels, m^2.
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
    outline = inside[ConvexHull(inside).vertices]
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
    )


def _segment(
    outline: Vector,
    center: Vector,
    axes: Vector,
    size: Vector,
    area: float,
    support: int,
    R_GW: Vector,
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
    )
