"""The command `footfall`."""

import logging
import math
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

# What simulates takes seconds to import; every command imports what it needs, so that
# the help text comes at once.
if TYPE_CHECKING:
    from pydrake.geometry import Meshcat
    from rich.console import Console

    from diagrams.scenario import Scenario
    from diagrams.summary import Summary
    from systems.ports import Vector

RUNS_FOLDER = Path("runs")
"""Where runs go by default."""
SLOPE = 15.0
"""Of the planes that `segment` keeps, deg; what `PlaneSegmenterParams` has."""
LOCAL_HOST = "127.0.0.1"
"""Where `--meshcat` listens by default: nobody else's machine reaches it."""
DONE, NOT_DONE, BAD_INPUT = 0, 1, 2
"""Exit status: the task was done, it was not, it could not be understood."""


class OptionError(ValueError):
    """An option cannot be understood; the message is one line that names it."""


app = typer.Typer(
    name="footfall",
    help="Humanoids that see stairs, obstacles and clutter, and walk them, simulated "
    "closed loop with Drake.",
    epilog="Exit status: 0 the task was done; 1 it was not (fell, infeasible, timed "
    "out); 2 bad input.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

ScenarioArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENARIO", help="Name of a shipped scenario, or a YAML file."
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


@app.command("list")
def list_command() -> None:
    """List the shipped scenarios, a line each."""
    from diagrams.shipped import list_scenarios

    scenarios = list_scenarios()
    width = max(len(name) for name, _ in scenarios)
    for name, description in scenarios:
        typer.echo(f"{name:<{width}}  {description}")


@app.command()
def run(
    scenario: ScenarioArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write, new or empty; by default "
            f"{RUNS_FOLDER}/SCENARIO-seedN, numbered if that exists.",
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

    Ctrl-C ends a run early; what it has logged is kept.
    """
    with _bad_input_in_one_line():
        chosen = _load(scenario, overrides, seed)
        folder = _free_folder(chosen, out)
        summary = _simulate(chosen, folder, meshcat_host if meshcat else None)
    from diagrams.summary_table import print_summary

    print_summary(summary, folder)
    raise typer.Exit(DONE if summary.outcome == "completed" else NOT_DONE)


@app.command()
def segment(
    cloud: Annotated[
        Path,
        typer.Argument(
            metavar="CLOUD", help="Point cloud: .pcd, .ply, .xyz, .txt or .npz."
        ),
    ],
    gravity: Annotated[
        str,
        typer.Option(
            metavar="X,Y,Z", help="Direction of gravity in the cloud's frame."
        ),
    ] = "0,0,-1",
    slope: Annotated[
        float,
        typer.Option(
            metavar="DEG",
            help="Steepest plane that is kept, in degrees from the horizontal.",
        ),
    ] = SLOPE,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write planes.json and planes.png to; by default "
            "segmented/CLOUD.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Find planes and stairs in a point cloud: JSON, a picture, times."""
    with _bad_input_in_one_line():
        from diagrams.segmenting import segment_file
        from systems.perception.segmenter_params import PlaneSegmenterParams

        direction = _parse_direction(gravity)
        params = PlaneSegmenterParams(slope_tolerance=_parse_slope(slope))
        target = out or Path("segmented") / cloud.stem
        result = segment_file(cloud, direction, target, params)
    found = result.segmentation
    typer.echo(
        f"{result.points} points: {len(found.planes)} planes, "
        f"{len(found.staircase.treads)} treads"
    )
    for stage, milliseconds in found.times_ms:
        typer.echo(f"  {stage:<16} {milliseconds:8.1f} ms")
    typer.echo(f"{result.planes_json}\n{result.planes_png}")


@app.command()
def plot(run_folder: RunArgument) -> None:
    """Draw the figures of a run into its folder `figures`."""
    with _bad_input_in_one_line():
        from diagrams.report import plot_run

        for path in plot_run(run_folder):
            typer.echo(path)


@app.command()
def replay(run_folder: RunArgument) -> None:
    """Write a run as a page that opens without a server."""
    with _bad_input_in_one_line():
        from diagrams.replay import replay_run

        _quiet_drake()
        typer.echo(replay_run(run_folder))


@app.command()
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
) -> None:
    """Render a run as a film strip, headless, into its folder `figures`."""
    with _bad_input_in_one_line():
        from diagrams.film_strip import render_run

        _quiet_drake()
        typer.echo(render_run(run_folder, frames, start, end))


@app.command()
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
    with _bad_input_in_one_line():
        from diagrams.block_diagram import block_diagram_svg
        from diagrams.tasks import build_task

        _quiet_drake()
        chosen = _load(scenario, overrides, None)
        path = out or Path(f"{chosen.name}.svg")
        picture = block_diagram_svg(build_task(chosen).diagram, chosen.name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(picture, encoding="utf-8")
    typer.echo(path)


def main() -> None:
    """Runs the command line."""
    logging.basicConfig(format="%(name)s: %(message)s")
    # It too warns of a cache that cannot be written, and makes do without.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    app()


def _load(name: str, overrides: list[str] | None, seed: int | None) -> "Scenario":
    from diagrams.scenario import load_scenario

    changes = list(overrides or [])
    if seed is not None:
        changes.append(f"simulation.seed={seed}")
    return load_scenario(name, changes)


def _free_folder(scenario: "Scenario", out: Path | None) -> Path:
    """The folder that was asked for, or the first that is free of the default ones."""
    if out is not None:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise OptionError(f"--out {out}: exists and is not an empty folder")
        _require_writable(out)
        return out
    name = f"{scenario.name}-seed{scenario.simulation.seed}"
    folder, number = RUNS_FOLDER / name, 1
    while folder.exists():
        number += 1
        folder = RUNS_FOLDER / f"{name}-{number}"
    return folder


def _require_writable(out: Path) -> None:
    """Tells before a run of minutes, rather than after it, that it cannot be kept."""
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=out.parent):
            pass
    except OSError as error:
        raise OptionError(
            f"--out {out}: cannot be written: {error.strerror}"
        ) from error


def _simulate(scenario: "Scenario", folder: Path, host: str | None) -> "Summary":
    """Runs a scenario; Meshcat shows it at the address, or not at all for None."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from diagrams.illustrations import illustrate
    from diagrams.simulation import run_task
    from diagrams.tasks import build_task

    # While it imported there was nothing to keep; from here on Ctrl-C is an exception.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    console = Console(stderr=True)
    with _status(console, "building the diagram"):
        _quiet_drake()
        meshcat = None if host is None else _start_meshcat(host)
        task = build_task(scenario, meshcat)
    if meshcat is not None:
        console.print(f"watch at {meshcat.web_url()}")
    limit = scenario.simulation.max_time
    with Progress(
        TextColumn("{task.fields[activity]:<6}"),
        BarColumn(),
        TextColumn("{task.completed:6.1f} s of at most {task.total:g} s, took"),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    ) as bar:
        job = bar.add_task("", total=limit, activity="")
        summary = run_task(
            task,
            scenario,
            folder,
            progress=lambda time, activity: bar.update(
                job, completed=time, activity=activity
            ),
            realtime_rate=0.0 if meshcat is None else 1.0,
        )
    with _status(console, "drawing figures, replay and block diagram"):
        for complaint in illustrate(folder, task.diagram):
            console.print(f"footfall: {complaint}", style="yellow", highlight=False)
    return summary


def _start_meshcat(host: str) -> "Meshcat":
    from diagrams.live_view import meshcat_at

    try:
        return meshcat_at(host)
    except RuntimeError as error:
        raise OptionError(f"--meshcat-host {host}: {error}") from error


def _status(console: "Console", doing: str) -> AbstractContextManager[object]:
    """Where there is no terminal a spinner would only fill the log with blank lines."""
    return console.status(doing) if console.is_terminal else nullcontext()


def _parse_direction(text: str) -> "Vector":
    import numpy as np

    try:
        numbers = np.array([float(part) for part in text.split(",")])
    except ValueError:
        numbers = np.zeros(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all() or not numbers.any():
        raise OptionError(
            f"--gravity: must be three numbers X,Y,Z, not all zero, got {text!r}"
        )
    return numbers


def _parse_slope(degrees: float) -> float:
    """In rad."""
    if not 0.0 < degrees < 90.0:
        raise OptionError(
            f"--slope: must lie between 0 and 90 degrees, got {degrees:g}"
        )
    return math.radians(degrees)


def _quiet_drake() -> None:
    """Drake tells of every port that Meshcat opens; a person did not ask."""
    logging.getLogger("drake").setLevel(logging.ERROR)


@contextmanager
def _bad_input_in_one_line() -> Iterator[None]:
    """What the user can mend ends in one line on stderr and exit status 2."""
    try:
        yield
    except Exception as error:
        if not isinstance(error, _bad_input_errors()):
            raise
        line = " ".join(_message(error).split())
        typer.echo(f"footfall: {line}", err=True)
        raise typer.Exit(BAD_INPUT) from None


def _message(error: Exception) -> str:
    """What the system says of a file comes with its name first, as ours does."""
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{error.filename}: {error.strerror}"
    return getattr(error, "strerror", None) or str(error)


def _bad_input_errors() -> tuple[type[Exception], ...]:
    """Those of what was imported; what was not has raised nothing."""
    homes = (
        ("diagrams.scenario", "ScenarioError"),
        ("diagrams.signals", "RunError"),
        ("systems.perception.cloud_files", "CloudFileError"),
        ("systems.perception.environment_xml", "EnvironmentFileError"),
    )
    own = [
        getattr(sys.modules[home], name) for home, name in homes if home in sys.modules
    ]
    return OptionError, OSError, *own
