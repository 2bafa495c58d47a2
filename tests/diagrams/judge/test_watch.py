"""What a simulation sees of its robot while it goes on."""

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator

from footfall.diagrams.judge.watch import WATCHED_REST, HoldClock, RobotWatch


def test_a_robot_that_stands_rests_and_has_not_fallen(standing) -> None:
    """In the air it does not rest: no sole bears anything."""
    task = standing.task(end=60.0)
    simulator = Simulator(task.diagram)
    watch = RobotWatch(task, simulator.get_context())
    assert not watch.rests()
    for step in range(1, 80):
        simulator.AdvanceTo(0.05 * step)
        if watch.rests():
            break
    assert watch.rests()
    assert watch.fall() is None
    assert not watch.lies()
    state = task.plant.GetPositionsAndVelocities(
        task.plant.GetMyContextFromRoot(simulator.get_context()), task.robot_instance
    )
    base = task.plant.num_positions(task.robot_instance)
    state[base + 3] = 0.05
    context = task.plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    task.plant.SetPositionsAndVelocities(context, task.robot_instance, state)
    assert not watch.rests()


def test_a_robot_that_tips_has_fallen_before_it_lies(standing) -> None:
    """First the sign of the fall, then the ground."""
    task = standing.task(end=60.0, pitch=0.4)
    simulator = Simulator(task.diagram)
    watch = RobotWatch(task, simulator.get_context())
    seen: list[tuple[bool, bool]] = []
    for step in range(1, 100):
        simulator.AdvanceTo(0.05 * step)
        seen.append((watch.fall() is not None, watch.lies()))
        if seen[-1][1]:
            break
    falls, lies = np.array(seen).T
    assert lies[-1]
    assert falls[-1]
    assert np.argmax(falls) < np.argmax(lies)


def test_what_bears_a_robot_beside_its_soles_is_a_fall(standing, monkeypatch) -> None:
    """Even where it is as high and as upright as ever."""
    task = standing.task(end=60.0)
    watch = RobotWatch(task, Simulator(task.diagram).get_context())
    monkeypatch.setattr(watch, "_upward", lambda: np.array([0.4, 0.4, 0.2]))
    sign = "something else than its soles bore 20% of its weight"
    assert watch.fall() == sign


def test_rest_must_last_a_second_on_end() -> None:
    """Every unrest sets the clock back."""
    clock = HoldClock(WATCHED_REST)
    for tick in range(150):
        clock.look(0.005 * tick, tick != 100)
    assert not clock.done()
    for tick in range(150, 303):
        clock.look(0.005 * tick, True)
    assert not clock.done()
    clock.look(0.005 * 303, True)
    assert clock.done()


@pytest.mark.parametrize("rests", [True, False])
def test_a_clock_that_saw_nothing_is_not_done(rests: bool) -> None:
    """Nor after a single look."""
    clock = HoldClock(WATCHED_REST)
    assert not clock.done()
    clock.look(7.0, rests)
    assert not clock.done()
