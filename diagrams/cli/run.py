"""`footfall run`: simulates a scenario."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfall.diagrams.cli.arguments import (
    DONE,
    SetOption,
    complete_scenario,
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
    scenarios: Annotated[
        list[str],
        typer.Argument(
            metavar="SCENARIO",
            help="Names of shipped scenarios, or YAML files, run one after the other.",
            autocompletion=complete_scenario,
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write, new or empty; by default runs/SCENARIO-seedN with "
            "what was set, numbered if that exists. Of several scenarios their folders "
            "go into it.",
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
            help="Draw replay, block diagram and figures, 5 to 15 s; `plot` and "
            "`replay` draw them later.",
        ),
    ] = True,
    quiet: Annotated[
        bool,
        typer.Option(
            "--quiet",
            "-q",
            help="Print no progress, and a line a run in place of the summary.",
        ),
    ] = False,
    as_json: Annotated[
        bool,
        typer.Option(
            "--json",
            help="Print the summary as JSON, a line a run, in place of the table.",
        ),
    ] = False,
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
    """Simulate scenarios closed loop; write the run folders; print the summaries.

    It takes about as long as what is simulated, on one core: stairs-exp1 a minute,
    stairs-exp2 two to three, a quasi-static climb more. All scenarios are read before
    the first is run.

    Ctrl-C or SIGTERM ends a run early; it is judged and kept, but not drawn, and what
    would follow is not run. The signals go to disk while it runs: what is killed has
    all but its last second.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.closed_loop.tasks import build_task
        from footfall.diagrams.judge.summary_table import (
            print_json,
            print_line,
            print_summary,
        )
        from footfall.diagrams.run_command import RUNS_FOLDER, run_scenario
        from footfall.diagrams.run_folder import require_usable

        quiet_drake()
        changes = list(overrides or [])
        chosen = [load_named(scenario, changes, seed) for scenario in scenarios]
        start = partial(_start_meshcat, meshcat_host) if meshcat else None
        show = print_json if as_json else print_line if quiet else print_summary
        parent, several = RUNS_FOLDER, len(chosen) > 1
        if several and out is not None:
            require_usable(out)
            parent, out = out, None
        outcomes = []
        with StopSignals() as stop, run_ends_in_one_line(stop):
            for number, one in enumerate(chosen, start=1):
                if several and not quiet:
                    typer.echo(f"{number}/{len(chosen)}  {one.name}", err=True)
                summary = run_scenario(
                    one,
                    changes,
                    out,
                    build_task,
                    stop,
                    start,
                    draw,
                    show=show,
                    quiet=quiet,
                    parent=parent,
                )
                outcomes.append(summary.outcome)
    raise typer.Exit(DONE if set(outcomes) == {"completed"} else NOT_DONE)


def _start_meshcat(host: str) -> "Meshcat":
    from footfall.diagrams.figures.live_view import meshcat_at

    try:
        return meshcat_at(host)
    except RuntimeError as error:
        raise OptionError(f"--meshcat-host {host}: {error}") from error
