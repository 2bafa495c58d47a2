"""Selection of the planes that are the treads of a staircase.

Two ways: the paper's (Sec. 4.3: the largest cluster of planes of like size) and, the
default, the longest chain of planes of a tread's size that rise from one to the next.
All of it in a frame G whose z points up.
"""

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
LANDING_GAP = 0.12
"""Most that a landing's edge, as it was seen, is off that of the tread it adjoins, m:
of a nosing's overhang and of what a riser hides."""
LANDING_OVERLAP = 0.6
"""Least part of the narrower one's width by which both adjoin."""
ON_PLANE = 0.03
"""Most that a splinter lies off its plane, m: less than the least rise."""
UNDERSIDE = (0.01, 0.10)
"""How far below its top the underside of an open tread may be, m."""
WEDGE_GAP = 0.06
"""Most that a winding tread and the next are apart in plan, m."""
WEDGE_LIKE = 0.6
"""Least area of the smaller of two winding treads, of the larger's."""
LONGEST_RUN = 0.45
"""Farthest from the front of a tread to that of the next where its back was not seen,
m."""
SHORTEST_RUN = 0.12
"""Least of it, m."""
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


def longest_chain(
    patches: tuple[Patch, ...], candidates: list[int], limits: StairLimits
) -> list[int]:
    """Finds the longest flight: each tread a rise above and a run behind the last.

    A landing follows a tread; none begins a flight.

    Args:
        patches: all patches.
        candidates: indices of those with the size of a tread or a landing, lowest
            first.
        limits: what passes for a staircase.

    Returns:
        Indices of the treads, lowest first; of flights as long the best supported.
    """
    length: dict[int, tuple[int, int]] = {}
    before: dict[int, int | None] = {}
    for upper in candidates:
        support = patches[upper].support
        length[upper], before[upper] = (1, support), None
        for lower in candidates:
            if lower == upper or lower not in length:
                continue
            if not _follows(patches[lower], patches[upper], limits):
                continue
            longer = (length[lower][0] + 1, length[lower][1] + support)
            if longer > length[upper]:
                length[upper], before[upper] = longer, lower
        if before[upper] is None and is_landing(patches[upper], limits):
            del length[upper]
    if not length:
        return []
    last: int | None = max(length, key=lambda number: length[number])
    chain: list[int] = []
    while last is not None:
        chain.append(last)
        last = before[last]
    return chain[::-1]


def _follows(lower: Patch, upper: Patch, limits: StairLimits) -> bool:
    """Tests whether `upper` may be the next tread after `lower`."""
    step = upper.center - lower.center
    rise = float(step[2])
    if not limits.min_rise <= rise <= limits.max_rise:
        return False
    if lower.plane.normal @ upper.plane.normal < np.cos(LEVEL_SLOPE):
        return False
    if is_landing(lower, limits) or is_landing(upper, limits):
        return _adjoins(lower, upper, limits)
    if is_turned(lower, upper, limits):
        return _winds(lower, upper) or is_top(lower, upper, limits)
    axes = (lower.axes[:2, 0], upper.axes[:2, 0])
    wider = max(lower.extent[1], upper.extent[1])
    if min(lower.extent[1], upper.extent[1]) < 0.6 * wider:
        return False
    # Patches of unlike size turn the axis least: measure along the better known one.
    axis = axes[0] if lower.extent[1] >= upper.extent[1] else axes[1]
    along = abs(float(step[:2] @ axis))
    across = abs(float(step[0] * axis[1] - step[1] * axis[0]))
    deepest = (lower.extent[0] + upper.extent[0]) / 2.0
    if across > 0.25 * wider:
        return False
    if 0.5 * deepest <= along <= deepest + 0.15:
        return True
    # Where lines are missing the middles tell nothing; the front edges still do.
    forward = axis if float(step[:2] @ axis) >= 0.0 else -axis
    low, high = lower.outline[:, :2] @ forward, upper.outline[:, :2] @ forward
    run = float(high.min() - low.min())
    behind = float(high.min() - low.max()) >= -LANDING_GAP / 2.0
    return bool(behind and SHORTEST_RUN <= run <= LONGEST_RUN)


