"""The room crossing closed loop, in contact physics, as short as it can be."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.figures.replay import replay_run
from footfall.diagrams.figures.room_view import draw_room
from footfall.diagrams.figures.run_figures import plot_run
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.simulation import run_task

SHORT = (
    "scene.clutter=null",
    "scene.boxes=[{name: bin, x: -1.0, y: 1.5, size: [0.4, 0.3, 0.5]}]",
    "task.goal=[-1.7, 0.1, 0.0]",
)
ONTO_THE_WAY = (
    "scene.boxes=[]",
    "scene.movers=[{name: trolley, x: -0.6, y: -1.8, to_x: -0.6, to_y: 0.0, time: 1.5,"
    " size: [0.5, 0.5, 0.6]}]",
    "task.goal=[-0.6, 0.0, 0.0]",
)


def run_room(folder: Path, name: str, changes: Sequence[str]) -> Run:
    """Runs a room and reads it back."""
    scenario = load_scenario(name, changes)
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


@pytest.fixture(scope="module")
def crossing(tmp_path_factory) -> Run:
    """A run past a box in a corner, to a goal less than a metre ahead."""
    return run_room(tmp_path_factory.mktemp("room") / "run", "room", SHORT)


@pytest.fixture(scope="module")
def stopped(tmp_path_factory) -> Run:
    """A box is pushed onto the goal while the robot is on its way."""
    folder = tmp_path_factory.mktemp("room-moving") / "run"
    return run_room(folder, "room-moving", ONTO_THE_WAY)


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
    assert activities == ["look", "plan", "rest", "move", "look", "plan", "stand"]
    assert states[-1]["state"] == "finished"


def test_it_looks_again_on_the_way(crossing) -> None:
    """What it sees is logged: floor, box and walls each time."""
    looks = [value for _, value in crossing.values("executive.environment")][1:]
    assert len(looks) >= 5
    assert all(look["floor"]["inlier_share"] > 0.7 for look in looks)
    room = crossing.scenario.scene.room
    for look in looks:
        x, y, _ = np.abs([box["center"] for box in look["boxes"]]).T
        from_walls = np.maximum(x - room.length / 2, y - room.width / 2)
        assert np.sum(np.abs(from_walls) > 0.1) == 1


def test_thinking_takes_its_time(stopped) -> None:
    """A look's result, a plan and a stop; what is logged may be an update late."""
    thinking = stopped.scenario.parameters.thinking
    for time, seen in stopped.values("executive.environment")[1:]:
        late = time - seen["sensed_at"] - thinking.room_perception
        assert -1e-6 < late < 2 * 0.025 + 1e-6
    latency = {"plan": thinking.room_planning, "replan": thinking.stopping}
    known = set()
    for (begun, value), (there, _) in pairwise(stopped.values("executive.status")):
        if value["activity"] in latency:
            known.add(value["activity"])
            late = there - begun - latency[value["activity"]]
            assert -1e-6 < late < 0.025 + 1e-6
    assert known == set(latency)


def test_perception_is_measured(crossing) -> None:
    """Against the true box: 3 cm and 5 cm are asked for; time by stage."""
    perception = crossing.summary["perception"]
    looks = crossing.values("executive.environment")[1:]
    assert perception["frames"] == perception["errors"]["boxes"] == len(looks)
    assert perception["errors"]["unseen"] == 0
    assert perception["errors"]["max_center_m"] < 0.03
    assert perception["errors"]["max_size_m"] < 0.05
    assert perception["floor_inlier_share"] > 0.7
    stages = perception["ms_per_frame"]
    assert list(stages) == ["cloud", "floor", "boxes", "xml", "total"]
    assert all(0.0 < stages[name] <= stages["total"] for name in stages)


def test_it_is_drawn_from_above(crossing) -> None:
    """All that the paper's Fig. 5 has, and both trees."""
    ax = Figure().subplots()
    draw_room(ax, crossing)
    labels = set(ax.get_legend_handles_labels()[1])
    assert labels >= {"wall", "box", "box seen", "path", "goal", "tree from the start"}
    assert any(path.name == "top_view.png" for path in plot_run(crossing.folder))


def test_a_box_on_its_way_makes_it_stop_in_balance(stopped) -> None:
    """It stands, has touched nothing, and says why it cannot go there any more."""
    states = [value for _, value in stopped.values("executive.status")]
    assert [value["activity"] for value in states][:7] == [
        *("look", "plan", "rest", "move", "replan", "stop", "look"),
    ]
    summary = stopped.summary
    assert summary["outcome"] == "infeasible"
    assert "the goal (-0.60, 0.00) m is inside box_" in summary["reason"]
    assert summary["max_dcm_error_m"] < 0.03
    assert summary["max_foot_slip_m"] < 0.005
    assert stopped.values("contact_monitor.touches")[-1][1]["touches"] == []
    feet = stopped.signals["feet.true"].iloc[-1]
    assert max(feet["left_x"], feet["right_x"]) < -1.0


def test_moving_boxes_are_logged_and_replayed(stopped) -> None:
    """From where they stood to where they came to; the page has them move."""
    movers = stopped.signals["movers.state"]
    np.testing.assert_allclose(movers.iloc[0, 1:3], [-0.6, -1.8], atol=1e-6)
    np.testing.assert_allclose(movers.iloc[-1, 1:3], [-0.6, 0.0], atol=5e-3)
    page = replay_run(stopped.folder).read_text()
    assert replay_run(stopped.folder).read_text() == page
    (stopped.folder / "signals" / "movers.state.parquet").unlink()
    assert replay_run(stopped.folder).read_text() != page
