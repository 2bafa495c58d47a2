"""`footfall sweep`: runs a scenario many times."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import DONE
from footfall.diagrams.cli.errors import NOT_DONE, bad_input_in_one_line
from footfall.diagrams.interruption import StopSignals


def sweep(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="SWEEP", help="A YAML file: a scenario and what varies in it."
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder of the sweep, by default sweeps/SWEEP; one that holds this "
            "sweep already is gone on with.",
            show_default=False,
        ),
    ] = None,
    jobs: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=1,
            help="Runs at a time, by default as many as there are processors.",
            show_default=False,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Run on a Dask cluster whose scheduler has this address, "
            "tcp://HOST:PORT; each thread of its workers takes a run at a time.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Run a scenario many times; write a table, a report and figures.

    Each run is a process of its own. A sweep that was cut, by Ctrl-C or by a power
    failure, goes on where it was when it is called again. It takes as long as its runs,
    about a minute each, over the jobs; how much is left is told after each.

    On a Dask cluster the folder of the sweep, and a scenario file of your own, must lie
    on a file system that its machines share; it needs the extra `cluster`.

    Six staircases, both seeds of each, are:

        scenario: stairs-exp1
        fields:
          scene.staircase.rise: {from: 0.12, to: 0.20, levels: 3}
          scene.staircase.steps: [2, 4]
        seeds: 2
    """
    with bad_input_in_one_line():
        import os

        from footfall.diagrams.sweep.definition import SweepError
        from footfall.diagrams.sweep.pools import DaskPool, LocalPool, Pool
        from footfall.diagrams.sweep_command import sweep_scenario

        if jobs and scheduler:
            raise SweepError("--jobs: a cluster has as many as its workers' threads")
        pool: Pool = (
            DaskPool(scheduler) if scheduler else LocalPool(jobs or os.cpu_count() or 1)
        )
        with StopSignals() as stop:
            try:
                folder, rate, missing = sweep_scenario(file, out, pool, typer.echo)
            except KeyboardInterrupt:
                line = "footfall: interrupted; the same command goes on where it was"
                typer.echo(line, err=True)
                raise typer.Exit(stop.exit_status()) from None
    typer.echo(f"success: {rate}" if rate.runs else "success: no run has a result")
    if missing:
        typer.echo(f"without a result: {missing}; the same command tries them again")
    typer.echo(f"written to {folder}")
    raise typer.Exit(NOT_DONE if missing else DONE)
