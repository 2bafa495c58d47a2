"""The crossing planner's shell: what it asks its cores, what it refuses and keeps."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context

from footfall.models.values.obstacle import Obstacle, ObstacleMap
from footfall.models.values.planned import FootstepPlan, MotionPlan
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.crossing.crossing_planner import CrossingPlanner
from footfall.systems.planning.crossing.params import (
    CrossingParams,
    HighCrossingParams,
)
from footfall.systems.planning.crossing.quasi_static_unit import (
    QuasiStaticCrossingParams,
)
from footfall.systems.planning.crossing.report import CrossingMotion
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_task import Mode, MotionTask, Walker
from tests.systems.planning.crossing.crossing_cases import body

WALKING = MotionPlannerParams(com_height=0.83)
PREVIEW = ZmpPreviewParams(com_height=0.85)
FEET: Vector = np.array([[0.0, 0.095, 0.0, 0.0, 0.0, 0.0], [0.0, -0.095, 0, 0, 0, 0]])
COM: Vector = np.array([0.035, 0.0, 0.83])
STANDING = plan_motion(MotionTask(FEET, COM), Walker(WALKING, PREVIEW, body().robot))
OUTLINE: Vector = np.array([[-0.2, -2.0], [3.0, -2.0], [3.0, 2.0], [-0.2, 2.0]])
"""Of the floor that was seen."""
NEAR = Obstacle(np.array([0.7, 0.0]), 0.0, 0.05, 0.15, 1.2)


def _make(
    *obstacles: Obstacle,
    status: str = "ok",
    goal: tuple[float, float, float] = (1.4, 0.0, 0.0),
    crossing: CrossingParams | None = None,
    mode: Mode = "dynamic",
) -> tuple[CrossingPlanner, Context]:
    """The System before obstacles, standing at the origin."""
    system = CrossingPlanner(
        FootstepPlannerParams(max_step_length=0.22),
        WALKING,
        crossing or CrossingParams(),
        PREVIEW,
        body(),
        STANDING,
        mode,
    )
    context = system.CreateDefaultContext()
    seen = ObstacleMap(obstacles, 0.0, status, OUTLINE)  # type: ignore[arg-type]
    system.GetInputPort("obstacle_map").FixValue(context, AbstractValue.Make(seen))
    system.GetInputPort("goal").FixValue(context, list(goal))
    moving = np.concatenate([FEET.ravel(), np.full(12, 7.0)])
    system.GetInputPort("foot_references").FixValue(context, moving)
    com = np.concatenate([COM, np.full(6, 7.0)])
    system.GetInputPort("com_reference").FixValue(context, com)
    return system, context


def _steps(system: CrossingPlanner, context: Context) -> FootstepPlan:
    plan = system.GetOutputPort("footstep_plan").Eval(context)
    assert isinstance(plan, FootstepPlan)
    return plan


def _motion(system: CrossingPlanner, context: Context) -> MotionPlan:
    plan = system.GetOutputPort("motion_plan").Eval(context)
    assert isinstance(plan, MotionPlan)
    return plan


def test_it_plans_steps_and_motion_over_what_lies_in_the_way() -> None:
    """From the references' poses, with the report of what was found."""
    system, context = _make(NEAR)
    steps, motion = _steps(system, context), _motion(system, context)
    assert steps.status == "planned"
    assert [step.plane for step in steps.footsteps].count(0) == 2
    assert isinstance(motion, CrossingMotion)
    assert motion.footsteps == steps.footsteps
    np.testing.assert_array_equal(motion.foot_poses[0], FEET)
    np.testing.assert_allclose(motion.com[0], COM, atol=1e-3)
    assert motion.report.obstacles == (NEAR,)
    assert motion.report.keys[0].X_ads > 0.35
    assert [name for name, _ in motion.report.planning_ms] == ["FU", "FTG to FTA"]
    assert all(ms > 0.0 for _, ms in motion.report.planning_ms)
    end = motion.foot_poses[-1].mean(axis=0)
    np.testing.assert_allclose(end[:2], [1.4, 0.0], atol=1e-6)


