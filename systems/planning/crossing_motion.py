"""Algorithm 1: from footsteps over obstacles to the motion of the whole robot.

FTG, CWTG1, IK, UBMG, CWTG2 and FTA in the paper's order (Stasse et al. 2009, Sec.
III); FU has been asked before, when the footsteps were placed.
"""

import dataclasses
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from pydrake.systems.framework import Context
from scipy.interpolate import CubicSpline

from systems.balance.dynamic_filter import filter_motion_varying_height
from systems.balance.zmp_preview import (
    GRAVITY,
    ComMotion,
    ZmpPreviewParams,
)
from systems.balance.zmp_tracking import height_factor
from systems.obstacle_values import KeyConfiguration, Obstacle
from systems.planning.com_trajectory_generator import ComTracker, com_tracker
from systems.planning.crossing_feet import (
    Mask,
    crossing_rows,
    feet_along,
    section_of,
    yielding_path,
)
from systems.planning.crossing_params import CrossingParams, Mode, slowed
from systems.planning.crossing_posture import arm_swing, waist_height, waist_rpy
from systems.planning.crossing_report import (
    BodyCurves,
    CrossingMotion,
    CrossingReport,
    StaticBalance,
)
from systems.planning.crossing_timing import CrossingStep, time_steps, zmp_reference
from systems.planning.feet_adaptor import LegPoses, Repairs, adapt, leg_gaps
from systems.planning.leg_clearance import Section
from systems.planning.motion_params import MotionPlannerParams
from systems.planning.quasi_static_check import least_margin, worst_torque
from systems.planning.single_support_torque import single_support_torque
from systems.planning.step_timing import contact_phases
from systems.planning.whole_body_plan import (
    BodyMotion,
    WholeBody,
    body_motion,
    body_zmp,
    waist_over,
)
from systems.ports import Vector
from systems.values import FEET, ContactPhase, Footstep

