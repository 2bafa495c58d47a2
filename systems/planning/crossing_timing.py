"""When the feet of a crossing move, where its ZMP rests and how high its waist is."""

from dataclasses import dataclass

import numpy as np

from systems.obstacle_values import Obstacle, across
from systems.planning.crossing_params import CrossingParams
from systems.planning.leg_clearance import Section
from systems.planning.motion import middle_zmp, stance_zmp
from systems.planning.motion_params import MotionPlannerParams
from systems.ports import Vector
from systems.values import FEET, ContactPhase, Foot, Footstep, other_foot


@dataclass(frozen=True)
class TimedStep:
    """One footstep in time."""

    foot: Foot
    push: float
    """When the double support before it begins, s."""
    lift: float
    """When the foot leaves the ground, s."""
    land: float
    """When it is back, s."""
    start: Vector
    """Sole pose it leaves, (6,)."""
    end: Vector
    """Sole pose it takes, (6,)."""
    stance: Vector
    """Sole pose of the other foot meanwhile, (6,)."""
    obstacle: int
    """Index of the obstacle it crosses, -1 for none."""
    leads: bool
    """Whether it is the first foot over that obstacle: phase 1, else phase 3."""


def time_steps(
    feet: Vector,
    footsteps: tuple[Footstep, ...],
    walking: MotionPlannerParams,
    crossing: CrossingParams,
) -> tuple[tuple[TimedStep, ...], float]:
    """Lays footsteps out in time; those with a plane cross the obstacle of that index.

    Args:
        feet: sole poses at the start, (2, 6), left first.
        footsteps: where they go, in order.
        walking: durations on free ground.
        crossing: durations over an obstacle.

    Returns:
        The steps and when the motion ends, s.
    """
    poses = dict(zip(FEET, feet, strict=True))
    steps: list[TimedStep] = []
    led: set[int] = set()
    push, time = 0.0, walking.lead_in
    for step in footsteps:
        rpy = step.X_WF.rotation().ToRollPitchYaw().vector()
        end: Vector = np.concatenate([step.X_WF.translation(), rpy])
        crosses = step.plane >= 0
        leads = crosses and step.plane not in led
        if leads and steps:
            time = push + crossing.double_support
        land = time + (crossing.single_support if crosses else walking.single_support)
        stance = poses[other_foot(step.foot)]
        steps.append(
            TimedStep(
                step.foot,
                push,
                time,
                land,
                poses[step.foot],
                end,
                stance,
                step.plane,
                leads,
            )
        )
        led |= {step.plane} if crosses else set()
        poses[step.foot] = end
        push = land
        time = land + (crossing.double_support if crosses else walking.double_support)
    return tuple(steps), push + walking.lead_out if steps else walking.lead_in


def contact_phases(
    steps: tuple[TimedStep, ...], end: float
) -> tuple[ContactPhase, ...]:
    """The contact phases of the whole motion."""
    phases = []
    for step in steps:
        phases.append(ContactPhase(step.push, step.lift, FEET, None))
        phases.append(
            ContactPhase(step.lift, step.land, (other_foot(step.foot),), step.foot)
        )
    phases.append(ContactPhase(steps[-1].land if steps else 0.0, end, FEET, None))
    return tuple(phases)


def zmp_reference(
    time: Vector,
    steps: tuple[TimedStep, ...],
    feet: Vector,
    com: Vector,
    end: float,
    params: MotionPlannerParams,
    forward: float,
    rolling: float,
) -> Vector:
    """ZMP_des(t): rests on the stance foot, moves over in double support, (n, 3), m."""
    final = feet.copy()
    for step in steps:
        final[FEET.index(step.foot)] = step.end
    first = middle_zmp(feet, params)
    first[:2] = com[:2]
    keys = [(0.0, first), (0.3 * params.lead_in, first)]
    for step in steps:
        ahead = forward if step.obstacle >= 0 else params.zmp_forward
        point = stance_zmp(step.stance, other_foot(step.foot), ahead, params)
        keys.append((step.lift, point))
        if step.leads:
            point = stance_zmp(
                step.stance, other_foot(step.foot), ahead + rolling, params
            )
        keys.append((step.land, point))
    keys.append((end - 0.4 * params.lead_out, middle_zmp(final, params)))
    times = [key[0] for key in keys]
    points = np.array([key[1] for key in keys])
    return np.column_stack([np.interp(time, times, points[:, i]) for i in range(3)])


def third_order(u: Vector) -> Vector:
    """Third-order blend from 0 to 1, level at both ends."""
    u = np.clip(u, 0.0, 1.0)
    blend: Vector = u**2 * (3.0 - 2.0 * u)
    return blend


def bump(time: Vector, steps: tuple[TimedStep, ...]) -> Vector:
    """0 in walking, 1 in phase 2: raised in phase 1, lowered in phase 3, (n,).

    Waist height and waist yaw follow it: third-order polynomials that are given by
    position and speed at both ends (Sec. III-C).
    """
    total = np.zeros(len(time))
    for step in steps:
        if step.obstacle >= 0:
            u = (time - step.lift) / (step.land - step.lift)
            total += third_order(u) if step.leads else -third_order(u)
    return total


def section_of(obstacle: Obstacle) -> Section:
    """The obstacle in the plane across it."""
    return Section(obstacle.width, obstacle.height)


def front_distance(obstacle: Obstacle, point: Vector) -> float:
    """How far a horizontal point (2,) is before the obstacle's front face, m."""
    ahead = across(obstacle.yaw)
    return float((obstacle.center - point) @ ahead) - obstacle.width / 2.0
