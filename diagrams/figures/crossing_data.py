"""The crossings of a run read back: what was planned, over what, and when its phases.

Horizontal lengths in the figures are taken along x, the direction across the first
obstacle, and along y to its left; both from the origin of W.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from footfall.diagrams.judge.crossing_judge import SAME
from footfall.diagrams.run_data import RunData
from footfall.diagrams.signal_names import PLAN_SIGNAL
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.scenes.solids import Box
from footfall.models.values.feet import Foot
from footfall.models.values.obstacle import KeyConfiguration, Obstacle, across
from footfall.models.values.planned import Footstep
from footfall.models.values.value import pose_from_json
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import Repairs
from footfall.systems.planning.crossing.motion import plan_crossing
from footfall.systems.planning.crossing.params import CrossingParams, ways_of_crossing
from footfall.systems.planning.crossing.report import BodyCurves, CrossingMotion
from footfall.systems.planning.whole_body.whole_body_plan import planning_body

AROUND = 2
"""How many steps before and after a crossing its figures show."""


class Phases(NamedTuple):
    """When a crossing's phases begin and end, s of the simulation."""

    begin: float
    """The first foot leaves the ground: phase 1."""
    touch: float
    """It is down beyond the obstacle: phase 2."""
    lift: float
    """The second foot leaves the ground: phase 3."""
    end: float
    """It is down."""
    first: Foot
    """Which foot crosses in phase 1."""
    second: Foot
    """Which in phase 3."""


@dataclass(frozen=True, eq=False)
class PlannedCrossing:
    """One plan that was carried out, n ticks, with the obstacles that it crosses."""

    time: Vector
    """(n,), s of the simulation."""
    feet: Vector
    """Sole poses, (n, 2, 6), left first."""
    com: Vector
    """p_WCom, (n, 3), m."""
    zmp: Vector
    """The desired ZMP, (n, 2), m."""
    footsteps: tuple[Footstep, ...]
    obstacles: tuple[Obstacle, ...]
    """What is crossed, as it was seen."""
    keys: tuple[KeyConfiguration, ...]
    way: int
    """Which of `ways_of_crossing` the planner took."""
    repairs: Repairs
    """What the feet adaptor changed."""
    phases: tuple[Phases, ...]
    """Of each obstacle."""
    swings: Vector
    """When each footstep's foot is in the air, (k, 2), s of the simulation."""
    curves: BodyCurves
    """Of the whole body; `time` is that of the simulation."""

    def window(self) -> tuple[float, float]:
        """Spans the time from some steps before to as many after all crossings, s."""
        starts, ends = self.swings.T
        first = int(np.argmin(np.abs(starts - self.phases[0].begin)))
        last = int(np.argmin(np.abs(ends - self.phases[-1].end)))
        return (
            float(starts[max(first - AROUND, 0)]),
            float(ends[min(last + AROUND, len(ends) - 1)]),
        )

    def stretch(self) -> tuple[float, float]:
        """Phases 1 to 3 of all crossings, with a step before and after, s."""
        starts, ends = self.swings.T
        before = starts[starts < self.phases[0].begin - 1e-6]
        after = ends[ends > self.phases[-1].end + 1e-6]
        return (
            float(before[-1]) if len(before) else self.phases[0].begin,
            float(after[0]) if len(after) else self.phases[-1].end,
        )


def planned_crossings(
    entries: Sequence[tuple[float, Mapping[str, Any]]],
) -> tuple[PlannedCrossing, ...]:
    """Finds the plans of a run that cross something.

    Args:
        entries: what was logged of `PLAN_SIGNAL`, (time, value).
    """
    return tuple(
        _planned(value)
        for _, value in entries
        if value.get("report") and value["report"]["obstacles"]
    )


