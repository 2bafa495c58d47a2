"""The executive: settle, scan, plan, move, and again, until nothing is left."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.values.planned import FootstepPlan, MotionPlan, TaskStatus
from footfall.systems.planning.executive.executive import (
    Decision,
    Executive,
    ExecutiveParams,
    decide,
)
from footfall.systems.ports import eval_vector

PARAMS = ExecutiveParams(period=0.025, settle_time=0.29)
PLANNED = FootstepPlan(status="planned")


def motion(duration: float = 1.0, start_time: float = 0.0) -> MotionPlan:
    """A plan of that duration in which nothing happens."""
    n = round(duration / 0.005) + 1
    rows = np.zeros((n, 3))
    return MotionPlan(
        start_time=start_time,
        period=0.005,
        footsteps=(),
        phases=(),
        contacts=np.ones((n, 2)),
        foot_poses=np.zeros((n, 2, 6)),
        contact_lengths=np.ones((n, 2)),
        com=rows,
        com_velocity=rows,
        com_acceleration=rows,
        zmp=rows,
        cart_zmp=np.zeros((n, 2)),
        waist=rows,
    )


STAND = motion(0.0)


def refuse() -> MotionPlan:
    """Stands in for a planner that must not be asked."""
    raise AssertionError("asked for a plan that is not needed")


def decided(
    before: Decision,
    time: float,
    sweeps: int = 0,
    footsteps: FootstepPlan | None = None,
    plan: Callable[[], MotionPlan] = refuse,
    latency: float = 0.0,
) -> Decision:
    """One decision; planners that are not given must not be asked."""
    return decide(
        before,
        time,
        sweeps,
        lambda: footsteps if footsteps is not None else refuse(),  # type: ignore
        plan,
        PARAMS,
        latency,
    )


def test_settles_before_the_scan() -> None:
    """For the settling time; until then the decision is the very same."""
    start = Decision(STAND)
    assert decided(start, 0.28) is start
    scan = decided(start, 0.3)
    assert (scan.activity, scan.since) == ("scan", 0.3)
    assert scan.status == TaskStatus("running", "scan")
    later = Decision(STAND, since=5.0)
    assert decided(later, 5.2) is later
    assert decided(later, 5.3).activity == "scan"


def test_scans_until_a_new_sweep_is_worked_in() -> None:
    """An old one does not count."""
    scan = Decision(STAND, activity="scan", sweeps=2)
    assert decided(scan, 9.0, sweeps=2) is scan


def test_moves_along_what_was_planned() -> None:
    """From now on, whatever time the planner counts from."""
    scan = Decision(STAND, activity="scan", sweeps=2)
    move = decided(scan, 9.0, 3, PLANNED, motion)
    assert (move.activity, move.since, move.sweeps) == ("move", 9.0, 3)
    assert move.motion_plan == motion(start_time=9.0)
    assert move.footstep_plan is PLANNED
    assert move.status == TaskStatus("running", "move")


def test_a_plan_is_there_after_the_time_it_takes() -> None:
    """Made at once of what is known now; it begins later, and the robot stands."""
    scan = Decision(STAND, activity="scan", sweeps=2)
    asked = []

    def plan() -> MotionPlan:
        asked.append("motion")
        return motion()

    thinking = decided(scan, 9.0, 3, PLANNED, plan, latency=0.31)
    assert asked == ["motion"]
    assert (thinking.activity, thinking.since, thinking.sweeps) == ("plan", 9.0, 3)
    assert thinking.status == TaskStatus("running", "plan")
    assert (thinking.motion_plan, thinking.footstep_plan) == (STAND, FootstepPlan())
    # Another sweep is worked in meanwhile; the planners are not asked again.
    assert decided(thinking, 9.3, 4) is thinking
    move = decided(thinking, 9.325, 4)
    assert (move.activity, move.sweeps) == ("move", 3)
    assert move.since == move.motion_plan.start_time == pytest.approx(9.325)
    assert move.footstep_plan is PLANNED
    assert decided(move, 10.3, 4) is move
    assert decided(move, 10.33, 4).activity == "settle"


def test_a_refusal_takes_as_long() -> None:
    """Of footsteps or of the motion; until then the task is running."""
    scan = Decision(motion(1.0, 3.0), activity="scan", sweeps=1)
    steep = FootstepPlan(status="infeasible", reason="a 40 cm rise")
    weak = replace(motion(), reason="torque: KNEE would need 120 Nm")
    for footsteps, plan, reason in (
        (steep, refuse, "a 40 cm rise"),
        (PLANNED, lambda: weak, weak.reason),
    ):
        thinking = decided(scan, 9.0, 2, footsteps, plan, latency=0.5)
        assert thinking.status.state == "running"
        stand = decided(thinking, 9.5, 2)
        assert stand.status == TaskStatus("infeasible", "stand", reason)
        assert stand.motion_plan is scan.motion_plan
        assert stand.since == pytest.approx(9.5)


def test_settles_again_when_the_motion_is_over() -> None:
    """Not before its last row; the plan goes on being held."""
    move = Decision(motion(1.0, start_time=9.0), activity="move", since=9.0, sweeps=3)
    assert decided(move, 9.99, sweeps=4) is move
    settle = decided(move, 10.0, sweeps=4)
    assert (settle.activity, settle.since) == ("settle", 10.0)
    assert settle.motion_plan is move.motion_plan
    assert settle.sweeps == 3


@pytest.mark.parametrize(
    "footsteps",
    [FootstepPlan(), FootstepPlan(status="infeasible", reason="a 40 cm rise")],
)
def test_stands_where_nothing_is_left_to_do(footsteps: FootstepPlan) -> None:
    """With the planner's status and reason; the last motion is held for ever."""
    scan = Decision(motion(1.0, 3.0), activity="scan", sweeps=1)
    stand = decided(scan, 9.0, 2, footsteps)
    assert stand.activity == "stand"
    assert stand.status == TaskStatus(footsteps.status, "stand", footsteps.reason)
    assert stand.motion_plan is scan.motion_plan
    assert decided(stand, 99.0, 9) is stand


