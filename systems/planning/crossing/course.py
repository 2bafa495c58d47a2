"""A crossing between its steps in time and its motion: CWTG1, FTG, IK and FTA on it."""

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
from footfall.systems.planning.crossing.params import CrossingParams, Mode
from footfall.systems.planning.crossing.posture import waist_height
from footfall.systems.planning.crossing.timing import CrossingStep
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.whole_body.whole_body_plan import (
    BodyMotion,
    WholeBody,
    body_motion,
    body_zmp,
)

Index: TypeAlias = np.ndarray[Any, np.dtype[np.intp]]


@dataclass(frozen=True, eq=False)
class Course:
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
    def tick(self) -> float:
        """Between `rows`, s."""
        return self._stride * self.walking.period

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
        soles: Vector | None = None,
    ) -> BodyMotion:
        """IK and UBMG at some ticks."""
        rounds = 1
        if guess is None:
            guess = np.tile(self.start_waist[:2] - self.com[:2], (len(rows), 1))
            rounds = 2 if self.mode == "quasi_static" else 1
        return body_motion(
            self.body,
            moved.com[rows],
            height[rows],
            self.rpy[rows],
            self.soles(repairs, self.time[rows]) if soles is None else soles,
            self.arms[rows],
            guess,
            rounds,
        )

    def multibody_zmp(self, motion: BodyMotion) -> Vector:
        """p_MB at `rows`, (m, 2), m."""
        ground = self.zmp[self.rows, 2]
        return body_zmp(self.body, motion.q, ground, self.tick)

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

        masses: dict[tuple[float, float], tuple[ComMotion, Vector, Vector]] = {}

        def poses_of(repairs: Repairs) -> LegPoses:
            # The other repairs change the feet alone.
            heights = (repairs.raised, repairs.lowered)
            if heights not in masses:
                masses[heights] = self.single_mass(repairs)
            moved, height, _ = masses[heights]
            soles = self.soles(repairs, self.time[looked])
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
