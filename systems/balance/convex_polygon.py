"""Convex polygons in the plane: from half planes, and how far inside a point is."""

import math

import numpy as np

from footfall.models.values.vector import Vector

_TOUCH = 1e-12
"""Distance outside a half plane that counts as on its edge, m."""


def clip_square(normals: Vector, offsets: Vector, half_side: float) -> Vector:
    """Intersects a square about the origin with half planes.

    Cuts by the half planes that the corners violate most, until none is violated: a
    few cuts more than the result has edges, however many half planes there are.

    Args:
        normals: unit normals, (k, 2).
        offsets: (k,), m; a half plane is n p <= offset.
        half_side: half the side of the square, m.

    Returns:
        Vertices, (n, 2), m, counter-clockwise; (0, 2) where nothing is left.
    """
    r = half_side
    vertices = [(-r, -r), (r, -r), (r, r), (-r, r)]
    while vertices:
        outside = normals @ np.array(vertices).T - offsets[:, None]
        violated = outside.max(axis=1, initial=-np.inf) > _TOUCH
        if not violated.any():
            break
        # A half plane that holds everywhere goes on to hold on what is left.
        normals, offsets, outside = (
            normals[violated],
            offsets[violated],
            outside[violated],
        )
        worst = sorted(set(outside.argmax(axis=0).tolist()))
        for normal, offset in zip(
            normals[worst].tolist(), offsets[worst].tolist(), strict=True
        ):
            vertices = _cut(vertices, normal, offset)
    return simplified(np.array(vertices).reshape(-1, 2))


def _cut(
    vertices: list[tuple[float, float]], normal: list[float], offset: float
) -> list[tuple[float, float]]:
    """Cuts the polygon with a half plane."""
    if not vertices:
        return vertices
    n_x, n_y = normal
    kept = []
    x_0, y_0 = vertices[-1]
    d_0 = n_x * x_0 + n_y * y_0 - offset
    for x, y in vertices:
        d = n_x * x + n_y * y - offset
        if (d < 0.0 < d_0) or (d_0 < 0.0 < d):
            t = d_0 / (d_0 - d)
            kept.append((x_0 + t * (x - x_0), y_0 + t * (y - y_0)))
        if d <= 0.0:
            kept.append((x, y))
        x_0, y_0, d_0 = x, y, d
    return kept


def simplified(vertices: Vector, tolerance: float = 1e-10) -> Vector:
    """Removes vertices that repeat one or lie on a straight edge.

    Args:
        vertices: (n, 2), m, counter-clockwise.
        tolerance: what counts as the same place, m.

    Returns:
        The remaining vertices, in order; one for a point, two for a segment.
    """
    kept: list[list[float]] = np.asarray(vertices, dtype=np.float64).tolist()
    i = 0
    while len(kept) > 1 and i < len(kept):
        (a_x, a_y), (b_x, b_y) = kept[i - 1], kept[i]
        c_x, c_y = kept[(i + 1) % len(kept)]
        chord_x, chord_y, x, y = c_x - a_x, c_y - a_y, b_x - a_x, b_y - a_y
        length = math.hypot(chord_x, chord_y)
        if math.hypot(x, y) <= tolerance or (
            len(kept) > 2
            and abs(chord_x * y - chord_y * x) <= tolerance * length
            and 0.0 <= chord_x * x + chord_y * y <= length**2
        ):
            del kept[i]
            i = max(i - 1, 0)
        else:
            i += 1
    return np.array(kept).reshape(-1, 2)


def signed_margin(vertices: Vector, point: Vector) -> float:
    """Computes the signed distance of a point to a convex polygon's edge.

    Args:
        vertices: (n, 2), m, counter-clockwise; one is a point, two a segment.
        point: (2,), m.

    Returns:
        Distance to the nearest edge, m, positive inside; minus the distance to the
        polygon outside; minus infinity where there is no polygon.
    """
    if len(vertices) == 0:
        return float("-inf")
    # A handful of vertices: plain numbers take a fifth of the time of arrays.
    p_x, p_y = float(point[0]), float(point[1])
    corners = vertices.tolist()
    nearest, inside = math.inf, len(corners) > 2
    for (x, y), (next_x, next_y) in zip(
        corners, corners[1:] + corners[:1], strict=True
    ):
        edge_x, edge_y, to_x, to_y = next_x - x, next_y - y, p_x - x, p_y - y
        squared = edge_x * edge_x + edge_y * edge_y
        along = (to_x * edge_x + to_y * edge_y) / (squared if squared > 0.0 else 1.0)
        along = min(max(along, 0.0), 1.0)
        off_x, off_y = to_x - along * edge_x, to_y - along * edge_y
        nearest = min(nearest, off_x * off_x + off_y * off_y)
        inside = inside and edge_x * to_y - edge_y * to_x >= 0.0
    distance = math.sqrt(nearest)
    return distance if inside else -distance


def area(vertices: Vector) -> float:
    """Computes the area of a polygon, (n, 2), counter-clockwise, m^2."""
    x, y = vertices.T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def hausdorff_distance(a: Vector, b: Vector) -> float:
    """Computes the Hausdorff distance of two convex polygons, (n, 2), m.

    Infinity where one of them is empty and the other is not.
    """
    if len(a) == 0 or len(b) == 0:
        return 0.0 if len(a) == len(b) else float("inf")
    return max(
        max(-signed_margin(b, vertex) for vertex in a),
        max(-signed_margin(a, vertex) for vertex in b),
        0.0,
    )
