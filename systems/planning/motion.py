"""From footsteps to a motion: contact phases, feet, ZMP, and a CoM of varying height.

The horizontal CoM is the one whose ZMP follows the reference although the CoM rises
(`systems.balance.zmp_tracking`). For the preview controller, which assumes a cart of
constant height, the plan gives the ZMP of the cart that moves the same way (Kajita et
al. 2003, Eq. 4), so that tracking it reproduces this CoM.
"""

from dataclasses import dataclass

import numpy as np

from models.robot import RobotModel
from systems.balance.zmp_preview import GRAVITY, ZmpPreviewParams, rest_state
from systems.balance.zmp_tracking import generate_varying_height, height_factor
from systems.planning.footstep_planner import pose_from_xyz_rpy
from systems.planning.motion_params import MotionPlannerParams
from systems.planning.swing_trajectory import quintic, swing_trajectory
from systems.planning.toe_off import heading, lift_heel, toe_off_pitch
from systems.ports import Vector
from systems.values import (
    FEET,
    ContactPhase,
    Foot,
    Footstep,
    MotionPlan,
    other_foot,
)

LEVEL = 0.03
"""Heights this near each other are the same level, m."""


@dataclass(frozen=True)
class Step:
    """One footstep in time."""

    foot: Foot
    push: float
    """When the double support before it begins, s."""
    lift: float
    """When the foot leaves the ground, s."""
    land: float
    """When it is back, s."""
    start: Vector
    """Pose it leaves, (6,)."""
    end: Vector
    """Pose it takes, (6,)."""
    stance: Vector
    """Pose of the other foot meanwhile, (6,)."""
    climbs: bool


def schedule(
    feet: Vector, footsteps: tuple[Footstep, ...], params: MotionPlannerParams
) -> tuple[tuple[Step, ...], float]:
    """Lays footsteps out in time.

    Args:
        feet: poses of both feet at the start, (2, 6), left first.
        footsteps: where they go, in order.
        params: durations.

    Returns:
        The steps and when the motion ends, s.
    """
    poses = dict(zip(FEET, feet, strict=True))
    steps: list[Step] = []
    push, time = 0.0, params.lead_in
    for footstep in footsteps:
        foot, stance = footstep.foot, other_foot(footstep.foot)
        rpy = footstep.X_WF.rotation().ToRollPitchYaw().vector()
        end: Vector = np.concatenate([footstep.X_WF.translation(), rpy])
        climbs = abs(end[2] - poses[foot][2]) > params.climb_threshold
        land = time + (params.climb_single_support if climbs else params.single_support)
        steps.append(
            Step(foot, push, time, land, poses[foot], end, poses[stance], climbs)
        )
        poses[foot] = end
        push = land
        time = land + (params.climb_double_support if climbs else params.double_support)
    return tuple(steps), push + params.lead_out if steps else params.lead_in


def plan_motion(
    feet: Vector,
    com: Vector,
    footsteps: tuple[Footstep, ...],
    edges: Vector,
    params: MotionPlannerParams,
    preview: ZmpPreviewParams,
    robot: RobotModel,
) -> MotionPlan:
    """Plans the motion along footsteps, from standing to standing, beginning at time 0.

    Args:
        feet: poses of both feet at the start, (2, 6), left first, level.
        com: p_WCom at the start, (3,), at rest.
        footsteps: where the feet go, in order; none makes a plan that stands.
        edges: a point of the front edge of each tread, (m, 3), m.
        params: timing and shape.
        preview: weights of the ZMP tracking and the cart's height.
        robot: its soles and legs.

    Returns:
        The plan.
    """
    steps, end = schedule(feet, footsteps, params)
    n = round(end / params.period) + 1
    time: Vector = np.arange(n, dtype=np.float64) * params.period
    last = {step.foot: step.end for step in steps}
    final = np.array([last.get(foot, feet[i]) for i, foot in enumerate(FEET)])
    zmp = _zmp_reference(time, steps, feet, final, com, end, params)
    height = _com_height(time, steps, com[2], final, end, params)
    rate = np.gradient(height, params.period)
    acceleration = np.gradient(rate, params.period)
    factor = height_factor(height, zmp[:, 2], acceleration)
    motion = generate_varying_height(zmp[:, :2], factor, preview, rest_state(com[:2]))
    zmp[:, :2] = motion.zmp
    path = np.column_stack([motion.com, height])
    poses, contacts, lengths = _feet(time, steps, feet, path, edges, params, robot)
    climbs = any(step.climbs for step in steps)
    return MotionPlan(
        start_time=0.0,
        period=params.period,
        footsteps=footsteps,
        phases=_phases(steps, end),
        contacts=contacts,
        foot_poses=poses,
        contact_lengths=lengths,
        com=path,
        com_velocity=np.column_stack([motion.velocity, rate]),
        com_acceleration=np.column_stack([motion.acceleration, acceleration]),
        zmp=zmp,
        cart_zmp=motion.com - preview.com_height / GRAVITY * motion.acceleration,
        waist=_waist(time, poses, end, params.lean if climbs else 0.0, params),
    )


def stance_zmp(
    pose: Vector, foot: Foot, forward: float, params: MotionPlannerParams
) -> Vector:
    """Where the ZMP is to be while the robot stands on one foot, p_WZmp, (3,)."""
    left: Vector = heading(pose[5] + np.pi / 2.0)
    inward = -left if foot == "left" else left
    p_WZmp = pose[:3].copy()
    p_WZmp[:2] += forward * heading(pose[5]) + params.zmp_inward * inward
    return p_WZmp


