"""Decides what is due in a room: look, plan, walk, and look while walking."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

import shapely  # type: ignore[import-untyped]
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.robots.robot import Sole
from footfall.models.values.planned import (
    Footstep,
    FootstepPlan,
    MotionPlan,
    TaskStatus,
)
from footfall.models.values.room import Environment, PathPlan
from footfall.models.values.validation import Parameters, number
from footfall.systems.planning.executive.decision_state import declare_decisions
from footfall.systems.planning.footsteps.foothold import sole_corners
from footfall.systems.ports import eval_abstract, eval_vector
from footfall.systems.thinking import ThinkingParams, Thought, ready_time

Activity: TypeAlias = Literal["look", "plan", "rest", "move", "replan", "stop", "stand"]


@dataclass(kw_only=True)
class PathExecutiveParams(Parameters):
    """When it decides and what it takes for blocked."""

    period: float = number(0.025, "s", least=1e-3, most=10.0)
    """Between decisions, s."""
    first_rest: float = number(1.5, "s", least=0.0)
    """Before this it does not set off, s: while it stands it learns its gyroscope's
    bias, which it cannot tell from a turn as it walks."""
    settle_time: float = number(0.4, "s", least=0.0)
    """Standing still before a look on which a path is planned, s."""
    look_period: float = number(0.5, "s", least=1e-3)
    """Between looks at the room while walking, s."""
    body_radius: float = number(0.22, "m", least=0.0)
    """What the walking body takes around each sole, m: a box that comes nearer blocks
    the step. Less than what paths keep, so that the noise of a box's edge does not. By
    default the robot's `body_radius`."""
    max_plans: int = number(20, least=1)
    """After this many plans the task is given up."""


@dataclass(frozen=True, eq=False)
class PathDecision(Thought):
    """What the executive has decided, and what that rests on."""

    motion_plan: MotionPlan
    footstep_plan: FootstepPlan = dataclasses.field(default_factory=FootstepPlan)
    path_plan: PathPlan = dataclasses.field(default_factory=PathPlan)
    environment: Environment = dataclasses.field(default_factory=Environment)
    activity: Activity = "look"
    since: float = 0.0
    """When this activity began, s."""
    looked: float = 0.0
    """When the room was last looked at, s; what was seen then may be yet to come."""
    plans: int = 0
    """How many motions were planned."""
    status: TaskStatus = dataclasses.field(
        default_factory=lambda: TaskStatus("running", "look")
    )


def blocking_box(
    footsteps: tuple[Footstep, ...],
    environment: Environment,
    sole: Sole,
    body_radius: float,
) -> str | None:
    """The name of a box in the way of footsteps; None where the way is clear.

    Args:
        footsteps: that are still to be made.
        environment: what is seen now.
        sole: of both feet.
        body_radius: what the body takes around each sole, m.
    """
    for footstep in footsteps:
        outline = shapely.Polygon(sole_corners(footstep.X_WF, sole)[:, :2])
        for box in environment.boxes:
            if outline.distance(shapely.Polygon(box.footprint())) < body_radius:
                return box.name
    return None


def remaining_footsteps(plan: MotionPlan, time: float) -> tuple[Footstep, ...]:
    """The footsteps of a plan that have not landed yet."""
    lands = [phase.end for phase in plan.phases if phase.swing is not None]
    done = sum(plan.start_time + land <= time for land in lands)
    return plan.footsteps[done:]


@dataclass(frozen=True)
class Sources:
    """What the executive can ask for; each is evaluated only when it is called."""

    environment: Callable[[], Environment]
    path: Callable[[], PathPlan]
    footsteps: Callable[[], FootstepPlan]
    motion: Callable[[], MotionPlan]
    stop: Callable[[MotionPlan, float], MotionPlan | None]


def decide(
    before: PathDecision,
    time: float,
    frames: int,
    sources: Sources,
    sole: Sole,
    params: PathExecutiveParams,
    thinking: ThinkingParams,
) -> PathDecision:
    """One decision.

    What is thought out rests on the frame and the stance of when the thinking began.

    Args:
        before: the last one.
        time: now, s.
        frames: how many frames the camera has taken.
        sources: perception and planners.
        sole: of both feet.
        params: see there.
        thinking: how long perception and planning take.

    Returns:
        The decision; `before` itself where nothing changes.
    """
    plan = before.motion_plan
    ended = time >= plan.start_time + plan.duration
    if before.activity in ("move", "replan", "stop") and ended:
        return _turn_to(dataclasses.replace(before, coming=None), "look", time)
    if before.coming is not None:
        return before.at(time)
    if before.activity == "look":
        if time - before.since < params.settle_time or frames == 0:
            return before
        return _look_and_plan(before, time, sources, params, thinking)
    if before.activity == "move" and time - before.looked >= params.look_period:
        return _look_on_the_way(before, time, sources, sole, params, thinking)
    return before


def _look_and_plan(
    before: PathDecision,
    time: float,
    sources: Sources,
    params: PathExecutiveParams,
    thinking: ThinkingParams,
) -> PathDecision:
    """A look while standing; what it shows and what is planned on it come later."""
    seen = ready_time(time, thinking.room_perception, params.period)
    ready = ready_time(seen, thinking.room_planning, params.period)
    environment = dataclasses.replace(sources.environment(), sensed_at=time)
    looking = dataclasses.replace(before, looked=time)
    known = dataclasses.replace(looking, environment=environment)
    planned = _plan(known, ready, sources, params)
    if planned.since > ready:
        planned = _turn_to(known, "rest", ready).until(planned.since, planned)
    planning = _turn_to(known, "plan", seen).until(ready, planned)
    return looking.until(seen, planning).at(time)


