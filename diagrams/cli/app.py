"""The command `footfall`: its options, and the commands that it has."""

import logging
from collections.abc import Callable
from typing import Annotated

import typer

from footfall.diagrams.cli.check_robot import check_robot_file
from footfall.diagrams.cli.estimate import estimate
from footfall.diagrams.cli.export import export
from footfall.diagrams.cli.pictures import diagram, plot, replay
from footfall.diagrams.cli.render import render
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
    pretty_exceptions_enable=False,
    # Else the lines of a docstring are not joined to what fits the terminal.
    rich_markup_mode="markdown",
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


COMMANDS: tuple[tuple[str, Callable[..., None], tuple[str, ...]], ...] = (
    ("list", list_shipped, ()),
    (
        "fields",
        fields,
        (
            "footfall fields scene.staircase",
            "footfall fields parameters --task room_crossing",
            "footfall fields --schema scenario.json",
        ),
    ),
    (
        "run",
        run,
        (
            "footfall run stairs-exp1",
            "footfall run stairs-exp1 --set scene.staircase.rise=0.18 --seed 3",
            "footfall run obstacle-15cm obstacle-20cm --out crossings --quiet",
            "footfall run my_stairs.yaml --no-draw --json",
        ),
    ),
    ("sweep", sweep, ("footfall sweep docs/sweeps/staircases.yaml --jobs 2",)),
    (
        "check-robot",
        check_robot_file,
        ("footfall check-robot my_robot.yaml", "footfall check-robot jvrc1"),
    ),
    (
        "segment",
        segment,
        (
            "footfall segment stairs.pcd",
            "footfall segment scan.ply --gravity 0,-1,0 --viewpoint 0,1.2,0",
        ),
    ),
    (
        "report",
        report,
        ("footfall report runs/stairs-exp1-seed0", "footfall report sweeps/staircases"),
    ),
    (
        "plot",
        plot,
        (
            "footfall plot runs/stairs-exp1-seed0",
            "footfall plot runs/stairs-exp1-seed0 --format pdf,svg",
        ),
    ),
    (
        "estimate",
        estimate,
        (
            "footfall estimate runs/stairs-exp1-seed0",
            "footfall estimate runs/stairs-exp1-seed0 --set "
            "parameters.base_estimator.accelerometer=0.05",
        ),
    ),
    ("replay", replay, ("footfall replay runs/stairs-exp1-seed0",)),
    ("export", export, ("footfall export runs/stairs-exp1-seed0",)),
    (
        "render",
        render,
        (
            "footfall render runs/stairs-exp1-seed0",
            "footfall render runs/stairs-exp1-seed0 --frames 6 --from 8 --to 11",
            "footfall render runs/stairs-exp1-seed0 --video climb.mp4",
        ),
    ),
    (
        "diagram",
        diagram,
        ("footfall diagram stairs-exp1", "footfall diagram room --out room.svg"),
    ),
)
"""Name, what it calls, and examples for its help text."""

for name, command, examples in COMMANDS:
    # Typer joins the lines of an epilog unless there is a blank one between them.
    items = (f"- `{example}`" for example in examples)
    lines = "\n\n".join(("For example:", *items)) if examples else None
    app.command(name, epilog=lines)(command)


def main() -> None:
    """Runs the command line."""
    logging.basicConfig(format="%(name)s: %(message)s")
    # It too warns of a cache that cannot be written, and makes do without.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    app()
