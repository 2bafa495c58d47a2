"""What `footfall sweep` does: checks, runs, tabulates and draws; and reads it back."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pandas as pd

from footfall.diagrams.scenario import ScenarioError, load_scenario
from footfall.diagrams.sweep.definition import Sweep, SweepError, load_sweep_file
from footfall.diagrams.sweep.figures import draw_sweep
from footfall.diagrams.sweep.runner import JobEnd, run_sweep
from footfall.diagrams.sweep.sampling import jobs_of
from footfall.diagrams.sweep.table import (
    COST_FILE,
    REPORT_FILE,
    TABLE_FILE,
    Rate,
    rate_of,
    write_tables,
)

SWEEPS_FOLDER = Path("sweeps")
"""Where sweeps go by default."""


def sweep_scenario(
    file: Path, out: Path | None, jobs: int, tell: Callable[[str], None]
) -> tuple[Path, Rate, int]:
    """Carries a sweep out, or goes on with it, and writes its table and figures.

    Args:
        file: its definition.
        out: where it goes; None for `SWEEPS_FOLDER` and the file's name.
        jobs: how many runs go on at a time.
        tell: is told a line for every run that ends.

    Returns:
        Its folder, how often it succeeded, and how many runs have no result.

    Raises:
        SweepError: the definition cannot be used, or the folder holds another.
        OSError: the folder cannot be written to.
    """
    sweep = load_sweep_file(file)
    check_samples(sweep, file)
    folder = out or SWEEPS_FOLDER / sweep.name

    def progress(ended: JobEnd, done: int, of: int) -> None:
        what = ended.reason if ended.end == "done" else f"{ended.end}, {ended.reason}"
        tell(f"{done}/{of}  run {ended.job.number}  {what}")

    ends = run_sweep(sweep, folder, jobs, progress)
    table = write_tables(sweep, folder)
    draw_sweep(sweep, table, folder)
    missing = sum(ended.end != "done" for ended in ends)
    return folder, rate_of(table), missing


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


@dataclass(frozen=True)
class SweepFolder:
    """A sweep's folder, read back."""

    folder: Path

    @cached_property
    def table(self) -> pd.DataFrame:
        """A row a run: varied fields, seed, outcome, figures, the command again."""
        return pd.read_parquet(self.folder / TABLE_FILE)

    @cached_property
    def costs(self) -> pd.DataFrame:
        """What each run took: wall and processor time, s, and memory, MB."""
        return pd.read_parquet(self.folder / COST_FILE)

    @property
    def report(self) -> str:
        """The report, Markdown."""
        return (self.folder / REPORT_FILE).read_text(encoding="utf-8")


def load_sweep(folder: Path | str) -> SweepFolder:
    """Gives a sweep back: `.table`, `.costs`, `.report`.

    Raises:
        SweepError: the folder holds no sweep that has come to a table.
    """
    path = Path(folder)
    if not (path / TABLE_FILE).is_file():
        raise SweepError(f"{path}: not a sweep's folder, it has no {TABLE_FILE}")
    return SweepFolder(path)
