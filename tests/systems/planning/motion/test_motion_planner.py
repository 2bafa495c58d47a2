"""The motion planner's shell: what it hands to the core."""

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.perceived import PlaneSegment, Staircase
from footfall.models.values.planned import Footstep, FootstepPlan, MotionPlan
from footfall.systems.balance.zmp_preview import ZmpPreviewParams
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_params import MotionPlannerParams
from footfall.systems.planning.motion.motion_planner import MotionPlanner, front_edges
from footfall.systems.planning.motion.motion_task import MotionTask, Walker

START = np.array([[0.39, 0.095, 0, 0, 0, 0], [0.39, -0.095, 0, 0, 0, 0]])
COM = np.array([0.425, 0.0, 0.85])
PREVIEW = ZmpPreviewParams(com_height=0.85)
STEPS = (
    Footstep("right", RigidTransform([0.70, -0.095, 0.2]), 0),
    Footstep("left", RigidTransform([0.70, 0.095, 0.2]), 0),
)


def tread(x: float, z: float, yaw: float = 0.0) -> PlaneSegment:
    """A rectangle of 27 by 50 cm."""
    X_WR = RigidTransform(RotationMatrix.MakeZRotation(yaw), [x, 0.0, z])
    return PlaneSegment(
        polygon=np.zeros((0, 3)),
        X_WR=X_WR,
        size=np.array([0.27, 0.5]),
        normal=np.array([0.0, 0.0, 1.0]),
        area=0.135,
        support_count=100,
    )


def make(footsteps: tuple[Footstep, ...]) -> tuple[MotionPlanner, Context]:
    """The system at the start stance, before one tread."""
    system = MotionPlanner(Walker(MotionPlannerParams(), PREVIEW, JVRC1))
    context = system.CreateDefaultContext()
    plan = FootstepPlan(footsteps, "planned" if footsteps else "finished")
    for name, value in (
        ("footstep_plan", plan),
        ("staircase", Staircase(treads=(tread(0.735, 0.2),))),
    ):
        system.GetInputPort(name).FixValue(context, AbstractValue.Make(value))
    feet = np.concatenate([START.ravel(), np.full(12, 7.0)])
    system.GetInputPort("foot_references").FixValue(context, feet)
    com = np.concatenate([COM, np.full(6, 7.0)])
    system.GetInputPort("com_reference").FixValue(context, com)
    return system, context


def plan_of(system: MotionPlanner, context: Context) -> MotionPlan:
    """The output."""
    plan = system.GetOutputPort("motion_plan").Eval(context)
    assert isinstance(plan, MotionPlan)
    return plan


def test_front_edges_are_where_the_treads_begin() -> None:
    """Half the depth before the middle, against the tread's own x."""
    edges = front_edges((tread(0.735, 0.2), tread(1.0, 0.4, yaw=np.pi / 2.0)))
    np.testing.assert_allclose(edges, [[0.6, 0, 0.2], [1.0, -0.135, 0.4]], atol=1e-12)
    assert front_edges(()).shape == (0, 3)


def test_plans_from_the_references_over_the_edges() -> None:
    """As the core does, on poses and positions alone."""
    walker = Walker(MotionPlannerParams(), PREVIEW, JVRC1)
    edges = np.array([[0.6, 0.0, 0.2]])
    want = plan_motion(MotionTask(START, COM, STEPS, edges), walker)
    found = plan_of(*make(STEPS))
    assert found == want
    assert found.start_time == 0.0
    assert found != plan_motion(MotionTask(START, COM, STEPS), walker)


def test_without_footsteps_it_stands() -> None:
    """In a plan with one phase."""
    plan = plan_of(*make(()))
    assert len(plan.phases) == 1
    assert (plan.foot_poses == START).all()


def test_a_new_input_is_a_new_plan() -> None:
    """Whichever of the four it is."""
    system, context = make(STEPS)
    before = plan_of(system, context)
    for name, value in (
        ("com_reference", np.concatenate([COM + 0.01, np.zeros(6)])),
        ("foot_references", np.concatenate([START.ravel() + 0.001, np.zeros(12)])),
        ("footstep_plan", AbstractValue.Make(FootstepPlan(STEPS[:1], "planned"))),
        ("staircase", AbstractValue.Make(Staircase())),
    ):
        system.GetInputPort(name).FixValue(context, value)
        after = plan_of(system, context)
        assert after != before
        before = after


def test_a_wrong_parameter_is_refused() -> None:
    """When the system is made."""
    with pytest.raises(ValueError, match=r"^lead_in: must be at least 0"):
        MotionPlanner(Walker(MotionPlannerParams(lead_in=0.0), PREVIEW, JVRC1))
