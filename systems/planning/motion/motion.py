"""From footsteps to a motion: contact phases, feet, ZMP, and a CoM of varying height.

The horizontal CoM is the one whose ZMP follows the reference although the CoM rises
(`footfall.systems.balance.zmp_tracking`). For the preview controller, which assumes a
cart of constant height, the plan gives the ZMP of the cart that moves the same way
(Kajita et al. 2003, Eq. 4), so that tracking it reproduces this CoM.
"""

from dataclasses import dataclass

import numpy as np

from footfall.models.values.feet import FEET, other_foot
from footfall.models.values.planned import Footstep, MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import GRAVITY, rest_state
from footfall.systems.balance.zmp_tracking import generate_varying_height, height_factor
from footfall.systems.planning.footsteps.footstep_planner import pose_from_xyz_rpy
from footfall.systems.planning.motion.leg_reach import height_excess, step_drops
from footfall.systems.planning.motion.motion_filter import (
    STRIDE,
    follow_with_whole_body,
)
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.motion.step_timing import (
    TimedStep,
    along_keys,
    contact_phases,
    final_feet,
    middle_zmp,
    stance_zmp,
    step_times,
    transfers,
    zmp_weight,
)
from footfall.systems.planning.motion.swing_trajectory import quintic, swing_trajectory
from footfall.systems.planning.motion.thigh_clearance import (
    HighSwing,
    drawn_inwards,
    raised_hip,
)
from footfall.systems.planning.motion.toe_off import heading, lift_heel, toe_off_pitch

REPAIRS = 2
"""How often a motion whose knees are stretched is planned anew, lower."""
TOLERANCE = 1e-3
"""So much higher than the knees are to be bent for, m, a motion may be."""
LEVEL = 0.03
"""Heights this near each other are the same level, m."""


@dataclass(frozen=True)
class Step(TimedStep):
    """One footstep of a walk or a climb in time."""

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
    moves = transfers(feet, footsteps)
    if not moves:
        return (), params.lead_in
    climbs = [abs(m.end[2] - m.start[2]) > params.climb_threshold for m in moves]
    after = [
        params.climb_double_support if up else params.double_support for up in climbs
    ]
    single = [
        params.climb_single_support if up else params.single_support for up in climbs
    ]
    times = step_times([params.lead_in, *after[:-1]], single)
    steps = tuple(
        Step(m.foot, m.start, m.end, m.stance, *when, up)
        for m, when, up in zip(moves, times, climbs, strict=True)
    )
    return steps, steps[-1].land + params.lead_out


def plan_motion(task: MotionTask, walker: Walker) -> MotionPlan:
    """Plans the motion along footsteps, from standing to standing, beginning at time 0.

    Args:
        task: start, footsteps and edges.
        walker: parameters and robot.
    """
    feet, com, params = task.feet, task.com, walker.params
    preview, body = walker.preview, walker.body
    steps, end = schedule(feet, task.footsteps, params)
    n = round(end / params.period) + 1
    time: Vector = np.arange(n, dtype=np.float64) * params.period
    final = final_feet(feet, steps)
    zmp = _zmp_reference(time, steps, feet, final, com, end, params)
    weight = zmp_weight(time, end, params)
    drops = (0.0,) * len(steps)
    for _ in range(1 + REPAIRS):
        height = _com_height(time, steps, com[2], final, end, drops, params)
        rate = np.gradient(height, params.period)
        acceleration = np.gradient(rate, params.period)
        factor = height_factor(height, zmp[:, 2], acceleration)
        motion = generate_varying_height(
            zmp[:, :2], factor, preview, rest_state(com[:2]), weight
        )
        path = np.column_stack([motion.com, height])
        poses, contacts, lengths = _feet(time, steps, path, task, walker)
        waist = _waist(time, steps, poses, end, params)
        if body is None or not steps:
            break
        rows = slice(None, None, STRIDE)
        excess = height_excess(
            body, path[rows], waist[rows], poses[rows], params.knee_margin
        )
        if excess.max() < TOLERANCE:
            break
        more = step_drops(time[rows], excess, steps)
        drops = tuple(np.add(drops, more).tolist())
    zmp[:, :2] = motion.zmp
    if body is not None and steps:
        motion = follow_with_whole_body(
            motion, zmp, height, factor, weight, waist, poses, body, preview
        )
        path[:, :2] = motion.com
    return MotionPlan(
        start_time=0.0,
        period=params.period,
        footsteps=task.footsteps,
        phases=contact_phases(steps, end),
        contacts=contacts,
        foot_poses=poses,
        contact_lengths=lengths,
        com=path,
        com_velocity=np.column_stack([motion.velocity, rate]),
        com_acceleration=np.column_stack([motion.acceleration, acceleration]),
        zmp=zmp,
        cart_zmp=motion.com - preview.com_height / GRAVITY * motion.acceleration,
        waist=waist,
    )


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
    return along_keys(time, keys)


def _com_height(
    time: Vector,
    steps: tuple[Step, ...],
    start: float,
    final: Vector,
    end: float,
    drops: tuple[float, ...],
    params: MotionPlannerParams,
) -> Vector:
    """Each rise begins when a foot has landed and is over before the next one does.

    By `drops`, m, the CoM is lower while the legs make each of the steps.
    """
    height = np.full(len(time), start)
    level = start
    begin = 0.0
    for i, step in enumerate(steps):
        target = step.stance[2] + params.com_height - drops[i]
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
    com: Vector,
    task: MotionTask,
    walker: Walker,
) -> tuple[Vector, Vector, Vector]:
    """Computes foot poses (n, 2, 6), contacts (n, 2) and carrying lengths (n, 2)."""
    edges, params, robot = task.edges, walker.params, walker.robot
    sole = robot.sole
    poses = np.tile(task.feet, (len(time), 1, 1))
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
        swing = swing_trajectory(
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
        poses[rows, i] = np.hstack([swing.positions, swing.rpy])
        if step.climbs:
            poses[rows, i, :3] = drawn_inwards(
                swing.positions, step.foot, step.end[5], params.climb_inward
            )
        poses[land + 1 :, i] = step.end
        contacts[lift:land, i] = 0.0
        lengths[lift:land, i] = sole.length
    return poses, contacts, lengths


def _waist(
    time: Vector,
    steps: tuple[Step, ...],
    poses: Vector,
    end: float,
    params: MotionPlannerParams,
) -> Vector:
    """Orientation of the pelvis along a motion, roll, pitch, yaw, (n, 3), rad.

    Upright at both ends, leaning forward between where a step climbs, the swinging side
    of a climbing step raised; yaw midway between the feet.
    """
    rpy = np.zeros((len(time), 3))
    climbs = any(step.climbs for step in steps)
    if climbs:
        swings = [HighSwing(s.foot, s.lift, s.land, s.climbs) for s in steps]
        rpy[:, 0] = raised_hip(time, swings, end, params.climb_roll)
        blend = quintic(time / params.lead_in)
        blend -= quintic((time - end) / params.lead_out + 1.0)
        rpy[:, 1] = params.lean * blend
    rpy[:, 2] = poses[:, :, 5].mean(axis=1)
    return rpy
