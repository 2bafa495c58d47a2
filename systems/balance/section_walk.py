"""The few rows of a gravito-inertial cone that bound a question's polygon.

Double description gives every row of the six-dimensional cone, some 170 for two soles,
of which a polygon has six to twelve as edges. Here the boundary of the polygon alone
is walked, edge by edge: the simplex method under an objective that turns once round
(the shadow-vertex method: Gass and Saaty, "The computational algorithm for the
parametric objective function", 1955). Each pivot is one corner of the polygon, and
each direction in which two pivots tie is one edge: a row of the cone.
"""

import math

import numpy as np
from scipy.optimize import nnls

from footfall.models.values.vector import Vector
from footfall.systems.balance.wrench_slice import WrenchSlice

_JITTER = 1e-9
"""Every generator pushes by about this much more, in weights, during the walk: corners
in which many sets of forces meet fall apart into as many close ones, and the walk
cannot turn on the spot. It chooses the rows only; they are computed without it."""
_SHORT = 1e-8
"""A shorter edge is one of the jitter's, m."""
_PARALLEL = 1e-12
"""Edges that turn by less are one edge in pieces, rad."""
_ONCE_ROUND = 2.0 * math.pi + 1e-6
"""A little over, so that an edge that faces the first direction is not missed, rad."""
_PIVOT = 1e-11
"""Smaller entries of the tableau count as zero."""
_MAX_PIVOTS = 500
"""More than any stance of contacts that a robot has hands and feet for."""


def section_rows(generators: Vector, part: WrenchSlice) -> Vector | None:
    """Selects the cone's rows that bound the section of the points' wrenches.

    Args:
        generators: of the cone, (6, m), unit columns.
        part: the question; its W of rank two.

    Returns:
        H, (k, 6), unit rows, H w <= 0, in the order of the polygon's edges,
        counter-clockwise, unproven. None where there is no boundary to walk: no
        point, one reached with fewer than four generators however they are pushed
        (ice), or a polygon that goes on to infinity.
    """
    count = generators.shape[1]
    U, singular, Vt = np.linalg.svd(part.W)
    across = U[:, 2:].T
    along = Vt.T @ (U[:, :2] / singular).T
    # The forces l >= 0 with E l = e make the wrench of some point, C l - along w_0.
    E, e = across @ generators, across @ part.w_0
    C = along @ generators
    push = _JITTER * (1.0 + np.arange(count) * 0.6180339887 % 1.0)
    try:
        forces, _ = nnls(E, e + E @ push)
    except RuntimeError:
        return None
    basis = np.flatnonzero(forces)
    # Where no forces reach the slice, those that come nearest are three at most.
    if len(basis) != 4:
        return None
    edges = _walk(E, C, forces, basis.tolist())
    if len(edges) == 0:
        return None
    directions = np.array([direction for direction, _ in edges])
    bases = np.array([basis for _, basis in edges])
    # The multipliers y of E l = e: d C l - y E l <= 0 for all l >= 0, 0 on the edge.
    y = np.linalg.solve(
        E[:, bases].transpose(1, 2, 0),
        np.einsum("kd,dkb->kb", directions, C[:, bases])[:, :, None],
    )[:, :, 0]
    rows = directions @ along - y @ across
    return np.asarray(rows / np.sqrt((rows * rows).sum(axis=1))[:, None])


def _walk(
    E: Vector, C: Vector, forces: Vector, basis: list[int]
) -> list[tuple[tuple[float, float], list[int]]]:
    """Finds outward direction and a basis of every edge; none if unbounded."""
    count = E.shape[1]
    columns = list(basis)
    # Below the four rows of forces, two: what each generator adds to the point. Last
    # column: the forces of the basis, and minus the point.
    tableau = np.zeros((6, count + 1))
    tableau[:4, :count] = np.linalg.solve(E[:, columns], E)
    tableau[:4, count] = forces[columns]
    tableau[4:, :count] = C - C[:, columns] @ tableau[:4, :count]
    tableau[4:, count] = -C[:, columns] @ forces[columns]
    gain_x, gain_y, point = tableau[4, :-1], tableau[5, :-1], tableau[4:, -1]

    for _ in range(_MAX_PIVOTS):
        entering = int(gain_x.argmax())
        if gain_x[entering] <= _PIVOT:
            break
        if not _pivot(tableau, columns, entering):
            return []
    x, y = 1.0, 0.0
    edges: list[tuple[tuple[float, float], list[int]]] = []
    turned, last = 0.0, -np.inf
    for _ in range(_MAX_PIVOTS):
        # How far the direction may turn until a generator is worth as much as another.
        loss = -(x * gain_x + y * gain_y)
        rise = x * gain_y - y * gain_x
        rising = np.flatnonzero(rise > _PIVOT)
        slopes = loss[rising] / rise[rising]
        angle = math.atan(max(float(slopes.min(initial=np.inf)), 0.0))
        turned += angle
        if turned > _ONCE_ROUND:
            return edges
        cos, sin = math.cos(angle), math.sin(angle)
        x, y = x * cos - y * sin, x * sin + y * cos
        if len(rising) == 0:
            continue
        before, tied = point.tolist(), columns.copy()
        if not _pivot(tableau, columns, int(rising[slopes.argmin()])):
            return []
        step = math.dist(before, point.tolist())
        if step > _SHORT and turned - last > _PARALLEL:
            edges.append(((x, y), tied))
            last = turned
    return []


def _pivot(tableau: Vector, columns: list[int], entering: int) -> bool:
    """Takes a generator into the basis; False where no force of it falls to zero."""
    column = tableau[:, entering].copy()
    leaving, least = -1, math.inf
    for i, (pace, force) in enumerate(
        zip(column[:4].tolist(), tableau[:4, -1].tolist(), strict=True)
    ):
        if pace > _PIVOT and force < least * pace:
            leaving, least = i, force / pace
    if leaving < 0:
        return False
    row = tableau[leaving] / column[leaving]
    tableau -= np.multiply.outer(column, row)
    tableau[leaving] = row
    columns[leaving] = entering
    return True
