"""The commands that draw a run or a scenario."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import (
    RunArgument,
    ScenarioArgument,
    SetOption,
    load_named,
    quiet_drake,
)
from footfall.diagrams.cli.errors import OptionError, bad_input_in_one_line


def plot(
    run_folder: RunArgument,
    kinds: Annotated[
        str,
        typer.Option(
            "--format",
            metavar="KIND,...",
            help="Of png, pdf and svg, one or several; vector graphics for papers.",
        ),
    ] = "png",
) -> None:
    """Draw the figures of a run into its folder `figures`."""
    with bad_input_in_one_line():
        from footfall.diagrams.figures.run_figures import FORMATS, plot_run

        formats = list(dict.fromkeys(kind.strip().lower() for kind in kinds.split(",")))
        if not set(formats) <= set(FORMATS):
            known = ", ".join(FORMATS)
            raise OptionError(f"--format: must be some of {known}, got {kinds!r}")
        for path in plot_run(run_folder, formats):
            typer.echo(path)


def replay(run_folder: RunArgument) -> None:
    """Write a run as a page that opens without a server."""
    with bad_input_in_one_line():
        from footfall.diagrams.figures.replay import replay_run

        quiet_drake()
        typer.echo(replay_run(run_folder))


def diagram(
    scenario: ScenarioArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="SVG file to write; by default SCENARIO.svg.",
            show_default=False,
        ),
    ] = None,
    overrides: SetOption = None,
) -> None:
    """Draw the block diagram of a scenario as SVG."""
    with bad_input_in_one_line():
        from footfall.diagrams.closed_loop.tasks import build_task
        from footfall.diagrams.figures.block_diagram import block_diagram_svg

        quiet_drake()
        chosen = load_named(scenario, overrides, None)
        path = out or Path(f"{chosen.name}.svg")
        picture = block_diagram_svg(build_task(chosen).diagram, chosen.name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(picture, encoding="utf-8")
    typer.echo(path)
