"""Stability polygons by linear programming: Bretl and Lall's recursive projection.

Bretl and Lall, "Testing static equilibrium for legged robots" (T-RO 2008), the stair
paper's Ref. 10. Each linear programme pushes the point as far as it goes along a
direction; every edge that is not proven by one is split. Independent of double
description, slower, and right where that fails.
"""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linprog

from footfall.models.values.vector import Vector
from footfall.systems.balance.convex_polygon import simplified
from footfall.systems.balance.wrench_slice import WrenchSlice

_EXPANSION = 1e-8
"""An edge is final when no point lies further outside it, m."""
_MAX_VERTICES = 500
"""More than any stance of contacts that a robot has hands and feet for."""


class LinearProgrammeError(RuntimeError):
    """The solver gave up on a programme that it had found feasible."""


def project(
    generators: Vector, slices: Sequence[WrenchSlice], half_side: float
) -> Vector:
    """Projects the cone: the points for which the wrenches of all slices lie in it.

    Args:
        generators: of the cone, (6, m).
        slices: one or several questions about the same point.
        half_side: the answer is clipped to a square of twice this about Q, m.

    Returns:
        Vertices, (n, 2), m from Q, counter-clockwise; (0, 2) where there is none, one
        for a point, two for a segment.

    Raises:
        LinearProgrammeError: the solver failed.
    """
    columns = generators.shape[1]
    count = len(slices)
    A = np.zeros((6 * count, columns * count + 2))
    b = np.zeros(6 * count)
    for i, part in enumerate(slices):
        rows = slice(6 * i, 6 * i + 6)
        A[rows, columns * i : columns * (i + 1)] = generators
        A[rows, -2:] = -part.W
        b[rows] = part.w_0
    bounds = [(0.0, None)] * (columns * count) + [(-half_side, half_side)] * 2
    objective = np.zeros(A.shape[1])

    def furthest(direction: Vector) -> Vector | None:
        objective[-2:] = -direction
        result = linprog(
            objective,
            A_eq=A,
            b_eq=b,
            bounds=bounds,
            method="highs",
            options={
                "primal_feasibility_tolerance": 1e-10,
                "dual_feasibility_tolerance": 1e-10,
            },
        )
        if result.status == 2:
            return None
        if result.status != 0:
            raise LinearProgrammeError(result.message)
        solution: Vector = np.asarray(result.x)
        return solution[-2:]

    vertices: list[Vector] = []
    for direction in ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]):
        vertex = furthest(np.array(direction))
        if vertex is None:
            return np.zeros((0, 2))
        vertices.append(vertex)
    i = 0
    while i < len(vertices) and len(vertices) < _MAX_VERTICES:
        edge = vertices[(i + 1) % len(vertices)] - vertices[i]
        length = float(np.hypot(*edge))
        if length > _EXPANSION:
            normal = np.array([edge[1], -edge[0]]) / length
            vertex = furthest(normal)
            if vertex is None:
                raise LinearProgrammeError("feasible at first, infeasible later")
            if normal @ (vertex - vertices[i]) > _EXPANSION:
                vertices.insert(i + 1, vertex)
                continue
        i += 1
    return simplified(np.array(vertices), _EXPANSION)
