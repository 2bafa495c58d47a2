"""Flights of stairs among the planes of a cloud, and the floor that they rise from.

What is no staircase is left out: a lone plane that stands as high as a bench, planes
that begin higher above the floor than any rise, a seat whose front was not seen.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.models.robots.robot import Sole
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.levels import Sampling
from footfall.systems.perception.planes.planes import Patch
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.stair_chain import (
    floor_below,
    is_top,
    is_turned,
    longest_chain,
    split_at_turns,
)
from footfall.systems.perception.planes.tread_candidates import (
    StairLimits,
    is_landing,
    landing_candidates,
    largest_size_cluster,
    tread_candidates,
)
from footfall.systems.perception.planes.treads import (
    Tread,
    is_something_behind,
    refine_treads,
    stair_rotation,
    voxel_area,
)

LONE_TRIES = 4
"""Planes that are tried as a lone tread, the lowest first."""
LONE_AREA = 0.06
"""Least area of a lone or winding tread that was seen, m^2: of two soles."""
LIKE_RISE = 1.6
"""Most that a landing or a floor rises above the last tread, of what treads rise."""
RISE_NOISE = 0.01
"""Most that a rise may be off by noise, m."""
MIN_SEEN = 0.5
"""Least part of a tread's rectangle over which points were seen."""
UNDER_ROBOT = 0.4
"""A plane as near to the viewpoint, seen from above, m, is the one it stands on."""


@dataclass(frozen=True, eq=False)
class Flight:
    """A straight flight of stairs."""

    patches: list[int]
    """Its treads' patches, lowest first."""
    yaw: float
    """Direction up the flight in G, rad."""
    treads: list[Tread]
    """The treads' rectangles in its frame."""
    floor: int | None
    """The patch it rises from; None where none was seen."""
    winding: bool = False
    """Whether its treads are wedges; then they have no common frame and no `treads`."""


def find_flights(
    patches: tuple[Patch, ...],
    cloud: Vector,
    params: PlaneSegmenterParams,
    viewpoint: Vector | None,
    sampling: Sampling,
    sole: Sole | None = None,
) -> list[Flight]:
    """Finds the flights of stairs among the patches.

    Args:
        patches: bounded pieces of plane, in G.
        cloud: finite points in G, (n, 3), m.
        params: parameters.
        viewpoint: where they were seen from in G, (3,), m.
        sampling: of the cloud.
        sole: of the robot: a tread that is known from front to back must be as deep
            as it is wide; None for any.

    Returns:
        The flights, those of several treads first; of those the nearest to the
        viewpoint or, without one, the longest. Behind a turn a flight is one of its
        own.
    """
    limits = params.stairs
    if params.staircase_from == "size_cluster":
        return _flights_of_one_size(patches, cloud, params, viewpoint, sampling)
    left = tread_candidates(patches, limits) + landing_candidates(patches, limits)
    left.sort(key=lambda number: float(patches[number].center[2]))
    flights: list[Flight] = []
    lone = 0
    while chain := longest_chain(patches, left, limits):
        if len(chain) == 1:
            lone += 1
            alone = [i for i in left if not is_landing(patches[i], limits)]
            if flights or not alone or lone > LONE_TRIES:
                break
            chain = alone[:1]
        left = [number for number in left if number not in chain]
        for part in split_at_turns(patches, chain, limits):
            flight = _settle(part, patches, cloud, params, viewpoint, sampling, sole)
            if flight is not None:
                flights.append(flight)
    if viewpoint is not None:
        eye = shapely.Point(viewpoint[:2])

        def nearest(flight: Flight) -> tuple[bool, float]:
            first = shapely.Polygon(patches[flight.patches[0]].outline[:, :2])
            return len(flight.patches) < 2, float(first.distance(eye))

        flights.sort(key=nearest)
    return flights


def floor_seen(
    patches: tuple[Patch, ...],
    viewpoint: Vector | None,
    params: PlaneSegmenterParams,
) -> int | None:
    """Finds the floor where there is no staircase: the one under the viewpoint, if any.

    Args:
        patches: bounded pieces of plane, in G.
        viewpoint: where they were seen from in G, (3,), m.
        params: parameters.
    """
    if viewpoint is not None:
        eye = shapely.Point(viewpoint[:2])
        under = [
            i
            for i, patch in enumerate(patches)
            if patch.center[2] < viewpoint[2]
            and shapely.Polygon(patch.outline[:, :2]).distance(eye) <= UNDER_ROBOT
        ]
        if under:
            return max(under, key=lambda i: float(patches[i].center[2]))
    return floor_below(patches, [], params.stairs)


