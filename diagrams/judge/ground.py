"""What a sole should stand on, and whether it stands flat on it; pure."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely  # type: ignore[import-untyped]
from pydrake.math import RigidTransform

from footfall.models.scenes.tread import Tread
from footfall.models.values.geometry import rectangle_corners_world
from footfall.models.values.vector import Vector

ABOVE = 0.005
"""A corner of a sole that stands flat is at most this far above the ground, m."""
DEEP = 0.003
"""And at most this deep in it, m."""
SOLE_ON_GROUND = 0.75
"""Share of a sole's area that must lie over the ground for it to stand there; a heel
may overhang, as climbing a high step with short treads requires."""


@dataclass(frozen=True)
class Ground:
    """A level surface that soles may stand on."""

    name: str
    """In messages, e.g. "the floor"."""
    X_WR: RigidTransform
    """z out of it, origin at the middle of the rectangle."""
    size: Vector | None = None
    """Lengths of the rectangle along x and y, (2,), m; None where it has no end."""
    corners: Vector | None = None
    """Where it is no rectangle its outline in W seen from above, (n, 2), m."""

    def outline(self) -> shapely.Polygon | None:
        """Computes the outline in W seen from above; None where it has no end."""
        if self.corners is not None:
            return shapely.Polygon(self.corners)
        if self.size is None:
            return None
        return shapely.Polygon(rectangle_corners_world(self.X_WR, self.size)[:, :2])


FLOOR = Ground("the floor", RigidTransform())
"""z = 0."""


def tread_ground(tread: Tread, name: str) -> Ground:
    """Makes ground of a tread, called by a name."""
    return Ground(name, tread.X_WR, tread.size, tread.outline)


def end_ground(treads: Sequence[Tread]) -> Ground:
    """Finds what a robot stands on in the end: the last tread, or the floor."""
    return tread_ground(treads[-1], "the top tread") if treads else FLOOR


def corner_heights(corners: Vector, ground: Ground) -> Vector:
    """Height of a sole's corners above the ground, (n, 4), m.

    Args:
        corners: (n, 4, 3), m.
        ground: which.
    """
    inverse = ground.X_WR.inverse().GetAsMatrix4()
    return np.asarray(corners @ inverse[2, :3] + inverse[2, 3])


def sole_outlines(corners: Vector) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """Soles seen from above as polygons, (n,).

    Args:
        corners: (n, 4, 3), m.
    """
    outlines: np.ndarray[tuple[int], np.dtype[np.object_]] = shapely.polygons(
        np.ascontiguousarray(corners[:, :, :2])
    )
    return outlines


def carried_outlines(
    corners: Vector, ground: Ground
) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """Computes the part of each sole that lies over the ground, polygons, (n,).

    Args:
        corners: (n, 4, 3), m.
        ground: which.
    """
    outline = ground.outline()
    soles = sole_outlines(corners)
    if outline is None:
        return soles
    carried: np.ndarray[tuple[int], np.dtype[np.object_]] = shapely.intersection(
        soles, outline
    )
    return carried


def share_over(corners: Vector, ground: Ground) -> Vector:
    """Share of each sole's area that lies over the ground, (n,).

    Args:
        corners: (n, 4, 3), m.
        ground: which.
    """
    if ground.size is None:
        return np.ones(len(corners))
    whole = shapely.area(sole_outlines(corners))
    share: Vector = shapely.area(carried_outlines(corners, ground)) / whole
    return share


def stands_flat(corners: Vector, ground: Ground) -> np.ndarray[tuple[int], np.dtype]:
    """Tells whether a sole stands flat on the ground, (n,): at its height and over it.

    What is not finite does not.

    Args:
        corners: (n, 4, 3), m.
        ground: which.
    """
    finite = np.asarray(np.isfinite(corners).all(axis=(1, 2)))
    height = corner_heights(np.where(finite[:, None, None], corners, 0.0), ground)
    level = (height.max(axis=1) <= ABOVE) & (height.min(axis=1) >= -DEEP)
    flat: np.ndarray[tuple[int], np.dtype] = np.logical_and(finite, level)
    flat[flat] = share_over(corners[flat], ground) >= SOLE_ON_GROUND
    return flat
