"""Selection of the planes that are the treads of a staircase: the longest chain.

Of planes with the size of a tread or a landing, each a rise above and a run behind the
one before. All of it in a frame G whose z points up. The paper's own way (Sec. 4.3) is
`tread_candidates.largest_size_cluster`.
"""

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import Patch
from footfall.systems.perception.planes.tread_candidates import (
    LEVEL_SLOPE,
    StairLimits,
    is_landing,
)

LANDING_GAP = 0.12
"""Most that a landing's edge, as it was seen, is off that of the tread it adjoins, m:
of a nosing's overhang and of what a riser hides."""
LANDING_OVERLAP = 0.6
"""Least part of the narrower one's width by which both adjoin."""
WEDGE_GAP = 0.06
"""Most that a winding tread and the next are apart in plan, m."""
WEDGE_LIKE = 0.6
"""Least area of the smaller of two winding treads, of the larger's."""
LONGEST_RUN = 0.45
"""Farthest from the front of a tread to that of the next where its back was not seen,
m."""
SHORTEST_RUN = 0.12
"""Least of it, m."""


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