def _plan(
    before: PathDecision, ready: float, sources: Sources, params: PathExecutiveParams
) -> PathDecision:
    """What is to be done when the plan is ready, s, or later after the first rest."""
    footsteps = sources.footsteps()
    known = dataclasses.replace(
        before, path_plan=sources.path(), footstep_plan=footsteps
    )
    status, reason = footsteps.status, footsteps.reason
    if status == "planned" and before.plans >= params.max_plans:
        status, reason = "infeasible", f"not there after {before.plans} plans"
    if status != "planned":
        return _turn_to(known, "stand", ready, status, reason)
    start = ready_time(ready, max(0.0, params.first_rest - ready), params.period)
    plan = sources.motion().starting_at(start)
    moving = dataclasses.replace(known, motion_plan=plan, plans=before.plans + 1)
    return _turn_to(moving, "move", start)


def _look_on_the_way(
    before: PathDecision,
    time: float,
    sources: Sources,
    sole: Sole,
    params: PathExecutiveParams,
    thinking: ThinkingParams,
) -> PathDecision:
    """A look while walking; the walk goes on until a box is seen and a stop planned."""
    seen = ready_time(time, thinking.room_perception, params.period)
    environment = dataclasses.replace(sources.environment(), sensed_at=time)
    looking = dataclasses.replace(before, looked=time)
    looked = dataclasses.replace(looking, environment=environment)
    ahead = remaining_footsteps(before.motion_plan, seen)
    if blocking_box(ahead, environment, sole, params.body_radius) is None:
        return looking.until(seen, looked).at(time)
    ready = ready_time(seen, thinking.stopping, params.period)
    shorter = sources.stop(before.motion_plan, ready)
    if shorter is None:
        return looking.until(seen, looked).at(time)
    stopping = _turn_to(dataclasses.replace(looked, motion_plan=shorter), "stop", ready)
    replanning = _turn_to(looked, "replan", seen).until(ready, stopping)
    return looking.until(seen, replanning).at(time)


def _turn_to(
    before: PathDecision,
    activity: Activity,
    time: float,
    state: Literal["running", "finished", "infeasible"] = "running",
    reason: str = "",
) -> PathDecision:
    status = TaskStatus(state, activity, reason)
    return dataclasses.replace(before, activity=activity, since=time, status=status)


class PathExecutive(LeafSystem):
    """Looks at the room, plans a way to the goal, walks it, and looks on the way.

    A box that is seen on the steps ahead makes the robot stop in balance; it then
    looks again, plans anew and goes on. Perception and planning take time: the robot
    stands until a plan is there, and walks on until a stop is.

    .. pydrake_system::

        name: PathExecutive
        input_ports:
        - frame
        - environment
        - path_plan
        - footstep_plan
        - motion_plan
        output_ports:
        - motion_plan
        - footstep_plan
        - path_plan
        - environment
        - status

    - `frame`: how many frames the camera has taken, (1,).
    - `environment` (input): floor and boxes as seen now, abstract Environment;
      evaluated at every look.
    - `path_plan` (input): from where the robot stands to the goal, abstract PathPlan;
      evaluated once a plan, as are the next two.
    - `footstep_plan` (input): footsteps along it, abstract FootstepPlan.
    - `motion_plan` (input): the motion along those, abstract MotionPlan.
    - `motion_plan` (output): the motion that is being carried out.
    - `footstep_plan` (output): the footsteps that were planned last.
    - `path_plan` (output): their path.
    - `environment` (output): what was seen at the last look that is worked out, and
      when that look was.
    - `status`: how the task is going, abstract TaskStatus.
    """

    def __init__(
        self,
        params: PathExecutiveParams,
        sole: Sole,
        stand: MotionPlan,
        stop: Callable[[MotionPlan, float], MotionPlan | None],
        thinking: ThinkingParams | None = None,
    ) -> None:
        """Declares ports and the update.

        Args:
            params: see there.
            sole: of both feet.
            stand: the plan of the default context, which stands.
            stop: cuts a plan short from a time on; None where it ends as soon.
            thinking: how long perception and planning take; None for the defaults.

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate()
        self._params, self._sole, self._stop = params, sole, stop
        self._thinking = thinking or ThinkingParams()
        self._thinking.validate()
        self._frame = self.DeclareVectorInputPort("frame", 1)
        self._environment = self.DeclareAbstractInputPort(
            "environment", AbstractValue.Make(Environment())
        )
        self._path = self.DeclareAbstractInputPort(
            "path_plan", AbstractValue.Make(PathPlan())
        )
        self._footsteps = self.DeclareAbstractInputPort(
            "footstep_plan", AbstractValue.Make(FootstepPlan())
        )
        self._motion = self.DeclareAbstractInputPort(
            "motion_plan", AbstractValue.Make(stand)
        )
        self._decision = declare_decisions(
            self,
            PathDecision(stand),
            ("motion_plan", "footstep_plan", "path_plan", "environment", "status"),
            params.period,
            self._decide,
        )

    def _decide(self, context: Context, before: PathDecision) -> PathDecision:
        sources = Sources(
            lambda: eval_abstract(self._environment, context, Environment),
            lambda: eval_abstract(self._path, context, PathPlan),
            lambda: eval_abstract(self._footsteps, context, FootstepPlan),
            lambda: eval_abstract(self._motion, context, MotionPlan),
            self._stop,
        )
        frames = round(float(eval_vector(self._frame, context)[0]))
        return decide(
            before,
            context.get_time(),
            frames,
            sources,
            self._sole,
            self._params,
            self._thinking,
        )