def _flights_of_one_size(
    patches: tuple[Patch, ...],
    cloud: Vector,
    params: PlaneSegmenterParams,
    viewpoint: Vector | None,
    sampling: Sampling,
) -> list[Flight]:
    """Finds the flight as the paper does (Sec. 4.3)."""
    limits = params.stairs
    level = [i for i, patch in enumerate(patches) if patch.extent[2] <= params.max_dz]
    extents = np.array([patches[i].extent for i in level]).reshape(-1, 3)
    chosen = [level[i] for i in largest_size_cluster(extents, limits.size_tolerance)]
    chosen.sort(key=lambda i: float(patches[i].center[2]))
    if not chosen:
        return []
    yaw, treads = refine_treads(
        [patches[i] for i in chosen], cloud, viewpoint, sampling=sampling
    )
    return [Flight(chosen, yaw, treads, floor_below(patches, chosen, limits))]


def is_tread(
    tread: Tread, yaw: float, params: PlaneSegmenterParams, sole: Sole | None
) -> bool:
    """Tells whether a tread whose edges are known is as large as one and whole.

    Args:
        tread: the tread.
        yaw: of its staircase's frame S in G, rad.
        params: limits, and the voxels of which it must cover half its rectangle's.
        sole: of the robot; None for any.
    """
    depth, width = tread.high - tread.low
    least = params.stairs.min_depth
    if sole is not None and tread.drops and tread.ends:
        least = max(least, 2.0 * sole.half_width)
    if width < params.stairs.min_width - RISE_NOISE or depth < least:
        return False
    seen = voxel_area(tread, stair_rotation(yaw), params.voxel_size)
    return bool(seen >= MIN_SEEN * depth * width)


def _is_too_high(flight: list[Patch]) -> bool:
    """Tells whether the last patch stands over the treads as a table at their end does.

    Args:
        flight: the patches, lowest first.
    """
    rises = np.diff([float(patch.center[2]) for patch in flight])
    return bool(len(rises) > 1 and rises[-1] > LIKE_RISE * rises[:-1].max())


def _is_alone(treads: list[Tread], limits: StairLimits) -> bool:
    """Tells whether there is one tread, but for a deeper plane that it leads up to."""
    depths = [float(tread.high[0] - tread.low[0]) for tread in treads]
    return len(depths) == 1 or (
        len(depths) == 2 and depths[1] > (1.0 + limits.depth_tolerance) * depths[0]
    )


def _settle(
    chosen: list[int],
    patches: tuple[Patch, ...],
    cloud: Vector,
    params: PlaneSegmenterParams,
    viewpoint: Vector | None,
    sampling: Sampling,
    sole: Sole | None,
) -> Flight | None:
    """Bounds the treads of a chain; None where it is no staircase."""
    limits = params.stairs
    flight = [patches[i] for i in chosen]
    if len(chosen) == 1 and (
        flight[0].extent[2] > params.max_dz or flight[0].area < LONE_AREA
    ):
        # Of a flight the treads lean alike; a lone plane that leans is a block.
        return None
    landings = [is_landing(patch, limits) for patch in flight]
    if len(flight) > 1 and is_top(flight[-2], flight[-1], limits):
        landings[-1] = True
    if landings[-1] and _is_too_high(flight):
        chosen, flight, landings = chosen[:-1], flight[:-1], landings[:-1]
    straight = [patch for patch, wide in zip(flight, landings, strict=True) if not wide]
    if any(is_turned(a, b, limits) for a, b in pairwise(straight)):
        if any(patch.area < LONE_AREA for patch in flight):
            return None
        floor = floor_below(patches, chosen, limits)
        return Flight(chosen, 0.0, [], floor, winding=True)
    yaw, treads = refine_treads(flight, cloud, viewpoint, landings, sampling)
    if len(treads) > 1 and not treads[-1].ends and not landings[-1]:
        # What the view cuts off is a part of a tread or, where it is deeper than the
        # others, the floor above, which ends the flight as a tread does: but not for
        # one who stands on it and looks down. Of a landing it does not matter.
        depths = [float(tread.high[0] - tread.low[0]) for tread in treads]
        usual = float(np.median(np.array(depths[:-1])[np.logical_not(landings[:-1])]))
        deeper = depths[-1] > (1.0 + limits.depth_tolerance) * usual
        if deeper and viewpoint is not None:
            deeper = float((viewpoint @ stair_rotation(yaw))[0]) > treads[-1].low[0]
        elif deeper:
            deeper = not is_something_behind(treads[-1], cloud @ stair_rotation(yaw))
        if deeper or depths[-1] < limits.min_part * usual:
            chosen, treads = chosen[:-1], treads[:-1]
    good = [is_tread(tread, yaw, params, sole) for tread in treads]
    if not all(good):
        chosen, treads = chosen[: good.index(False)], treads[: good.index(False)]
    if not treads:
        return None
    if not treads[0].drops:
        # Where nothing lower was seen before it, its end in the cloud is that of the
        # view, not its edge: the floor, or the tread that the robot stands on.
        if len(treads) < 2:
            return None
        return Flight(chosen[1:], yaw, treads[1:], chosen[0])
    highest = limits.max_lone_rise if _is_alone(treads, limits) else limits.max_rise
    if treads[0].drop > highest + RISE_NOISE:
        return None
    return Flight(chosen, yaw, treads, floor_below(patches, chosen, limits))
