"""`footfall export`: a run for Foxglove and PlotJuggler."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import RunArgument, quiet_drake
from footfall.diagrams.cli.errors import bad_input_in_one_line


def export(
    run_folder: RunArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.mcap",
            help="File to write; by default run.mcap in the run's folder.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Write a run as an MCAP file, which Foxglove and PlotJuggler open.

    All signals are in it, with units, frames and limits, and in Foxglove's schemas the
    robot, the scene, what was seen and planned, contact forces, CoM and ZMP. Beside it
    goes foxglove.json, a layout to import in Foxglove. It needs the extra mcap and
    takes about as long as the run was simulated for.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.export.mcap_file import export_run

        quiet_drake()
        for path in export_run(run_folder, out):
            typer.echo(path)
