"""Which planes have the size of a tread or of a landing, and which are parts of one."""

from dataclasses import dataclass

import numpy as np
import shapely  # type: ignore[import-untyped]
from scipy.cluster.hierarchy import fcluster, linkage

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import (
    FittedPlane,
    Patch,
    bound_patch,
    fit_plane,
)

PART_OFFSET = 0.015
"""Most that parts of one tread lie off one plane, m: three times the noise."""
PART_FILL = 0.45
"""Least part of a joined tread's rectangle that was seen."""
ON_PLANE = 0.03
"""Most that a splinter lies off its plane, m: less than the least rise."""
UNDERSIDE = (0.01, 0.10)
"""How far below its top the underside of an open tread may be, m."""
LEVEL_SLOPE = 0.09
"""Steepest tread that is joined from parts or winds, and most that a tread and the
next lean differently, rad."""


@dataclass(kw_only=True)
class StairLimits(Parameters):
    """Limits of what passes for a staircase."""

    min_depth: float = number(0.08, "m", above=0.0)
    """Least depth of a tread, m: less than any sole needs, so that a tread that is
    seen in part still counts."""
    max_depth: float = number(0.60, "m", above=0.0)
    """Largest depth of a tread, m: stairs in gardens have half a metre; a landing has
    more."""
    max_landing: float = number(2.5, "m", above=0.0)
    """Longest side of a landing, m: what is larger is a floor."""
    min_width: float = number(0.30, "m", above=0.0)
    """Least width of a tread, m: two feet side by side."""
    max_width: float = number(6.0, "m", above=0.0)
    """Largest width of a tread, m."""
    min_rise: float = number(0.04, "m", above=0.0)
    """Least rise from a tread to the next, m."""
    max_rise: float = number(0.50, "m", above=0.0)
    """Largest rise from a tread to the next, m. Twice what the paper climbs (0.24), so
    that a staircase too steep to climb is seen for what it is."""
    max_lone_rise: float = number(0.42, "m", above=0.0)
    """Largest rise of a tread that no other follows, m: what stands higher alone, as a
    bench or a box, is no staircase."""
    max_lean: float = number(0.16, "rad", above=0.0)
    """Steepest tread, rad: what leans more is a ramp or a block."""
    min_fill: float = number(0.4, least=0.0, most=1.0)
    """Least part of a tread's rectangle that was seen as its plane: splinters of a
    floor fill theirs less."""
    max_turn: float = number(0.35, "rad", least=0.0)
    """Most that the way to the next tread departs from a tread's own axis, rad."""
    depth_tolerance: float = number(0.06, least=0.0, most=1.0)
    """How much deeper than the others a last tread whose back was not seen may be, as
    a part of their depth: what is deeper is a floor."""
    min_part: float = number(0.5, above=0.0, most=1.0)
    """Least depth of a last tread whose back was not seen, as a part of the others'."""
    max_gap: float = number(0.30, "m", least=0.0)
    """Largest gap between parts of one tread, m: the shadow of a leg."""
    size_tolerance: float = number(0.1, "m", above=0.0)
    """Distance below which two sizes (dx, dy) are of one cluster, m; the paper names
    the clustering, not its distance."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        for name in ("depth", "width", "rise"):
            least, most = getattr(self, f"min_{name}"), getattr(self, f"max_{name}")
            if not least < most:
                raise ValueError(
                    f"max_{name}: must exceed min_{name}, {least:g} m, got {most:g} m"
                )


def largest_size_cluster(extents: Vector, tolerance: float) -> list[int]:
    """Finds the largest cluster of segments in the (dx, dy) plane: the paper's rule.

    Args:
        extents: (dx, dy, dz) of each segment, (n, 3), m.
        tolerance: single-linkage distance, m.

    Returns:
        Indices of the cluster's segments; of clusters as large the one with the
        smallest segments, for the others are floors and landings.
    """
    if len(extents) < 2:
        return list(range(len(extents)))
    labels = fcluster(linkage(extents[:, :2]), tolerance, criterion="distance")
    best = max(
        np.unique(labels),
        key=lambda label: (
            np.count_nonzero(labels == label),
            -float(np.prod(extents[labels == label, :2], axis=1).mean()),
        ),
    )
    return [int(i) for i in np.flatnonzero(labels == best)]


def join_parts(patches: tuple[Patch, ...], limits: StairLimits) -> tuple[Patch, ...]:
    """Joins the parts of a tread that something stands before, as the robot's knees.

    Parts are level, of one plane, no farther apart than `max_gap`, and together no
    larger than a tread.

    Args:
        patches: all patches.
        limits: what passes for a staircase.

    Returns:
        The patches, those joined in the place of their first part.
    """
    joined = list(patches)
    tries = [
        (i, k)
        for k in range(len(patches))
        for i in range(k)
        if _may_be_parts(patches[i], patches[k], limits)
    ]
    place = list(range(len(patches)))
    for i, k in tries:
        i, k = place[i], place[k]
        if i == k:
            continue
        whole = _join(joined[i], joined[k], limits)
        if whole is not None:
            joined[min(i, k)] = whole
            place = [min(i, k) if at in (i, k) else at for at in place]
    return tuple(joined[i] for i in sorted(set(place)))


def _may_be_parts(a: Patch, b: Patch, limits: StairLimits) -> bool:
    between = b.center - a.center
    return bool(
        abs(between[2]) <= PART_OFFSET + LEVEL_SLOPE * np.hypot(*between[:2])
        and np.hypot(*between[:2]) <= limits.max_width
        and max(a.extent[0], b.extent[0]) <= limits.max_depth
        and max(a.extent[1], b.extent[1]) <= limits.max_width
        and min(a.plane.normal[2], b.plane.normal[2]) >= np.cos(LEVEL_SLOPE)
        and shapely.distance(
            shapely.Polygon(a.outline[:, :2]), shapely.Polygon(b.outline[:, :2])
        )
        <= limits.max_gap
    )


def _join(a: Patch, b: Patch, limits: StairLimits) -> Patch | None:
    """Merges both parts' points to a patch; None where that is no tread."""
    points = np.concatenate([a.points, b.points])
    point, normal = fit_plane(points)
    if np.percentile(np.abs((points - point) @ normal), 95.0) > PART_OFFSET:
        return None
    inliers = np.concatenate([a.plane.inliers, b.plane.inliers])
    whole = bound_patch(FittedPlane(point, normal, inliers), points, a.area + b.area)
    if whole is None:
        return None
    fits = whole.extent[0] <= limits.max_depth and whole.extent[1] <= limits.max_width
    filled = whole.area >= PART_FILL * whole.extent[0] * whole.extent[1]
    return whole if fits and filled else None


