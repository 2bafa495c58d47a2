"""Algorithm 1: from footsteps over obstacles to the motion of the whole robot.

FTG, CWTG1, IK, UBMG, CWTG2 and FTA in the paper's order (Stasse et al. 2009, Sec.
III); FU has been asked before, when the footsteps were placed.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
from pydrake.systems.framework import Context
from scipy.interpolate import CubicSpline

from systems.balance.dynamic_filter import filter_motion_varying_height
from systems.balance.zmp_preview import (
    GRAVITY,
    ComMotion,
    ZmpPreviewParams,
    rest_state,
)
from systems.balance.zmp_tracking import generate_varying_height, height_factor
from systems.obstacle_values import KeyConfiguration, Obstacle, across
from systems.planning.crossing_params import CrossingParams
from systems.planning.crossing_timing import (
    TimedStep,
    bump,
    contact_phases,
    front_distance,
    section_of,
    third_order,
    time_steps,
    zmp_reference,
)
from systems.planning.feet_adaptor import (
    LegPoses,
    Repairs,
    adapt,
    ankle_displacement,
    leg_gaps,
    penetration_path,
)
from systems.planning.foot_trajectory_generator import Crossing, foot_trajectory
from systems.planning.leg_clearance import Section
from systems.planning.motion_params import MotionPlannerParams
from systems.planning.whole_body_plan import (
    BodyMotion,
    WholeBody,
    body_motion,
    body_zmp,
)
from systems.ports import Vector
from systems.values import FEET, Footstep, MotionPlan, Value


@dataclass(frozen=True, eq=False)
class BodyCurves(Value):
    """The planned motion of the whole body over time, n rows (Figs. 8 and 9)."""

    time: Vector
    """(n,), s after the motion's start."""
    waist: Vector
    """Origin of the pelvis in W, (n, 3), m."""
    zmp_cwtg1: Vector
    """p_MB: the multibody ZMP of the motion that CWTG1 plans, x and y, (n, 2), m."""
    zmp_cwtg2: Vector
    """The same of the motion after CWTG2, (n, 2), m."""


