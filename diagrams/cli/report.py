"""`footfall report`: a run or a sweep as one page."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import quiet_drake
from footfall.diagrams.cli.errors import bad_input_in_one_line


def report(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="FOLDER",
            help="A run folder that `run` has written, or a sweep's of `sweep`.",
        ),
    ],
) -> None:
    """Write a run, or a sweep, as one page that needs nothing beside it.

    Of a run: what happened, film strip, replay, all figures with what to look for in
    them, the summary with the meaning of each number, and the command that repeats it.
    Of a sweep: success with its intervals, figures, and the command of each failure.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.report.any_report import write_report

        quiet_drake()
        path, complaints = write_report(folder)
    for complaint in complaints:
        typer.echo(f"footfall: {complaint}", err=True)
    typer.echo(path)
