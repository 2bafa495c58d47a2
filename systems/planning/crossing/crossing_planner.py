"""The crossing planner as a System: obstacles in, footsteps and motion out."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem, ValueProducer

from footfall.models.values.obstacle import Feasibility, Obstacle, ObstacleMap
from footfall.models.values.planned import FootstepPlan, MotionPlan
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.callbacks import weakly_bound
from footfall.systems.planning.crossing.feasibility_unit import feasibility_unit
from footfall.systems.planning.crossing.feet import section_of
from footfall.systems.planning.crossing.footsteps import in_the_way, plan_crossing_steps
from footfall.systems.planning.crossing.motion import plan_crossing
from footfall.systems.planning.crossing.params import (
    CrossingParams,
    ways_of_crossing,
)
from footfall.systems.planning.crossing.quasi_static_check import balance_of
from footfall.systems.planning.crossing.quasi_static_unit import quasi_static_unit
from footfall.systems.planning.crossing.report import refusal_of
from footfall.systems.planning.crossing.seen_floor import plan_walk_segment
from footfall.systems.planning.footsteps.foothold import Refusal
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    waist_above_com,
)
from footfall.systems.plant_cache import declare_scratch_context
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.timing import timed


@dataclass(frozen=True, eq=False)
class CrossingPlan(Value):
    """What the planner has decided."""

    footsteps: FootstepPlan
    motion: MotionPlan
    """A CrossingMotion with its report where footsteps are planned."""


class CrossingPlanner(LeafSystem):
    """Walks to a goal over what lies in the way (obstacle paper, Algorithm 1).

    .. pydrake_system::

        name: CrossingPlanner
        input_ports:
        - obstacle_map
        - goal
        - foot_references
        - com_reference
        output_ports:
        - footstep_plan
        - motion_plan

    - `obstacle_map`: what was seen, abstract ObstacleMap.
    - `goal`: midpoint of the feet and heading at the end in W, (3,), m and rad.
    - `foot_references`: sole frames X_WF that are tracked now, left then right, then
      their rates, (24,).
    - `com_reference`: p_WCom, v_WCom and a_WCom that are tracked now, (9,).
    - `footstep_plan`: abstract FootstepPlan; infeasible, with the reason, where an
      obstacle cannot be crossed.
    - `motion_plan`: abstract MotionPlan that starts at time 0; it stands where there
      are no footsteps, else it is a CrossingMotion with its report.
    """

    def __init__(
        self,
        footsteps: FootstepPlannerParams,
        walking: MotionPlannerParams,
        crossing: CrossingParams,
        preview: ZmpPreviewParams,
        body: WholeBody,
        standing: MotionPlan,
        mode: Mode = "dynamic",
    ) -> None:
        """Declares the ports.

        Args:
            footsteps: reach and tolerances of walking.
            walking: timing and shape of walking.
            crossing: of the crossing.
            preview: weights of the ZMP tracking.
            body: the robot alone.
            standing: a plan that stands.
            mode: how the robot is to cross.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        for params in (footsteps, walking, crossing, preview):
            params.validate()
        self._footsteps, self._walking = footsteps, walking
        self._preview, self._body = preview, body
        # The first way that will do is taken.
        self._ways = ways_of_crossing(crossing) if mode == "dynamic" else (crossing,)
        self._standing = standing
        self._mode: Mode = mode
        self._waist = walking.com_height + waist_above_com(body)
        self._map = self.DeclareAbstractInputPort(
            "obstacle_map", AbstractValue.Make(ObstacleMap())
        )
        self._goal = self.DeclareVectorInputPort("goal", 3)
        self._feet = self.DeclareVectorInputPort("foot_references", 24)
        self._com = self.DeclareVectorInputPort("com_reference", 9)
        self._scratch = declare_scratch_context(self, body.plant)
        nothing = CrossingPlan(FootstepPlan(), standing)
        compute: Callable[..., None] = timed(self, self._calc)
        entry = self.DeclareCacheEntry(
            "plan",
            ValueProducer(allocate=lambda: AbstractValue.Make(nothing), calc=compute),
            {port.ticket() for port in (self._map, self._goal, self._feet, self._com)},
        )
        # An entry that the System held would keep it alive for ever.
        self._plan = entry.cache_index()
        parts: tuple[tuple[str, Any, Callable[[CrossingPlan], object]], ...] = (
            ("footstep_plan", FootstepPlan(), lambda plan: plan.footsteps),
            ("motion_plan", standing, lambda plan: plan.motion),
        )
        for name, model, part in parts:
            calc: Callable[..., None] = weakly_bound(partial(self._calc_part, part))
            self.DeclareAbstractOutputPort(
                name,
                lambda model=model: AbstractValue.Make(model),
                calc,
                prerequisites_of_calc={entry.ticket()},
            )

    def _calc_part(
        self,
        part: Callable[[CrossingPlan], object],
        context: Context,
        output: AbstractValue,
    ) -> None:
        plan: Any = self.get_cache_entry(self._plan).Eval(context)
        output.set_value(part(plan))

    def _calc(self, context: Context, output: AbstractValue) -> None:
        obstacles = eval_abstract(self._map, context, ObstacleMap)
        goal = eval_vector(self._goal, context)
        feet = eval_vector(self._feet, context)[:12].reshape(2, 6)
        com = eval_vector(self._com, context)[:3]
        output.set_value(self._decide(obstacles, goal, feet, com, context))

    def _decide(
        self,
        seen: ObstacleMap,
        goal: Vector,
        feet: Vector,
        com: Vector,
        context: Context,
    ) -> CrossingPlan:
        if seen.status == "no floor":
            reason = "no floor was seen"
            return CrossingPlan(FootstepPlan((), "infeasible", reason), self._standing)
        sole = self._body.robot.sole
        heading = np.angle(np.exp(1j * feet[:, 5]).sum())
        start = np.array([*feet[:, :2].mean(axis=0), heading])
        leg = plan_walk_segment(seen, start, goal, sole)
        if isinstance(leg, Refusal):
            plan = FootstepPlan((), "infeasible", leg.reason)
            return CrossingPlan(plan, self._standing)
        ahead = in_the_way(leg.obstacles, start[:2], leg.goal[:2], sole)
        scratch = self._scratch(context)
        spent: dict[str, float] = {"FU": 0.0, "FTG to FTA": 0.0}
        refused = FootstepPlan()
        for way, crossing in enumerate(self._ways if ahead else self._ways[:1]):
            begun = perf_counter()
            answers = self._feasibilities(ahead, crossing, scratch)
            steps = plan_crossing_steps(
                feet, leg.goal, ahead, answers, sole, self._footsteps
            )
            asked = perf_counter()
            spent["FU"] += 1e3 * (asked - begun)
            if steps.plan.status != "planned":
                refused = steps.plan
                continue
            motion = plan_crossing(
                feet,
                com,
                steps.plan.footsteps,
                steps.obstacles,
                steps.keys,
                self._walking,
                crossing,
                self._preview,
                self._body,
                scratch,
                self._mode,
                give_up=True,
            )
            spent["FTG to FTA"] += 1e3 * (perf_counter() - asked)
            report = dataclasses.replace(
                motion.report, way=way, planning_ms=tuple(spent.items())
            )
            refusal = refusal_of(report, crossing)
            if not refusal:
                motion = dataclasses.replace(motion, report=report)
                return CrossingPlan(steps.plan, motion)
            refused = FootstepPlan((), "infeasible", refusal)
        return CrossingPlan(refused, self._standing)

    def _feasibilities(
        self, ahead: tuple[Obstacle, ...], crossing: CrossingParams, scratch: Context
    ) -> tuple[Feasibility, ...]:
        """FU for each obstacle."""
        leg, params = self._body.leg, crossing.feasibility
        sections = [section_of(obstacle) for obstacle in ahead]
        if self._mode == "dynamic":
            return tuple(
                feasibility_unit(section, self._waist, leg, params)
                for section in sections
            )
        quasi = crossing.quasi_static
        balance = balance_of(self._body, scratch, quasi)
        return tuple(
            quasi_static_unit(section, self._waist, leg, params, quasi, balance)
            for section in sections
        )