@dataclass(frozen=True, eq=False)
class CrossingReport(Value):
    """How well a planned motion keeps what it is to keep."""

    gap: float
    """Least distance of the legs to the true size of the obstacles as they were seen,
    m; inf without obstacles."""
    short: float
    """Most that an ankle is out of reach, m."""
    zmp_error_before: tuple[float, float]
    """Largest distance of the multibody ZMP to its reference after CWTG1, along and
    across the heading, over the crossings, m."""
    zmp_error_after: tuple[float, float]
    """The same after CWTG2."""
    repairs: Repairs
    obstacles: tuple[Obstacle, ...] = ()
    """What is crossed."""
    keys: tuple[KeyConfiguration, ...] = ()
    """The key configuration of each."""
    phases: tuple[tuple[float, float], ...] = ()
    """When phase 1 begins and phase 3 ends over each, s after the motion's start."""
    planning_ms: tuple[tuple[str, float], ...] = ()
    """Wall time of FU and of FTG to FTA, ms."""
    curves: BodyCurves | None = None
    """What the figures of a crossing show; None where nothing was planned."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossingMotion(MotionPlan):
    """A motion over obstacles and how well it does."""

    report: CrossingReport


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

    Returns:
        The motion and how well it does.
    """
    steps, end = time_steps(feet, footsteps, walking, crossing)
    n = round(end / walking.period) + 1
    time: Vector = np.arange(n, dtype=np.float64) * walking.period
    zmp = zmp_reference(
        time, steps, feet, com, end, walking, crossing.zmp_forward, crossing.zmp_rolling
    )
    stride = max(1, round(crossing.sampling / walking.period))
    rows = np.arange(0, n, stride)
    ground = float(feet[:, 2].mean())
    rpy = _waist_rpy(time, steps, feet, end, walking, crossing)
    posture = _arm_swing(time[rows], steps, crossing, body)
    start_waist = _waist_over(body, context, com, feet, rpy[0])

    def feet_of(repairs: Repairs, at: Vector) -> Vector:
        return _feet(at, steps, feet, obstacles, crossing, body, walking, repairs)

    def waist_of(repairs: Repairs, at: Vector) -> Vector:
        return _waist_height(at, steps, keys, start_waist[2], ground, repairs, crossing)

    guess = np.tile(start_waist[:2] - com[:2], (len(rows), 1))

    def single_mass(repairs: Repairs) -> tuple[ComMotion, Vector, Vector]:
        """CWTG1: the CoM of the single mass, the waist's height, the height factor."""
        waist_height = waist_of(repairs, time)
        com_height = waist_height + (com[2] - start_waist[2])
        factor = _factor(com_height, zmp[:, 2], walking.period)
        moved = generate_varying_height(
            zmp[:, :2], factor, preview, rest_state(com[:2])
        )
        return moved, waist_height, factor

    def legs_of(
        repairs: Repairs, moved: ComMotion, waist_height: Vector, rounds: int
    ) -> tuple[BodyMotion, Vector]:
        """IK and UBMG."""
        nonlocal guess
        soles = feet_of(repairs, time[rows])
        motion = body_motion(
            body,
            context,
            moved.com[rows],
            waist_height[rows],
            rpy[rows],
            soles,
            posture,
            guess,
            rounds,
        )
        guess = motion.waist[:, :2] - motion.com[:, :2]
        return motion, soles

    window = _crossing_rows(time[rows], steps)
    looked = rows[window][::2]

    def poses_of(repairs: Repairs) -> LegPoses:
        moved, waist_height, _ = single_mass(repairs)
        soles = feet_of(repairs, time[looked])
        motion = body_motion(
            body,
            context,
            moved.com[looked],
            waist_height[looked],
            rpy[looked],
            soles,
            {name: angle[window][::2] for name, angle in posture.items()},
            np.tile(start_waist[:2] - com[:2], (len(looked), 1)),
            rounds=1,
        )
        return LegPoses(motion.angles, soles)

    sections = tuple(section_of(obstacle) for obstacle in obstacles)
    margins = crossing.feasibility
    inflated = tuple(
        Section(s.width + 2.0 * margins.s_w, s.height + margins.s_h) for s in sections
    )

    def gaps_of(poses: LegPoses) -> Vector:
        shifts = [margins.s_w] * len(inflated)
        return leg_gaps(
            body.leg, poses.angles, poses.soles, obstacles, inflated, shifts, ground
        )

    def yielding(poses: LegPoses, repairs: Repairs) -> Repairs | None:
        gaps = gaps_of(poses)
        path = _yielding_path(poses, gaps, time[looked], steps, body, repairs)
        return None if path is None else dataclasses.replace(repairs, path=path)

    straight = body.leg.lower[:, 3] + crossing.knee_margin
    repairs = Repairs()
    if len(looked):
        repairs = adapt(
            poses_of,
            gaps_of,
            yielding,
            (
                straight,
                body.leg.upper[:, 3] - crossing.fold_margin,
            ),
            ground
            + body.leg.sole.ankle_height
            + body.leg.hip_to_ankle(float(straight.max()))
            - start_waist[2],
            crossing.max_repairs,
        )

    moved, waist_height, factor = single_mass(repairs)
    errors, zmps = [], []
    for stage in range(crossing.filter_stages + 1):
        motion, soles = legs_of(repairs, moved, waist_height, 1)
        p_MB = body_zmp(body, context, motion.q, zmp[rows, 2], stride * walking.period)
        errors.append(_worst(zmp[rows, :2] - p_MB, time[rows], steps))
        zmps.append(p_MB)
        if stage < crossing.filter_stages:
            spread = CubicSpline(time[rows], p_MB)(time)
            spread[rows[-1] :] = p_MB[-1]
            moved = filter_motion_varying_height(
                moved, zmp[:, :2], spread, factor, preview
            )
    before, after = errors[0], errors[-1]
    true_gap = leg_gaps(
        body.leg,
        motion.angles,
        soles,
        obstacles,
        sections,
        [0.0] * len(sections),
        ground,
    )
    report = CrossingReport(
        gap=float(true_gap.min()) if true_gap.size else float("inf"),
        short=float(motion.short.max()),
        zmp_error_before=before,
        zmp_error_after=after,
        repairs=repairs,
        obstacles=obstacles,
        keys=keys,
        phases=tuple(
            (
                min(step.lift for step in steps if step.obstacle == k),
                max(step.land for step in steps if step.obstacle == k),
            )
            for k in range(len(obstacles))
        ),
        curves=BodyCurves(time[rows], motion.waist, zmps[0], zmps[-1]),
    )
    height = CubicSpline(time[rows], motion.com[:, 2])
    path = np.column_stack([moved.com, height(time)])
    rate, acceleration = height(time, 1), height(time, 2)
    poses = feet_of(repairs, time)
    contacts = np.ones((n, 2))
    for step in steps:
        lift, land = (round(t / walking.period) for t in (step.lift, step.land))
        contacts[lift:land, FEET.index(step.foot)] = 0.0
    return CrossingMotion(
        report=report,
        start_time=0.0,
        period=walking.period,
        footsteps=footsteps,
        phases=contact_phases(steps, end),
        contacts=contacts,
        foot_poses=poses,
        contact_lengths=np.full((n, 2), body.robot.sole.length),
        com=path,
        com_velocity=np.column_stack([moved.velocity, rate]),
        com_acceleration=np.column_stack([moved.acceleration, acceleration]),
        zmp=zmp,
        cart_zmp=moved.com - preview.com_height / GRAVITY * moved.acceleration,
        waist=rpy,
    )


