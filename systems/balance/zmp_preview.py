"""Preview control of the ZMP: which CoM motion keeps the ZMP on its reference.

`preview_gains`, `preview_step` and `generate` are Kajita et al., "Biped walking
pattern generation by using preview control of zero-moment point" (ICRA 2003): a cart
of constant height, servo type, gains from the Riccati equation. The obstacle paper's
Eqs. 16 to 18 are its first stage. `footfall.systems.balance.zmp_tracking` is the
better way for a plan whose future is known and whose height varies.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded, solve_discrete_are

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector

GRAVITY = 9.81
"""Standard gravity, m/s^2."""


@dataclass(kw_only=True)
class ZmpPreviewParams(Parameters):
    """Parameters of the preview controller; Kajita 2003 where not said otherwise."""

    period: float = number(
        0.005, "s", least=1e-4, most=0.1, shared="parameters.control_period"
    )
    """T: one tick, s; the paper's value, and the period of the servo loop."""
    com_height: float = number(
        0.814, "m", least=0.3, most=3.0, shared="parameters.com_height"
    )
    """z_c: height of the CoM over the ZMP's plane, m; the paper's value."""
    preview_time: float = number(1.6, "s", above=0.0, most=10.0)
    """How far ahead the reference is used, s; the paper's value."""
    error_weight: float = number(1.0, "1/m^2", least=1e-3, most=1e3)
    """Q_e: weight of the ZMP error, 1/m^2; the paper's value."""
    state_weight: list[float] = number([0.0, 0.0, 0.0], least=0.0, length=3)
    """Q_x: weights of the increments of CoM position, velocity and acceleration a
    tick; the paper's value is zero."""
    jerk_weight: float = number(1e-6, "s^6/m^2", least=1e-12, most=1.0)
    """R: weight of the increment of the jerk a tick, s^6/m^2; the paper's value."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.period <= self.preview_time:
            raise ValueError(
                "preview_time: must be at least one period, "
                f"got {self.preview_time:g} s"
            )


@dataclass(frozen=True, eq=False)
class PreviewGains:
    """The cart, and the law u = -G_i sum(e) - G_x x - sum_j G_p(j) p_ref(k + j)."""

    A: Vector
    """State matrix of the cart, (3, 3): x = (position, velocity, acceleration)."""
    B: Vector
    """Input matrix, (3,): the jerk."""
    C: Vector
    """Output row, (3,): the ZMP p = C x."""
    G_i: float
    """Gain on the sum of the ZMP error."""
    G_x: Vector
    """Gains on the state, (3,)."""
    G_p: Vector
    """Preview gains, (N,), of the reference 1 to N ticks ahead."""

    @property
    def horizon(self) -> int:
        """N: how many ticks ahead the reference is used."""
        return len(self.G_p)


@dataclass(frozen=True, eq=False)
class ComMotion:
    """A horizontal CoM motion, sampled each tick; jerk is constant over a tick."""

    com: Vector
    """p_WCom, (n, 2), m."""
    velocity: Vector
    """v_WCom, (n, 2), m/s."""
    acceleration: Vector
    """a_WCom, (n, 2), m/s^2."""
    jerk: Vector
    """From this tick to the next, (n, 2), m/s^3."""
    zmp: Vector
    """p_WZmp of the cart-table model, (n, 2), m."""


def cart(period: float) -> tuple[Vector, Vector]:
    """Computes A, b of the triple integrator driven by a jerk constant over a tick.

    Args:
        period: T, s.

    Returns:
        A, (3, 3), and B, (3,), with x = (position, velocity, acceleration).
    """
    T = period
    A = np.array([[1.0, T, T**2 / 2.0], [0.0, 1.0, T], [0.0, 0.0, 1.0]])
    return A, np.array([T**3 / 6.0, T**2 / 2.0, T])


def preview_gains(params: ZmpPreviewParams) -> PreviewGains:
    """Solves the preview servo problem (Kajita 2003, Eqs. 11 to 14).

    J = sum Q_e e^2 + dx' Q_x dx + R du^2 (11), u(k) = -G_i sum e - G_x x -
    sum_j G_p(j) p_ref(k + j) (12 to 14), where e is the ZMP error and dx, du are the
    increments of state and jerk.

    Args:
        params: see there.

    Returns:
        The gains.

    Raises:
        ValueError: a parameter is out of range.
    """
    params.validate()
    A, B = cart(params.period)
    C = np.array([1.0, 0.0, -params.com_height / GRAVITY])
    A_s = np.zeros((4, 4))
    A_s[0] = [1.0, *(C @ A)]
    A_s[1:, 1:] = A
    B_s = np.array([C @ B, *B])
    Q_s = np.diag([params.error_weight, *params.state_weight])
    P = solve_discrete_are(A_s, B_s[:, None], Q_s, np.array([[params.jerk_weight]]))
    denominator = params.jerk_weight + B_s @ P @ B_s
    K = B_s @ P @ A_s / denominator

    ticks = round(params.preview_time / params.period)
    A_closed = A_s - np.outer(B_s, K)
    G_p = np.empty(ticks)
    G_p[0] = -K[0]
    X = -A_closed.T @ P[:, 0]
    for tick in range(1, ticks):
        G_p[tick] = B_s @ X / denominator
        X = A_closed.T @ X
    return PreviewGains(A=A, B=B, C=C, G_i=float(K[0]), G_x=K[1:], G_p=G_p)


def preview_step(
    gains: PreviewGains, state: Vector, error_sum: Vector, zmp_preview: Vector
) -> tuple[Vector, Vector, Vector]:
    """Steps the controller by one tick, for both axes.

    Args:
        gains: from `preview_gains`.
        state: rows x and y of (position, velocity, acceleration) now, (2, 3).
        error_sum: sum of the ZMP error before now, (2,), m.
        zmp_preview: reference from now to N ticks ahead, (2, N + 1), m.

    Returns:
        The state at the next tick, (2, 3), the error sum with that of now, (2,), and
        the jerk between, (2,).
    """
    error_sum = error_sum + state @ gains.C - zmp_preview[:, 0]
    jerk = -(gains.G_i * error_sum + state @ gains.G_x + zmp_preview[:, 1:] @ gains.G_p)
    return state @ gains.A.T + np.outer(jerk, gains.B), error_sum, jerk


def generate(
    gains: PreviewGains, zmp_ref: Vector, initial_state: Vector | None = None
) -> ComMotion:
    """Computes the motion that `preview_step` makes over a whole reference, at once.

    The reference is taken to stay at its last value. The preview is one convolution;
    what is left is a linear recursion, solved as a banded system.

    Args:
        gains: from `preview_gains`.
        zmp_ref: reference of the ZMP, (n, 2), m.
        initial_state: rows x and y of (position, velocity, acceleration), (2, 3); at
            rest on the first ZMP if None. The error sum starts at
            `rest_error_sum` of the first ZMP.

    Returns:
        The motion, n ticks.

    Raises:
        ValueError: zmp_ref is not (n, 2) with n of at least 1, or not finite.
    """
    # scipy.signal brings scipy.stats along, which takes longer than the rest of SciPy.
    from scipy.signal import oaconvolve

    zmp_ref = check_reference(zmp_ref)
    start = rest_state(zmp_ref[0]) if initial_state is None else initial_state
    n, N = len(zmp_ref), gains.horizon
    padded = np.vstack([zmp_ref[1:], np.repeat(zmp_ref[-1:], N, axis=0)])
    feed = oaconvolve(padded, gains.G_p[::-1, None], mode="valid", axes=0)
    # z = (error sum before now, x): z' = M z + m_ref p_ref + m_feed feed.
    B, C = gains.B, gains.C
    M = np.zeros((4, 4))
    M[0] = [1.0, *C]
    M[1:, 0] = -gains.G_i * B
    M[1:, 1:] = gains.A - np.outer(B, gains.G_x + gains.G_i * C)
    rhs = np.zeros((n + 1, 4, 2))
    rhs[0, 0] = rest_error_sum(gains, zmp_ref[0])
    rhs[0, 1:] = start.T
    rhs[1:, 0] = -zmp_ref
    rhs[1:, 1:] = B[:, None] * (gains.G_i * zmp_ref - feed)[:, None, :]
    band = np.zeros((8, 4 * (n + 1)))
    band[0] = 1.0
    for row in range(4):
        for column in range(4):
            band[4 + row - column, column : 4 * n : 4] = -M[row, column]
    z = solve_banded((7, 0), band, rhs.reshape(-1, 2)).reshape(n + 1, 4, 2)
    com, velocity, acceleration = z[:n, 1], z[:n, 2], z[:n, 3]
    jerk = (z[1:, 3] - acceleration) / B[2]
    zmp = np.einsum("s,nsi->ni", C, z[:n, 1:])
    return ComMotion(com, velocity, acceleration, jerk, zmp)


def rest_state(p_W: Vector) -> Vector:
    """Makes the cart's state at rest over p_W, (2,): rows x and y, (2, 3)."""
    state = np.zeros((2, 3))
    state[:, 0] = p_W
    return state


def rest_error_sum(gains: PreviewGains, p_W: Vector) -> Vector:
    """Computes the error sum with which the law stays at rest over a ZMP at p_W.

    The preview ends after N ticks, so its gains do not add up to the one on position:
    without this sum the CoM is first pulled towards the world's origin. With it the
    law is the same wherever the robot starts.

    Args:
        gains: from `preview_gains`.
        p_W: where the reference is, (2,), m.

    Returns:
        The error sum, (2,), m.
    """
    return np.asarray(-(gains.G_x[0] + gains.G_p.sum()) / gains.G_i * p_W)


def check_reference(zmp_ref: Vector) -> Vector:
    """Checks a reference and returns it as an array of floats.

    Raises:
        ValueError: it is not (n, 2) with n of at least 1, or not finite.
    """
    array = np.asarray(zmp_ref, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2 or len(array) == 0:
        raise ValueError(f"zmp_ref: must have shape (n, 2), got {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError("zmp_ref: must be finite, got nan or inf")
    return array
