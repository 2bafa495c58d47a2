"""The command that repeats a run."""

import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from footfall.diagrams.fields.commented_yaml import commented_yaml
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
    seed = scenario.simulation.seed
    shipped = load_scenario(scenario.name, [f"simulation.seed={seed}"])
    changes = [
        f"{path}={_flow(value)}"
        for path, value in _differences(_plain(shipped), _plain(scenario))
        if path != "simulation.seed" and path not in NAMES
    ]
    try:
        again = load_scenario(scenario.name, [f"simulation.seed={seed}", *changes])
    except ScenarioError:
        return None
    if _plain(again) != _plain(scenario):
        return None
    parts = ["footfall", "run", scenario.name, "--seed", str(seed)]
    for change in changes:
        parts += ["--set", change]
    return shlex.join(parts)


def file_command(scenario_file: Path) -> str:
    """Writes the command that runs a scenario's file, which holds its seed."""
    return shlex.join(["footfall", "run", str(scenario_file)])


def _plain(scenario: Scenario) -> dict[str, Any]:
    """Gives the fields that act in a scenario as plain data."""
    data: dict[str, Any] = yaml.safe_load(commented_yaml(scenario))
    return data


def _differences(
    before: dict[str, Any], after: dict[str, Any], prefix: str = ""
) -> Iterator[tuple[str, Any]]:
    """Yields path and new value of each field that differs, groups field by field."""
    for name, value in after.items():
        old, path = before.get(name), f"{prefix}{name}"
        if isinstance(value, dict) and isinstance(old, dict):
            yield from _differences(old, value, f"{path}.")
        elif value != old or name not in before:
            yield path, value


def _flow(value: Any) -> str:
    """Writes a value as YAML in one line."""
    text = yaml.safe_dump(value, default_flow_style=True, width=float("inf"))
    return text.removesuffix("\n").removesuffix("\n...")
