"""What several commands take, and what they do with it."""

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

# What simulates takes seconds to import; every command imports what it needs, so that
# the help text comes at once.
if TYPE_CHECKING:
    from footfall.diagrams.scenario import Scenario

DONE = 0
"""Exit status: the task was done."""


def complete_scenario(begun: str) -> list[str]:
    """Lists for the shell what a scenario may be that begins so.

    Args:
        begun: of a shipped scenario's name, or of a path.
    """
    from footfall.diagrams.shipped import shipped_scenarios

    path = Path(begun)
    folder = path if begun.endswith("/") or not begun else path.parent
    beside = sorted(folder.iterdir()) if folder.is_dir() else []
    files = [f"{one}/" if one.is_dir() else str(one) for one in beside]
    names = [*sorted(shipped_scenarios()), *files]
    ends = ("/", ".yaml", ".yml")
    return [
        name
        for name in names
        if name.startswith(begun)
        and (name in shipped_scenarios() or name.endswith(ends))
    ]


ScenarioArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENARIO",
        help="Name of a shipped scenario, or a YAML file.",
        autocompletion=complete_scenario,
    ),
]
RunArgument = Annotated[
    Path, typer.Argument(metavar="RUN", help="A run folder that `run` has written.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change a field of the scenario, e.g. scene.staircase.rise=0.18. "
        "May be given several times.",
    ),
]


def load_named(name: str, overrides: list[str] | None, seed: int | None) -> "Scenario":
    """Loads a scenario with what was changed on the command line.

    Raises:
        ScenarioError: it cannot be used.
    """
    from footfall.diagrams.scenario import load_scenario

    changes = list(overrides or [])
    if seed is not None:
        changes.append(f"simulation.seed={seed}")
    return load_scenario(name, changes)


def quiet_drake() -> None:
    """Silences Drake: it tells of every port that Meshcat opens; nobody asked."""
    logging.getLogger("drake").setLevel(logging.ERROR)
