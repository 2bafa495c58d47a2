"""The room's executive: look, plan, walk, look again, stop for a box, plan anew."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.analysis import Simulator

from footfall.models.robots.robot import Sole
from footfall.models.values.planned import (
    ContactPhase,
    Footstep,
    FootstepPlan,
    MotionPlan,
    TaskStatus,
)
from footfall.models.values.room import Environment, ObstacleBox, PathPlan
from footfall.systems.planning.executive.path_executive import (
    PathDecision,
    PathExecutive,
    PathExecutiveParams,
    Sources,
    blocking_box,
    decide,
    remaining_footsteps,
)
from footfall.systems.thinking import ThinkingParams

SOLE = Sole(heel=0.10, toe=0.15, half_width=0.05, ankle_height=0.1)
PARAMS = PathExecutiveParams(
    first_rest=0.0, settle_time=0.4, look_period=0.5, body_radius=0.2
)
AT_ONCE = ThinkingParams(room_perception=0.0, room_planning=0.0, stopping=0.0)
SLOW = ThinkingParams(room_perception=0.2, room_planning=0.51, stopping=0.1)
PLANNED = FootstepPlan(status="planned")
STEPS = tuple(
    Footstep(foot, RigidTransform([0.25 * (i + 1), y, 0.0]), -1)
    for i, (foot, y) in enumerate((("left", 0.1), ("right", -0.1)) * 2)
)


def box(x: float, y: float = 0.0) -> ObstacleBox:
    """A box of 20 cm."""
    return ObstacleBox("bin", np.array([x, y, 0.1]), 0.0, np.full(3, 0.2))


def motion(duration: float, start_time: float = 0.0) -> MotionPlan:
    """A walk of four steps, each in the air for half of its quarter of the time."""
    rows = np.zeros((round(duration / 0.005) + 1, 3))
    quarter = duration / 4.0
    phases = []
    for i, step in enumerate(STEPS if duration else ()):
        lifts, lands = (i + 0.5) * quarter, (i + 1.0) * quarter
        phases.append(ContactPhase(i * quarter, lifts, ("left", "right"), None))
        stance = "right" if step.foot == "left" else "left"
        phases.append(ContactPhase(lifts, lands, (stance,), step.foot))
    return MotionPlan(
        start_time=start_time,
        period=0.005,
        footsteps=STEPS if duration else (),
        phases=tuple(phases),
        contacts=np.ones((len(rows), 2)),
        foot_poses=np.zeros((len(rows), 2, 6)),
        contact_lengths=np.ones((len(rows), 2)),
        com=rows,
        com_velocity=rows,
        com_acceleration=rows,
        zmp=rows,
        cart_zmp=np.zeros((len(rows), 2)),
        waist=rows,
    )


STAND = motion(0.0)
WALK = motion(4.0)


def unasked(*_: object) -> None:
    """Stands in for a source that must not be asked."""
    raise AssertionError("asked for what is not needed")


def decided(
    before: PathDecision,
    time: float,
    frames: int = 1,
    *,
    environment: Environment | None = None,
    footsteps: FootstepPlan | None = None,
    plan: MotionPlan | None = None,
    stop: Callable[[MotionPlan, float], MotionPlan | None] = unasked,  # type: ignore
    params: PathExecutiveParams = PARAMS,
    thinking: ThinkingParams = AT_ONCE,
) -> PathDecision:
    """One decision; sources that are not given must not be asked."""

    def give(value: object) -> Callable[[], object]:
        return unasked if value is None else lambda: value

    path = None if footsteps is None else PathPlan(reason="of the path planner")
    sources = Sources(
        give(environment),  # type: ignore
        give(path),  # type: ignore
        give(footsteps),  # type: ignore
        give(plan),  # type: ignore
        stop,
    )
    return decide(before, time, frames, sources, SOLE, params, thinking)


MOVING = PathDecision(
    WALK.starting_at(10.0), activity="move", since=10.0, looked=10.0, plans=1
)


def test_looks_after_it_has_stood_still_and_has_a_frame() -> None:
    """Until both hold the decision is the very same, and nobody is asked."""
    start = PathDecision(STAND, since=5.0)
    assert decided(start, 5.39) is start
    assert decided(start, 6.0, frames=0) is start


def test_it_stands_at_the_start_to_know_its_gyroscope() -> None:
    """It has a plan and waits; later on it sets off as soon as it has one."""
    patient = replace(PARAMS, first_rest=2.0)
    seen = {"environment": Environment(), "footsteps": PLANNED, "plan": WALK}
    waiting = decided(PathDecision(STAND), 0.5, params=patient, **seen)  # type: ignore
    assert waiting.activity == "rest"
    assert waiting.motion_plan is STAND
    going = waiting.at(2.0)
    assert (going.activity, going.motion_plan.start_time) == ("move", 2.0)
    later = decided(PathDecision(STAND, since=5.0), 6.0, params=patient, **seen)  # type: ignore
    assert (later.activity, later.motion_plan.start_time) == ("move", 6.0)


def test_a_refusal_does_not_wait_for_the_first_rest() -> None:
    """What cannot be walked needs no gyroscope."""
    refused = FootstepPlan(status="infeasible", reason="why")
    after = decided(
        PathDecision(STAND),
        0.5,
        environment=Environment(),
        footsteps=refused,
        params=replace(PARAMS, first_rest=2.0),
    )
    assert after.status == TaskStatus("infeasible", "stand", "why")


def test_plans_from_what_it_sees_and_goes() -> None:
    """The plan begins now; all that it rests on is kept."""
    seen = Environment(boxes=(box(3.0),))
    after = decided(
        PathDecision(STAND, plans=2),
        0.5,
        environment=seen,
        footsteps=PLANNED,
        plan=WALK,
    )
    assert (after.activity, after.since, after.looked) == ("move", 0.5, 0.5)
    assert after.plans == 3
    assert after.motion_plan.start_time == 0.5
    assert after.environment == replace(seen, sensed_at=0.5)
    assert after.footstep_plan == PLANNED
    assert after.path_plan.reason == "of the path planner"
    assert after.status == TaskStatus("running", "move")


@pytest.mark.parametrize("status", ["finished", "infeasible"])
def test_ends_as_the_footstep_planner_says(status: str) -> None:
    """With its reason, standing, and no motion is asked for; for good."""
    refused = FootstepPlan(status=status, reason="why")  # type: ignore
    after = decided(
        PathDecision(STAND), 1.0, environment=Environment(), footsteps=refused
    )
    assert after.status == TaskStatus(status, "stand", "why")  # type: ignore
    assert after.motion_plan is STAND
    assert decided(after, 9.0) is after


def test_gives_up_after_so_many_plans() -> None:
    """A robot that is in the way of itself does not go on for ever."""
    after = decided(
        PathDecision(STAND, plans=3),
        1.0,
        environment=Environment(),
        footsteps=PLANNED,
        params=replace(PARAMS, max_plans=3),
    )
    assert after.status == TaskStatus("infeasible", "stand", "not there after 3 plans")


def test_looks_again_on_the_way() -> None:
    """Every half second; a box beside the way changes nothing but what was seen."""
    assert decided(MOVING, 10.4) is MOVING
    seen = Environment(boxes=(box(1.0, 2.0),))
    looked = decided(MOVING, 10.5, environment=seen)
    assert looked.looked == 10.5
    assert looked.environment == replace(seen, sensed_at=10.5)
    assert (looked.activity, looked.motion_plan) == ("move", MOVING.motion_plan)
    assert decided(looked, 10.9) is looked


def test_a_box_on_the_steps_ahead_makes_it_stop() -> None:
    """It carries out the shorter plan, to its end, without another look."""
    seen = Environment(boxes=(box(1.0),))
    asked = []

    def stop(plan: MotionPlan, time: float) -> MotionPlan:
        asked.append((plan, time))
        return motion(2.0, 10.0)

    after = decided(MOVING, 10.5, environment=seen, stop=stop)
    assert asked == [(MOVING.motion_plan, 10.5)]
    assert (after.activity, after.status.activity) == ("stop", "stop")
    assert after.motion_plan.duration == 2.0
    assert decided(after, 11.9) is after
    again = decided(after, 12.0)
    assert (again.activity, again.since) == ("look", 12.0)


def test_a_box_behind_the_steps_that_remain_does_not() -> None:
    """The steps that have landed are over."""
    seen = Environment(boxes=(box(0.0),))
    near = decided(MOVING, 10.5, environment=seen, stop=lambda *_: motion(2.0, 10.0))
    assert near.activity == "stop"
    assert decided(MOVING, 12.5, environment=seen).activity == "move"


def test_goes_on_where_the_walk_ends_as_soon() -> None:
    """There is nothing to cut off."""
    seen = Environment(boxes=(box(1.0),))
    after = decided(MOVING, 12.5, environment=seen, stop=lambda *_: None)
    assert (after.activity, after.looked) == ("move", 12.5)


def test_looks_where_the_walk_has_ended() -> None:
    """Whether it is there is for the footstep planner to say."""
    after = decided(MOVING, 14.0)
    assert (after.activity, after.since) == ("look", 14.0)


def test_standing_it_waits_for_what_it_sees_and_then_for_the_plan() -> None:
    """Both of the look at the beginning; nobody is asked again."""
    seen = Environment(boxes=(box(3.0),))
    start = PathDecision(STAND)
    looking = decided(
        start, 0.5, environment=seen, footsteps=PLANNED, plan=WALK, thinking=SLOW
    )
    assert (looking.activity, looking.looked) == ("look", 0.5)
    assert looking.environment == Environment()
    assert decided(looking, 0.675) is looking
    planning = decided(looking, 0.7)
    assert planning.status == TaskStatus("running", "plan")
    assert planning.environment == replace(seen, sensed_at=0.5)
    assert (planning.footstep_plan, planning.motion_plan) == (FootstepPlan(), STAND)
    assert decided(planning, 1.2) is planning
    moving = decided(planning, 1.225)
    assert (moving.activity, moving.plans, moving.looked) == ("move", 1, 0.5)
    assert moving.since == moving.motion_plan.start_time == pytest.approx(1.225)
    assert (moving.footstep_plan, moving.path_plan.reason) == (
        PLANNED,
        "of the path planner",
    )


def test_standing_a_refusal_takes_as_long() -> None:
    """The task is running until then."""
    refused = FootstepPlan(status="infeasible", reason="why")
    looking = decided(
        PathDecision(STAND),
        1.0,
        environment=Environment(),
        footsteps=refused,
        thinking=SLOW,
    )
    planning = decided(looking, 1.2)
    assert planning.status.state == "running"
    after = decided(planning, 1.725)
    assert after.status == TaskStatus("infeasible", "stand", "why")


def test_walking_it_sees_late_and_stops_later() -> None:
    """The stop is planned for when it takes over; until then the walk goes on."""
    seen = Environment(boxes=(box(1.0),))
    asked = []

    def stop(plan: MotionPlan, time: float) -> MotionPlan:
        asked.append((plan, time))
        return motion(2.0, 10.0)

    looking = decided(MOVING, 10.5, environment=seen, stop=stop, thinking=SLOW)
    assert asked == [(MOVING.motion_plan, pytest.approx(10.8))]
    assert (looking.activity, looking.looked) == ("move", 10.5)
    assert looking.environment == Environment()
    assert decided(looking, 10.675) is looking
    replanning = decided(looking, 10.7)
    assert replanning.status == TaskStatus("running", "replan")
    assert replanning.environment == replace(seen, sensed_at=10.5)
    assert replanning.motion_plan == MOVING.motion_plan
    assert decided(replanning, 10.775) is replanning
    stopping = decided(replanning, 10.8)
    assert (stopping.activity, stopping.motion_plan) == ("stop", motion(2.0, 10.0))
    assert decided(stopping, 12.0).activity == "look"


def test_steps_that_land_before_the_box_is_seen_are_not_ahead() -> None:
    """The second lands at 12 s: it counts for a look at 11.7 s, not for one at 11.9."""
    seen = Environment(boxes=(box(0.15),))
    for time, ahead in ((11.7, True), (11.9, False)):
        asked: list[float] = []

        def stop(plan: MotionPlan, time: float, asked: list[float] = asked) -> None:
            asked.append(time)

        decided(MOVING, time, environment=seen, stop=stop, thinking=SLOW)
        assert bool(asked) is ahead


def test_while_a_look_is_worked_on_there_is_no_other() -> None:
    """However often it should look; the next look follows when it can."""
    params = replace(PARAMS, look_period=0.1)
    seen = Environment(boxes=(box(1.0, 2.0),))
    looking = decided(MOVING, 10.5, environment=seen, params=params, thinking=SLOW)
    assert decided(looking, 10.65, params=params, thinking=SLOW) is looking
    looked = decided(looking, 10.7, params=params, thinking=SLOW)
    assert (looked.activity, looked.looked) == ("move", 10.5)
    assert looked.environment == replace(seen, sensed_at=10.5)
    again = decided(looked, 10.725, environment=seen, params=params, thinking=SLOW)
    assert again.looked == 10.725


def test_a_walk_ends_whatever_is_being_worked_on() -> None:
    """What comes after is looked at anew."""
    seen = Environment(boxes=(box(9.0),))
    looking = decided(MOVING, 13.9, environment=seen, thinking=SLOW)
    ended = decided(looking, 14.0)
    assert (ended.activity, ended.since) == ("look", 14.0)
    assert decided(ended, 14.3) is ended


def test_remaining_footsteps_are_those_in_the_air_or_to_come() -> None:
    """A step counts until it has landed."""
    plan = motion(4.0, 10.0)
    assert [len(remaining_footsteps(plan, 10.0 + t)) for t in (0.0, 0.9, 1.1, 4.1)] == [
        4,
        4,
        3,
        0,
    ]


@pytest.mark.parametrize(("gap", "blocked"), [(0.19, True), (0.21, False)])
def test_a_box_blocks_within_the_bodys_radius_of_a_sole(
    gap: float, blocked: bool
) -> None:
    """Measured from the sole's edge to the box's."""
    step = Footstep("left", RigidTransform([1.0, 0.0, 0.0]), -1)
    seen = Environment(boxes=(box(9.0), box(1.0 + SOLE.toe + gap + 0.1)))
    assert (blocking_box((step,), seen, SOLE, 0.2) == "bin") is blocked
    assert blocking_box((), seen, SOLE, 0.2) is None


@pytest.mark.parametrize(
    ("field", "value"),
    [("period", 0.0), ("look_period", -1.0), ("settle_time", -0.1), ("max_plans", 0)],
)
def test_wrong_parameters_are_named(field: str, value: float) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}: "):
        PathExecutive(  # type: ignore
            replace(PARAMS, **{field: value}), SOLE, STAND, unasked, AT_ONCE
        )
    with pytest.raises(ValueError, match=r"^stopping: "):
        PathExecutive(PARAMS, SOLE, STAND, unasked, ThinkingParams(stopping=-1.0))  # type: ignore


def test_the_system_carries_its_decisions_out() -> None:
    """It looks at 0.4 s, walks 0.71 s later and is told that it is there."""
    executive = PathExecutive(PARAMS, SOLE, STAND, unasked, SLOW)  # type: ignore
    simulator = Simulator(executive)
    context = simulator.get_mutable_context()
    executive.GetInputPort("frame").FixValue(context, [1.0])
    for name, value in (
        ("environment", Environment()),
        ("path_plan", PathPlan()),
        ("footstep_plan", PLANNED),
        ("motion_plan", WALK),
    ):
        port = executive.GetInputPort(name)
        port.FixValue(context, AbstractValue.Make(value))

    def status() -> TaskStatus:
        return executive.GetOutputPort("status").Eval(context)

    simulator.AdvanceTo(0.35)
    assert status().activity == "look"
    simulator.AdvanceTo(0.65)
    assert status() == TaskStatus("running", "plan")
    seen = executive.GetOutputPort("environment").Eval(context)
    assert seen.sensed_at == pytest.approx(0.4, abs=0.026)
    simulator.AdvanceTo(1.2)
    assert status() == TaskStatus("running", "move")
    plan = executive.GetOutputPort("motion_plan").Eval(context)
    assert plan.start_time == pytest.approx(0.4 + 0.2 + 0.525, abs=0.026)
    executive.GetInputPort("footstep_plan").FixValue(
        context, AbstractValue.Make(FootstepPlan(status="finished"))
    )
    simulator.AdvanceTo(6.5)
    assert status().state == "finished"
