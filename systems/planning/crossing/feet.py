"""The feet along a whole crossing: FTG step by step, and where FTA has to look."""

from typing import Any, TypeAlias

import numpy as np

from footfall.models.values.feet import FEET
from footfall.models.values.obstacle import Obstacle, across
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import (
    LegPoses,
    Repairs,
    ankle_displacement,
    penetration_path,
)
from footfall.systems.planning.crossing.foot_trajectory_generator import (
    Crossing,
    foot_trajectory,
)
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.crossing.posture import share_of
from footfall.systems.planning.crossing.timing import CrossingStep
from footfall.systems.planning.motion.thigh_clearance import inward_bow
from footfall.systems.planning.whole_body.leg_model import LegModel

Mask: TypeAlias = np.ndarray[Any, np.dtype[np.bool_]]


def section_of(obstacle: Obstacle) -> Section:
    """The obstacle in the plane across it."""
    return Section(obstacle.width, obstacle.height)


def front_distance(obstacle: Obstacle, point: Vector) -> float:
    """How far a horizontal point (2,) is before the obstacle's front face, m."""
    ahead = across(obstacle.yaw)
    return float((obstacle.center - point) @ ahead) - obstacle.width / 2.0


def feet_along(
    time: Vector,
    steps: tuple[CrossingStep, ...],
    feet: Vector,
    obstacles: tuple[Obstacle, ...],
    leg: LegModel,
    crossing: CrossingParams,
    repairs: Repairs,
) -> Vector:
    """FTG for every step: sole poses, (n, 2, 6).

    Args:
        time: (n,), s.
        steps: of the motion.
        feet: sole poses at its start, (2, 6).
        obstacles: what is crossed.
        leg: the legs.
        crossing: margins and control points.
        repairs: by which the second foot's way over an obstacle is changed.
    """
    poses = np.tile(feet, (len(time), 1, 1))
    margins = crossing.feasibility
    for step in steps:
        i = FEET.index(step.foot)
        poses[time > step.land, i] = step.end
        inside = (time >= step.lift) & (time <= step.land)
        if not inside.any():
            continue
        over = None
        if step.obstacle >= 0:
            obstacle = obstacles[step.obstacle]
            x0, x1, top = section_of(obstacle).inflated(margins.s_w, margins.s_h)
            front = front_distance(obstacle, step.start[:2]) + x0
            over = Crossing(Section(x1 - x0, top), front, step.leads)
        follows = step.obstacle >= 0 and not step.leads
        poses[inside, i] = foot_trajectory(
            step.start,
            step.end,
            time[inside] - step.lift,
            step.land - step.lift,
            over,
            leg.outline,
            leg.sole.ankle_height,
            crossing.feet,
            repairs.shift if follows else 0.0,
        )
        if step.obstacle >= 0:
            # A folded leg has to reach down and outwards: under the swaying waist its
            # hip would have to roll beyond its limit.
            u = share_of(step, time[inside])
            left = across(obstacles[step.obstacle].yaw + np.pi / 2.0)
            inward = crossing.inward if step.foot == "right" else -crossing.inward
            poses[inside, i, :2] += np.outer(inward * inward_bow(u), left)
        if follows and repairs.path.size:
            shares = np.linspace(0.0, 1.0, len(repairs.path))
            push = np.interp(share_of(step, time[inside]), shares, repairs.path)
            x_W = across(obstacles[step.obstacle].yaw)
            poses[inside, i, :2] += push[:, None] * x_W
    return poses


def crossing_rows(time: Vector, steps: tuple[CrossingStep, ...]) -> Mask:
    """Which rows lie in phases 1 to 3 of a crossing, (n,)."""
    inside = np.zeros(len(time), dtype=bool)
    for step in steps:
        if step.obstacle >= 0:
            inside |= (time >= step.push) & (time <= step.land + 0.05)
    return inside


def yielding_path(
    poses: LegPoses,
    gaps: Vector,
    time: Vector,
    steps: tuple[CrossingStep, ...],
    leg: LegModel,
    repairs: Repairs,
) -> Vector | None:
    """The third repair for the second foot over the first obstacle that it meets.

    Args:
        poses: the legs at n moments.
        gaps: their distances to the inflated obstacles, (m, n, 2), m.
        time: those moments, (n,), s.
        steps: of the motion.
        leg: the legs.
        repairs: so far.

    Returns:
        The displacement of that foot's way, see `Repairs.path`; None where it meets
        nothing.
    """
    for step in steps:
        if step.obstacle < 0 or step.leads:
            continue
        i = FEET.index(step.foot)
        inside = np.flatnonzero((time >= step.lift) & (time <= step.land))
        depth = np.maximum(-gaps[step.obstacle, inside, i], 0.0)
        if not (depth > 0.0).any():
            continue
        leverage = np.zeros(len(inside))
        for row, angles in enumerate(poses.angles[inside, i]):
            # The shin half-way between knee and ankle stands for what penetrates.
            middle = 0.5 * leg.shank
            dP = ankle_displacement(leg, step.foot, angles, middle, 1.0)
            leverage[row] = min(max(dP, 0.5), 3.0)
        return penetration_path(
            depth, share_of(step, time[inside]), leverage, repairs.path
        )
    return None
