"""How near the outline of a leg comes to an obstacle, in the plane across it.

Here x points across the obstacle from its front face on, z up from the ground.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from footfall.models.values.vector import Vector

Mask: TypeAlias = np.ndarray[Any, np.dtype[np.bool_]]

BELOW = 1.0
"""How far an obstacle goes on below the ground, m."""


@dataclass(frozen=True)
class Section:
    """An obstacle in the plane across it: it fills 0 to `width`, up to `height`."""

    width: float
    """o_w, m."""
    height: float
    """o_h, m."""

    def inflated(self, s_w: float, s_h: float) -> tuple[float, float, float]:
        """Front, back and top of the obstacle with its margins, m."""
        return -s_w, self.width + s_w, self.height + s_h


def cross_product(a: Vector, b: Vector) -> Vector:
    """Computes a_x b_y - a_y b_x of planar vectors, (..., 2)."""
    product: Vector = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def segments_intersect(p: Vector, q: Vector, o: Vector, r: Vector) -> Vector:
    """Tells whether segments p-q and o-r cross, (...), as 0 or 1 (Eqs. 5 and 9).

    A = (q - p) x (r - o) < 0 of Eq. 9 alone, as printed, holds for segments far apart
    too; so the sides of both are looked at.

    The cross products of Eq. 9 tell on which side of one segment the ends of the other
    lie; the segments cross where both pairs of ends lie on different sides.
    """
    apart = cross_product(q - p, o - p) * cross_product(q - p, r - p)
    beside = cross_product(r - o, p - o) * cross_product(r - o, q - o)
    return np.asarray((apart < 0.0) & (beside < 0.0), dtype=np.float64)


def outline_gap(points: Vector, section: Section) -> Vector:
    """Computes the signed distance of closed outlines to an obstacle.

    Args:
        points: corners in order, (n, k, 2), m; the ground is under z = 0.
        section: the obstacle; it goes on below the ground.

    Returns:
        Least distance, (n,); where an outline meets the obstacle minus how deep one's
        corners are in the other, or an edge of the outline in the obstacle.
    """
    half_x, half_z = section.width / 2.0, (section.height + BELOW) / 2.0
    # About the middle of the obstacle's rectangle; a and b are the ends of each edge.
    a_x = points[:, :, 0] - half_x
    a_z = points[:, :, 1] - (section.height - half_z)
    b_x, b_z = _next(a_x), _next(a_z)
    # From the corners of the outline to the rectangle.
    out_x, out_z = np.abs(a_x) - half_x, np.abs(a_z) - half_z
    inside = np.maximum(out_x, out_z)
    out = np.sqrt(np.maximum(out_x, 0.0) ** 2 + np.maximum(out_z, 0.0) ** 2)
    gap = np.where(inside > 0.0, out, inside).min(axis=1)
    # From the obstacle's upper corners to the outline's edges.
    edge_x, edge_z = b_x - a_x, b_z - a_z
    length = np.maximum(edge_x**2 + edge_z**2, 1e-12)
    above = half_z - a_z
    # Where the edges pass the height of these corners: a corner is in the outline
    # when it has an odd number of them on one side.
    passes = (a_z > half_z) != (b_z > half_z)
    passed_x = a_x + above * edge_x / np.where(passes, edge_z, 1.0)
    for corner_x in (-half_x, half_x):
        ahead = corner_x - a_x
        share = np.clip((ahead * edge_x + above * edge_z) / length, 0.0, 1.0)
        offset = (ahead - share * edge_x) ** 2 + (above - share * edge_z) ** 2
        distance = np.sqrt(offset.min(axis=1))
        held = (passes & (passed_x > corner_x)).sum(axis=1) % 2 == 1
        gap = np.where(held, -distance, np.minimum(gap, distance))
    # An edge may pass through the rectangle with no corner in the other.
    near = (gap >= 0.0) & (a_z.min(axis=1) < half_z)
    near &= (a_x.min(axis=1) < half_x) & (a_x.max(axis=1) > -half_x)
    rows = np.flatnonzero(near)
    a = np.stack([a_x[rows], a_z[rows]], axis=2)
    b = np.stack([b_x[rows], b_z[rows]], axis=2)
    met = _met(a, b, half_x, half_z)
    gap[rows[met]] = -_edge_depth(a[met], b[met], half_x, half_z)
    return np.asarray(gap)


def _next(values: Vector) -> Vector:
    """Of each corner, (n, k), that of the next one."""
    return np.concatenate([values[:, 1:], values[:, :1]], axis=1)


def _met(a: Vector, b: Vector, half_x: float, half_z: float) -> Mask:
    """Whether edges a-b of outlines, (n, k, 2), cross the sides or the top, (n,)."""
    met = np.zeros(len(a), dtype=bool)
    corners = half_x * np.array([-1.0, -1.0, 1.0, 1.0])
    heights = half_z * np.array([-1.0, 1.0, 1.0, -1.0])
    around = np.column_stack([corners, heights])
    for o, r in pairwise(around):
        met |= segments_intersect(a, b, o, r).any(axis=1)
    return met


def _edge_depth(a: Vector, b: Vector, half_x: float, half_z: float) -> Vector:
    """How far the deepest point of edges a-b, (n, k, 2), is from sides and top, (n,).

    Along an edge the distance to each face is linear, so that the least of them is
    largest at an end or where two of them are the same.
    """
    start = np.stack([half_x + a[..., 0], half_x - a[..., 0], half_z - a[..., 1]], -1)
    end = np.stack([half_x + b[..., 0], half_x - b[..., 0], half_z - b[..., 1]], -1)
    slope = end - start
    share = np.zeros((*a.shape[:2], 5))
    share[..., 1] = 1.0
    for k, (i, j) in enumerate(((0, 1), (0, 2), (1, 2))):
        steeper = slope[..., j] - slope[..., i]
        steeper = np.where(np.abs(steeper) > 1e-12, steeper, np.inf)
        share[..., 2 + k] = (start[..., i] - start[..., j]) / steeper
    share = np.clip(share, 0.0, 1.0)
    depth = start[:, :, None] + share[..., None] * slope[:, :, None]
    return np.asarray(depth.min(axis=3).max(axis=(1, 2), initial=0.0))