def tread_candidates(patches: tuple[Patch, ...], limits: StairLimits) -> list[int]:
    """Selects the patches with the size of a tread, lowest first.

    The paper's bound on dz (Sec. 4.3) would lose wide treads where gravity is a degree
    off; the slope of all patches is bounded already. Splinters of a larger plane and
    undersides of treads are none.
    """
    chosen = [
        number
        for number, patch in enumerate(patches)
        if limits.min_depth <= patch.extent[0] <= limits.max_depth
        and limits.min_width <= patch.extent[1] <= limits.max_width
        and patch.plane.normal[2] >= np.cos(limits.max_lean)
        and patch.area >= limits.min_fill * patch.extent[0] * patch.extent[1]
        and not _is_splinter(patch, patches, limits)
        and not _is_covered(patch, patches)
    ]
    return sorted(chosen, key=lambda number: float(patches[number].center[2]))


def _is_splinter(patch: Patch, patches: tuple[Patch, ...], limits: StairLimits) -> bool:
    """Tells whether a patch lies in the plane of one too large for a tread."""
    return any(
        other.area > patch.area
        and (other.extent[0] > limits.max_depth or other.extent[1] > limits.max_width)
        and abs((patch.center - other.plane.point) @ other.plane.normal) <= ON_PLANE
        for other in patches
    )


def _is_covered(patch: Patch, patches: tuple[Patch, ...]) -> bool:
    """Tells whether a patch is the underside of the one right above it."""
    for other in patches:
        height = float(other.center[2] - patch.center[2])
        if not UNDERSIDE[0] < height < UNDERSIDE[1]:
            continue
        own = shapely.Polygon(patch.outline[:, :2])
        above = shapely.Polygon(other.outline[:, :2])
        if own.intersection(above).area > 0.5 * own.area:
            return True
    return False


def is_landing(patch: Patch, limits: StairLimits) -> bool:
    """Tells whether a patch is too deep for a tread."""
    return bool(patch.extent[0] > limits.max_depth)


def landing_candidates(patches: tuple[Patch, ...], limits: StairLimits) -> list[int]:
    """Selects the patches with the size of a landing, lowest first.

    The lowest patch in view is none: it is the floor, or a part of it.
    """
    level = list(range(len(patches)))
    level.sort(key=lambda number: float(patches[number].center[2]))
    return [
        number
        for number in level[1:]
        if is_landing(patches[number], limits)
        and patches[number].extent[1] <= limits.max_landing
    ]
