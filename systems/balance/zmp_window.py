"""The analytic preview window of the obstacle paper (Eqs. 16 to 18, after Wieber).

Over N_L ticks the ZMP is linear in the jerks; the jerks that keep it near its reference
at least cost have a closed form. Only the first of them is applied, then the window
moves on.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ComMotion,
    ZmpPreviewParams,
    cart,
    check_reference,
    rest_state,
)


@dataclass(frozen=True, eq=False)
class WindowGains:
    """The first row of Eq. 18: jerk = -(K_x x + K_p p_ref).

    u = -(P_u' P_u + R/Q I)^-1 P_u' (P_x x - p_ref).
    """

    P_x: Vector
    """Of Eq. 16, p = P_x x + P_u u: effect of the state on the ZMP of the next ticks,
    (N_L, 3)."""
    P_u: Vector
    """Of Eq. 16: effect of the jerks, (N_L, N_L)."""
    K_x: Vector
    """(3,)."""
    K_p: Vector
    """(N_L,), on the reference of the next ticks, negative."""


def window_gains(params: ZmpPreviewParams) -> WindowGains:
    """Solves the preview window of Eq. 17 for its feedback law, the same at every tick.

    min over u of Q / 2 |p - p_ref|^2 + R / 2 |u|^2 (17), p = P_x x + P_u u (16).

    Args:
        params: period, com_height, preview_time, error_weight (Q) and jerk_weight (R);
            here R weighs the jerk itself (Eq. 17), not its increment.

    Raises:
        ValueError: a parameter is out of range.
    """
    params.validate()
    A, B = cart(params.period)
    C = np.array([1.0, 0.0, -params.com_height / GRAVITY])
    n = round(params.preview_time / params.period)
    powers = [np.eye(3)]
    for _ in range(n):
        powers.append(A @ powers[-1])
    P_x = np.array([C @ power for power in powers[1:]])
    response = np.array([C @ power @ B for power in powers[:-1]])
    delay = np.subtract.outer(np.arange(n), np.arange(n))
    P_u = np.where(delay >= 0, response[np.maximum(delay, 0)], 0.0)
    ratio = params.jerk_weight / params.error_weight
    law = np.linalg.solve(P_u.T @ P_u + ratio * np.eye(n), P_u.T)[0]
    return WindowGains(P_x, P_u, law @ P_x, -law)


def generate_by_window(
    gains: WindowGains, zmp_ref: Vector, params: ZmpPreviewParams
) -> ComMotion:
    """Computes the motion of Eq. 18 over a reference, from rest on its first ZMP.

    Args:
        gains: from `window_gains`.
        zmp_ref: reference of the ZMP, (n, 2), m; it stays at its last value.
        params: those of the gains.

    Raises:
        ValueError: zmp_ref is not (n, 2) with n of at least 1, or not finite.
    """
    zmp_ref = check_reference(zmp_ref)
    A, B = cart(params.period)
    n, N = len(zmp_ref), len(gains.K_p)
    padded = np.vstack([zmp_ref[1:], np.repeat(zmp_ref[-1:], N, axis=0)])
    state = rest_state(zmp_ref[0])
    states, jerks = np.zeros((n, 2, 3)), np.zeros((n, 2))
    for k in range(n):
        states[k] = state
        jerks[k] = -(state @ gains.K_x + gains.K_p @ padded[k : k + N])
        state = state @ A.T + np.outer(jerks[k], B)
    com, velocity, acceleration = np.moveaxis(states, 2, 0)
    zmp = com - params.com_height / GRAVITY * acceleration
    return ComMotion(com, velocity, acceleration, jerks, zmp)
