"""CWTG2 for walks: the CoM moves so that the whole body's ZMP follows its reference.

A plan's CoM is that of a single mass. Legs that swing fast move the ZMP of the whole
body by centimetres; the dynamic filter (`footfall.systems.balance.dynamic_filter`,
obstacle paper, Eqs. 19 and 20) takes that back: the CoM motion of p_ref - p_MB, p_MB
being the ZMP of the whole body, is added to the plan's.
"""

import numpy as np
from scipy.interpolate import CubicSpline

from footfall.models.values.vector import Vector
from footfall.systems.balance.dynamic_filter import filter_motion_varying_height
from footfall.systems.balance.zmp_preview import ComMotion, ZmpPreviewParams
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    body_motion,
    body_zmp,
    waist_above_com,
)

STRIDE = 2
"""Ticks between the postures that are looked at."""
STAGES = 2
"""How often the filter is applied; the second time takes most of what is left."""


def follow_with_whole_body(
    motion: ComMotion,
    zmp: Vector,
    height: Vector,
    height_factor: Vector,
    weight: Vector,
    waist: Vector,
    feet: Vector,
    body: WholeBody,
    preview: ZmpPreviewParams,
) -> ComMotion:
    """Corrects a single mass's motion for what legs and trunk do.

    Args:
        motion: of the single mass, n ticks.
        zmp: reference of the ZMP, (n, 3), m.
        height: of the CoM, (n,), m.
        height_factor: c that the motion was planned with, (n,), s^2.
        weight: how much the ZMP error counts, (n,).
        waist: orientation of the pelvis, roll, pitch, yaw, (n, 3), rad.
        feet: sole poses, (n, 2, 6).
        body: the robot.
        preview: weights and period of the ZMP tracking.

    Returns:
        The corrected motion; it starts where `motion` does.
    """
    n = len(zmp)
    rows = np.arange(0, n, STRIDE)
    tick = STRIDE * preview.period
    waist_height = height[rows] + waist_above_com(body)
    offset: Vector | None = None
    for _ in range(STAGES):
        found = body_motion(
            body,
            motion.com[rows],
            waist_height,
            waist[rows],
            feet[rows],
            0.0,
            offset,
            1,
        )
        offset = found.waist[:, :2] - found.com[:, :2]
        p_MB = body_zmp(body, found.q, zmp[rows, 2], tick)
        at_every_tick = CubicSpline(rows, p_MB)(np.minimum(np.arange(n), rows[-1]))
        motion = filter_motion_varying_height(
            motion, zmp[:, :2], at_every_tick, height_factor, preview, weight
        )
    return motion
