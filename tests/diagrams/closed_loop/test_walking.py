"""The walking controllers: they hold the stand they begin with."""

import numpy as np
import pytest
from pydrake.math import RigidTransform
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.diagrams.closed_loop.setup import Stand, initial_stand
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.values.planned import Footstep
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import (
    preview_gains,
    preview_step,
    rest_error_sum,
    rest_state,
)
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_player import zmp_preview
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.ports import eval_vector

OVERRIDES = ("robot.x=-0.5", "robot.y=0.4", "robot.yaw=0.5", "scene.staircase.x=1.0")


@pytest.fixture(scope="module")
def stood() -> tuple[TaskDiagram, Context]:
    """After a second."""
    task = build_task(load_scenario("stairs-exp1", OVERRIDES))
    simulator = Simulator(task.diagram)
    simulator.AdvanceTo(1.0)
    return task, simulator.get_context()


def output(stood: tuple[TaskDiagram, Context], system: str, port: str) -> Vector:
    """A vector port of a subsystem."""
    task, root = stood
    return np.asarray(task.output(f"{system}.{port}", root))


def make_stand(*overrides: str) -> tuple[Stand, Context, object]:
    """The stand, the model's context at it and the model."""
    scenario = load_scenario("stairs-exp1", overrides)
    model = robot_alone(JVRC1)
    stand = initial_stand(scenario, JVRC1, model)
    context = model.CreateDefaultContext()
    model.SetPositions(context, stand.positions)
    return stand, context, model


