"""What `footfall run` does: simulates, writes the folder, prints, and draws at last."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path

from pydrake.geometry import Meshcat
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.figures.illustrations import illustrate
from footfall.diagrams.interruption import StopSignals
from footfall.diagrams.judge.summary import Summary
from footfall.diagrams.judge.summary_table import print_summary
from footfall.diagrams.run_folder import make_numbered, require_usable, run_name
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.simulation import run_task

RUNS_FOLDER = Path("runs")
"""Where runs go by default."""
TOLD_EVERY = 10.0
"""How often progress is told where there is no terminal, s of simulated time."""


def run_scenario(
    scenario: Scenario,
    changes: Sequence[str],
    out: Path | None,
    build: Callable[[Scenario, Meshcat | None], TaskDiagram],
    stop: StopSignals,
    start_meshcat: Callable[[], Meshcat] | None = None,
    draw: bool = True,
    show: Callable[[Summary, Path], None] = print_summary,
    quiet: bool = False,
    parent: Path = RUNS_FOLDER,
) -> Summary:
    """Simulates a scenario, writes its folder, prints its summary, draws its pictures.

    What a signal ends is judged and printed like any other run, and not drawn.

    Args:
        scenario: what is run.
        changes: "key=value" each, by which it differs from what its name says.
        out: where the run goes, new or empty; None for a numbered folder below
            `parent` that tells scenario, seed and changes.
        build: makes the closed loop of a scenario.
        stop: notes the signals that come while the run is judged.
        start_meshcat: gives what shows it live; None where nothing does.
        draw: whether its pictures are drawn.
        show: prints what became of it, and where it was written.
        quiet: whether progress is kept to itself; what could not be drawn is told.
        parent: where the folders of runs without `out` lie.

    Raises:
        OutError: `out` cannot be used.
        OSError: the folder cannot be made.
        RecordingError: it cannot be written to any more.
        KeyboardInterrupt: a signal came; its message says what is left to draw.
    """
    if out is not None:
        require_usable(out)
    console = Console(stderr=True, quiet=quiet)
    with _status(console, "building the diagram"):
        meshcat = start_meshcat() if start_meshcat else None
        task = build(scenario, meshcat)
    if meshcat is not None:
        console.print(f"watch at {meshcat.web_url()}")
    folder = out or make_numbered(
        parent, run_name(scenario.name, scenario.simulation.seed, changes)
    )
    limit = scenario.simulation.max_time
    with _progress(console, limit) as progress:
        rate = 1.0 if meshcat else 0.0
        summary = run_task(task, scenario, folder, progress, rate, stop.held)
    with stop.held():
        show(summary, folder)
    try:
        if summary.outcome == "interrupted" or stop.received is not None:
            raise KeyboardInterrupt
        if not draw:
            return summary
        with _status(console, "drawing replay, block diagram and figures"):
            complaints = illustrate(folder, task.diagram)
        for complaint in complaints:
            Console(stderr=True).print(
                f"footfall: {complaint}", style="yellow", highlight=False
            )
    except KeyboardInterrupt:
        rest = f"interrupted; `footfall plot {folder}` draws what is missing"
        raise KeyboardInterrupt(rest) from None
    return summary


@contextmanager
def _progress(console: Console, limit: float) -> Iterator[Callable[[float, str], None]]:
    """Shows the time and activity it is told as a bar, or as a line now and then."""
    if not console.is_terminal:
        told = 0.0

        def tell(time: float, activity: str) -> None:
            nonlocal told
            if time > told + TOLD_EVERY - 1e-9:
                told += TOLD_EVERY
                doing = f": {activity}" if activity else ""
                line = f"{time:.4g} s of at most {limit:g} s{doing}"
                console.print(line, highlight=False, markup=False, soft_wrap=True)

        yield tell
        return
    with Progress(
        TextColumn("{task.fields[activity]:<6}"),
        BarColumn(),
        TextColumn("{task.completed:6.1f} s of at most {task.total:g} s, took"),
        TimeElapsedColumn(),
        console=console,
        transient=True,
    ) as bar:
        job = bar.add_task("", total=limit, activity="")
        yield lambda time, activity: bar.update(job, completed=time, activity=activity)


def _status(console: Console, doing: str) -> AbstractContextManager[object]:
    """Shows what is being done; no spinner fills a log with blank lines."""
    return console.status(doing) if console.is_terminal else nullcontext()
