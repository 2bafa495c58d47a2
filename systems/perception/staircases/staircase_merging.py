"""Merging a new scan into what is known of a staircase.

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 4.3: the higher steps "will be fully
reconstructed after the robot stepping on the lower ones".
"""

from dataclasses import dataclass, replace

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from scipy.spatial import ConvexHull

from footfall.models.values.perceived import (
    PlaneSegment,
    PlaneSegmentation,
    SeenEdges,
    Staircase,
)
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import plane_axes


@dataclass(kw_only=True)
class StaircaseMapParams(Parameters):
    """When a plane of a new scan is one that is known already."""

    height_tolerance: float = number(0.04, "m", above=0.0)
    """Most that the heights differ, m: less than the least rise, more than the drift
    of a robot's own position over a few steps."""
    edge_tolerance: float = number(0.02, "m", above=0.0)
    """Edges this near are two measurements of one edge and are averaged, m; beyond it
    the outer one counts, for hidden parts make a tread look smaller, never larger."""
    min_overlap: float = number(0.3, above=0.0, most=1.0)
    """Least overlap of two rectangles of one tread, as part of the smaller one."""
    max_turn: float = number(0.2, "rad", above=0.0)
    """Most that the directions of two views of one staircase differ, rad."""
    partial_depth: float = number(0.06, least=0.0, most=1.0)
    """How much less deep than the others a last tread whose back was not seen may be,
    as a part of their depth: of a smaller part one waits to see the rest."""
    deep_enough: float = number(0.30, "m", above=0.0)
    """A part of a tread as deep as this is one to stand on, m: a sole and margins."""
    min_landing: float = number(0.45, "m", above=0.0)
    """Least depth of a landing, m."""
    period: float = number(0.025, "s", least=1e-3, most=10.0)
    """How often the map looks for a new sweep, s: the time of one scan line."""


def merge_staircase(
    known: Staircase, seen: PlaneSegmentation, params: StaircaseMapParams
) -> Staircase:
    """Merges a new scan's planes into the known staircase.

    A tread that was seen again is averaged, weighted by support; a view in which part
    of it is hidden does not shrink it. Treads that were not seen stay. New ones are
    added where they go on with the known flight. The floor stays.

    Args:
        known: the staircase so far, in W; empty at first.
        seen: the new scan, in W.
        params: parameters.
    """
    seen = replace(seen, staircase=leave_partial(seen.staircase, params))
    if not known.treads:
        floor = known.floor or seen.staircase.floor
        return replace(seen.staircase, floor=floor)
    treads = list(known.treads)
    left = []
    for tread in seen.staircase.treads:
        match = _match(treads, tread, params)
        if match is None:
            left.append(tread)
        elif _turn(treads[match], tread) <= params.max_turn:
            treads[match] = _merge_treads(treads[match], tread, params)
    # A tread that the robot stands on is seen in part, as a plane and not as a tread.
    for plane in seen.planes:
        match = _match(treads, plane, params)
        if match is not None and plane not in seen.staircase.treads:
            treads[match] = _confirm(treads[match], plane)
    for tread in left:
        if _continues(treads, tread, params):
            treads.append(tread)
    treads.sort(key=_height)
    floor = known.floor
    if floor is None and seen.staircase.floor is not None:
        below = _height(treads[0]) - _height(seen.staircase.floor)
        floor = seen.staircase.floor if below > params.height_tolerance else None
    return Staircase(treads=tuple(treads), floor=floor)


def leave_partial(staircase: Staircase, params: StaircaseMapParams) -> Staircase:
    """Leaves out a last tread that the view cuts off: how far it goes is not known yet.

    Args:
        staircase: what one scan saw.
        params: when a part of a tread is enough.
    """
    if len(staircase.treads) < 2:
        return staircase
    *others, last = staircase.treads
    if last.edges is None or last.edges.back:
        return staircase
    depths = [float(tread.size[0]) for tread in others]
    treads = [depth for depth in depths if depth < params.min_landing]
    usual = np.median(treads or depths)
    whole = last.size[0] >= (1.0 - params.partial_depth) * usual
    if whole or last.size[0] >= params.deep_enough:
        return staircase
    return replace(staircase, treads=staircase.treads[:-1])


def _height(plane: PlaneSegment) -> float:
    """Returns the height of the rectangle's centre, m."""
    p_WR: Vector = plane.X_WR.translation()
    return float(p_WR[2])


def _match(
    treads: list[PlaneSegment], seen: PlaneSegment, params: StaircaseMapParams
) -> int | None:
    """Finds the index of the known tread that `seen` is a view of."""
    best, match = params.min_overlap, None
    for index, tread in enumerate(treads):
        if abs(_height_over(tread, seen)) > params.height_tolerance:
            continue
        overlap = _overlap(tread, seen)
        if overlap >= best:
            best, match = overlap, index
    return match


def _height_over(tread: PlaneSegment, seen: PlaneSegment) -> float:
    """Computes the height of `tread`'s centre over the plane of `seen`, m."""
    p_WTread: Vector = tread.X_WR.translation()
    p_WSeen: Vector = seen.X_WR.translation()
    offset = p_WTread - p_WSeen
    return float(offset @ seen.normal / max(float(seen.normal[2]), 0.1))


