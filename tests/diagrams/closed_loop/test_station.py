"""The station: what its sensors say of a robot that stands, and what pushes do."""

from dataclasses import dataclass

import numpy as np
import pytest
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.diagrams.closed_loop.parts import Parts
from footfall.diagrams.closed_loop.robot_station import (
    RobotStation,
    build_robot_station,
)
from footfall.diagrams.closed_loop.setup import set_up
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.contact import Touches
from footfall.models.values.vector import Vector

WEIGHT = 62.4 * 9.81


@dataclass(frozen=True)
class Standing:
    """The whole closed loop, after it has stood for a while."""

    task: TaskDiagram
    root: Context

    def output(self, system: str, port: str) -> Vector:
        """A vector port of a subsystem."""
        return np.asarray(self.task.output(f"{system}.{port}", self.root))


def stand(seconds: float, *overrides: str) -> Standing:
    """Simulates the first scenario; it stands and scans."""
    task = build_task(load_scenario("stairs-exp1", overrides))
    simulator = Simulator(task.diagram)
    simulator.AdvanceTo(seconds)
    return Standing(task, simulator.get_context())


@pytest.fixture(scope="module")
def standing() -> Standing:
    """Turned, away from the origin."""
    return stand(
        1.0, "robot.x=-0.5", "robot.y=0.4", "robot.yaw=0.5", "scene.staircase.x=1.0"
    )


def test_soles_carry_the_weight(standing: Standing) -> None:
    """Both alike, on level ground."""
    wrenches = standing.output("foot_wrench_sensor", "foot_wrenches").reshape(2, 6)
    assert wrenches[:, 2].sum() == pytest.approx(WEIGHT, rel=5e-3)
    assert wrenches[0, 2] == pytest.approx(wrenches[1, 2], rel=0.1)


def test_measured_zmp_is_under_the_measured_com(standing: Standing) -> None:
    """On the ground."""
    zmp = standing.output("foot_wrench_sensor", "zmp")
    com = standing.output("kinematic_state", "com")
    np.testing.assert_allclose(zmp[:2], com[:2], atol=3e-3)
    assert zmp[2] == pytest.approx(0.0, abs=2e-3)


def test_measured_state_is_the_plant_s(standing: Standing) -> None:
    """CoM and feet as the plant with the scene has them."""
    plant, instance = standing.task.plant, standing.task.robot_instance
    context = plant.GetMyContextFromRoot(standing.root)
    np.testing.assert_allclose(
        standing.output("kinematic_state", "com"),
        plant.CalcCenterOfMassPositionInWorld(context, [instance]),
        atol=1e-12,
    )
    feet = standing.output("kinematic_state", "foot_poses").reshape(2, 6)
    left = plant.GetBodyByName(JVRC1.foot_bodies["left"], instance)
    ankle = plant.EvalBodyPoseInWorld(context, left)
    sole = ankle.multiply(np.array([0.0, 0.0, -JVRC1.sole.ankle_height]))
    np.testing.assert_allclose(feet[0, :3], sole, atol=1e-12)


def test_it_stands_where_the_scenario_says(standing: Standing) -> None:
    """Feet side by side under the start pose, facing its way."""
    feet = standing.output("kinematic_state", "foot_poses").reshape(2, 6)
    np.testing.assert_allclose(feet.mean(axis=0)[:3], [-0.5, 0.4, 0.0], atol=2e-3)
    np.testing.assert_allclose(feet[:, 5], 0.5, atol=5e-3)
    across = feet[0, :2] - feet[1, :2]
    assert across @ [-np.sin(0.5), np.cos(0.5)] == pytest.approx(0.19, abs=3e-3)


def test_torques_asked_for_are_held_and_applied(standing: Standing) -> None:
    """Within the limits; the knees bear some of the weight."""
    command = standing.output("torque_hold", "y")
    assert command.shape == (32,)
    plant = standing.task.plant
    context = plant.GetMyContextFromRoot(standing.root)
    applied = plant.get_net_actuation_output_port(standing.task.robot_instance).Eval(
        context
    )
    assert np.abs(applied).max() <= 100.0
    names = plant.GetActuatorNames(standing.task.robot_instance, False)
    knee = list(names).index("L_KNEE")
    assert abs(applied[knee]) > 10.0
    np.testing.assert_allclose(applied, command, atol=12.0)


