"""Convex polygons against shapely and by hand."""

import numpy as np
import pytest
from shapely import MultiPoint, Point, Polygon, box
from shapely.geometry.base import BaseGeometry

from footfall.systems.balance.convex_polygon import (
    area,
    clip_square,
    hausdorff_distance,
    signed_margin,
    simplified,
)

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])


def half_planes(polygon: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit normals and offsets of a counter-clockwise polygon's edges."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    normals = np.column_stack([edges[:, 1], -edges[:, 0]])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return normals, (normals * polygon).sum(axis=1)


def test_clipping_by_its_edges_gives_a_polygon_back() -> None:
    """Also with redundant and repeated half planes among them."""
    rng = np.random.default_rng(0)
    for _ in range(50):
        hull = MultiPoint(rng.uniform(-1.0, 1.0, (9, 2))).convex_hull
        polygon = np.array(hull.exterior.coords)[:0:-1]
        if area(polygon) < 0.0:
            polygon = polygon[::-1]
        normals, offsets = half_planes(polygon)
        angles = rng.uniform(0.0, 2.0 * np.pi, 40)
        loose = np.column_stack([np.cos(angles), np.sin(angles)])
        normals = np.vstack([normals, loose, normals])
        offsets = np.concatenate([offsets, np.full(40, 1.5), offsets + 1e-14])
        vertices = clip_square(normals, offsets, 5.0)
        assert len(vertices) == len(polygon)
        assert hausdorff_distance(vertices, polygon) < 1e-11
        assert area(vertices) == pytest.approx(hull.area)


def test_clipping_by_nothing_and_by_too_much() -> None:
    """The square itself; nothing."""
    whole = clip_square(np.zeros((0, 2)), np.zeros(0), 3.0)
    assert area(whole) == pytest.approx(36.0)
    opposed = np.array([[1.0, 0.0], [-1.0, 0.0]])
    assert clip_square(opposed, np.array([-0.1, -0.1]), 3.0).shape == (0, 2)


def test_simplified_drops_what_says_nothing() -> None:
    """Repeated vertices and those on a straight edge, round the end too."""
    spoiled = np.array(
        [[0, 0], [1, 0], [2, 0], [2, 0], [2, 2], [1, 2], [0, 2], [0, 1], [0, 0]],
        dtype=float,
    )
    kept = simplified(spoiled)
    assert hausdorff_distance(kept, SQUARE) == 0.0
    assert len(kept) == 4
    assert simplified(np.ones((3, 2))).shape == (1, 2)
    assert simplified(np.array([[0.0, 0], [1, 0], [0.5, 0]])).shape == (2, 2)


@pytest.mark.parametrize("shape", [box(0, 0, 2, 2), Polygon([(0, 0), (3, 1), (1, 2)])])
def test_margin_is_shapely_s_distance(shape: BaseGeometry) -> None:
    """To the boundary, negative outside."""
    polygon = np.array(shape.exterior.coords)[:-1]
    polygon = polygon if area(polygon) > 0.0 else polygon[::-1]
    rng = np.random.default_rng(1)
    for point in rng.uniform(-1.0, 4.0, (100, 2)):
        sign = 1.0 if shape.contains(Point(point)) else -1.0
        expected = sign * shape.exterior.distance(Point(point))
        assert signed_margin(polygon, point) == pytest.approx(expected)


def test_margin_of_what_has_no_inside() -> None:
    """A segment and a point are left by any step aside; nothing is infinitely far."""
    segment = np.array([[0.0, 0.0], [2.0, 0.0]])
    assert signed_margin(segment, np.array([1.0, 0.0])) == 0.0
    assert signed_margin(segment, np.array([1.0, 0.3])) == pytest.approx(-0.3)
    assert signed_margin(segment[:1], np.array([3.0, 4.0])) == pytest.approx(-5.0)
    assert signed_margin(np.zeros((0, 2)), np.zeros(2)) == -np.inf


def test_hausdorff_distance() -> None:
    """Of a shifted square, of a part, of nothing."""
    shifted = SQUARE + np.array([0.1, 0.0])
    assert hausdorff_distance(SQUARE, shifted) == pytest.approx(0.1)
    for a, b in ((SQUARE, SQUARE * 0.5), (SQUARE * 0.5, SQUARE)):
        assert hausdorff_distance(a, b) == pytest.approx(np.sqrt(2.0))
    assert hausdorff_distance(np.zeros((0, 2)), SQUARE) == np.inf
    assert hausdorff_distance(np.zeros((0, 2)), np.zeros((0, 2))) == 0.0
