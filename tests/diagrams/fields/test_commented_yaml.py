"""A written scenario has units and meanings, and loads back equal."""

from pathlib import Path

import pytest
import yaml

from footfall.diagrams.scenario import load_scenario, save_scenario


def _saved(path: Path, name: str, *overrides: str) -> str:
    scenario = load_scenario(name, overrides)
    save_scenario(scenario, path)
    assert load_scenario(path) == scenario
    return path.read_text(encoding="utf-8")


def test_units_and_meanings_are_comments(tmp_path: Path) -> None:
    """Where they are short; no line is long."""
    text = _saved(tmp_path / "a.yaml", "stairs-exp1")
    rise = "    rise: 0.2  # [m] Height of each step (stair paper, experiment 1)\n"
    assert rise in text
    assert "  mode: dynamic  # one of dynamic, quasi_static\n" in text
    assert "  control_period: 0.005  # [s] Tick of the fast loop\n" in text
    assert "      moment_cost: [0.02, 0.01, 0.05]" in text
    long = [line for line in text.splitlines() if len(line) > 88]
    assert long == []
    assert "# [m]\n" in text


@pytest.mark.parametrize(
    ("name", "there", "absent"),
    [
        (
            "stairs-exp1",
            {"segmenter", "staircase_map", "executive"},
            {"crossing", "path_planner", "depth_cloud", "floor", "obstacles"},
        ),
        ("room", {"depth_cloud", "path_planner"}, {"segmenter", "executive"}),
        ("obstacle-15cm", {"obstacle_finder", "crossing"}, {"segmenter", "floor"}),
    ],
)
def test_only_what_acts_is_there(
    name: str, there: set[str], absent: set[str], tmp_path: Path
) -> None:
    """By the scenario's task."""
    data = yaml.safe_load(_saved(tmp_path / "a.yaml", name))
    assert there <= set(data["parameters"])
    assert absent & set(data["parameters"]) == set()
    assert ("camera" in data["sensors"]) == (name == "room")
    assert "goal" in data["task"] or name == "stairs-exp1"


def test_what_was_set_and_does_not_act_says_so(tmp_path: Path) -> None:
    """It is not lost."""
    text = _saved(tmp_path / "a.yaml", "stairs-exp1", "sensors.camera.period=0.2")
    assert "  camera:  # Does not act: task.kind is not room_crossing\n" in text
    assert "    period: 0.2" in text


def test_texts_lists_and_odd_numbers_load_back(tmp_path: Path) -> None:
    """Quotes, colons, groups in lists, empty texts and tiny numbers."""
    _saved(
        tmp_path / "a.yaml",
        "stairs-exp1",
        "description='a: # \"b\" '",
        "scene.boxes=[{name: 'yes', x: -2}, {name: '1', x: -3}]",
        "task.pushes=[{force: [0, 1.0e-7, 0]}, {force: [1, 0, 0], time: 3}]",
        "parameters.zmp_preview.jerk_weight=1.0e-9",
    )


def test_the_same_scenario_gives_the_same_bytes(tmp_path: Path) -> None:
    """Written again from what was read."""
    text = _saved(tmp_path / "a.yaml", "room-moving")
    assert _saved(tmp_path / "b.yaml", str(tmp_path / "a.yaml")) == text
