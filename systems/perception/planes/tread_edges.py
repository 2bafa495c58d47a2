"""Where the points of a tread end: by faces, and by the rays that pass."""

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.tread_points import PASSING

MAX_SPACING = 0.06
"""Farthest from a tread's end to the next ray beyond that tells where it ends, m."""
EDGE_SEEN = 0.2
"""Part of an end's strips that are enough to tell where it is."""
MIN_FACE_POINTS = 25
"""Fewer points do not make a face."""


def pierced(points: Vector, eye: Vector, point: Vector, normal: Vector) -> Vector:
    """Finds where the rays to points pierce a plane, (k, 2), m, of those that do.

    Noise of ranges moves no point of these. From hardly above the plane they tell
    nothing; then the points stay where they are.

    Args:
        points: (n, 3), m.
        eye: where they were seen from, (3,), m.
        point: a point of the plane, (3,), m.
        normal: its unit normal, (3,).
    """
    height = float((eye - point) @ normal)
    drop = height - (points - point) @ normal
    if height <= PASSING:
        return points[:, :2]
    good = drop > 0.1 * height
    part = height / drop[good]
    return np.asarray(eye[:2] + part[:, None] * (points[good, :2] - eye[:2]))


def strip_end(on: Vector, past: Vector, width: float) -> tuple[float, bool]:
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


def find_face(x: Vector, edge: float) -> tuple[float, bool]:
    """Finds a vertical face near an edge.

    Args:
        x: of the points that may be of it, (n,), m.
        edge: where it should be, m.

    Returns:
        Its place, m, or the edge as it was, and whether there is a face.
    """
    for reach in (0.05, 0.02):
        x = x[np.abs(x - edge) < reach]
        if len(x) < MIN_FACE_POINTS:
            return edge, False
        edge = float(np.median(x))
    return edge, True
