"""The CoM motion whose ZMP tracks a reference although the CoM's height varies.

Where `footfall.systems.balance.zmp_preview` assumes a cart of constant height, here the
height factor c_k = (z_k - p_zk) / (g + zdd_k) is given a tick, which makes the
cart-table model exact on stairs. The whole future is known, so the problem is one
finite-horizon linear-quadratic programme; its optimality conditions are one banded
system.
"""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ComMotion,
    ZmpPreviewParams,
    check_reference,
    rest_state,
)

Index: TypeAlias = NDArray[np.intp]

_BAND = 6
"""Sub- and superdiagonals: a tick has three unknowns, the cost couples two ticks."""


def height_factor(
    com_height: Vector, zmp_height: Vector, com_acceleration: Vector
) -> Vector:
    """Computes c of p = com - c a, the ZMP of a single mass whose height varies.

    p_x = (m g c_x + p_z m c''_x - m (c_z c''_x - c_x c''_z)) / (m g + m c''_z) of the
    obstacle paper's Eq. 14 is p_x = c_x - c''_x (c_z - p_z) / (g + c''_z). Used whole,
    it does not need c''_z much less than g, which the paper assumes for Eq. 15.

    Args:
        com_height: z of the CoM, (n,), m.
        zmp_height: p_z, height of the ground under the ZMP, (n,), m.
        com_acceleration: vertical acceleration of the CoM, (n,), m/s^2.

    Returns:
        c, (n,), s^2.
    """
    return (com_height - zmp_height) / (GRAVITY + com_acceleration)


def generate_varying_height(
    zmp_ref: Vector,
    height_factor: Vector,
    params: ZmpPreviewParams,
    initial_state: Vector | None = None,
    weight: Vector | None = None,
) -> ComMotion:
    """Computes the optimal motion over a plan that ends at rest on the last ZMP.

    Minimises sum Q_e w e^2 + R du^2 as `preview_gains` does (e the ZMP error, du the
    increment of the jerk), subject to the triple integrator, the initial state and
    the terminal one. Each tick has the unknowns position, acceleration and the
    multiplier of its spline equation
    x[k+1] - 2 x[k] + x[k-1] = T^2/6 (a[k+1] + 4 a[k] + a[k-1]).

    Args:
        zmp_ref: reference of the ZMP, (n, 2), m.
        height_factor: c, (n,), s^2; see the function of that name.
        params: period, error_weight and jerk_weight are used; the others belong to
            the constant-height controller.
        initial_state: rows x and y of (position, velocity, acceleration), (2, 3); at
            rest on the first ZMP if None.
        weight: w, (n,), how much the ZMP error counts at each tick; 1 if None.

    Returns:
        The motion, n ticks. Its ZMP is com - c a.

    Raises:
        ValueError: zmp_ref is not (n, 2) with n of at least 3, height_factor not (n,)
            and positive, weight not (n,) and positive, or a parameter out of range.
    """
    params.validate()
    zmp_ref = check_reference(zmp_ref)
    n = len(zmp_ref)
    c = np.asarray(height_factor, dtype=np.float64)
    if n < 3:
        raise ValueError(f"zmp_ref: must hold at least 3 ticks, got {n}")
    if c.shape != (n,) or not (np.isfinite(c).all() and c.min() > 0.0):
        raise ValueError(
            f"height_factor: must be positive and of shape ({n},), got shape {c.shape}"
        )
    w = np.ones(n) if weight is None else np.asarray(weight, dtype=np.float64)
    if w.shape != (n,) or not (np.isfinite(w).all() and w.min() > 0.0):
        raise ValueError(
            f"weight: must be positive and of shape ({n},), got shape {w.shape}"
        )
    start = rest_state(zmp_ref[0]) if initial_state is None else initial_state

    # About the last ZMP the unknowns are small, and the end is at rest at zero.
    origin = zmp_ref[-1]
    T, Q = params.period, params.error_weight * w
    wanted = Q[:, None] * (zmp_ref - origin)
    band = _optimality_conditions(c, T, Q, params.jerk_weight)
    rhs = np.zeros((n, 3, 2))
    rhs[1:-1, 0] = wanted[1:-1]
    rhs[1:-1, 1] = -(c[:, None] * wanted)[1:-1]
    rhs[0, 0] = start[:, 0] - origin
    rhs[0, 1] = start[:, 2]
    rhs[0, 2] = start[:, 1] / T
    solution = solve_banded((_BAND, _BAND), band, rhs.reshape(-1, 2)).reshape(n, 3, 2)

    x, a = solution[:, 0], solution[:, 1]
    jerk = np.vstack([np.diff(a, axis=0) / T, np.zeros((1, 2))])
    velocity = np.vstack(
        [np.diff(x, axis=0) / T - T / 6.0 * (2.0 * a[:-1] + a[1:]), np.zeros((1, 2))]
    )
    return ComMotion(x + origin, velocity, a, jerk, x + origin - c[:, None] * a)


