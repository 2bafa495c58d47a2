"""Stability polygons of the CoM and the ZMP on contacts at any tilt.

The stair paper's Sec. 6.2: the gravito-inertial wrench cone, cut by the question (at
rest, accelerating, pushing through a ZMP). The cone's rows come from double
description, all of them; or, in half the time, only those that the question meets, by
walking round the polygon. No polygon is returned unchecked. Rows are taken only where
the generators prove them, so that the polygon cannot be too small; every vertex is then
proven by contact forces (the first phase of a linear programme, by non-negative least
squares), so that it cannot be too large. Where a proof fails the next method is asked,
in the end linear programmes, and the answer is marked.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np
from scipy.optimize import nnls

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import Contact
from footfall.systems.balance.convex_polygon import clip_square
from footfall.systems.balance.gravito_inertial_cone import (
    centred_generators,
    cone_of_generators,
    proven_rows,
    span,
)
from footfall.systems.balance.section_walk import section_rows
from footfall.systems.balance.stability_projection import LinearProgrammeError, project
from footfall.systems.balance.wrench_slice import (
    WrenchSlice,
    accelerated_slice,
    static_slice,
    zmp_slice,
)

Status: TypeAlias = Literal[
    "ok", "degenerate", "unbounded", "infeasible", "no_contact", "solver_failed"
]
Method: TypeAlias = Literal["section", "double_description", "projection"]

_ATTEMPTS: dict[Method, tuple[Method, ...]] = {
    "section": ("section", "double_description"),
    "double_description": ("double_description",),
    "projection": (),
}
"""Methods asked in turn until an answer passes its check."""
HALF_SIDE = 10.0
"""An unbounded polygon is clipped to a square of twice this about the contacts, m."""
_UNREACHED = 1e-9
"""A wrench further than this from the cone, in weights (and m), is outside it."""
_FLAT = 1e-9
"""A row whose part in the plane is shorter holds for every point or for none, 1."""


@dataclass(frozen=True, eq=False)
class StabilityPolygon(Value):
    """A polygon, how it was found, and what it means when it is empty."""

    vertices: Vector = field(default_factory=lambda: np.zeros((0, 2)))
    """(n, 2) in W, m, counter-clockwise; one for a point, two for a segment."""
    status: Status = "infeasible"
    """"ok"; "degenerate": a point or a segment; "unbounded": contacts can brace
    against each other, clipped to a square of 2 `HALF_SIDE`; "infeasible": no point;
    "no_contact"; "solver_failed": neither method gave an answer."""
    method: Method = "section"
    """Whose vertices these are."""
    caught: bool = False
    """Whether a faster method gave an answer that the check refused."""


def static_polygon(
    contacts: Sequence[Contact], method: Method = "section"
) -> StabilityPolygon:
    """Computes the static-stability polygon of the CoM (stair paper, Eqs. 4 and 5).

    sum f_i = m (p''_G - g) (4), sum p_i x f_i + tau_i = m p_G x (p''_G - g) + L'_G (5),
    with p''_G = L'_G = 0: all p_G for which there are f_i, tau_i within their cones.

    Args:
        contacts: the stance.
        method: "section" for the rows that bound it, "double_description" for those
            of the whole cone, "projection" for Bretl and Lall's linear programmes.

    Returns:
        The polygon of the CoM's (x, y), whatever its height.
    """
    return _polygon(contacts, lambda p_WQ: [static_slice()], method)


def robust_polygon(
    contacts: Sequence[Contact],
    com_height: float,
    acceleration_bound: Vector,
    method: Method = "double_description",
) -> StabilityPolygon:
    """Computes where the CoM may be and still accelerate any way within bounds.

    Args:
        contacts: the stance.
        com_height: z of the CoM in W, m.
        acceleration_bound: largest |a_WCom| along x, y and z, (3,), m/s^2.
        method: "section" for the rows that bound it, "double_description" for those
            of the whole cone (one serves all eight corners of the bounds),
            "projection" for linear programmes.

    Returns:
        The polygon of the CoM's (x, y) at that height; its angular momentum is kept.

    Raises:
        ValueError: a bound is negative or not finite.
    """
    bound = np.asarray(acceleration_bound, dtype=np.float64)
    if bound.shape != (3,) or not (np.isfinite(bound).all() and bound.min() >= 0.0):
        raise ValueError(
            f"acceleration_bound: must be three values of at least 0, got {bound}"
        )
    signs = [np.array([-1.0, 1.0]) if limit > 0.0 else np.zeros(1) for limit in bound]
    corners = np.array(np.meshgrid(*signs)).reshape(3, -1).T * bound

    def slices(p_WQ: Vector) -> list[WrenchSlice]:
        return [accelerated_slice(a, com_height - p_WQ[2]) for a in corners]

    return _polygon(contacts, slices, method)


def zmp_support_area(
    contacts: Sequence[Contact],
    p_WCom: Vector,
    plane_height: float,
    method: Method = "section",
) -> StabilityPolygon:
    """Computes the ZMP support area of a CoM that keeps its height.

    Caron, Pham and Nakamura, "ZMP support areas for multi-contact mobility under
    frictional constraints" (T-RO 2017), in the mode of the linear pendulum. On level
    ground with friction enough it is the hull of the soles.

    Args:
        contacts: the stance.
        p_WCom: the CoM, (3,), m.
        plane_height: z of the horizontal plane in which the ZMP is taken, m.
        method: "section" for the rows that bound it, "double_description" for those
            of the whole cone, "projection" for linear programmes.

    Returns:
        The area in that plane.

    Raises:
        ValueError: the CoM lies in the plane.
    """

    def slices(p_WQ: Vector) -> list[WrenchSlice]:
        return [zmp_slice(p_WCom - p_WQ, plane_height - p_WQ[2])]

    return _polygon(contacts, slices, method)


def required_friction(
    contacts: Sequence[Contact], com: Vector | None = None, limit: float = 100.0
) -> float:
    """Computes the least friction, the same at every contact, of a standing robot.

    Args:
        contacts: the stance; their own friction is not used.
        com: (x, y) of the CoM, (2,), m; None for the CoM that needs least.
        limit: no friction above this is tried.

    Returns:
        mu of the pyramids, to 1e-7; infinity where no friction up to `limit` is enough
        or there is no contact.
    """
    if len(contacts) == 0:
        return float("inf")

    def stands(mu: float) -> bool:
        G, p_WQ = centred_generators(
            [Contact(c.X_WC, c.half_length, c.half_width, mu) for c in contacts]
        )
        if com is None:
            return _exists(G, [static_slice()])
        return _reaches(G, static_slice().at((com - p_WQ[:2])[None])[0])

    if not stands(limit):
        return float("inf")
    low, high = 0.0, limit
    if stands(low):
        return 0.0
    while high - low > 1e-7:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if stands(middle) else (middle, high)
    return high


_Slices: TypeAlias = Callable[[Vector], list[WrenchSlice]]


def _polygon(
    contacts: Sequence[Contact], slices_about: _Slices, method: Method
) -> StabilityPolygon:
    """Computes the points for which every slice's wrench lies in the stance's cone."""
    if len(contacts) == 0:
        return StabilityPolygon(status="no_contact", method=method)
    G, p_WQ = centred_generators(contacts)
    slices = slices_about(p_WQ)
    caught = False
    for attempt in () if _loses_a_dimension(G, slices) else _ATTEMPTS[method]:
        rows = _rows(attempt, G, p_WQ, slices)
        vertices = np.zeros((0, 2)) if rows is None else _clip(rows, slices)
        if len(vertices) > 2 and _proven(G, slices, vertices):
            return _result(vertices, p_WQ, attempt, caught)
        if not _exists(G, slices):
            return StabilityPolygon(method=attempt, caught=len(vertices) > 0)
        caught = caught or rows is not None
    try:
        vertices = project(G, slices, HALF_SIDE)
    except LinearProgrammeError:
        return StabilityPolygon(
            status="solver_failed", method="projection", caught=caught
        )
    return _result(vertices, p_WQ, "projection", caught)


def _rows(
    method: Method, G: Vector, p_WQ: Vector, slices: list[WrenchSlice]
) -> list[Vector] | None:
    """Selects the proven rows of each slice, (k, 6); none if the method fails."""
    if method == "double_description":
        return [cone_of_generators(G, p_WQ).rows] * len(slices)
    sections = []
    for part in slices:
        rows = section_rows(G, part)
        if rows is None:
            return None
        sections.append(proven_rows(rows, G))
    return sections


def _result(
    vertices: Vector, p_WQ: Vector, method: Method, caught: bool
) -> StabilityPolygon:
    status: Status = "ok"
    if len(vertices) == 0:
        status = "infeasible"
    elif np.abs(vertices).max() > HALF_SIDE - 1e-6:
        status = "unbounded"
    elif len(vertices) < 3:
        status = "degenerate"
    return StabilityPolygon(vertices + p_WQ[:2], status, method, caught)


def _loses_a_dimension(G: Vector, slices: list[WrenchSlice]) -> bool:
    """Tests whether the cone is flat across a slice: the answer is a segment or point.

    Half planes cannot tell such an answer from none; linear programmes can.
    """
    normals = span(G)[1]
    return len(normals) > 0 and any(
        np.abs(normals @ np.column_stack([part.w_0, part.W])).max() > _UNREACHED
        for part in slices
    )


def _clip(rows: list[Vector], slices: list[WrenchSlice]) -> Vector:
    """Clips the square with the slices' half planes."""
    normals = np.vstack([H @ part.W for H, part in zip(rows, slices, strict=True)])
    offsets = np.concatenate(
        [-H @ part.w_0 for H, part in zip(rows, slices, strict=True)]
    )
    length = np.sqrt((normals * normals).sum(axis=1))
    bounds = length > _FLAT
    if (offsets[~bounds] < -_UNREACHED).any():
        return np.zeros((0, 2))
    normals, offsets, length = normals[bounds], offsets[bounds], length[bounds]
    return clip_square(normals / length[:, None], offsets / length, HALF_SIDE)


def _proven(G: Vector, slices: list[WrenchSlice], vertices: Vector) -> bool:
    """Tests whether contact forces exist for every vertex."""
    return all(_reaches(G, wrench) for part in slices for wrench in part.at(vertices))


def _reaches(G: Vector, wrench: Vector) -> bool:
    """Tests whether w = G l for some l >= 0."""
    try:
        distance = nnls(G, wrench)[1]
    except RuntimeError:
        # It ran out of iterations: not proven.
        return False
    return bool(distance <= _UNREACHED)


def _exists(G: Vector, slices: list[WrenchSlice]) -> bool:
    """Tests whether each slice has a point; yes where the solver gives up."""
    for part in slices:
        U = np.linalg.svd(part.W)[0]
        across = U[:, 2:].T
        try:
            if nnls(across @ G, across @ part.w_0)[1] > _UNREACHED:
                return False
        except RuntimeError:
            continue
    return True
