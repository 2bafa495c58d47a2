"""Quasi-static segments laid out in time: the motion plan that carries them out."""

import numpy as np

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.planned import ContactPhase, MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import GRAVITY
from footfall.systems.planning.footsteps.footstep_planner import pose_from_xyz_rpy
from footfall.systems.planning.motion.motion import LEVEL
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.motion.quasi_static import Segment
from footfall.systems.planning.motion.swing_trajectory import quintic, swing_trajectory
from footfall.systems.planning.motion.thigh_clearance import (
    HighSwing,
    drawn_inwards,
    raised_hip,
)
from footfall.systems.planning.motion.toe_off import lift_heel


def play_segments(
    segments: tuple[Segment, ...], task: MotionTask, walker: Walker
) -> MotionPlan:
    """Samples segments: straight CoM lines, at rest at both ends.

    Args:
        segments: at least one, each beginning where the last one ended.
        task: whose footsteps they carry out, and the edges.
        walker: parameters, those of the cart among them, and robot.

    Returns:
        The plan; its ZMP reference is the CoM's projection.
    """
    params, robot = walker.params, walker.robot
    period = params.period
    counts = [round(segment.duration / period) for segment in segments]
    pause = round(params.quasi_static.rest / period)
    n = sum(counts) + pause * len(counts) + 1
    com, zmp = np.zeros((n, 3)), np.zeros((n, 3))
    waist = np.zeros((n, 3))
    poses, lengths, contacts = np.zeros((n, 2, 6)), np.zeros((n, 2)), np.ones((n, 2))
    phases: list[ContactPhase] = []
    swings: list[HighSwing] = []
    row = 0
    for segment, count in zip(segments, counts, strict=True):
        # The last segment's rows go to the end; a later one overwrites its own.
        rows = slice(row, n)
        u = quintic(np.minimum(np.arange(n - row) / count, 1.0))[:, None]
        com[rows] = segment.com[0] + u * (segment.com[1] - segment.com[0])
        zmp[rows, 2] = _ground(segment, com[rows])
        waist[rows, 1] = segment.lean[0] + u[:, 0] * np.diff(segment.lean)
        lengths[rows] = segment.lengths
        contacts[rows] = 1.0
        poses[rows] = _feet(segment, u[:, 0], count, task.edges, params, robot)
        if segment.swing is not None:
            contacts[row : row + count, FEET.index(segment.swing)] = 0.0
            land = (row + count) * period
            rise = _rise(segment, segment.swing, robot)
            high = abs(rise) > params.climb_threshold
            swings.append(HighSwing(segment.swing, row * period, land, high))
        start = row * period
        row += count + pause
        phases.append(ContactPhase(start, row * period, segment.stance, segment.swing))
    velocity: Vector = np.asarray(np.gradient(com, period, axis=0))
    acceleration: Vector = np.asarray(np.gradient(velocity, period, axis=0))
    zmp[:, :2] = com[:, :2]
    time: Vector = np.arange(n, dtype=np.float64) * period
    waist[:, 0] = raised_hip(time, swings, time[-1], params.climb_roll)
    waist[:, 2] = poses[:, :, 5].mean(axis=1)
    return MotionPlan(
        start_time=0.0,
        period=period,
        footsteps=task.footsteps,
        phases=tuple(phases),
        contacts=contacts,
        foot_poses=poses,
        contact_lengths=lengths,
        com=com,
        com_velocity=velocity,
        com_acceleration=acceleration,
        zmp=zmp,
        cart_zmp=com[:, :2] - walker.preview.com_height / GRAVITY * acceleration[:, :2],
        waist=waist,
    )


def _ground(segment: Segment, com: Vector) -> Vector:
    """Height of the ground under the CoM, (n,), m; in between where both feet stand."""
    if segment.swing is not None:
        return np.full(len(com), segment.start[FEET.index(segment.stance[0]), 2])
    left, right = segment.start[:, :3]
    way = (right - left)[:2]
    share = np.clip((com[:, :2] - left[:2]) @ way / (way @ way), 0.0, 1.0)
    height: Vector = left[2] + share * (right[2] - left[2])
    return height


def _rise(segment: Segment, foot: Foot, robot: RobotModel) -> float:
    """How much higher a foot ends than the ground it leaves, heel up or not, m."""
    start, end = (feet[FEET.index(foot)] for feet in (segment.start, segment.end))
    rise: float = end[2] - start[2] + robot.sole.toe * np.sin(start[4])
    return rise


def _feet(
    segment: Segment,
    u: Vector,
    count: int,
    edges: Vector,
    params: MotionPlannerParams,
    robot: RobotModel,
) -> Vector:
    """Poses of both feet from a segment's start on, (n, 2, 6)."""
    n = len(u)
    poses = np.tile(segment.start, (n, 1, 1))
    for i, foot in enumerate(FEET):
        start, end = segment.start[i], segment.end[i]
        if foot != segment.swing:
            if end[4] > start[4]:
                poses[:, i] = lift_heel(start, u * end[4], robot.sole)
            continue
        ground = end[2] - _rise(segment, foot, robot)
        way = swing_trajectory(
            pose_from_xyz_rpy(start),
            pose_from_xyz_rpy(end),
            count * params.period,
            params.period,
            edges[(edges[:, 2] > ground + LEVEL) & (edges[:, 2] < end[2] + LEVEL)],
            robot.sole,
            params.swing,
        )
        stop = min(n, count + 1)
        poses[:stop, i] = np.hstack([way.positions, way.rpy])[:stop]
        if abs(_rise(segment, foot, robot)) > params.climb_threshold:
            bowed = drawn_inwards(way.positions, foot, end[5], params.climb_inward)
            poses[:stop, i, :3] = bowed[:stop]
        poses[stop:, i] = end
    return poses
