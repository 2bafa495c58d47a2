"""A scenario names a robot by its file; what follows from the robot is filled in."""

from pathlib import Path

import pytest

from footfall.diagrams.scenario import ScenarioError, load_scenario, save_scenario
from tests.models.robots.biped import HIP, write_biped


@pytest.fixture
def scenario_file(tmp_path: Path) -> Path:
    """In a folder of its own, its robot in another."""
    write_biped(tmp_path / "robots")
    file = tmp_path / "stand.yaml"
    file.write_text("robot: robots/biped.yaml\ntask: {kind: stand}\n")
    return file


def test_the_file_lies_where_the_scenario_says(scenario_file: Path) -> None:
    """From the scenario's folder; parameters follow from the robot."""
    scenario = load_scenario(scenario_file)
    robot = scenario.robot.model()
    assert robot.name == scenario.robot.name == "biped"
    assert scenario.parameters.footstep_planner.stance_width == pytest.approx(2 * HIP)
    assert scenario.parameters.com_height == robot.standing_com[1]
    assert scenario.parameters.path_planner.footprint_radius == robot.footprint_radius


def test_what_the_scenario_says_of_a_parameter_stays(scenario_file: Path) -> None:
    """In the file, or set."""
    scenario = load_scenario(scenario_file, ["parameters.com_height=0.7"])
    assert scenario.parameters.com_height == 0.7


def test_the_resolved_scenario_runs_anywhere(scenario_file: Path) -> None:
    """It carries the description, with everything that was derived."""
    scenario = load_scenario(scenario_file)
    saved = scenario_file.parent / "run/scenario.yaml"
    saved.parent.mkdir()
    save_scenario(scenario, saved)
    (scenario_file.parent / "robots/biped.yaml").unlink()
    again = load_scenario(saved)
    assert again == scenario
    assert again.robot.model() == scenario.robot.model()


def test_any_scenario_takes_a_robot_by_set(scenario_file: Path, monkeypatch) -> None:
    """Its path from the working folder; fields of the robot can be set as well."""
    monkeypatch.chdir(scenario_file.parent / "robots")
    sets = ["robot=biped.yaml", "robot.description.leg_reach=0.5", "robot.x=1.0"]
    robot = load_scenario("stand", sets).robot
    assert (robot.name, robot.x, robot.model().leg_reach) == ("biped", 1.0, 0.5)


def test_fields_of_a_shipped_robot_can_be_set() -> None:
    """All others stay what they are."""
    robot = load_scenario("stand", ["robot.description.leg_reach=0.7"]).robot.model()
    assert (robot.name, robot.leg_reach, robot.standing_com[1]) == ("jvrc1", 0.7, 0.85)


def test_a_wrong_robot_is_refused_in_one_line(scenario_file: Path) -> None:
    """That names both files and every field."""
    file = scenario_file.parent / "robots/biped.yaml"
    file.write_text(file.read_text() + "head_body: hed\nswing_joints: [arm]\n")
    with pytest.raises(ScenarioError) as raised:
        load_scenario(scenario_file)
    text = str(raised.value)
    assert text.startswith(
        f"{scenario_file}: robot: {file}: head_body: there is no link"
    )
    assert "; swing_joints: " in text
    assert "\n" not in text