def make(latency: float = 0.0) -> tuple[Executive, Context]:
    """The system on a world that always has a further motion of 0.2 s."""
    system = Executive(PARAMS, STAND, latency)
    context = system.CreateDefaultContext()
    system.GetInputPort("sweep").FixValue(context, [0.0])
    system.GetInputPort("footstep_plan").FixValue(context, AbstractValue.Make(PLANNED))
    system.GetInputPort("motion_plan").FixValue(
        context, AbstractValue.Make(motion(0.2))
    )
    return system, context


def output(system: Executive, context: Context, name: str) -> object:
    """An abstract port's value."""
    return system.GetOutputPort(name).Eval(context)


def test_default_context_stands() -> None:
    """Nothing is scanned yet."""
    system, context = make()
    assert output(system, context, "motion_plan") == STAND
    assert output(system, context, "status") == TaskStatus()
    assert eval_vector(system.GetOutputPort("scan"), context)[0] == 0.0


@pytest.mark.parametrize(
    ("latency", "rounds"),
    [
        (0.0, [("move", 0.75), ("settle", 0.95), ("scan", 1.25)]),
        (0.15, [("plan", 0.75), ("move", 0.9), ("settle", 1.1), ("scan", 1.4)]),
    ],
)
def test_a_round_of_scan_and_motion(
    latency: float, rounds: list[tuple[str, float]]
) -> None:
    """As the ports tell it; the scanner sweeps only while it is to."""
    system, context = make(latency)
    simulator = Simulator(system, context)
    scan, seen = system.GetOutputPort("scan"), []
    for step in range(1, 60):
        if step == 30:
            system.GetInputPort("sweep").FixValue(context, [1.0])
        simulator.AdvanceTo(0.025 * step + 0.001)
        status = output(system, context, "status")
        assert isinstance(status, TaskStatus)
        activity, on = status.activity, eval_vector(scan, context)[0]
        assert on == (activity == "scan")
        if not seen or seen[-1][0] != activity:
            seen.append((activity, round(context.get_time() - 0.001, 3)))
    assert seen == [("", 0.025), ("scan", 0.3), *rounds]
    plan = output(system, context, "motion_plan")
    assert plan == replace(motion(0.2), start_time=pytest.approx(0.75 + latency))
    assert output(system, context, "footstep_plan") == PLANNED


@pytest.mark.parametrize(
    ("field", "value"),
    [("period", 0.0), ("period", np.nan), ("settle_time", -0.1)],
)
def test_parameters_out_of_range_are_refused(field: str, value: float) -> None:
    """By name."""
    with pytest.raises(ValueError, match=rf"^{field}: must .*, got "):
        Executive(ExecutiveParams(**{field: value}), STAND)


def test_a_time_to_plan_that_makes_no_sense_is_refused() -> None:
    """As a parameter is."""
    with pytest.raises(ValueError, match=r"^latency: must be at least 0 s, got "):
        Executive(PARAMS, STAND, -0.1)


def test_a_motion_that_cannot_be_done_is_refused_before_moving() -> None:
    """The task is infeasible for the plan's reason; nothing new is carried out."""
    before = Decision(STAND, activity="scan", since=1.0)
    refused = replace(motion(), reason="torque: KNEE would need 120 Nm")
    after = decided(before, 4.0, 1, PLANNED, lambda: refused)
    assert after.activity == "stand"
    assert after.motion_plan is STAND
    assert after.status == TaskStatus("infeasible", "stand", refused.reason)
