"""The loop runs on what the robot senses: who sees the truth, how good the rest."""

from collections.abc import Iterator

import numpy as np
import pytest
from pydrake.multibody.plant import MultibodyPlant

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems, leaf_wires
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.estimating import SENSORS, estimate_from_sensors
from footfall.diagrams.judge.estimate_errors import estimate_summary
from footfall.diagrams.judge.true_motion import true_motion
from footfall.diagrams.scenario import ScenarioError, load_scenario
from footfall.diagrams.signals import RunError
from footfall.diagrams.simulation import simulate

SCENARIOS = ("stand", "stairs-exp1", "obstacle-15cm", "room-moving")
SENSES = {
    "accelerometer",
    "gyroscope",
    "joint_encoders",
    "ankle_force_sensors",
    "tilting_lidar",
    "depth_camera",
}
DRIVES = {"plant", "torque_hold", "pusher", "box_mover"}
JUDGE = {
    "scene_graph",
    "kinematic_state",
    "foot_wrench_sensor",
    "wanted_torque",
    "contact_monitor",
    "speed_monitor",
}
"""Of these the judge and the logs have their figures; nothing else may take them."""


def is_log(name: str) -> bool:
    """Whether a System only records."""
    return name.startswith(("signal_log(", "log("))


def reached(task: TaskDiagram) -> Iterator[tuple[str, str]]:
    """Whom the plant's outputs reach, and whom those of judge and scene do."""
    for source, target in leaf_wires(task.diagram):
        name = source.get_system().get_name()
        if name in {"plant", *JUDGE}:
            yield name, target.get_system().get_name()


@pytest.fixture(scope="module", params=SCENARIOS)
def task(request: pytest.FixtureRequest) -> TaskDiagram:
    """The closed loop of every kind of task."""
    return build_task(load_scenario(request.param))


def test_the_true_state_reaches_nobody_who_acts(task: TaskDiagram) -> None:
    """Only sensors, drives, judge and logs."""
    allowed = SENSES | DRIVES | JUDGE
    strangers = {
        (source, target)
        for source, target in reached(task)
        if target not in allowed and not is_log(target)
    }
    assert not strangers


def test_what_the_judge_sees_reaches_no_sensor(task: TaskDiagram) -> None:
    """No round-about way: from judge and scene to plant, judge and logs alone."""
    for source, target in reached(task):
        if source in JUDGE:
            assert target in JUDGE | {"plant"} or is_log(target), (source, target)


def test_nothing_else_holds_the_plant(task: TaskDiagram) -> None:
    """Of Systems that act none has the true plant, or anything of it, as a member."""
    allowed = SENSES | DRIVES | JUDGE
    for _, system in leaf_systems(task.diagram):
        if system.get_name() in allowed:
            continue
        for value in vars(system).values():
            assert value is not task.plant, system.get_name()
            if isinstance(value, MultibodyPlant):
                assert value.num_model_instances() < task.plant.num_model_instances()


def test_on_the_true_state_there_is_no_estimator() -> None:
    """The switch, as YAML has it; the summary has no estimate then."""
    task = build_task(load_scenario("stand", ["robot.state=true"]))
    names = {system.get_name() for _, system in leaf_systems(task.diagram)}
    assert not names & {"base_estimator", "imu", "joint_encoders"}
    assert ("plant", "believed_state") in set(reached(task))


@pytest.fixture(scope="module")
def stood() -> tuple[TaskDiagram, dict]:
    """Stands for two seconds, pushed once."""
    changes = ["task.stand_time=1.5", "simulation.max_time=2.0"]
    push = "task.pushes=[{time: 0.5, duration: 0.1, force: [40.0, 30.0, 0.0]}]"
    task = build_task(load_scenario("stand", [*changes, push]))
    simulated = simulate(task, 2.0)
    return task, dict(task.signals.frames(simulated.context))


def test_the_estimate_of_a_robot_that_stands(stood: tuple[TaskDiagram, dict]) -> None:
    """Within millimetres, a fifth of a degree, and millimetres a second."""
    task, frames = stood
    samples = frames["plant.state"].to_numpy(dtype=np.float64)
    motion = true_motion(
        task.plant, task.robot_instance, task.robot, samples[:, 0], samples[:, 1:]
    )
    errors = estimate_summary(frames, motion)
    assert errors is not None
    assert errors["max_position_m"] < 5e-3  # type: ignore[operator]
    assert errors["max_tilt_deg"] < 0.2  # type: ignore[operator]
    assert errors["rms_com_velocity_m_s"] < 5e-3  # type: ignore[operator]
    assert errors["max_position_m"] > 1e-6  # type: ignore[operator]
    assert errors["slips"] == [0, 0]
    assert errors["imu_silent_s"] == 0.0
    assert errors["drift_percent_of_climb"] is None


def test_the_estimator_alone_says_the_same(stood: tuple[TaskDiagram, dict]) -> None:
    """From the logged sensors, bit for bit."""
    _, frames = stood
    again = estimate_from_sensors(load_scenario("stand"), frames)
    for name in ("base_estimator.state", "base_estimator.deviation"):
        before, after = frames[name].to_numpy(), again[name].to_numpy()
        count = min(len(before), len(after))
        assert count > 390
        np.testing.assert_array_equal(before[:count], after[:count])


def test_the_estimator_alone_asks_for_its_sensors(
    stood: tuple[TaskDiagram, dict],
) -> None:
    """By the signal's name; and for a scenario that estimates."""
    frames = {name: stood[1][name] for name in [*SENSORS.values()][:2]}
    with pytest.raises(RunError, match=r"^ankle_force_sensors.foot_wrenches: was not"):
        estimate_from_sensors(load_scenario("stand"), frames)
    true = load_scenario("stand", ["robot.state=true"])
    with pytest.raises(ScenarioError, match=r"^stand: robot.state: must be estimated"):
        estimate_from_sensors(true, frames)


def test_a_dead_imu_is_told() -> None:
    """The robot stands on by its feet, and the figures say for how long."""
    changes = ["task.stand_time=1.0", "sensors.imu.fails_at=0.3"]
    task = build_task(load_scenario("stand", changes))
    simulated = simulate(task, 1.2)
    frames = task.signals.frames(simulated.context)
    faults = frames["base_estimator.faults"].to_numpy()
    assert faults[-1, 3] == pytest.approx(faults[-1, 0] - 0.32, abs=0.02)
    believed, true = (
        frames[name].iloc[-1, 5:8].to_numpy(dtype=float)
        for name in ("base_estimator.state", "plant.state")
    )
    error = believed - true
    assert np.abs(error).max() < 5e-3
