"""The treads of any scene: level facets that look up and are wide enough; pure."""

from collections.abc import Sequence

import numpy as np
import shapely  # type: ignore[import-untyped]
from pydrake.math import RigidTransform, RotationMatrix

from footfall.models.scenes.prisms import GRID, SAME_HEIGHT, SLIVER, Facet, Prism
from footfall.models.scenes.tread import Tread
from footfall.models.values.vector import Vector

LOWEST = 0.01
"""What is lower than this is floor, m."""
RECTANGULAR = 0.995
"""Share of its least rectangle that an area must fill to be one itself."""


def open_facets(facets: Sequence[Facet], prisms: Sequence[Prism]) -> list[Facet]:
    """Takes off the facets what lies under other solids.

    Args:
        facets: of all solids, that look up.
        prisms: all that may stand on them.

    Returns:
        Joined where coplanar, lowest first.
    """
    found: list[Facet] = []
    for facet in sorted(facets, key=lambda item: item.height):
        over = [
            shapely.Polygon(prism.base)
            for prism in prisms
            if prism.low <= facet.height + SAME_HEIGHT < prism.high - SAME_HEIGHT
        ]
        outline = facet.outline
        if over:
            cover = shapely.union_all(over, grid_size=GRID)
            outline = shapely.difference(outline, cover, grid_size=GRID)
        if outline.area < SLIVER:
            continue
        if found and facet.height - found[-1].height < SAME_HEIGHT:
            outline = shapely.union_all([found.pop().outline, outline], grid_size=GRID)
        found.append(Facet(facet.height, outline))
    return found


def level_treads(
    facets: Sequence[Facet], min_side: float, forward: Vector, name: str
) -> tuple[Tread, ...]:
    """Finds the treads among level facets.

    A tread's x goes the way from the treads below to those above, along the side of its
    rectangle that is nearest to it; of a lone one along `forward`.

    Args:
        facets: that look up and that nothing covers.
        min_side: what is narrower is nothing to stand on, m.
        forward: horizontal direction where nothing else tells it, (2,).
        name: what their names begin with; "tread_1" and so on follow, lowest first.
    """
    areas = [
        (facet.height, polygon)
        for facet in sorted(facets, key=lambda item: item.height)
        if facet.height > LOWEST
        for polygon in shapely.get_parts(facet.outline)
        if _least_side(polygon) >= min_side
    ]
    middles = [np.array(_rectangle(polygon).centroid.coords[0]) for _, polygon in areas]
    treads = []
    for number, (height, polygon) in enumerate(areas):
        below = middles[max(number - 1, 0)]
        above = middles[min(number + 1, len(areas) - 1)]
        way = above - below
        if np.linalg.norm(way) < SAME_HEIGHT:
            way = forward
        treads.append(_tread(f"{name}tread_{number + 1}", height, polygon, way))
    return tuple(treads)


def _tread(name: str, height: float, polygon: shapely.Polygon, way: Vector) -> Tread:
    corners = np.asarray(_rectangle(polygon).exterior.coords)[:-1]
    sides = corners[1:3] - corners[:2]
    lengths = np.linalg.norm(sides, axis=1)
    axes = sides / lengths[:, None]
    chosen = int(np.argmax(np.abs(axes @ way)))
    x = axes[chosen] * (1.0 if axes[chosen] @ way >= 0.0 else -1.0)
    yaw = float(np.arctan2(x[1], x[0]))
    p: Vector = np.append(corners.mean(axis=0), height)
    size: Vector = np.array([lengths[chosen], lengths[1 - chosen]])
    full = polygon.area > RECTANGULAR * lengths.prod()
    return Tread(
        name,
        RigidTransform(RotationMatrix.MakeZRotation(yaw), p),
        size,
        None if full else np.asarray(polygon.exterior.coords)[:-1],
    )


def _rectangle(polygon: shapely.Polygon) -> shapely.Polygon:
    return shapely.minimum_rotated_rectangle(polygon)


def _least_side(polygon: shapely.Polygon) -> float:
    rectangle = _rectangle(polygon)
    if rectangle.geom_type != "Polygon":
        return 0.0
    corners = np.asarray(rectangle.exterior.coords)[:3]
    return float(np.linalg.norm(np.diff(corners, axis=0), axis=1).min())
