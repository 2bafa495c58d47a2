"""The dynamic filter: what the single mass left out of the CoM motion.

The obstacle paper, Eqs. 19 and 20, after Kajita 2003: the joint motion that follows a
first CoM motion has another ZMP than the cart. The difference to the reference is
previewed a second time, and the motion it asks for is added to the CoM.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ComMotion,
    PreviewGains,
    ZmpPreviewParams,
    generate,
)
from footfall.systems.balance.zmp_tracking import generate_varying_height


@dataclass(frozen=True, eq=False)
class MomentumTrajectory:
    """CoM and momentum of a robot along a joint motion, sampled each tick."""

    mass: float
    """m, kg."""
    com: Vector
    """p_WCom, (n, 3), m."""
    linear: Vector
    """P, (n, 3), kg m/s."""
    angular: Vector
    """L about the world's origin, (n, 3), kg m^2/s."""


def multibody_zmp(
    trajectory: MomentumTrajectory, zmp_height: Vector | float, period: float
) -> Vector:
    """Computes the ZMP of a motion of the whole robot, Eq. 20 (see `zmp_of_rates`).

    The rates of momentum are central differences. The paper prints -L_x' in p_y; with
    L about the world's origin the moment balance gives +L_x', which stands here.

    Args:
        trajectory: at least two ticks.
        zmp_height: p_z, height of the ground under the ZMP, (n,) or one for all, m.
        period: T, s.

    Returns:
        p_WZmp, (n, 2), m.
    """
    force_rate = np.gradient(trajectory.linear, period, axis=0)
    moment_rate = np.gradient(trajectory.angular, period, axis=0)
    return zmp_of_rates(
        trajectory.mass, trajectory.com, force_rate, moment_rate, zmp_height
    )


def zmp_of_rates(
    mass: float,
    com: Vector,
    linear_rate: Vector,
    angular_rate: Vector,
    zmp_height: Vector | float,
) -> Vector:
    """Computes the ZMP from mass, CoM and the rates of momentum (Eq. 20).

    p_x = (m g c_x + p_z P'_x - L'_y) / (m g + P'_z),
    p_y = (m g c_y + p_z P'_y + L'_x) / (m g + P'_z).

    Args:
        mass: m, kg.
        com: p_WCom, (n, 3), m.
        linear_rate: P', (n, 3), N.
        angular_rate: L' about the world's origin, (n, 3), N m.
        zmp_height: p_z, (n,) or one for all, m.

    Returns:
        p_WZmp, (n, 2), m.
    """
    weight = mass * GRAVITY
    f_z = weight + linear_rate[:, 2]
    x = weight * com[:, 0] + zmp_height * linear_rate[:, 0] - angular_rate[:, 1]
    y = weight * com[:, 1] + zmp_height * linear_rate[:, 1] + angular_rate[:, 0]
    return np.column_stack([x / f_z, y / f_z])


def filter_motion(
    motion: ComMotion,
    zmp_ref: Vector,
    zmp_multibody: Vector,
    gains: PreviewGains,
) -> ComMotion:
    """Applies the published CWTG2: a second preview of p_ref2 = p_ref1 - p_MB (Eq. 19).

    What it asks for is added to the motion; `cwtg2: preview` of the crossing.

    The motion must rest for two previews before its first step: the first stage moves
    one preview ahead of the step, and the second previews what the first does.

    Args:
        motion: of the first stage, n ticks.
        zmp_ref: p_ref1, (n, 2), m.
        zmp_multibody: p_MB of the joint motion that follows `motion`, (n, 2), m.
        gains: those of the first stage.

    Returns:
        The corrected motion; it starts where `motion` does.
    """
    correction = generate(gains, zmp_ref - zmp_multibody, np.zeros((2, 3)))
    return _added(motion, correction)


def filter_motion_varying_height(
    motion: ComMotion,
    zmp_ref: Vector,
    zmp_multibody: Vector,
    height_factor: Vector,
    params: ZmpPreviewParams,
    weight: Vector | None = None,
) -> ComMotion:
    """Applies the second stage on `zmp_tracking`, exact on stairs.

    It knows the whole future and needs no more rest than the first stage did.

    Args:
        motion: of the first stage, n ticks.
        zmp_ref: p_ref1, (n, 2), m.
        zmp_multibody: p_MB of the joint motion that follows `motion`, (n, 2), m.
        height_factor: c of the first stage, (n,), s^2.
        params: those of the first stage.
        weight: that of the first stage.

    Returns:
        The corrected motion; it starts where `motion` does and ends at rest, with the
        CoM moved by the last ZMP error.
    """
    error = zmp_ref - zmp_multibody
    correction = generate_varying_height(
        error, height_factor, params, np.zeros((2, 3)), weight
    )
    return _added(motion, correction)


def _added(a: ComMotion, b: ComMotion) -> ComMotion:
    return ComMotion(
        a.com + b.com,
        a.velocity + b.velocity,
        a.acceleration + b.acceleration,
        a.jerk + b.jerk,
        a.zmp + b.zmp,
    )