def test_without_an_obstacle_it_walks() -> None:
    """What is beside the way is none."""
    aside = replace(NEAR, center=np.array([0.7, 2.0]))
    system, context = _make(aside)
    steps = _steps(system, context)
    assert steps.status == "planned"
    assert {step.plane for step in steps.footsteps} == {-1}
    motion = _motion(system, context)
    assert isinstance(motion, CrossingMotion)
    assert motion.report.obstacles == ()
    assert motion.report.phases == ()


def test_at_the_goal_it_stands() -> None:
    """Finished, in the plan that it was given."""
    system, context = _make(NEAR, goal=(0.0, 0.0, 0.0))
    assert _steps(system, context).status == "finished"
    assert _motion(system, context) is STANDING


@pytest.mark.parametrize(
    ("obstacle", "crossing", "mode", "reason"),
    [
        (replace(NEAR, height=0.5), CrossingParams(), "dynamic", "0.50 m high"),
        (
            NEAR,
            CrossingParams(
                min_gap=0.2, max_repairs=0, high=HighCrossingParams(min_gap=0.2)
            ),
            "dynamic",
            "mm of it, less than 200 mm, after all repairs",
        ),
        (
            replace(NEAR, height=0.25),
            CrossingParams(max_repairs=0, high=HighCrossingParams(margins=[])),
            "dynamic",
            " mm too short",
        ),
        (
            NEAR,
            CrossingParams(filter_stages=0, max_zmp_error=0.03),
            "dynamic",
            "Eq. 20: the ZMP leaves its reference by",
        ),
        (
            NEAR,
            CrossingParams(max_torque=0.5),
            "dynamic",
            "KNEE takes 0.",
        ),
        (
            NEAR,
            CrossingParams(
                min_limit_distance=0.3, inward=0.0, high=HighCrossingParams(inward=0.0)
            ),
            "dynamic",
            "rad of its limit, less than 0.30 rad",
        ),
        (replace(NEAR, height=0.2), CrossingParams(), "quasi_static", "Eq. 6"),
        (
            NEAR,
            CrossingParams(
                quasi_static=QuasiStaticCrossingParams(torque_share=0.80, lean=0.25)
            ),
            "quasi_static",
            "of its effort limit, more than 0.80",
        ),
        (
            NEAR,
            CrossingParams(
                quasi_static=QuasiStaticCrossingParams(
                    walk_double_support=0.4, double_support=0.6, rest=0.05
                )
            ),
            "quasi_static",
            "Eq. 7: the CoM comes within",
        ),
    ],
)
def test_it_refuses_before_it_moves(
    obstacle: Obstacle, crossing: CrossingParams, mode: Mode, reason: str
) -> None:
    """And says which constraint fails; the motion stands."""
    system, context = _make(obstacle, crossing=crossing, mode=mode)
    plan = _steps(system, context)
    assert plan.status == "infeasible"
    assert plan.footsteps == ()
    assert "cannot be crossed" in plan.reason
    assert reason in plan.reason
    assert _motion(system, context) is STANDING


def test_without_a_floor_there_is_no_plan() -> None:
    """Eyes that saw none."""
    system, context = _make(status="no floor")
    assert _steps(system, context).reason == "no floor was seen"
    assert _motion(system, context) is STANDING


def test_the_mode_sets_the_pace() -> None:
    """A quasi-static motion reports its balance, a dynamic one does not."""
    slow, fast = (
        _motion(*_make(NEAR, goal=(1.2, 0.0, 0.0), mode=mode))
        for mode in ("quasi_static", "dynamic")
    )
    assert isinstance(slow, CrossingMotion)
    assert isinstance(fast, CrossingMotion)
    assert slow.duration > 2.0 * fast.duration
    assert slow.report.balance is not None
    assert fast.report.balance is None


