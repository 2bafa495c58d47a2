"""From a scenario to its closed loop: every one that is shipped, for a moment."""

import numpy as np
import pytest

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.diagrams.closed_loop.tasks import STATIONS, build_task
from footfall.diagrams.judge.falls import base_height
from footfall.diagrams.judge.true_motion import true_motion
from footfall.diagrams.scenario import ScenarioError, load_scenario
from footfall.diagrams.shipped import list_scenarios
from footfall.diagrams.simulation import simulate
from footfall.diagrams.task_params import TASKS

NAMES = [name for name, _ in list_scenarios()]


@pytest.mark.parametrize("name", NAMES)
def test_every_scenario_runs_for_a_moment(name: str) -> None:
    """It is built, stands where it is to start, and logs."""
    scenario = load_scenario(name)
    task = build_task(scenario)
    simulated = simulate(task, 0.08)
    assert (simulated.stop, simulated.error) == ("time limit", None), simulated.reason
    assert simulated.context.get_time() == pytest.approx(0.08)
    frame = task.signals.frames(simulated.context)["plant.state"]
    samples = frame.to_numpy()
    assert len(samples) >= 16
    motion = true_motion(
        task.plant, task.robot_instance, task.robot, samples[:, 0], samples[:, 1:]
    )
    feet = np.array([motion.X_WF[foot][:, :3, 3] for foot in ("left", "right")])
    middle = feet.mean(axis=0)
    start = [scenario.robot.x, scenario.robot.y, 0.0]
    np.testing.assert_allclose(middle - start, 0.0, atol=4e-3)
    height = base_height(motion)
    assert height.min() > 0.98 * height[0]


@pytest.mark.parametrize("name", NAMES)
def test_every_subsystem_has_a_name_of_its_own(name: str) -> None:
    """None that Drake had to make up."""
    diagram = build_task(load_scenario(name)).diagram
    names = [system.get_name() for system in diagram.GetSystems()]
    names += [leaf.get_name() for station, leaf in leaf_systems(diagram) if station]
    assert not [name for name in names if "@" in name or "/" in name]
    assert len(set(names)) == len(names)


def test_every_kind_of_task_has_a_builder() -> None:
    """And every builder is a kind that a scenario may name."""
    assert set(STATIONS) == set(TASKS)


def test_an_unknown_task_is_bad_input() -> None:
    """Named with what there is."""
    scenario = load_scenario("stairs-exp1")
    scenario.task.kind = "juggling"
    with pytest.raises(ScenarioError, match=r"task\.kind: must be one of .*'juggling'"):
        build_task(scenario)


def test_same_seed_same_motion_bit_for_bit() -> None:
    """Two simulations of a second, scanner noise included."""
    states = []
    for _ in range(2):
        task = build_task(load_scenario("stairs-exp1", ["simulation.seed=3"]))
        simulated = simulate(task, 1.0)
        frames = task.signals.frames(simulated.context)
        states.append({name: frame.to_numpy() for name, frame in frames.items()})
    assert set(states[0]) == set(states[1])
    for name, values in states[0].items():
        np.testing.assert_array_equal(values, states[1][name], err_msg=name)
