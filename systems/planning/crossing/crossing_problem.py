"""The problem of a crossing: from steps in time to CoM, waist and feet.

CWTG1, FTG, IK and FTA of the obstacle paper, Sec. III, applied to one motion.
"""

import dataclasses
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from pydrake.systems.framework import Context
from scipy.interpolate import CubicSpline

from footfall.models.values.obstacle import KeyConfiguration, Obstacle
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ComMotion
from footfall.systems.balance.zmp_tracking import height_factor
from footfall.systems.planning.crossing.com_trajectory_generator import ComTracker
from footfall.systems.planning.crossing.feet import (
    Mask,
    crossing_rows,
    feet_along,
    yielding_path,
)
from footfall.systems.planning.crossing.feet_adaptor import (
    LegPoses,
    Repairs,
    adapt,
    leg_gaps,
)
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.crossing.params import CrossingParams
from footfall.systems.planning.crossing.posture import waist_height
from footfall.systems.planning.crossing.timing import CrossingStep
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.whole_body.whole_body_plan import (
    BodyMotion,
    WholeBody,
    body_motion,
    body_zmp,
)

Index: TypeAlias = np.ndarray[Any, np.dtype[np.intp]]


@dataclass(frozen=True, eq=False, kw_only=True)
class Schedule:
    """What is decided of a motion tick by tick before its CoM and its feet are."""

    time: Vector
    """Of the n ticks, (n,), s."""
    steps: tuple[CrossingStep, ...]
    """The footsteps in time."""
    zmp: Vector
    """Reference of the ZMP, (n, 3), m."""
    rpy: Vector
    """Orientation of the waist, (n, 3), rad."""
    arms: Vector
    """How far each arm swings, (n, 2)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossingStart:
    """Where the robot stands before the first step."""

    feet: Vector
    """Sole poses, (2, 6)."""
    com: Vector
    """p_WCom, (3,), m."""
    waist: Vector
    """p_WWaist, (3,), m."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossingProblem:
    """A motion to be found: CoM, waist and feet over the obstacles (CWTG, FTG, FTA)."""

    schedule: Schedule
    start: CrossingStart
    obstacles: tuple[Obstacle, ...]
    keys: tuple[KeyConfiguration, ...]
    """The double support over each of them."""
    walking: MotionPlannerParams
    crossing: CrossingParams
    tracker: ComTracker
    """CWTG1."""
    body: WholeBody
    context: Context
    """Scratch context of its plant."""
    mode: Mode

    @property
    def ground(self) -> float:
        """Computes the height of the floor, m."""
        return float(self.start.feet[:, 2].mean())

    @property
    def rows(self) -> Index:
        """Lists the ticks at which the whole body is evaluated."""
        return np.arange(0, len(self.schedule.time), self._stride)

    @property
    def tick(self) -> float:
        """Computes the time between `rows`, s."""
        return self._stride * self.walking.period

    @property
    def _stride(self) -> int:
        return max(1, round(self.crossing.sampling / self.walking.period))

    def single_mass(self, repairs: Repairs) -> tuple[ComMotion, Vector, Vector]:
        """Runs CWTG1: CoM of the single mass, height of the waist, height factor."""
        height = waist_height(
            self.schedule.time,
            self.schedule.steps,
            self.keys,
            self.start.waist[2],
            self.ground,
            repairs,
            self.crossing,
        )
        period = self.walking.period
        com_height = height + (self.start.com[2] - self.start.waist[2])
        acceleration = np.gradient(np.gradient(com_height, period), period)
        factor = height_factor(com_height, self.schedule.zmp[:, 2], acceleration)
        return self.tracker(self.schedule.zmp[:, :2], factor), height, factor

    def soles(self, repairs: Repairs, time: Vector) -> Vector:
        """Runs FTG: sole poses, (n, 2, 6)."""
        return feet_along(
            time,
            self.schedule.steps,
            self.start.feet,
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
        soles: Vector | None = None,
    ) -> BodyMotion:
        """Runs IK and UBMG at some ticks."""
        rounds = 1
        if guess is None:
            guess = np.tile(self.start.waist[:2] - self.start.com[:2], (len(rows), 1))
            rounds = 2 if self.mode == "quasi_static" else 1
        return body_motion(
            self.body,
            moved.com[rows],
            height[rows],
            self.schedule.rpy[rows],
            self.soles(repairs, self.schedule.time[rows]) if soles is None else soles,
            self.schedule.arms[rows],
            guess,
            rounds,
        )

    def multibody_zmp(self, motion: BodyMotion) -> Vector:
        """Computes p_MB (Eq. 20) at `rows`, (m, 2), m."""
        ground = self.schedule.zmp[self.rows, 2]
        return body_zmp(self.body, motion.q, ground, self.tick)

    def at_every_tick(self, values: Vector) -> Vector:
        """Interpolates values at `rows` to all ticks, (n, ...)."""
        spread: Vector = CubicSpline(self.schedule.time[self.rows], values)(
            self.schedule.time
        )
        spread[self.rows[-1] :] = values[-1]
        return spread

    def repairs(self) -> Repairs:
        """Runs FTA: changes that keep the legs off the inflated obstacles."""
        window: Mask = crossing_rows(self.schedule.time[self.rows], self.schedule.steps)
        looked = self.rows[window][::2]
        if not len(looked):
            return Repairs()
        margins, leg = self.crossing.feasibility, self.body.leg
        inflated = tuple(
            Section(o.width + 2.0 * margins.s_w, o.height + margins.s_h)
            for o in self.obstacles
        )

        masses: dict[tuple[float, float], tuple[ComMotion, Vector, Vector]] = {}

        def poses_of(repairs: Repairs) -> LegPoses:
            # The other repairs change the feet alone.
            heights = (repairs.raised, repairs.lowered)
            if heights not in masses:
                masses[heights] = self.single_mass(repairs)
            moved, height, _ = masses[heights]
            soles = self.soles(repairs, self.schedule.time[looked])
            motion = self.body_along(moved, height, repairs, looked, soles=soles)
            return LegPoses(motion.angles, soles)

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
                poses,
                gaps_of(poses),
                self.schedule.time[looked],
                self.schedule.steps,
                leg,
                repairs,
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
            self.ground + highest - self.start.waist[2],
            self.crossing.max_repairs,
        )
