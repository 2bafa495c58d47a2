"""How near the outline of a leg comes to an obstacle, in the plane across it.

Here x points across the obstacle from its front face on, z up from the ground.
"""

from dataclasses import dataclass

import numpy as np

from systems.ports import Vector


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
    """Of planar vectors, (..., 2)."""
    product: Vector = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def segments_intersect(p: Vector, q: Vector, o: Vector, r: Vector) -> Vector:
    """Whether segments p-q and o-r cross, (...), as 0 or 1 (Eqs. 5 and 9).

    The cross products of Eq. 9 tell on which side of one segment the ends of the other
    lie; the segments cross where both pairs of ends lie on different sides.
    """
    apart = cross_product(q - p, o - p) * cross_product(q - p, r - p)
    beside = cross_product(r - o, p - o) * cross_product(r - o, q - o)
    return np.asarray((apart < 0.0) & (beside < 0.0), dtype=np.float64)


def outline_gap(points: Vector, section: Section) -> Vector:
    """Distance of closed outlines to an obstacle, m; not positive where they meet.

    Args:
        points: corners in order, (n, k, 2), m; the ground is under z = 0.
        section: the obstacle; it goes on below the ground.

    Returns:
        Least distance, (n,); where an outline meets the obstacle minus how deep its
        deepest corner (or edge) is in it.
    """
    deep = 1.0
    size = np.array([section.width / 2.0, (section.height + deep) / 2.0])
    middle = np.array([section.width / 2.0, (section.height - deep) / 2.0])
    a = points - middle
    b = np.roll(a, -1, axis=1)
    corners = size * np.array([[-1.0, 1.0], [1.0, 1.0]])
    # From the corners of the outline to the rectangle.
    out = np.maximum(np.abs(a) - size, 0.0)
    inside = (np.abs(a) - size).max(axis=2)
    gap = np.where(inside > 0.0, np.linalg.norm(out, axis=2), inside).min(axis=1)
    # From the obstacle's upper corners to the outline's edges.
    edge = b - a
    length = np.maximum((edge**2).sum(axis=2), 1e-12)
    for corner in corners:
        share = np.clip(((corner - a) * edge).sum(axis=2) / length, 0.0, 1.0)
        offset = corner - (a + share[..., None] * edge)
        distance = np.linalg.norm(offset, axis=2).min(axis=1)
        gap = np.where(_contains(a, corner), -distance, np.minimum(gap, distance))
    top = np.stack(np.broadcast_arrays(corners[0], a), 0)[0]
    other = np.broadcast_to(corners[1], a.shape)
    met = segments_intersect(a, b, top, other).any(axis=1)
    for corner in corners:
        low = np.broadcast_to(corner * [1.0, -1.0], a.shape)
        high = np.broadcast_to(corner, a.shape)
        met |= segments_intersect(a, b, low, high).any(axis=1)
    return np.asarray(np.where(met, np.minimum(gap, 0.0), gap))


def _contains(
    polygon: Vector, point: Vector
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Whether closed polygons (n, k, 2) hold a point (2,), by counting crossings."""
    a, b = polygon, np.roll(polygon, -1, axis=1)
    above = (a[..., 1] > point[1]) != (b[..., 1] > point[1])
    rise = np.where(above, b[..., 1] - a[..., 1], 1.0)
    x = a[..., 0] + (point[1] - a[..., 1]) * (b[..., 0] - a[..., 0]) / rise
    crossings = (above & (x > point[0])).sum(axis=1)
    return np.asarray(crossings % 2 == 1)