def is_top(lower: Patch, upper: Patch, limits: StairLimits) -> bool:
    """Tells whether a patch is what a tread leads up to, though its axis is another.

    Of a floor above, as of a landing, either side may be the shorter one.
    """
    deeper = upper.extent[0] > (1.0 + limits.depth_tolerance) * lower.extent[0]
    return bool(
        deeper and is_turned(lower, upper, limits) and _adjoins(lower, upper, limits)
    )


def split_at_turns(
    patches: tuple[Patch, ...], chain: list[int], limits: StairLimits
) -> list[list[int]]:
    """Splits a chain of treads where its way turns at a landing.

    Returns:
        Straight flights, lowest first; a landing belongs to the one that leads to it.
    """
    flights: list[list[int]] = [[]]
    before: Patch | None = None
    for member in chain:
        patch = patches[member]
        if not is_landing(patch, limits):
            turned = before is not None and is_turned(before, patch, limits)
            if turned and is_landing(patches[flights[-1][-1]], limits):
                flights.append([])
            before = patch
        flights[-1].append(member)
    return flights


def is_turned(a: Patch, b: Patch, limits: StairLimits) -> bool:
    """Tells whether the short sides of two patches point different ways."""
    cosine = abs(float(a.axes[:2, 0] @ b.axes[:2, 0]))
    return bool(cosine < np.cos(limits.max_turn))


def _winds(lower: Patch, upper: Patch) -> bool:
    """Tests whether `upper` may be the wedge after `lower`, about a newel."""
    if min(lower.plane.normal[2], upper.plane.normal[2]) < np.cos(LEVEL_SLOPE):
        return False
    below = shapely.Polygon(lower.outline[:, :2])
    above = shapely.Polygon(upper.outline[:, :2])
    if below.distance(above) > WEDGE_GAP:
        return False
    if below.intersection(above).area > 0.1 * min(below.area, above.area):
        return False
    smaller = min(below.area, above.area)
    if smaller < WEDGE_LIKE * max(below.area, above.area):
        return False
    # A wedge's middle is not that of its rectangle.
    step = np.subtract(above.centroid.coords[0], below.centroid.coords[0])
    reach = abs(float(step @ lower.axes[:2, 0]))
    return bool(reach >= 0.35 * lower.extent[0])


def _adjoins(lower: Patch, upper: Patch, limits: StairLimits) -> bool:
    """Tests whether one of a tread and a landing begins where the other ends.

    Which side of a landing is its depth only the tread's axis tells.
    """
    if is_landing(lower, limits) and is_landing(upper, limits):
        return False
    tread = upper if is_landing(lower, limits) else lower
    forward: Vector = tread.axes[:2, 0]
    if (upper.center - lower.center)[:2] @ forward < 0.0:
        forward = -forward
    axes = np.column_stack([forward, [-forward[1], forward[0]]])
    low, high = lower.outline[:, :2] @ axes, upper.outline[:, :2] @ axes
    gap = high[:, 0].min() - low[:, 0].max()
    ends = np.array([[side.min(), side.max()] for side in (low[:, 1], high[:, 1])])
    shared = ends[:, 1].min() - ends[:, 0].max()
    narrower = float(np.diff(ends, axis=1).min())
    return bool(abs(gap) <= LANDING_GAP and shared >= LANDING_OVERLAP * narrower)


def floor_below(
    patches: tuple[Patch, ...], treads: list[int], limits: StairLimits
) -> int | None:
    """Finds the plane the staircase rises from: the largest within a rise below it.

    A robot on the stairs may see none there; then the largest of all lower planes.
    Without a staircase it is the lowest of those half as large as the largest.
    """
    lowest = np.inf
    if treads:
        lowest = float(patches[treads[0]].center[2]) - limits.min_rise
    below = [
        number
        for number, patch in enumerate(patches)
        if number not in treads and patch.center[2] < lowest
    ]
    if not below:
        return None
    reach = lowest + limits.min_rise - limits.max_rise
    adjacent = [
        number
        for number in below
        if treads and float(patches[number].center[2]) >= reach
    ]
    largest = max(adjacent or below, key=lambda number: patches[number].area)
    if treads:
        return largest
    large = [i for i in below if patches[i].area >= 0.5 * patches[largest].area]
    return min(large, key=lambda number: float(patches[number].center[2]))
