"""Shorter paths by shortcuts, as RRT-Connect's wander."""

from collections.abc import Callable

import numpy as np

from footfall.models.values.vector import Vector


def path_length(points: Vector) -> float:
    """Length of a polyline, (n, 2), m."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def shorten_path(
    points: Vector, is_free: Callable[[Vector], bool], tries: int, seed: int
) -> Vector:
    """Cuts corners where the straight way is free.

    First every corner goes from which a later one is in sight, the latest first; then
    random pairs of points on the path are joined; then corners go once more.

    Args:
        points: a free path, (n, 2), m.
        is_free: whether a segment, (2, 2), m, is free.
        tries: how many random shortcuts to try.
        seed: of these.

    Returns:
        A free path between the same ends, (m, 2), m, never longer.
    """
    path = skip_corners(points, is_free)
    rng = np.random.default_rng(seed)
    for first, last in np.sort(rng.random((tries, 2)), axis=1):
        if len(path) < 3:
            break
        path = _shortcut(path, first, last, is_free)
    return skip_corners(path, is_free)


def _shortcut(
    path: Vector, first: float, last: float, is_free: Callable[[Vector], bool]
) -> Vector:
    """The path with its points at two shares of its length joined, where free."""
    step = np.linalg.norm(np.diff(path, axis=0), axis=1)
    reached = np.concatenate([[0.0], np.cumsum(step)])
    s = np.array([first, last]) * reached[-1]
    legs = np.clip(np.searchsorted(reached, s, side="right") - 1, 0, len(step) - 1)
    if legs[0] == legs[1]:
        return path
    share = (s - reached[legs]) / np.maximum(step[legs], 1e-12)
    ends = path[legs] + share[:, None] * (path[legs + 1] - path[legs])
    if np.linalg.norm(ends[1] - ends[0]) > s[1] - s[0] - 1e-4 or not is_free(ends):
        return path
    return np.vstack([path[: legs[0] + 1], ends, path[legs[1] + 1 :]])


def skip_corners(path: Vector, is_free: Callable[[Vector], bool]) -> Vector:
    """From each corner straight to the farthest one that is in sight.

    Args:
        path: a free path, (n, 2), m.
        is_free: whether a segment, (2, 2), m, is free.

    Returns:
        Some of its corners, (m, 2), m, both ends among them.
    """
    kept = [0]
    while kept[-1] < len(path) - 1:
        here = kept[-1]
        ahead = range(len(path) - 1, here + 1, -1)
        seen = (there for there in ahead if is_free(path[[here, there]]))
        kept.append(next(seen, here + 1))
    return path[kept]
