"""Algorithm 1: from footsteps over obstacles to the motion of the whole robot.

FTG, CWTG1, IK, UBMG, CWTG2 and FTA in the paper's order (Stasse et al. 2009, Sec.
III); FU has been asked before, when the footsteps were placed.
"""

import dataclasses

import numpy as np
from pydrake.systems.framework import Context
from scipy.interpolate import CubicSpline

from footfall.models.values.feet import FEET
from footfall.models.values.obstacle import KeyConfiguration, Obstacle
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.balance.dynamic_filter import (
    filter_motion,
    filter_motion_varying_height,
)
from footfall.systems.balance.zmp_preview import (
    GRAVITY,
    ZmpPreviewParams,
    preview_gains,
)
from footfall.systems.planning.crossing.appraisal import (
    appraise,
    refused_even_if_balanced,
    static_balance,
)
from footfall.systems.planning.crossing.com_trajectory_generator import com_tracker
from footfall.systems.planning.crossing.crossing_problem import (
    CrossingProblem,
    CrossingStart,
    Schedule,
)
from footfall.systems.planning.crossing.params import CrossingParams, slowed
from footfall.systems.planning.crossing.posture import arm_swing, waist_rpy
from footfall.systems.planning.crossing.report import CrossingMotion
from footfall.systems.planning.crossing.timing import time_steps, zmp_reference
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.motion.step_timing import contact_phases, zmp_weight
from footfall.systems.planning.whole_body.whole_body_plan import (
    BodyMotion,
    WholeBody,
    waist_over,
)


def plan_crossing(
    feet: Vector,
    com: Vector,
    footsteps: tuple[Footstep, ...],
    obstacles: tuple[Obstacle, ...],
    keys: tuple[KeyConfiguration, ...],
    walking: MotionPlannerParams,
    crossing: CrossingParams,
    preview: ZmpPreviewParams,
    body: WholeBody,
    context: Context,
    mode: Mode = "dynamic",
    give_up: bool = False,
) -> CrossingMotion:
    """Plans the motion from standing to standing, beginning at time 0.

    Args:
        feet: sole poses at the start, (2, 6), left first, level.
        com: p_WCom at the start, (3,), at rest.
        footsteps: where the feet go; a `plane` of 0 or more is the obstacle that the
            step crosses, two steps an obstacle.
        obstacles: what is crossed.
        keys: the key configuration of each.
        walking: timing and shape of level walking.
        crossing: of the crossing.
        preview: weights of the ZMP tracking and the cart's height.
        body: the robot.
        context: scratch context of its plant.
        mode: in "quasi_static" everything goes at the pace of `crossing.quasi_static`.
        give_up: leave CWTG2 out where it could not save the motion from refusal.

    Returns:
        The motion and how well it does.
    """
    if mode == "quasi_static":
        walking, crossing = slowed(walking, crossing)
    steps, end = time_steps(feet, footsteps, walking, crossing)
    n = round(end / walking.period) + 1
    time: Vector = np.arange(n, dtype=np.float64) * walking.period
    zmp = zmp_reference(time, steps, feet, com, end, walking, crossing, mode)
    # Slowly the CoM goes with the ZMP all the way, and Kajita's cart knows no weight.
    free = mode == "dynamic" and crossing.cwtg1 == "exact"
    weight = zmp_weight(time, end, walking) if free else None
    rpy = waist_rpy(time, steps, feet, crossing, mode)
    arms = arm_swing(time, steps, crossing, mode)
    problem = CrossingProblem(
        schedule=Schedule(time=time, steps=steps, zmp=zmp, rpy=rpy, arms=arms),
        start=CrossingStart(
            feet=feet, com=com, waist=waist_over(body, com, feet, rpy[0])
        ),
        obstacles=obstacles,
        keys=keys,
        walking=walking,
        crossing=crossing,
        tracker=com_tracker(crossing.cwtg1, preview, com[:2], weight),
        body=body,
        context=context,
        mode=mode,
    )
    repairs = problem.repairs()
    moved, height, factor = problem.single_mass(repairs)
    rows = problem.rows
    motion = problem.body_along(moved, height, repairs, rows)
    zmps = [problem.multibody_zmp(motion)]
    contacts = np.ones((n, 2))
    for step in steps:
        lift, land = (round(t / walking.period) for t in (step.lift, step.land))
        contacts[lift:land, FEET.index(step.foot)] = 0.0
    stages = crossing.filter_stages
    if give_up and refused_even_if_balanced(problem, motion, zmps, repairs, contacts):
        stages = 0
    for _ in range(stages):
        p_MB = problem.at_every_tick(zmps[-1])
        if crossing.cwtg2 == "preview":
            moved = filter_motion(moved, zmp[:, :2], p_MB, preview_gains(preview))
        else:
            moved = filter_motion_varying_height(
                moved, zmp[:, :2], p_MB, factor, preview, weight
            )
        motion = problem.body_along(moved, height, repairs, rows, _offset(motion))
        zmps.append(problem.multibody_zmp(motion))
    report = appraise(problem, motion, zmps, repairs, contacts)
    spline = CubicSpline(time[rows], motion.com[:, 2])
    com = np.column_stack([moved.com, spline(time)])
    poses, phases = problem.soles(repairs, time), contact_phases(steps, end)
    if mode == "quasi_static":
        balance = static_balance(problem, motion, com, poses, contacts, phases)
        report = dataclasses.replace(report, balance=balance)
    return CrossingMotion(
        report=report,
        start_time=0.0,
        period=walking.period,
        footsteps=footsteps,
        phases=phases,
        contacts=contacts,
        foot_poses=poses,
        contact_lengths=np.full((n, 2), body.robot.sole.length),
        com=com,
        com_velocity=np.column_stack([moved.velocity, spline(time, 1)]),
        com_acceleration=np.column_stack([moved.acceleration, spline(time, 2)]),
        zmp=zmp,
        cart_zmp=moved.com - preview.com_height / GRAVITY * moved.acceleration,
        waist=rpy,
        arms=arms,
    )


def _offset(motion: BodyMotion) -> Vector:
    """Where the waist is beside the CoM, (n, 2), m."""
    offset: Vector = motion.waist[:, :2] - motion.com[:, :2]
    return offset
