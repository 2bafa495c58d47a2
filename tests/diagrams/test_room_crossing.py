"""The room crossing closed loop, in contact physics, as short as it can be."""

import numpy as np
import pytest

from diagrams.scenario import load_scenario
from diagrams.signals import load_run
from diagrams.simulation import run_task
from diagrams.tasks import build_task

SHORT = ["scene.clutter=null", "task.goal=[-1.7, 0.1, 0.0]"]


@pytest.fixture(scope="module")
def crossing(tmp_path_factory):
    """A run through an empty room, to a goal less than a metre ahead."""
    folder = tmp_path_factory.mktemp("room") / "run"
    scenario = load_scenario("room", SHORT)
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


def test_the_goal_is_reached(crossing) -> None:
    """In balance, within the joints' limits, with nothing but soles on the floor."""
    summary = crossing.summary
    assert summary["outcome"] == "completed", summary["reason"]
    assert summary["goal_error_m"] < 0.03
    assert summary["goal_turn_rad"] < 0.05
    assert summary["max_foot_slip_m"] < 0.005
    assert summary["max_dcm_error_m"] < 0.03
    assert summary["max_speed_fraction"] < 1.0
    assert 4 <= summary["footsteps"] <= 8


def test_it_looks_walks_and_looks_whether_it_is_there(crossing) -> None:
    """One plan is enough in a room in which nothing moves."""
    states = [value for _, value in crossing.values("executive.status")]
    activities = [value["activity"] for value in states]
    assert activities == ["look", "move", "look", "stand"]
    assert states[-1]["state"] == "finished"


def test_it_looks_again_on_the_way(crossing) -> None:
    """What it sees is logged: a floor each time, and nothing but the walls on it."""
    looks = [value for _, value in crossing.values("executive.environment")][1:]
    assert len(looks) >= 5
    assert all(look["floor"]["inlier_share"] > 0.7 for look in looks)
    room = crossing.scenario.scene.room
    for box in (box for look in looks for box in look["boxes"]):
        x, y, _ = np.abs(box["center"])
        assert max(x - room.length / 2, y - room.width / 2) == pytest.approx(0, abs=0.1)
