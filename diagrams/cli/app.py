"""The command `footfall`: its options, and the commands that it has."""

import logging
from typing import Annotated

import typer

from footfall.diagrams.cli.check_robot import check_robot_file
from footfall.diagrams.cli.estimate import estimate
from footfall.diagrams.cli.pictures import diagram, plot, render, replay
from footfall.diagrams.cli.report import report
from footfall.diagrams.cli.run import run
from footfall.diagrams.cli.scenarios import fields, list_shipped
from footfall.diagrams.cli.segment import segment
from footfall.diagrams.cli.sweep import sweep

app = typer.Typer(
    name="footfall",
    help="Humanoids that see stairs, obstacles and clutter, and walk them, simulated "
    "closed loop with Drake.",
    epilog="Exit status: 0 the task was done; 1 it was not (failed, fell, infeasible, "
    "timed out, cut), or its folder could not be written; 2 bad input; 130 and 143 "
    "interrupted by Ctrl-C and SIGTERM.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"footfall {version('footfall')}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool,
        typer.Option(
            "--version",
            help="Print the version and leave.",
            callback=_print_version,
            is_eager=True,
        ),
    ] = False,
) -> None:
    """Options of the command itself; `help` of the app says what it does."""


for name, command in (
    ("list", list_shipped),
    ("fields", fields),
    ("run", run),
    ("sweep", sweep),
    ("check-robot", check_robot_file),
    ("segment", segment),
    ("report", report),
    ("plot", plot),
    ("estimate", estimate),
    ("replay", replay),
    ("render", render),
    ("diagram", diagram),
):
    app.command(name)(command)


def main() -> None:
    """Runs the command line."""
    logging.basicConfig(format="%(name)s: %(message)s")
    # It too warns of a cache that cannot be written, and makes do without.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    app()
