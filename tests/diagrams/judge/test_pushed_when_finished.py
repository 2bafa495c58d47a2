"""A robot that is pushed just after it has finished: whether the judge still looks.

A short walk stands for every task here; `tests/studies/push_finished.py` does the same
to whole climbs, crossings and rooms.
"""

from pathlib import Path

import pytest

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.simulation import run_task

SHORT = ("scene.clutter=null", "task.goal=[-2.2, 0.0, 0.0]")


def walk(folder: Path, *overrides: str) -> Run:
    """A walk of 30 cm, judged."""
    scenario = load_scenario("room", [*SHORT, *overrides])
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> float:
    """When the executive is done, s; the robot rests from then on."""
    run = walk(tmp_path_factory.mktemp("walk") / "run")
    assert run.summary["outcome"] == "completed", run.summary["reason"]
    states = run.values("executive.status")
    (done,) = [time for time, value in states if value["state"] == "finished"]
    assert done + 1.0 < run.summary["simulated_time_s"] < done + 5.0
    return done


def push(finished: float, x: float, y: float) -> str:
    """A push of 0.1 s that begins 0.1 s after the executive is done."""
    return (
        f"task.pushes=[{{time: {finished + 0.1}, duration: 0.1, "
        f"force: [{x}, {y}, 0.0]}}]"
    )


@pytest.mark.parametrize(("x", "y"), [(0.0, 700.0), (-700.0, 0.0), (900.0, 0.0)])
def test_a_robot_that_is_pushed_over_fell(tmp_path, finished, x, y) -> None:
    """By its fall, watched to the ground."""
    run = walk(tmp_path / "run", push(finished, x, y))
    assert run.summary["outcome"] == "fell"
    assert run.summary["reason"].startswith("the robot fell at ")
    height = run.signals["plant.state"].filter(like=f"{'PELVIS_S'}_z").to_numpy()
    assert height[-1, 0] < 0.35
    support = run.signals["contact_monitor.other_support"]["fz"].to_numpy()
    assert support[-20:].mean() > 0.3 * 62.4 * 9.81


def test_a_robot_that_is_nudged_is_completed(tmp_path, finished) -> None:
    """Sideways with 20 N: it comes to rest again, and is given the time for it."""
    run = walk(tmp_path / "run", push(finished, 0.0, 20.0))
    assert run.summary["outcome"] == "completed", run.summary["reason"]
    assert run.summary["simulated_time_s"] > finished + 1.2
