"""The command `footfall`."""

import logging
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from footfall.diagrams.cli_errors import (
    BAD_INPUT,
    NOT_DONE,
    OptionError,
    bad_input_in_one_line,
    run_ends_in_one_line,
)
from footfall.diagrams.cli_options import (
    parse_direction,
    parse_slope,
    parse_viewpoint,
)
from footfall.diagrams.interruption import StopSignals

# What simulates takes seconds to import; every command imports what it needs, so that
# the help text comes at once.
if TYPE_CHECKING:
    from pydrake.geometry import Meshcat

    from footfall.diagrams.scenario import Scenario

SLOPE = 15.0
"""Of the planes that `segment` keeps, deg; what `PlaneSegmenterParams` has."""
LOCAL_HOST = "127.0.0.1"
"""Where `--meshcat` listens by default: nobody else's machine reaches it."""
DONE = 0
"""Exit status: the task was done."""

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
    from footfall.diagrams.shipped import list_scenarios

    scenarios = list_scenarios()
    width = max(len(name) for name, _ in scenarios)
    for name, description in scenarios:
        typer.echo(f"{name:<{width}}  {description}")


@app.command("fields")
def fields_command(
    key: Annotated[
        str,
        typer.Argument(
            metavar="KEY",
            help="A field or a group, e.g. parameters.stabilizer; all by default.",
            show_default=False,
        ),
    ] = "",
    task: Annotated[
        str,
        typer.Option(
            metavar="KIND",
            help="Leave out what never acts in this task.kind, e.g. stair_climbing.",
            show_default=False,
        ),
    ] = "",
    schema: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write a JSON schema of scenario files instead, from which editors "
            "complete.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Print the fields of a scenario: default, unit, bounds, meaning.

    Of an interval ( and ) exclude the bound; what is null is absent unless given.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.fields_command import fields_text, write_schema

        if schema is not None and (key or task):
            raise OptionError("--schema: holds all fields, give neither KEY nor --task")
        text = fields_text(key, task) if schema is None else str(schema)
        if schema is not None:
            write_schema(schema)
    typer.echo(text)


@app.command()
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

        _quiet_drake()
        changes = list(overrides or [])
        chosen = _load(scenario, changes, seed)
        show = partial(_start_meshcat, meshcat_host) if meshcat else None
        with StopSignals() as stop, run_ends_in_one_line(stop):
            summary = run_scenario(chosen, changes, out, build_task, stop, show, draw)
    raise typer.Exit(DONE if summary.outcome == "completed" else NOT_DONE)


@app.command("sweep")
def sweep_command(
    sweep: Annotated[
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
) -> None:
    """Run a scenario many times; write a table, a report and figures.

    Each run is a process of its own. A sweep that was cut, by Ctrl-C or by a power
    failure, goes on where it was when it is called again.

    For example, six staircases, both seeds of each:

        scenario: stairs-exp1

        fields:

          scene.staircase.rise: {from: 0.12, to: 0.20, levels: 3}

          scene.staircase.steps: [2, 4]

        seeds: 2
    """
    with bad_input_in_one_line():
        import os

        from footfall.diagrams.sweep_command import sweep_scenario

        count = jobs or os.cpu_count() or 1
        with StopSignals() as stop:
            try:
                folder, rate, missing = sweep_scenario(sweep, out, count, typer.echo)
            except KeyboardInterrupt:
                line = "footfall: interrupted; the same command goes on where it was"
                typer.echo(line, err=True)
                raise typer.Exit(stop.exit_status()) from None
    typer.echo(f"success: {rate}" if rate.runs else "success: no run has a result")
    if missing:
        typer.echo(f"without a result: {missing}; the same command tries them again")
    typer.echo(f"written to {folder}")
    raise typer.Exit(NOT_DONE if missing else DONE)


@app.command("check-robot")
def check_robot_command(
    robot: Annotated[
        str,
        typer.Argument(
            metavar="FILE", help="A robot's YAML file, or the name of a shipped robot."
        ),
    ],
) -> None:
    """Check a robot of one's own: what is missing, what was derived, does it stand?

    Everything in the file that does not fit the URDF is told, a line each. A robot
    that fits is simulated: it stands for two seconds on contact.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.robot_report import check_robot
        from footfall.models.robots.robot_errors import RobotError

        _quiet_drake()
        try:
            report = check_robot(robot)
        except RobotError as error:
            for line in str(error).splitlines():
                typer.echo(f"footfall: {line}", err=True)
            raise typer.Exit(BAD_INPUT) from None
    for line in report.lines():
        typer.echo(line)
    raise typer.Exit(DONE if report.stands else NOT_DONE)


@app.command()
def segment(
    cloud: Annotated[
        Path,
        typer.Argument(
            metavar="CLOUD",
            help="Point cloud in metres: .pcd, .ply, .xyz, .txt, .csv, .npy or .npz.",
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
    viewpoint: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,Z",
            help="Where the cloud was seen from, in its frame: edges are found between "
            "rays, and what is above it is no plane to step on.",
            show_default=False,
        ),
    ] = None,
    published: Annotated[
        bool,
        typer.Option(
            "--published",
            help="Find them as the stair paper does: normals, voxels, supervoxels, "
            "RANSAC over all, the largest cluster of one size.",
        ),
    ] = False,
    robot: Annotated[
        str | None,
        typer.Option(
            metavar="FILE",
            help="A robot's YAML file: what is smaller than its sole is no plane to "
            "stand on; by default JVRC-1's.",
            show_default=False,
        ),
    ] = None,
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
    with bad_input_in_one_line():
        from footfall.diagrams.segmenting import segment_file
        from footfall.systems.perception.planes.segmenter_params import (
            PlaneSegmenterParams,
        )

        direction = parse_direction(gravity)
        params = PlaneSegmenterParams(slope_tolerance=parse_slope(slope))
        if published:
            params = params.published()
        eye = None if viewpoint is None else parse_viewpoint(viewpoint)
        target = out or Path("segmented") / cloud.stem
        sole = None
        if robot is not None:
            from footfall.diagrams.robots.robot_files import load_robot

            sole = load_robot(robot).sole
        result = segment_file(cloud, direction, target, params, sole, eye)
    found = result.segmentation
    typer.echo(
        f"{result.points} points: {len(found.planes)} planes, "
        f"{len(found.staircase.treads)} treads"
    )
    for doubt in result.doubts:
        typer.echo(f"  {doubt}")
    for stage, milliseconds in found.times_ms:
        typer.echo(f"  {stage:<16} {milliseconds:8.1f} ms")
    typer.echo(f"{result.planes_json}\n{result.planes_png}")


@app.command()
def plot(run_folder: RunArgument) -> None:
    """Draw the figures of a run into its folder `figures`."""
    with bad_input_in_one_line():
        from footfall.diagrams.figures.report import plot_run

        for path in plot_run(run_folder):
            typer.echo(path)


@app.command()
def estimate(
    run_folder: RunArgument,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder to write the estimate's signals to, new or empty.",
            show_default=False,
        ),
    ] = None,
    overrides: SetOption = None,
) -> None:
    """Estimate again, from a run's sensors alone, where the robot was.

    Prints the errors against the run's truth; with --set as other parameters of
    parameters.base_estimator or parameters.contact would have had them.
    """
    with bad_input_in_one_line():
        from footfall.diagrams.estimating import estimate_run, print_estimate
        from footfall.diagrams.run_folder import require_usable

        if out is not None:
            require_usable(out)
        frames, errors = estimate_run(run_folder, overrides or ())
        print_estimate(frames, errors, out)


@app.command()
def replay(run_folder: RunArgument) -> None:
    """Write a run as a page that opens without a server."""
    with bad_input_in_one_line():
        from footfall.diagrams.figures.replay import replay_run

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
    with bad_input_in_one_line():
        from footfall.diagrams.figures.film_strip import render_run

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
    with bad_input_in_one_line():
        from footfall.diagrams.closed_loop.tasks import build_task
        from footfall.diagrams.figures.block_diagram import block_diagram_svg

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
    from footfall.diagrams.scenario import load_scenario

    changes = list(overrides or [])
    if seed is not None:
        changes.append(f"simulation.seed={seed}")
    return load_scenario(name, changes)


def _start_meshcat(host: str) -> "Meshcat":
    from footfall.diagrams.figures.live_view import meshcat_at

    try:
        return meshcat_at(host)
    except RuntimeError as error:
        raise OptionError(f"--meshcat-host {host}: {error}") from error


def _quiet_drake() -> None:
    """Drake tells of every port that Meshcat opens; a person did not ask."""
    logging.getLogger("drake").setLevel(logging.ERROR)
