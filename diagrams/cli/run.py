"""`footfall run`: simulates a scenario."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfall.diagrams.cli.arguments import (
    DONE,
    ScenarioArgument,
    SetOption,
    load_named,
    quiet_drake,
)
from footfall.diagrams.cli.errors import (
    NOT_DONE,
    OptionError,
    bad_input_in_one_line,
    run_ends_in_one_line,
)
from footfall.diagrams.interruption import StopSignals

if TYPE_CHECKING:
    from pydrake.geometry import Meshcat

LOCAL_HOST = "127.0.0.1"
"""Where `--meshcat` listens by default: nobody else's machine reaches it."""


def run(
    scenario: ScenarioArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write, new or empty; by default runs/SCENARIO-seedN with "
            "what was set, numbered if that exists.",
            show_default=False,
        ),
    ] = None,
    overrides: SetOption = None,
    seed: Annotated[
        int | None,
        typer.Option(
            metavar="N", min=0, help="Seed of everything random (simulation.seed)."
        ),
    ] = None,
    draw: Annotated[
        bool,
        typer.Option(
            "--draw/--no-draw",
            help="Draw replay, block diagram and figures; `plot` draws figures later.",
        ),
    ] = True,
    meshcat: Annotated[
        bool, typer.Option("--meshcat", help="Show the run live in a browser.")
    ] = False,
    meshcat_host: Annotated[
        str,
        typer.Option(
            metavar="ADDRESS",
            help="Interface that --meshcat listens on; '*' for every one.",
        ),
    ] = LOCAL_HOST,
) -> None:
    """Simulate a scenario closed loop; write the run folder; print the summary.

    Ctrl-C or SIGTERM ends a run early; it is judged and kept, but not drawn. The
    signals go to disk while it runs: what is killed has all but its last second.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.closed_loop.tasks import build_task
        from footfall.diagrams.run_command import run_scenario

        quiet_drake()
        changes = list(overrides or [])
        chosen = load_named(scenario, changes, seed)
        show = partial(_start_meshcat, meshcat_host) if meshcat else None
        with StopSignals() as stop, run_ends_in_one_line(stop):
            summary = run_scenario(chosen, changes, out, build_task, stop, show, draw)
    raise typer.Exit(DONE if summary.outcome == "completed" else NOT_DONE)


def _start_meshcat(host: str) -> "Meshcat":
    from footfall.diagrams.figures.live_view import meshcat_at

    try:
        return meshcat_at(host)
    except RuntimeError as error:
        raise OptionError(f"--meshcat-host {host}: {error}") from error