def alone(scenario: Scenario) -> tuple[RobotStation, Simulator]:
    """The station without controllers, in the air."""
    station = build_robot_station(set_up(scenario, Parts({})))
    plant, diagram = station.plant, station.station.system
    na = plant.num_actuators(station.instance)
    simulator = Simulator(diagram)
    root = simulator.get_mutable_context()
    base = plant.GetBodyByName(JVRC1.base_body)
    context = plant.GetMyMutableContextFromRoot(root)
    plant.SetFreeBodyPose(context, base, RigidTransform([0.0, 0.0, 2.0]))
    diagram.GetInputPort("torque").FixValue(root, np.zeros(na))
    diagram.GetInputPort("joint_references").FixValue(root, np.zeros(2 * na))
    return station, simulator


def test_a_push_of_the_scenario_moves_the_robot() -> None:
    """By its impulse over the mass; while in the air nothing else does."""
    push = "task.pushes=[{time: 0.05, duration: 0.1, force: [300, -100, 0]}]"
    speeds = []
    for overrides in ((), (push,)):
        station, simulator = alone(load_scenario("stairs-exp1", overrides))
        simulator.AdvanceTo(0.2)
        plant: MultibodyPlant = station.plant
        context = plant.GetMyContextFromRoot(simulator.get_context())
        speeds.append(plant.CalcCenterOfMassTranslationalVelocityInWorld(context))
    impulse = 62.4 * (speeds[1] - speeds[0])
    np.testing.assert_allclose(impulse, [30.0, -10.0, 0.0], atol=1.0)


def test_the_model_of_the_controllers_is_the_robot_alone() -> None:
    """The same masses, joints and limits as the robot in the scene."""
    model = robot_alone(JVRC1)
    station, _ = alone(load_scenario("stairs-exp1"))
    plant, instance = station.plant, station.instance
    assert model.num_positions() == plant.num_positions(instance)
    assert model.num_actuators() == plant.num_actuators(instance)
    own = model.GetPositionNames(False, False)
    there = plant.GetPositionNames(instance, False, False)
    assert list(own) == list(there)
    assert model.CalcTotalMass(model.CreateDefaultContext()) == pytest.approx(
        plant.CalcTotalMass(plant.CreateDefaultContext(), [instance])
    )


@pytest.mark.parametrize("scenario", ["stairs-exp1", "obstacle-15cm", "room-moving"])
def test_everything_is_watched_in_every_task(scenario: str) -> None:
    """Every solid for every body, and soles may touch the ground alone."""
    box = "scene.boxes=[{name: bin, x: -0.5, y: 1.5, size: [0.4, 0.3, 0.5]}]"
    loaded = load_scenario(scenario, [box])
    station, _ = alone(loaded)
    monitor = station.station.system.GetSubsystemByName("contact_monitor")
    watched = monitor._watched
    scene = loaded.scene
    movers = {f"box/{mover.name}" for mover in scene.movers}
    assert set(watched.solids) == {s.name for s in scene.solids()} | movers
    assert {watched.solids[index] for index in watched.ground} == {
        "room/floor",
        *(tread.name for tread in scene.treads()),
    }
    assert set(JVRC1.foot_bodies.values()) <= set(watched.bodies)
    assert len(watched.bodies) > 25
    soles = [part for part in watched.part_of.values() if part.sole]
    assert {part.body for part in soles} == set(watched.feet)


def test_legs_that_are_pushed_together_meet() -> None:
    """They do not pass through each other, and the monitor names them."""
    force = "time: 0.1, duration: 0.4, force: [0.0, {}, 0.0]"
    pushes = ", ".join(
        f"{{body: {side}_KNEE_S, {force.format(newtons)}}}"
        for side, newtons in (("L", -900.0), ("R", 900.0))
    )
    standing = stand(0.5, f"task.pushes=[{pushes}]", "robot.x=-1.0")
    task = standing.task
    touches = task.output("contact_monitor.touches", standing.root)
    assert isinstance(touches, Touches)
    met = {frozenset((touch.body, touch.solid)): touch for touch in touches.touches}
    touch = met[frozenset(JVRC1.foot_bodies.values())]
    assert touch.peak_force > 100.0
    context = task.plant.GetMyContextFromRoot(standing.root)
    positions = task.plant.GetPositions(context, task.robot_instance)
    assert SelfDistanceMeter(JVRC1).nearest(positions, 0.02).distance > -0.005
