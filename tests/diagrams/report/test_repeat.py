"""The command that repeats a run does repeat it."""

import shlex
from dataclasses import replace

from footfall.diagrams.report.repeat import file_command, short_command
from footfall.diagrams.scenario import load_scenario

CHANGES = (
    "scene.staircase.rise=0.18",
    "robot.state='true'",
    "sensors.encoders.stuck_joints=[L_KNEE]",
    "task.pushes=[{time: 1.0, force: [0.0, 40.0, 0.0]}]",
)


def test_changes_of_a_shipped_scenario_are_said_again() -> None:
    """Seed and fields, so that the same scenario comes of it."""
    scenario = load_scenario("stairs-exp1", ["simulation.seed=3", *CHANGES])
    command = short_command(scenario)
    assert command is not None
    words = shlex.split(command)
    assert words[:5] == ["footfall", "run", "stairs-exp1", "--seed", "3"]
    assert words[5::2] == ["--set"] * len(CHANGES)
    assert "scene.staircase.rise=0.18" in words
    assert load_scenario(words[2], ["simulation.seed=3", *words[6::2]]) == scenario


def test_what_the_seed_draws_is_not_said() -> None:
    """The boxes of a room come with it."""
    scenario = load_scenario("room", ["simulation.seed=4"])
    assert short_command(scenario) == "footfall run room --seed 4"


def test_a_scenario_of_ones_own_has_no_short_command() -> None:
    """Nor one that only bears a shipped one's name."""
    scenario = load_scenario("stand")
    assert short_command(replace(scenario, name="mine")) is None
    other = replace(load_scenario("stairs-exp1"), name="stand")
    command = short_command(other)
    assert command is None or "task.kind=stair_climbing" in command
    file = "a folder/scenario.yaml"
    assert shlex.split(file_command(file)) == ["footfall", "run", file]