def _optimality_conditions(c: Vector, T: float, Q: Vector, R: float) -> Vector:
    """Builds the optimality conditions in LAPACK's banded form, (13, 3 n).

    Row 3 k is the condition on x[k], 3 k + 1 that on a[k], 3 k + 2 the equation whose
    multiplier is l[k]: the initial velocity at k = 0, the terminal one at the last k,
    the spline equation between.
    """
    n = len(c)
    band = np.zeros((2 * _BAND + 1, 3 * n))

    def put(row: Index, column: Index, value: Vector | float) -> None:
        # Both run in steps of a tick, so that they are one diagonal.
        if len(row):
            diagonal = band[_BAND + row[0] - column[0]]
            diagonal[column[0] : column[-1] + 1 : 3] += value

    k = np.arange(n)
    inner = k[1:-1]
    # The ends of x and a are given.
    for end in (k[:1], k[-1:]):
        put(3 * end, 3 * end, 1.0)
        put(3 * end + 1, 3 * end + 1, 1.0)
    # The ZMP error x - c a - p.
    put(3 * inner, 3 * inner, Q[inner])
    put(3 * inner, 3 * inner + 1, -(Q * c)[inner])
    put(3 * inner + 1, 3 * inner, -(Q * c)[inner])
    put(3 * inner + 1, 3 * inner + 1, (Q * c**2)[inner])
    # The jerk's increments: second differences of a, which is level beyond its ends.
    laplacian = np.zeros((n, 3))
    laplacian[:, 1] = -2.0
    laplacian[[0, -1], 1] = -1.0
    laplacian[1:, 0] = laplacian[:-1, 2] = 1.0
    for i in range(3):
        for j in range(3):
            row, column = k + i - 1, k + j - 1
            kept = (row >= 1) & (row <= n - 2) & (column >= 0) & (column <= n - 1)
            value = R / T**2 * laplacian[:, i] * laplacian[:, j]
            put(3 * row[kept] + 1, 3 * column[kept] + 1, value[kept])
    # The equations, and their transpose into the conditions on x and a.
    first, last = k[:1], k[-1:]
    for at, shift, in_x, in_a in (
        (first, 0, -1.0 / T**2, -1.0 / 3.0),
        (first, 1, 1.0 / T**2, -1.0 / 6.0),
        (inner, -1, 1.0 / T**2, -1.0 / 6.0),
        (inner, 0, -2.0 / T**2, -4.0 / 6.0),
        (inner, 1, 1.0 / T**2, -1.0 / 6.0),
        (last, -1, -1.0 / T**2, 1.0 / 6.0),
        (last, 0, 1.0 / T**2, 1.0 / 3.0),
    ):
        unknown = at + shift
        put(3 * at + 2, 3 * unknown, in_x)
        put(3 * at + 2, 3 * unknown + 1, in_a)
        free = (unknown >= 1) & (unknown <= n - 2)
        put(3 * unknown[free], 3 * at[free] + 2, in_x)
        put(3 * unknown[free] + 1, 3 * at[free] + 2, in_a)
    return band