def middle_zmp(feet: Vector, params: MotionPlannerParams) -> Vector:
    """Where the ZMP is to be while the robot stands on both feet, p_WZmp, (3,)."""
    both = [
        stance_zmp(feet[i], foot, params.zmp_forward, params)
        for i, foot in enumerate(FEET)
    ]
    middle: Vector = np.mean(both, axis=0)
    return middle


def _phases(steps: tuple[Step, ...], end: float) -> tuple[ContactPhase, ...]:
    phases = []
    for step in steps:
        phases.append(ContactPhase(step.push, step.lift, FEET, None))
        phases.append(
            ContactPhase(step.lift, step.land, (other_foot(step.foot),), step.foot)
        )
    phases.append(ContactPhase(steps[-1].land if steps else 0.0, end, FEET, None))
    return tuple(phases)


def _zmp_reference(
    time: Vector,
    steps: tuple[Step, ...],
    feet: Vector,
    final: Vector,
    com: Vector,
    end: float,
    params: MotionPlannerParams,
) -> Vector:
    """Rests on the stance foot in single support and moves over in double support."""
    first = middle_zmp(feet, params)
    first[:2] = com[:2]
    keys = [(0.0, first), (0.3 * params.lead_in, first)]
    for step in steps:
        forward = params.climb_zmp_forward if step.climbs else params.zmp_forward
        point = stance_zmp(step.stance, other_foot(step.foot), forward, params)
        keys += [(step.lift, point), (step.land, point)]
    keys.append((end - 0.4 * params.lead_out, middle_zmp(final, params)))
    times = [key[0] for key in keys]
    points = np.array([key[1] for key in keys])
    return np.column_stack([np.interp(time, times, points[:, i]) for i in range(3)])


def _com_height(
    time: Vector,
    steps: tuple[Step, ...],
    start: float,
    final: Vector,
    end: float,
    params: MotionPlannerParams,
) -> Vector:
    """Each rise begins when a foot has landed and is over before the next one does."""
    height = np.full(len(time), start)
    level = start
    begin = 0.0
    for i, step in enumerate(steps):
        target = step.stance[2] + params.com_height
        finish = step.lift
        if i > 0:
            finish += params.rise_end * (step.land - step.lift)
        later = time >= begin
        blend = quintic((time[later] - begin) / (finish - begin))
        height[later] = level + (target - level) * blend
        level, begin = target, step.land
    target = float(final[:, 2].min()) + params.com_height
    later = time >= begin
    blend = quintic((time[later] - begin) / (end - begin))
    height[later] = level + (target - level) * blend
    return height


def _feet(
    time: Vector,
    steps: tuple[Step, ...],
    feet: Vector,
    com: Vector,
    edges: Vector,
    params: MotionPlannerParams,
    robot: RobotModel,
) -> tuple[Vector, Vector, Vector]:
    """Foot poses (n, 2, 6), contacts (n, 2) and carrying lengths (n, 2)."""
    sole = robot.sole
    poses = np.tile(feet, (len(time), 1, 1))
    contacts = np.ones((len(time), 2))
    lengths = np.full((len(time), 2), sole.length)
    for step in steps:
        i = FEET.index(step.foot)
        lift, land = (round(t / params.period) for t in (step.lift, step.land))
        pitch = 0.0
        if step.stance[2] - step.start[2] > params.climb_threshold:
            p_WHip = com[lift].copy()
            p_WHip[:2] += robot.hip_from_com[0] * heading(step.start[5])
            p_WHip[2] += robot.hip_from_com[1]
            pitch = toe_off_pitch(
                step.start, p_WHip, robot.leg_reach, params.max_toe_off, sole
            )
        if pitch > 0.0:
            begin = step.push + params.toe_off_start * (step.lift - step.push)
            rows = slice(int(np.ceil(begin / params.period)), lift + 1)
            u = (time[rows] - begin) / (step.lift - begin)
            poses[rows, i] = lift_heel(step.start, pitch * quintic(u), sole)
            lengths[rows, i] = params.toe_strip
        rows = slice(lift, land + 1)
        way = swing_trajectory(
            pose_from_xyz_rpy(poses[lift, i]),
            pose_from_xyz_rpy(step.end),
            step.land - step.lift,
            params.period,
            edges[
                (edges[:, 2] > step.start[2] + LEVEL)
                & (edges[:, 2] < step.end[2] + LEVEL)
            ],
            sole,
            params.swing,
        )
        poses[rows, i] = np.hstack([way.positions, way.rpy])
        poses[land + 1 :, i] = step.end
        contacts[lift:land, i] = 0.0
        lengths[lift:land, i] = sole.length
    return poses, contacts, lengths


def _waist(
    time: Vector, poses: Vector, end: float, lean: float, params: MotionPlannerParams
) -> Vector:
    """Upright at both ends, leaning forward between; yaw midway between the feet."""
    rpy = np.zeros((len(time), 3))
    blend = quintic(time / params.lead_in)
    rpy[:, 1] = lean * (blend - quintic((time - end) / params.lead_out + 1.0))
    rpy[:, 2] = poses[:, :, 5].mean(axis=1)
    return rpy
