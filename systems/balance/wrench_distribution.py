"""Sharing a net wrench among the feet, each inside its contact wrench cone."""

from dataclasses import dataclass
from functools import lru_cache

import daqp
import numpy as np
from pydrake.math import VectorToSkewSymmetric

from footfall.models.robots.robot import Sole
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import contact_wrench_cone
from footfall.systems.balance.sole_contacts import carrying_contact


@dataclass(kw_only=True)
class DistributionParams(Parameters):
    """Weights and limits of the quadratic programme."""

    friction: float = number(0.6, above=0.0, most=10.0, shared="parameters.friction")
    """mu of the pyramid that the wrenches are kept in; below the ground's, so that the
    feet do not slide."""
    edge_margin: float = number(0.012, "m", least=0.0)
    """The centre of pressure keeps this far inside the sole's edges, m: nearer to one
    the rubber of the sole gives and the foot tips over it."""
    min_force: float = number(5.0, "N", least=0.0)
    """Normal force that a foot on the ground keeps at least, N."""
    force_weight: float = number(1.0, above=0.0)
    """Weight of the error in net force, 1/N^2."""
    moment_weight: float = number(10.0, above=0.0)
    """Weight of the error in net moment about horizontal axes, 1/(Nm)^2."""
    yaw_weight: float = number(3.0, above=0.0)
    """Weight of the error in net moment about the vertical, 1/(Nm)^2."""
    tangential_cost: float = number(1e-4, least=0.0)
    """Cost of tangential force, 1/N^2."""
    moment_cost: list[float] = number([0.02, 0.01, 0.05], least=0.0, length=3)
    """Costs of a foot's moment about its centre, x, y, z, 1/(Nm)^2: keeps the centre of
    pressure off the edges where both feet can share."""
    torque_cost: float = number(0.003, least=0.0)
    """Cost of a joint torque of the legs, 1/(Nm)^2: lets the legs push against each
    other where that takes torque off the worst joint."""


@dataclass(frozen=True)
class TorqueMap:
    """Joint torques as they depend on the foot wrenches: tau = offset - matrix w."""

    offset: Vector
    """Torques without any wrench, (k,), Nm."""
    matrix: Vector
    """(k, 12): w is force, then moment about F, in W, of the left and the right foot,
    N and Nm."""


@lru_cache(maxsize=64)
def _cone(half_length: float, half_width: float, friction: float) -> Vector:
    cone = contact_wrench_cone(half_length, half_width, friction)
    cone.setflags(write=False)
    return cone


@lru_cache(maxsize=64)
def _costs(feet: int, tangential: float, moment: tuple[float, ...]) -> Vector:
    """Makes the part of the Hessian that does not change."""
    cost = [tangential, tangential, 0.0, *moment]
    hessian: Vector = np.diag(np.tile(cost, feet)) + 1e-7 * np.eye(6 * feet)
    hessian.setflags(write=False)
    return hessian


def distribute_wrench(
    net: Vector,
    p_WCom: Vector,
    foot_poses: Vector,
    contacts: Vector,
    lengths: Vector,
    sole: Sole,
    params: DistributionParams,
    torques: TorqueMap | None = None,
) -> tuple[Vector, bool]:
    """Computes the foot wrenches that come nearest to a net wrench inside their cones.

    Minimises the weighted error of the net wrench plus a small cost on what a foot
    exerts off its centre, subject to the 16 inequalities of each contact wrench cone
    (Caron 2015) on the part of the sole that carries.

    Args:
        net: net wrench wanted from the ground, (6,): force, then moment about the
            CoM, in W, N and Nm.
        p_WCom: the CoM, (3,), m.
        foot_poses: sole frames X_WF, (2, 6), left first.
        contacts: which feet are on the ground, (2,), above 0.5.
        lengths: length of sole that carries, from the toe edge back, (2,), m. Where it
            is less than the whole the heel is lifted; the ground under the toes, and
            with it their friction pyramid, is level.
        sole: of both feet.
        params: weights and limits.
        torques: joint torques to keep small at `torque_cost`; None for no care.

    Returns:
        Wrenches of the ground on the feet, (2, 6): force, then moment about the origin
        of F, in W; zero for a foot in the air. And whether the programme was solved.
    """
    wrenches = np.zeros((2, 6))
    feet = [i for i in range(2) if contacts[i] > 0.5]
    if not feet:
        return wrenches, True
    n = 6 * len(feet)
    # From wrenches at the carrying contacts, in their frames, to the net wrench about
    # the CoM and to the wrenches about F, both in W.
    grasp, spread = np.zeros((6, n)), np.zeros((12, n))
    cones = np.zeros((16 * len(feet), n))
    upper = np.full(n + len(cones), 1e5)
    lower = np.full(n + len(cones), -1e6)
    upper[n:] = 0.0
    for k, i in enumerate(feet):
        c = 6 * k
        contact = carrying_contact(foot_poses[i], lengths[i], sole, params.friction)
        R_WC: Vector = contact.X_WC.rotation().matrix()
        p_WC = contact.X_WC.translation()
        grasp[:3, c : c + 3] = R_WC
        grasp[3:, c : c + 3] = VectorToSkewSymmetric(p_WC - p_WCom) @ R_WC
        grasp[3:, c + 3 : c + 6] = R_WC
        about_F = spread[6 * i : 6 * i + 6]
        about_F[:3, c : c + 3] = R_WC
        about_F[3:, c : c + 3] = VectorToSkewSymmetric(p_WC - foot_poses[i, :3]) @ R_WC
        about_F[3:, c + 3 : c + 6] = R_WC
        half = 0.5 * lengths[i]
        cones[16 * k : 16 * k + 16, c : c + 6] = _cone(
            max(half - params.edge_margin, 0.5 * half),
            sole.half_width - params.edge_margin,
            params.friction,
        )
        lower[c + 2] = params.min_force
    weights = np.array(
        [params.force_weight] * 3 + [params.moment_weight] * 2 + [params.yaw_weight]
    )
    weighted = weights[:, None] * grasp
    hessian = grasp.T @ weighted
    hessian += _costs(len(feet), params.tangential_cost, tuple(params.moment_cost))
    gradient = -(net @ weighted)
    if torques is not None and params.torque_cost > 0.0:
        M = torques.matrix @ spread
        hessian += params.torque_cost * (M.T @ M)
        gradient -= params.torque_cost * (torques.offset @ M)
    sense = np.zeros(len(upper), dtype=np.int32)
    solution, _, status, _ = daqp.solve(hessian, gradient, cones, upper, lower, sense)
    if status < 1:
        return wrenches, False
    return (spread @ solution).reshape(2, 6), True
