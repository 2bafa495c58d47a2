"""`footfall render`: a run as a film strip or as a video."""

from pathlib import Path
from typing import Annotated

import typer

from footfall.diagrams.cli.arguments import RunArgument, quiet_drake
from footfall.diagrams.cli.errors import OptionError, bad_input_in_one_line

TOLD_EVERY = 100
"""How often progress is told, frames."""


def render(
    run_folder: RunArgument,
    frames: Annotated[
        int, typer.Option(metavar="N", min=1, help="How many pictures.")
    ] = 12,
    start: Annotated[
        float | None,
        typer.Option(
            "--from",
            metavar="S",
            help="When the first is taken; by default when the robot first moves, or a "
            "step before it crosses something.",
            show_default=False,
        ),
    ] = None,
    end: Annotated[
        float | None,
        typer.Option(
            "--to",
            metavar="S",
            help="When the last is taken; by default when the robot last moves, or a "
            "step after it has crossed.",
            show_default=False,
        ),
    ] = None,
    video: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write a video in its place, an .mp4 file that plays as fast as the "
            "robot moved. Takes about twice as long as it plays.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Render a run as a film strip into its folder `figures`, or as a video, headless.

    A video needs imageio-ffmpeg, which brings an ffmpeg of its own: `pip install
    'footfall[video]'`.
    """
    with bad_input_in_one_line():
        quiet_drake()
        if video is None:
            from footfall.diagrams.figures.film_strip import render_run

            typer.echo(render_run(run_folder, frames, start, end))
        else:
            typer.echo(_render_video(run_folder, video, start, end))


def _render_video(
    run_folder: Path, file: Path, start: float | None, end: float | None
) -> Path:
    if file.suffix.lower() != ".mp4":
        raise OptionError(f"--video {file}: must end with .mp4")
    try:
        from footfall.diagrams.figures.video import render_video
    except ModuleNotFoundError as error:
        if error.name != "imageio_ffmpeg":
            raise
        needs = "needs imageio-ffmpeg: pip install 'footfall[video]'"
        raise OptionError(f"--video {file}: {needs}") from None

    def tell(done: int, of: int) -> None:
        if done % TOLD_EVERY == 0:
            typer.echo(f"{done} of {of} frames", err=True)

    return render_video(run_folder, file, start, end, tell)
