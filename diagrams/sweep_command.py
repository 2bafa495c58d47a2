"""What `footfall sweep` does: checks, runs, tabulates and draws."""

from collections.abc import Callable
from pathlib import Path
from time import perf_counter

from footfall.diagrams.scenario import ScenarioError, load_scenario
from footfall.diagrams.sweep.definition import Sweep, SweepError, load_sweep_file
from footfall.diagrams.sweep.figures import draw_sweep
from footfall.diagrams.sweep.pools import Pool
from footfall.diagrams.sweep.runner import JobEnd, run_sweep
from footfall.diagrams.sweep.sampling import jobs_of
from footfall.diagrams.sweep.table import Rate, rate_of, write_tables

SWEEPS_FOLDER = Path("sweeps")
"""Where sweeps go by default."""


def sweep_scenario(
    file: Path, out: Path | None, pool: Pool, tell: Callable[[str], None]
) -> tuple[Path, Rate, int]:
    """Carries a sweep out, or goes on with it, and writes its table and figures.

    Args:
        file: its definition.
        out: where it goes; None for `SWEEPS_FOLDER` and the file's name.
        pool: where the runs go on, and how many at a time.
        tell: is told a line for every run that ends.

    Returns:
        Its folder, how often it succeeded, and how many runs have no result.

    Raises:
        SweepError: the definition cannot be used, the folder holds another, or the
            pool is not to be had.
        OSError: the folder cannot be written to.
    """
    sweep = load_sweep_file(file)
    check_samples(sweep, file)
    folder = out or SWEEPS_FOLDER / sweep.name

    begun, tried = perf_counter(), 0

    def progress(ended: JobEnd, done: int, of: int) -> None:
        nonlocal tried
        tried += 1
        what = ended.reason if ended.end == "done" else f"{ended.end}, {ended.reason}"
        left = time_left(perf_counter() - begun, tried, of - done)
        tell(f"{done}/{of}  run {ended.job.number}  {what}{left}")

    ends = run_sweep(sweep, folder, pool, progress)
    table = write_tables(sweep, folder)
    draw_sweep(sweep, table, folder)
    missing = sum(ended.end != "done" for ended in ends)
    return folder, rate_of(table), missing


def time_left(passed: float, ended: int, left: int) -> str:
    """Says how long the runs that are left will take, if they go as those before.

    Args:
        passed: since the first began, s.
        ended: how many have ended since.
        left: how many have not.

    Returns:
        Something to put after a line; nothing where nothing is left.
    """
    if not left:
        return ""
    minutes = passed / ended * left / 60.0
    return f"; about {minutes:.0f} min left" if minutes > 1.0 else "; a minute left"


def check_samples(sweep: Sweep, file: Path) -> None:
    """Loads the scenario of every run, so that none is refused after an hour.

    Raises:
        SweepError: one is refused, and why.
    """
    for job in jobs_of(sweep):
        try:
            load_scenario(sweep.scenario, job.changes(sweep))
        except ScenarioError as error:
            raise SweepError(f"{file}: run {job.number}: {error}") from None