TORQUE_TICK = 0.1
"""Between the postures of a quasi-static crossing whose torques are looked at, s."""
Index: TypeAlias = np.ndarray[Any, np.dtype[np.intp]]


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

    Returns:
        The motion and how well it does.
    """
    if mode == "quasi_static":
        walking, crossing = slowed(walking, crossing)
    steps, end = time_steps(feet, footsteps, walking, crossing)
    n = round(end / walking.period) + 1
    time: Vector = np.arange(n, dtype=np.float64) * walking.period
    zmp = zmp_reference(time, steps, feet, com, end, walking, crossing, mode)
    rpy = waist_rpy(time, steps, feet, crossing, mode)
    arms = arm_swing(time, steps, crossing, mode)
    course = _Course(
        time,
        steps,
        feet,
        com,
        zmp,
        rpy,
        arms,
        waist_over(body, context, com, feet, rpy[0]),
        obstacles,
        keys,
        walking,
        crossing,
        com_tracker(crossing.cwtg1, preview, com[:2]),
        body,
        context,
        mode,
    )
    repairs = course.repairs()
    moved, height, factor = course.single_mass(repairs)
    rows = course.rows
    motion = course.body_along(moved, height, repairs, rows)
    zmps = [course.multibody_zmp(motion)]
    for _ in range(crossing.filter_stages):
        moved = filter_motion_varying_height(
            moved, zmp[:, :2], course.at_every_tick(zmps[-1]), factor, preview
        )
        motion = course.body_along(moved, height, repairs, rows, _offset(motion))
        zmps.append(course.multibody_zmp(motion))
    spline = CubicSpline(time[rows], motion.com[:, 2])
    contacts = np.ones((n, 2))
    for step in steps:
        lift, land = (round(t / walking.period) for t in (step.lift, step.land))
        contacts[lift:land, FEET.index(step.foot)] = 0.0
    report = course.report(motion, zmps, repairs)
    com = np.column_stack([moved.com, spline(time)])
    poses, phases = course.soles(repairs, time), contact_phases(steps, end)
    if mode == "quasi_static":
        balance = course.static_balance(motion, com, poses, contacts, phases)
        report = dataclasses.replace(report, balance=balance)
    else:
        share, joint = course.torque(motion, contacts)
        report = dataclasses.replace(report, torque_share=share, torque_joint=joint)
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


@dataclass(frozen=True, eq=False)
class _Course:
    """What is given of a motion before its CoM and its feet over the obstacle are."""

    time: Vector
    steps: tuple[CrossingStep, ...]
    feet: Vector
    com: Vector
    zmp: Vector
    rpy: Vector
    arms: Vector
    start_waist: Vector
    obstacles: tuple[Obstacle, ...]
    keys: tuple[KeyConfiguration, ...]
    walking: MotionPlannerParams
    crossing: CrossingParams
    tracker: ComTracker
    body: WholeBody
    context: Context
    mode: Mode

    @property
    def ground(self) -> float:
        """Height of the floor, m."""
        return float(self.feet[:, 2].mean())

    @property
    def rows(self) -> Index:
        """Ticks at which the whole body is looked at."""
        return np.arange(0, len(self.time), self._stride)

    @property
    def _stride(self) -> int:
        return max(1, round(self.crossing.sampling / self.walking.period))

    def single_mass(self, repairs: Repairs) -> tuple[ComMotion, Vector, Vector]:
        """CWTG1: the CoM of the single mass, the waist's height, the height factor."""
        height = waist_height(
            self.time,
            self.steps,
            self.keys,
            self.start_waist[2],
            self.ground,
            repairs,
            self.crossing,
        )
        period = self.walking.period
        com_height = height + (self.com[2] - self.start_waist[2])
        acceleration = np.gradient(np.gradient(com_height, period), period)
        factor = height_factor(com_height, self.zmp[:, 2], acceleration)
        return self.tracker(self.zmp[:, :2], factor), height, factor

    def soles(self, repairs: Repairs, time: Vector) -> Vector:
        """FTG: sole poses, (n, 2, 6)."""
        return feet_along(
            time,
            self.steps,
            self.feet,
            self.obstacles,
            self.body.leg,
            self.crossing,
            repairs,
        )

    def body_along(
        self,
        moved: ComMotion,
        height: Vector,
        repairs: Repairs,
        rows: Index,
        guess: Vector | None = None,
    ) -> BodyMotion:
        """IK and UBMG at some ticks."""
        rounds = 1
        if guess is None:
            guess = np.tile(self.start_waist[:2] - self.com[:2], (len(rows), 1))
            rounds = 2 if self.mode == "quasi_static" else 1
        return body_motion(
            self.body,
            self.context,
            moved.com[rows],
            height[rows],
            self.rpy[rows],
            self.soles(repairs, self.time[rows]),
            self.arms[rows],
            guess,
            rounds,
        )

    def multibody_zmp(self, motion: BodyMotion) -> Vector:
        """p_MB at `rows`, (m, 2), m."""
        period = self._stride * self.walking.period
        ground = self.zmp[self.rows, 2]
        return body_zmp(self.body, self.context, motion.q, ground, period)

    def at_every_tick(self, values: Vector) -> Vector:
        """Values at `rows` spread over all ticks, (n, ...)."""
        spread: Vector = CubicSpline(self.time[self.rows], values)(self.time)
        spread[self.rows[-1] :] = values[-1]
        return spread

    def repairs(self) -> Repairs:
        """FTA: what has to change that the legs keep off the inflated obstacles."""
        window: Mask = crossing_rows(self.time[self.rows], self.steps)
        looked = self.rows[window][::2]
        if not len(looked):
            return Repairs()
        margins, leg = self.crossing.feasibility, self.body.leg
        inflated = tuple(
            Section(o.width + 2.0 * margins.s_w, o.height + margins.s_h)
            for o in self.obstacles
        )

        def poses_of(repairs: Repairs) -> LegPoses:
            moved, height, _ = self.single_mass(repairs)
            motion = self.body_along(moved, height, repairs, looked)
            return LegPoses(motion.angles, self.soles(repairs, self.time[looked]))

        def gaps_of(poses: LegPoses) -> Vector:
            shifts = [margins.s_w] * len(inflated)
            return leg_gaps(
                leg,
                poses.angles,
                poses.soles,
                self.obstacles,
                inflated,
                shifts,
                self.ground,
            )

        def yielding(poses: LegPoses, repairs: Repairs) -> Repairs | None:
            path = yielding_path(
                poses, gaps_of(poses), self.time[looked], self.steps, leg, repairs
            )
            return None if path is None else dataclasses.replace(repairs, path=path)

        straight = leg.lower[:, 3] + self.crossing.knee_margin
        folded = leg.upper[:, 3] - self.crossing.fold_margin
        highest = leg.sole.ankle_height + leg.hip_to_ankle(float(straight.max()))
        return adapt(
            poses_of,
            gaps_of,
            yielding,
            (straight, folded),
            self.ground + highest - self.start_waist[2],
            self.crossing.max_repairs,
        )

    def report(
        self, motion: BodyMotion, zmps: list[Vector], repairs: Repairs
    ) -> CrossingReport:
        """How well the motion does, from its joints at `rows`."""
        time = self.time[self.rows]
        gaps = leg_gaps(
            self.body.leg,
            motion.angles,
            self.soles(repairs, time),
            self.obstacles,
            tuple(section_of(obstacle) for obstacle in self.obstacles),
            [0.0] * len(self.obstacles),
            self.ground,
        )
        return CrossingReport(
            gap=float(gaps.min()) if gaps.size else float("inf"),
            short=float(motion.short.max()),
            zmp_error_before=self._zmp_error(zmps[0]),
            zmp_error_after=self._zmp_error(zmps[-1]),
            repairs=repairs,
            obstacles=self.obstacles,
            keys=self.keys,
            phases=tuple(
                (
                    min(step.lift for step in self.steps if step.obstacle == k),
                    max(step.land for step in self.steps if step.obstacle == k),
                )
                for k in range(len(self.obstacles))
            ),
            curves=BodyCurves(time, motion.waist, zmps[0], zmps[-1]),
        )

    def torque(self, motion: BodyMotion, contacts: Vector) -> tuple[float, str]:
        """Largest share of an effort limit while one foot carries in a crossing."""
        window = crossing_rows(self.time[self.rows], self.steps)
        carrying = np.where(window[:, None], contacts[self.rows], 0.0)
        share, joint, _ = single_support_torque(
            self.body,
            self.context,
            motion.q,
            self._stride * self.walking.period,
            carrying,
            max(1, round(TORQUE_TICK / self.crossing.sampling)),
        )
        return share, joint

    def static_balance(
        self,
        motion: BodyMotion,
        com: Vector,
        poses: Vector,
        contacts: Vector,
        phases: tuple[ContactPhase, ...],
    ) -> StaticBalance:
        """What a slow motion keeps; torques at a few moments of the crossings."""
        quasi = self.crossing.quasi_static
        looked = np.flatnonzero(crossing_rows(self.time[self.rows], self.steps))
        looked = looked[:: max(1, round(TORQUE_TICK / self.crossing.sampling))]
        at = self.rows[looked]
        share, joint, row = worst_torque(
            self.body, self.context, motion.q[looked], poses[at], contacts[at]
        )
        margin = least_margin(
            phases,
            com,
            poses,
            self.walking.period,
            self.body.robot.sole,
            quasi.friction,
        )
        return StaticBalance(margin, share, joint, float(self.time[at[row]]))

    def _zmp_error(self, p_MB: Vector) -> tuple[float, float]:
        """Largest ZMP error from phase 1 to 3 of any crossing, x and y of W, m."""
        inside = crossing_rows(self.time[self.rows], self.steps)
        if not inside.any():
            return 0.0, 0.0
        error = np.abs(self.zmp[self.rows, :2] - p_MB)[inside]
        return float(error[:, 0].max()), float(error[:, 1].max())


def _offset(motion: BodyMotion) -> Vector:
    """Where the waist is beside the CoM, (n, 2), m."""
    offset: Vector = motion.waist[:, :2] - motion.com[:, :2]
    return offset