@pytest.mark.parametrize("overrides", [(), OVERRIDES])
def test_the_stand_is_on_the_floor_under_the_start_pose(overrides) -> None:
    """Soles flat on z = 0, the CoM over their middle at its height."""
    stand, context, model = make_stand(*overrides)
    yaw, x, y = (0.5, -0.5, 0.4) if overrides else (0.0, 0.0, 0.0)
    com = model.CalcCenterOfMassPositionInWorld(context)
    np.testing.assert_allclose(com, stand.com, atol=2e-3)
    assert stand.com[2] == 0.85
    ahead = (stand.com[:2] - [x, y]) @ [np.cos(yaw), np.sin(yaw)]
    planner = load_scenario("stairs-exp1").parameters.motion_planner
    assert ahead == pytest.approx(planner.zmp_forward)
    assert 0.0 < ahead < JVRC1.sole.toe
    aside = (stand.com[:2] - [x, y]) @ [-np.sin(yaw), np.cos(yaw)]
    assert aside == pytest.approx(0.0, abs=1e-9)
    for foot, pose, side in zip(
        ("left", "right"), stand.foot_poses, (1.0, -1.0), strict=True
    ):
        body = model.GetBodyByName(JVRC1.foot_bodies[foot])
        X_WA = body.EvalPoseInWorld(context)
        sole = X_WA.multiply(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
        np.testing.assert_allclose(sole, pose[:3], atol=1e-5)
        want = [x - side * 0.095 * np.sin(yaw), y + side * 0.095 * np.cos(yaw), 0.0]
        np.testing.assert_allclose(pose[:3], want, atol=1e-12)
        assert pose[5] == yaw
        np.testing.assert_allclose(X_WA.rotation().matrix()[:, 2], [0, 0, 1], atol=1e-5)


def test_the_stand_is_held(stood) -> None:
    """CoM and DCM stay near the reference, the feet where they are."""
    com = output(stood, "kinematic_state", "com")
    reference = output(stood, "com_reference", "com_reference")
    np.testing.assert_allclose(com, reference[:3], atol=4e-3)
    dcm = output(stood, "stabilizer", "dcm")
    wanted = output(stood, "stabilizer", "dcm_reference")
    np.testing.assert_allclose(dcm, wanted, atol=4e-3)
    assert np.abs(output(stood, "ik_tracker", "velocities")).max() < 0.02


def test_the_stabiliser_asks_for_what_the_feet_feel(stood) -> None:
    """Forces in W and in the level soles agree to some newtons."""
    asked = output(stood, "stabilizer", "foot_wrenches").reshape(2, 6)
    felt = output(stood, "foot_wrench_sensor", "foot_wrenches").reshape(2, 6)
    np.testing.assert_allclose(asked[:, 2], felt[:, 2], atol=25.0)
    assert asked[:, 2].sum() == pytest.approx(62.4 * 9.81, rel=0.02)


def test_contacts_and_references_are_those_of_the_plan(stood) -> None:
    """Nothing is adapted while the robot stands."""
    for port in ("foot_references", "contacts"):
        np.testing.assert_array_equal(
            output(stood, "landing_adaptor", port),
            output(stood, "motion_player", port),
        )


@pytest.mark.parametrize(
    ("port", "system", "target"),
    [
        ("contacts", "stabilizer", "contacts"),
        ("contacts", "ik_tracker", "contacts"),
        ("contacts", "static_stability", "contacts"),
        ("foot_references", "stabilizer", "foot_references"),
        ("foot_references", "ik_tracker", "foot_references"),
    ],
)
def test_balance_and_tracking_go_by_the_feet_that_have_landed(
    stood, port: str, system: str, target: str
) -> None:
    """Not by the plan's, from which they differ about a touch-down."""
    task, root = stood
    root = root.Clone()
    landing = task.system("landing_adaptor")
    context = landing.GetMyMutableContextFromRoot(root)
    for group in range(context.num_discrete_state_groups()):
        state = context.get_discrete_state(group).value()
        context.SetDiscreteState(group, state - 0.25)
    adapted = eval_vector(landing.GetOutputPort(port), context)
    player = task.system("motion_player")
    planned = eval_vector(player.GetOutputPort(port), player.GetMyContextFromRoot(root))
    assert (np.abs(adapted - planned) > 0.1).all()
    subsystem = task.system(system)
    seen = eval_vector(
        subsystem.GetInputPort(target), subsystem.GetMyContextFromRoot(root)
    )
    np.testing.assert_array_equal(seen, adapted)


def test_controllers_share_their_period(stood) -> None:
    """Every fast loop ticks at 5 ms; only events ask for abstract state."""
    task, _ = stood
    for name in ("ik_tracker", "landing_adaptor", "zmp_preview"):
        system = task.system(name)
        assert system.GetUniquePeriodicDiscreteUpdateAttribute().period_sec() == 0.005
        assert system.num_abstract_states() == 0


@pytest.mark.parametrize("rise", [0.0, 0.2])
def test_a_plan_comes_into_view_of_the_preview_without_a_jump(rise: float) -> None:
    """Though its lead-in is shorter: the CoM's ZMP is the plan's from the start.

    Two treads up, or two steps ahead on the floor, until the first foot lifts; by 5 mm
    a tick at most.
    """
    params = load_scenario("stairs-exp1").controllers()
    feet: Vector = np.array([[0.0, 0.095, 0, 0, 0, 0], [0.0, -0.095, 0, 0, 0, 0]])
    com = np.array([params.motion_planner.zmp_forward, 0.0, params.com_height])
    footsteps = tuple(
        Footstep(foot, RigidTransform([0.27 * n, y, rise * n]), -1)
        for n in (1, 2)
        for foot, y in (("right", -0.095), ("left", 0.095))
    )
    edges = np.array([[0.2, 0.0, rise], [0.47, 0.0, 2.0 * rise]])
    walker = Walker(params.motion_planner, params.zmp_preview, JVRC1)
    plan = plan_motion(MotionTask(feet, com, footsteps, edges), walker)
    gains = preview_gains(params.zmp_preview)
    state, error = rest_state(com[:2]), rest_error_sum(gains, com[:2])
    rows = round(params.motion_planner.lead_in / params.control_period)
    assert rows < gains.horizon
    for row in range(rows):
        window = zmp_preview(plan, row, gains.horizon).reshape(2, -1)
        before = state @ gains.C
        np.testing.assert_allclose(before, plan.cart_zmp[row], atol=0.005)
        state, error, _ = preview_step(gains, state, error, window)
        assert np.abs(state @ gains.C - before).max() < 0.005