def _planned(value: Mapping[str, Any]) -> PlannedCrossing:
    start, report = float(value["start_time"]), value["report"]
    feet = _array(value["foot_poses"])
    curves = report["curves"]
    swings = [
        (start + phase["start"], start + phase["end"], phase["swing"])
        for phase in value["phases"]
        if phase["swing"]
    ]
    return PlannedCrossing(
        time=start + value["period"] * np.arange(len(feet)),
        feet=feet,
        com=_array(value["com"]),
        zmp=_array(value["zmp"])[:, :2],
        footsteps=tuple(
            Footstep(
                **{**step, "X_WF": pose_from_json(step["X_WF"])},
            )
            for step in value["footsteps"]
        ),
        obstacles=tuple(
            Obstacle(**{**item, "center": _array(item["center"])})
            for item in report["obstacles"]
        ),
        keys=tuple(KeyConfiguration(**key) for key in report["keys"]),
        way=int(report["way"]),
        repairs=Repairs(
            **{**report["repairs"], "path": _array(report["repairs"]["path"])}
        ),
        phases=tuple(
            _phases(start + begin, start + end, swings)
            for begin, end in report["phases"]
        ),
        swings=np.array([swing[:2] for swing in swings]),
        curves=BodyCurves(
            start + _array(curves["time"]),
            *(_array(curves[name]) for name in ("waist", "zmp_cwtg1", "zmp_cwtg2")),
        ),
    )


def _phases(
    begin: float, end: float, swings: Sequence[tuple[float, float, Foot]]
) -> Phases:
    """Finds what lies between the beginning of phase 1 and the end of phase 3."""
    inside = [s for s in swings if s[0] > begin - 1e-6 and s[1] < end + 1e-6]
    first, second = inside[0], inside[-1]
    return Phases(begin, first[1], second[0], end, first[2], second[2])


def _array(data: object) -> Vector:
    found: Vector = np.array(data, dtype=np.float64)
    return found


@dataclass(frozen=True, eq=False)
class CrossingData:
    """A run over obstacles: what truly happened and what was planned."""

    data: RunData
    plans: tuple[PlannedCrossing, ...]
    """At least one."""

    def params(self, plan: PlannedCrossing) -> CrossingParams:
        """Gives the parameters of the way in which a plan crosses."""
        params = self.data.run.scenario.parameters.crossing
        return ways_of_crossing(params)[plan.way]

    @property
    def axes(self) -> Vector:
        """The horizontal directions x and y of the figures, (2, 2)."""
        obstacle = self.plans[0].obstacles[0]
        box = self.true_box(obstacle)
        x = across(obstacle.yaw) if box is None else self.across_box(box, obstacle)
        return np.array([x, [-x[1], x[0]]])

    def true_box(self, obstacle: Obstacle) -> Box | None:
        """Finds the box that an obstacle truly is; None where there is none near it."""
        boxes = [
            solid
            for solid in self.data.run.scenario.scene.solids()
            if isinstance(solid, Box) and solid.role == "box"
        ]
        distances = [
            float(np.linalg.norm(box.X_WB.translation()[:2] - obstacle.center))
            for box in boxes
        ]
        if not distances or min(distances) > SAME:
            return None
        return boxes[int(np.argmin(distances))]

    @staticmethod
    def across_box(box: Box, obstacle: Obstacle) -> Vector:
        """Unit vector across a box's thin side as the obstacle is crossed, (2,)."""
        thin = int(np.argmin(box.size[:2]))
        direction: Vector = box.X_WB.rotation().matrix()[:2, thin]
        return direction if direction @ across(obstacle.yaw) >= 0.0 else -direction


def read_crossings(data: RunData) -> CrossingData | None:
    """Reads the crossings of a run; None where none was made or no plan was logged.

    Raises:
        RunError: the log of the plans is damaged.
    """
    if PLAN_SIGNAL not in data.run.value_names:
        return None
    plans = planned_crossings(data.run.values(PLAN_SIGNAL))
    return CrossingData(data, plans) if plans else None


def without_adaptation(
    crossing: CrossingData, planned: PlannedCrossing
) -> CrossingMotion:
    """Plans the same motion without feet adaptor and arms (Fig. 7, "before").

    Args:
        crossing: the run, whose parameters are taken.
        planned: what was carried out.
    """
    scenario = crossing.data.run.scenario
    robot, params = scenario.robot.model(), scenario.controllers()
    body = planning_body(robot, robot_alone(robot))
    motion = plan_crossing(
        planned.feet[0],
        planned.com[0],
        planned.footsteps,
        planned.obstacles,
        planned.keys,
        params.motion_planner,
        replace(crossing.params(planned), max_repairs=0, arm_swing=0.0),
        params.zmp_preview,
        body,
        body.plant.CreateDefaultContext(),
        "quasi_static" if scenario.task.mode == "quasi_static" else "dynamic",
    )
    moved = motion.starting_at(float(planned.time[0]))
    assert isinstance(moved, CrossingMotion)
    return moved
