"""Decides what is due: scan, plan, move, scan again."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.planned import FootstepPlan, MotionPlan, TaskStatus
from footfall.models.values.validation import Parameters, number, require_at_least
from footfall.systems.planning.executive.decision_state import declare_decisions
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.thinking import Thought, ready_time
from footfall.systems.timing import timed

Activity: TypeAlias = Literal["settle", "scan", "plan", "move", "stand"]


@dataclass(kw_only=True)
class ExecutiveParams(Parameters):
    """When it decides."""

    period: float = number(0.025, "s", least=1e-3, most=10.0)
    """Between decisions, s."""
    settle_time: float = number(0.3, "s", least=0.0)
    """Standing still before a scan, s."""


@dataclass(frozen=True, eq=False)
class Decision(Thought):
    """What the executive has decided, and what that rests on."""

    motion_plan: MotionPlan
    """What is being carried out."""
    footstep_plan: FootstepPlan = dataclasses.field(default_factory=FootstepPlan)
    """The footsteps of that."""
    activity: Activity = "settle"
    since: float = 0.0
    """When this activity began, s."""
    sweeps: int = 0
    """Sweeps of which the result has been used or is being planned on."""
    status: TaskStatus = dataclasses.field(default_factory=TaskStatus)


def decide(
    before: Decision,
    time: float,
    sweeps: int,
    plan_footsteps: Callable[[], FootstepPlan],
    plan_motion: Callable[[], MotionPlan],
    params: ExecutiveParams,
    latency: float = 0.0,
) -> Decision:
    """One decision.

    Args:
        before: the last one.
        time: now, s.
        sweeps: how many sweeps perception has worked in.
        plan_footsteps: plans on what is known now; called once a scan.
        plan_motion: plans the motion along those footsteps; called once a plan.
        params: see there.
        latency: how long planning takes, s. What is planned rests on what is known when
            it begins, and the robot stands still until it is there.

    Returns:
        The decision; `before` itself where nothing changes.
    """
    if before.activity == "settle":
        if time - before.since < params.settle_time:
            return before
        return _turn_to(before, "scan", time)
    if before.activity == "scan":
        if sweeps <= before.sweeps:
            return before
        planning = dataclasses.replace(before, sweeps=sweeps)
        ready = ready_time(time, latency, params.period)
        planned = _plan(planning, ready, plan_footsteps, plan_motion)
        return _turn_to(planning, "plan", time).until(ready, planned).at(time)
    if before.activity == "plan":
        return before.at(time)
    if before.activity == "move":
        plan = before.motion_plan
        if time < plan.start_time + plan.duration:
            return before
        return _turn_to(before, "settle", time)
    return before


def _plan(
    before: Decision,
    ready: float,
    plan_footsteps: Callable[[], FootstepPlan],
    plan_motion: Callable[[], MotionPlan],
) -> Decision:
    """What is to be done from `ready` on, s."""
    footsteps = plan_footsteps()
    known = dataclasses.replace(before, footstep_plan=footsteps)
    if footsteps.status != "planned":
        return _turn_to(known, "stand", ready, footsteps.status, footsteps.reason)
    plan = plan_motion().starting_at(ready)
    if plan.reason:
        return _turn_to(known, "stand", ready, "infeasible", plan.reason)
    return _turn_to(dataclasses.replace(known, motion_plan=plan), "move", ready)


def _turn_to(
    before: Decision,
    activity: Activity,
    time: float,
    state: Literal["running", "finished", "infeasible"] = "running",
    reason: str = "",
) -> Decision:
    status = TaskStatus(state, activity, reason)
    return dataclasses.replace(before, activity=activity, since=time, status=status)


class Executive(LeafSystem):
    """Scans, plans on what was seen, moves, and scans again until nothing is left.

    Planning takes time: the robot stands meanwhile, and a plan begins when it is there.

    .. pydrake_system::

        name: Executive
        input_ports:
        - sweep
        - footstep_plan
        - motion_plan
        output_ports:
        - motion_plan
        - footstep_plan
        - status
        - scan

    - `sweep`: number of sweeps that perception has worked in, (1,).
    - `footstep_plan` (input): footsteps on what is known now, abstract FootstepPlan;
      evaluated once a sweep.
    - `motion_plan` (input): motion along them, abstract MotionPlan; evaluated once a
      plan.
    - `motion_plan` (output): the motion that is being carried out.
    - `footstep_plan` (output): its footsteps.
    - `scan`: 1 while the scanner is to sweep, else 0, (1,).
    - `status`: how the task is going, abstract TaskStatus.
    """

    def __init__(
        self, params: ExecutiveParams, stand: MotionPlan, latency: float = 0.0
    ) -> None:
        """Declares ports and the update.

        Args:
            params: see there.
            stand: the plan of the default context, which stands.
            latency: how long planning takes, s.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate()
        require_at_least("latency", latency, 0.0, "s")
        self._params, self._latency = params, latency
        self._sweep = self.DeclareVectorInputPort("sweep", 1)
        self._footsteps = self.DeclareAbstractInputPort(
            "footstep_plan", AbstractValue.Make(FootstepPlan())
        )
        self._motion = self.DeclareAbstractInputPort(
            "motion_plan", AbstractValue.Make(stand)
        )
        self._decision = declare_decisions(
            self,
            Decision(stand),
            ("motion_plan", "footstep_plan", "status"),
            params.period,
            self._decide,
        )
        self.DeclareVectorOutputPort(
            "scan",
            1,
            timed(self, self._calc_scan),
            prerequisites_of_calc={self.xa_ticket()},
        )

    def _calc_scan(self, context: Context, output: BasicVector) -> None:
        scan = self._decision(context).activity == "scan"
        set_vector(output, np.array([float(scan)]))

    def _decide(self, context: Context, before: Decision) -> Decision:
        return decide(
            before,
            context.get_time(),
            round(float(eval_vector(self._sweep, context)[0])),
            lambda: eval_abstract(self._footsteps, context, FootstepPlan),
            lambda: eval_abstract(self._motion, context, MotionPlan),
            self._params,
            self._latency,
        )