def _bounds(tread: PlaneSegment, seen: PlaneSegment) -> tuple[Vector, Vector]:
    """Computes low and high corner of the rectangle of `seen`, in R of `tread`, m."""
    p_R = np.array(tread.X_WR.inverse().multiply(seen.corners().T)).T[:, :2]
    # Means over either side: a small turn between the two does not widen it.
    order_x, order_y = np.sort(p_R[:, 0]), np.sort(p_R[:, 1])
    low = np.array([order_x[:2].mean(), order_y[:2].mean()])
    high = np.array([order_x[2:].mean(), order_y[2:].mean()])
    return low, high


def _overlap(tread: PlaneSegment, seen: PlaneSegment) -> float:
    """Computes the overlap of the rectangles, as part of the smaller one."""
    low, high = _bounds(tread, seen)
    half = tread.size / 2.0
    common = np.clip(np.minimum(high, half) - np.maximum(low, -half), 0.0, None)
    smaller = min(float(np.prod(tread.size)), float(np.prod(high - low)))
    return float(np.prod(common)) / max(smaller, 1e-9)


def _turn(tread: PlaneSegment, seen: PlaneSegment) -> float:
    """Computes the angle between the directions up the stairs, rad."""
    a: Vector = tread.X_WR.rotation().matrix()[:, 0]
    b: Vector = seen.X_WR.rotation().matrix()[:, 0]
    return float(np.arccos(np.clip(a @ b, -1.0, 1.0)))


def _merge_treads(
    known: PlaneSegment, seen: PlaneSegment, params: StaircaseMapParams
) -> PlaneSegment:
    share = seen.support_count / max(seen.support_count + known.support_count, 1)
    normal = (1.0 - share) * known.normal + share * seen.normal
    normal /= np.linalg.norm(normal)
    x_known: Vector = known.X_WR.rotation().matrix()[:, 0]
    x_seen: Vector = seen.X_WR.rotation().matrix()[:, 0]
    axes = plane_axes(normal, (1.0 - share) * x_known + share * x_seen)
    height = -share * _height_over(known, seen)
    origin: Vector = known.X_WR.translation() + np.array([0.0, 0.0, height])
    frame = replace(known, X_WR=RigidTransform(RotationMatrix(axes), origin))
    low_k, high_k = _bounds(frame, known)
    low_s, high_s = _bounds(frame, seen)
    low = -_outer(-low_k, -low_s, share, params.edge_tolerance)
    high = _outer(high_k, high_s, share, params.edge_tolerance)
    center: Vector = origin + axes[:, :2] @ ((low + high) / 2.0)
    corners = np.concatenate([known.polygon, seen.polygon])
    p_R = np.clip((corners - origin) @ axes[:, :2], low, high)
    outline = p_R[ConvexHull(p_R).vertices]
    return PlaneSegment(
        polygon=origin + outline @ axes[:, :2].T,
        X_WR=RigidTransform(RotationMatrix(axes), center),
        size=high - low,
        normal=normal,
        area=max(known.area, seen.area),
        # Not the sum: an early, far view must not outweigh a near one for good.
        support_count=max(known.support_count, seen.support_count),
        edges=_merge_edges(known.edges, seen.edges),
    )


def _merge_edges(a: SeenEdges | None, b: SeenEdges | None) -> SeenEdges | None:
    """Counts an edge as seen that was seen in either view."""
    if a is None or b is None:
        return a or b
    return SeenEdges(
        front=a.front or b.front,
        back=a.back or b.back,
        right=a.right or b.right,
        left=a.left or b.left,
    )


def _outer(known: Vector, seen: Vector, share: float, tolerance: float) -> Vector:
    """Merges edges measured outwards: averaged where they agree, else the outer one."""
    mean = (1.0 - share) * known + share * seen
    agree = np.abs(known - seen) <= tolerance
    return np.where(agree, mean, np.maximum(known, seen))


def _confirm(known: PlaneSegment, seen: PlaneSegment) -> PlaneSegment:
    """Averages the known tread's height with that of a plane that lies on it."""
    share = seen.support_count / max(seen.support_count + known.support_count, 1)
    lift = np.array([0.0, 0.0, -share * _height_over(known, seen)])
    p_WR: Vector = known.X_WR.translation()
    moved: Vector = p_WR + lift
    return replace(
        known,
        polygon=known.polygon + lift,
        X_WR=RigidTransform(known.X_WR.rotation(), moved),
    )


def _continues(
    treads: list[PlaneSegment], seen: PlaneSegment, params: StaircaseMapParams
) -> bool:
    """Tests whether `seen` continues the flight: higher, farther, in line."""
    for tread in treads:
        p_R: Vector = tread.X_WR.inverse().multiply(seen.X_WR.translation())
        climbs = p_R[2] > params.height_tolerance and p_R[0] > 0.0
        descends = p_R[2] < -params.height_tolerance and p_R[0] < 0.0
        if not (climbs or descends) or abs(p_R[1]) > tread.size[1] / 2.0:
            return False
        if _turn(tread, seen) > params.max_turn:
            return False
    return True