def test_one_plan_serves_both_ports_and_lasts_until_an_input_changes() -> None:
    """The motion takes a tenth of a second to plan."""
    system, context = _make(NEAR, goal=(1.2, 0.0, 0.0))
    first = _motion(system, context)
    assert _motion(system, context) == first
    assert isinstance(first, CrossingMotion)
    times = first.report.planning_ms
    after = _steps(system, context)
    assert after.footsteps == first.footsteps
    again = _motion(system, context)
    assert isinstance(again, CrossingMotion)
    assert again.report.planning_ms == times
    changes = {
        "goal": [1.3, 0.0, 0.0],
        "obstacle_map": AbstractValue.Make(
            ObstacleMap((replace(NEAR, width=0.06),), 0.0, "ok", OUTLINE)
        ),
        "foot_references": np.concatenate([FEET.ravel() + 0.001, np.zeros(12)]),
        "com_reference": np.concatenate([COM + 0.003, np.zeros(6)]),
    }
    before = again
    for name, value in changes.items():
        system.GetInputPort(name).FixValue(context, value)
        motion = _motion(system, context)
        assert isinstance(motion, CrossingMotion)
        assert motion.report.planning_ms != before.report.planning_ms, name
        assert motion != before, name
        before = motion


def test_a_wrong_parameter_is_refused() -> None:
    """When the System is made."""
    with pytest.raises(ValueError, match="single_support: must be"):
        _make(NEAR, crossing=CrossingParams(single_support=0.0))


def test_a_high_obstacle_is_crossed_in_the_second_way() -> None:
    """Where the first way is refused, in the pace and with the margins of the other."""
    high = replace(NEAR, height=0.25)
    first_only = CrossingParams(high=HighCrossingParams(min_gap=0.5))
    assert _steps(*_make(high, crossing=first_only)).status == "infeasible"
    motion = _motion(*_make(high))
    assert isinstance(motion, CrossingMotion)
    first, last = motion.report.phases[0]
    params = HighCrossingParams()
    assert last - first == pytest.approx(
        2.0 * params.single_support + params.double_support
    )
    assert motion.report.gap > params.min_gap
    assert motion.report.way == 1


def test_what_is_not_seen_well_waits_for_the_next_look() -> None:
    """It walks up to the obstacle at the edge of sight and stops before it."""
    far = replace(NEAR, center=np.array([2.6, 0.0]))
    system, context = _make(far, goal=(4.0, 0.0, 0.0))
    plan = _steps(system, context)
    assert plan.status == "planned"
    assert {step.plane for step in plan.footsteps} == {-1}
    ends = [step.X_WF.translation()[0] for step in plan.footsteps[-2:]]
    assert max(ends) + body().robot.sole.toe < 2.575 - 0.15
    assert min(ends) > 2.0


def test_floor_that_was_not_seen_is_not_walked_on() -> None:
    """A goal behind is turned to; without any floor ahead there is a refusal."""
    system, context = _make(goal=(-2.0, 0.0, 0.0))
    plan = _steps(system, context)
    assert plan.status == "planned"
    for step in plan.footsteps:
        assert np.linalg.norm(step.X_WF.translation()[:2]) < 0.3
    yaw = plan.footsteps[-1].X_WF.rotation().ToRollPitchYaw().yaw_angle()
    assert abs(yaw) == pytest.approx(np.pi, abs=1e-3)
    blind = ObstacleMap((), 0.0, "ok")
    system.GetInputPort("obstacle_map").FixValue(context, AbstractValue.Make(blind))
    system.GetInputPort("goal").FixValue(context, [2.0, 0.0, 0.0])
    plan = _steps(system, context)
    assert plan.status == "infeasible"
    assert "the floor towards the goal is seen for 0.00 m only" in plan.reason