def _factor(com_height: Vector, zmp_height: Vector, period: float) -> Vector:
    acceleration = np.gradient(np.gradient(com_height, period), period)
    return height_factor(com_height, zmp_height, acceleration)


def _waist_over(
    body: WholeBody, context: Context, com: Vector, feet: Vector, rpy: Vector
) -> Vector:
    """Where the pelvis is when the CoM is at rest at `com`, (3,), m."""
    height = com[2] - 0.02
    waist = np.zeros(3)
    for _ in range(8):
        found = body_motion(
            body,
            context,
            com[None, :2],
            np.array([height]),
            rpy[None],
            feet[None],
            {},
            rounds=2,
        )
        height += com[2] - found.com[0, 2]
        waist = found.waist[0]
    return waist


def _waist_height(
    time: Vector,
    steps: tuple[TimedStep, ...],
    keys: tuple[KeyConfiguration, ...],
    walking: float,
    ground: float,
    repairs: Repairs,
    crossing: CrossingParams,
) -> Vector:
    """From walking height to Z_hds in phase 1 and back in phase 3 (Sec. III-C1)."""
    height = np.full(len(time), walking)
    for step in steps:
        if step.obstacle < 0:
            continue
        low = ground + keys[step.obstacle].Z_hds - repairs.lowered - walking
        u = (time - step.lift) / (step.land - step.lift)
        # High while the foot is folded over the obstacle, low while the legs straddle.
        down = third_order(1.0 + (u - 1.0) / crossing.waist_share)
        height += low * (down if step.leads else -third_order(u / crossing.waist_share))
        if repairs.raised > 0.0:
            middle = np.clip(u, 0.0, 1.0)
            height += repairs.raised * 16.0 * middle**2 * (1.0 - middle) ** 2
    return height


def _waist_rpy(
    time: Vector,
    steps: tuple[TimedStep, ...],
    feet: Vector,
    end: float,
    walking: MotionPlannerParams,
    crossing: CrossingParams,
) -> Vector:
    """Yaw midway between the feet, and what a crossing adds (Sec. III-C3)."""
    yaws = np.tile(feet[:, 5], (len(time), 1))
    for step in steps:
        i = FEET.index(step.foot)
        u = (time - step.lift) / (step.land - step.lift)
        turn = (step.end[5] - step.start[5] + np.pi) % (2.0 * np.pi) - np.pi
        yaws[:, i] += turn * third_order(u)
    rpy = np.zeros((len(time), 3))
    shape = bump(time, steps)
    rpy[:, 1] = crossing.lean * shape
    rpy[:, 2] = yaws.mean(axis=1)
    for step in steps:
        if step.leads:
            side = 1.0 if step.foot == "right" else -1.0
            rpy[:, 2] += side * crossing.waist_yaw * shape
            break
    return rpy


