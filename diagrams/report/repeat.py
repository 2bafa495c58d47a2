"""The command that repeats a run."""

import shlex
from pathlib import Path
from typing import Any

import yaml

from footfall.diagrams.fields.flat_fields import flat_fields
from footfall.diagrams.scenario import Scenario, ScenarioError, load_scenario
from footfall.diagrams.shipped import shipped_scenarios

NAMES = ("name", "description")
"""What is said of a scenario without being run."""


def short_command(scenario: Scenario) -> str | None:
    """Writes the command that runs a scenario by a shipped one's name and changes.

    Args:
        scenario: as it was run, every field resolved.

    Returns:
        None where no shipped scenario has its name, or where no changes of single
        fields lead from that one to this.
    """
    if scenario.name not in shipped_scenarios():
        return None
    seed, wanted = scenario.simulation.seed, flat_fields(scenario)
    # With the seed of the run: what it draws is no change.
    shipped = flat_fields(load_scenario(scenario.name, [f"simulation.seed={seed}"]))
    changes = [
        f"{path}={_flow(value)}"
        for path, value in wanted.items()
        if (path not in shipped or shipped[path] != value) and path not in NAMES
    ]
    try:
        again = load_scenario(scenario.name, [f"simulation.seed={seed}", *changes])
    except ScenarioError:
        return None
    if flat_fields(again) != wanted:
        return None
    parts = ["footfall", "run", scenario.name, "--seed", str(seed)]
    for change in changes:
        parts += ["--set", change]
    return shlex.join(parts)


def file_command(scenario_file: Path) -> str:
    """Writes the command that runs a scenario's file, which holds its seed."""
    return shlex.join(["footfall", "run", str(scenario_file)])


def _flow(value: Any) -> str:
    """Writes a value as YAML in one line."""
    text = yaml.safe_dump(value, default_flow_style=True, width=float("inf"))
    return text.removesuffix("\n").removesuffix("\n...")