def _arm_swing(
    time: Vector,
    steps: tuple[TimedStep, ...],
    crossing: CrossingParams,
    body: WholeBody,
) -> dict[str, Vector]:
    """UBMG: shoulders that pitch back while the first foot crosses (Sec. III-D)."""
    if crossing.arm_swing == 0.0:
        return {}
    shape = bump(time, steps)
    return {
        name: body.robot.posture.get(name, 0.0) + crossing.arm_swing * shape
        for name in body.robot.posture
        if name.endswith("SHOULDER_P")
    }


def _feet(
    time: Vector,
    steps: tuple[TimedStep, ...],
    feet: Vector,
    obstacles: tuple[Obstacle, ...],
    crossing: CrossingParams,
    body: WholeBody,
    walking: MotionPlannerParams,
    repairs: Repairs,
) -> Vector:
    """FTG for every step: sole poses, (n, 2, 6)."""
    poses = np.tile(feet, (len(time), 1, 1))
    margins = crossing.feasibility
    for step in steps:
        i = FEET.index(step.foot)
        over = None
        if step.obstacle >= 0:
            obstacle = obstacles[step.obstacle]
            x0, x1, top = section_of(obstacle).inflated(margins.s_w, margins.s_h)
            front = front_distance(obstacle, step.start[:2]) + x0
            over = Crossing(Section(x1 - x0, top), front, step.leads)
        inside = (time >= step.lift) & (time <= step.land)
        poses[inside, i] = foot_trajectory(
            step.start,
            step.end,
            time[inside] - step.lift,
            step.land - step.lift,
            over,
            body.leg.outline,
            body.leg.sole.ankle_height,
            crossing.feet,
            0.0 if step.obstacle < 0 or step.leads else repairs.shift,
        )
        if step.obstacle >= 0 and not step.leads and repairs.path.size:
            x_W = across(obstacles[step.obstacle].yaw)
            u = (time[inside] - step.lift) / (step.land - step.lift)
            push = np.interp(u, np.linspace(0.0, 1.0, len(repairs.path)), repairs.path)
            poses[inside, i, :2] += push[:, None] * x_W
        poses[time > step.land, i] = step.end
    return poses


def _crossing_rows(
    time: Vector, steps: tuple[TimedStep, ...]
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which rows lie in phases 1 to 3 of a crossing, (n,)."""
    inside = np.zeros(len(time), dtype=bool)
    for step in steps:
        if step.obstacle >= 0:
            inside |= (time >= step.push) & (time <= step.land + 0.05)
    return inside


def _yielding_path(
    poses: LegPoses,
    gaps: Vector,
    time: Vector,
    steps: tuple[TimedStep, ...],
    body: WholeBody,
    repairs: Repairs,
) -> Vector | None:
    """The third repair for the second foot over the obstacle it is deepest in."""
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
            middle = 0.5 * body.leg.shank
            dP = ankle_displacement(body.leg, step.foot, angles, middle, 1.0)
            leverage[row] = min(max(dP, 0.5), 3.0)
        share = (time[inside] - step.lift) / (step.land - step.lift)
        return penetration_path(depth, share, leverage, repairs.path)
    return None


def _worst(
    error: Vector, time: Vector, steps: tuple[TimedStep, ...]
) -> tuple[float, float]:
    """Largest ZMP error from phase 1 to 3 of any crossing, x and y of W, m."""
    inside = _crossing_rows(time, steps)
    if not inside.any():
        return 0.0, 0.0
    x, y = np.abs(error[inside]).max(axis=0)
    return float(x), float(y)
