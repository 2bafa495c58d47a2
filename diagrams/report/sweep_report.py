"""A sweep as one page: how often it succeeded, figures, and what did not succeed."""

import shlex
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from footfall.diagrams.figures.captions import (
    OUTCOMES_CAPTION,
    SUCCESS_CAPTION,
    Caption,
)
from footfall.diagrams.report.page import PAGE_FILE, Picture, data_uri, render_page
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.sweep.definition import Sweep
from footfall.diagrams.sweep.figures import SweepFigure, draw_sweep
from footfall.diagrams.sweep.sweep_folder import load_sweep
from footfall.diagrams.sweep.table import (
    NO_RESULT,
    SUCCESS,
    Rate,
    rate_of,
    rates_by_field,
    varied_columns,
)


@dataclass(frozen=True)
class RateRow:
    """How often a group of runs succeeded, as the page shows it."""

    group: str
    rate: str
    """In words; "no result yet" where no run of it has one."""
    low: float
    high: float
    share: float
    """Interval and rate, in per cent; 0 each without a result."""


@dataclass(frozen=True)
class Failure:
    """A run that did not succeed."""

    run: int
    outcome: str
    reason: str
    command: str


def report_sweep(folder: Path) -> Path:
    """Writes a sweep as one page that needs nothing beside it, `report.html`.

    Args:
        folder: of a sweep that has come to a table.

    Raises:
        SweepError: the folder holds no such sweep, or it is damaged.
        OSError: the page cannot be written.
    """
    found = load_sweep(folder)
    sweep, table = found.sweep, found.table
    columns = ["run", *varied_columns(sweep), "seed", "outcome"]
    html = render_page(
        "sweep.html.j2",
        title=sweep.name,
        scenario=Path(sweep.scenario).name,
        changes=sweep.changes,
        sentence=sweep_sentence(sweep, table),
        overall=rate_row("all runs", rate_of(table)),
        groups=[
            (field, [rate_row(group, rate) for group, rate in rates])
            for field, rates in rates_by_field(sweep, table)
        ],
        pictures=[_picture(one) for one in draw_sweep(sweep, table, folder)],
        failures=failures(table),
        columns=columns,
        rows=table[columns].astype(object).to_numpy().tolist(),
        command=shlex.join(
            ["footfall", "sweep", f"{sweep.name}.yaml", "--out", str(folder)]
        ),
        cost=_cost(found.costs),
    )
    path = folder / PAGE_FILE
    with whole_file(path) as partial:
        partial.write_text(html, encoding="utf-8")
    return path


def sweep_sentence(sweep: Sweep, table: pd.DataFrame) -> str:
    """Says in two sentences what was varied, and how often it went well."""
    rate, missing = rate_of(table), int((table["outcome"] == NO_RESULT).sum())
    varied = " and ".join(varied_columns(sweep)) or "seeds alone"
    seeds = "1 seed" if len(sweep.seeds) == 1 else f"{len(sweep.seeds)} seeds"
    said = f"{len(table)} runs over {varied}, {seeds} each."
    if rate.runs:
        low, high = (100.0 * end for end in rate.interval())
        said += (
            f" {rate.successes} of {rate.runs} succeeded: {100.0 * rate.share:.0f} %"
        )
        said += f", with a 95 % interval from {low:.0f} to {high:.0f} %."
    return f"{said} {missing} have no result." if missing else said


def rate_row(group: str, rate: Rate) -> RateRow:
    """Shows a rate with its interval; without a result it says so."""
    if not rate.runs:
        return RateRow(group, "no result yet", 0.0, 0.0, 0.0)
    low, high = rate.interval()
    return RateRow(group, str(rate), 100.0 * low, 100.0 * high, 100.0 * rate.share)


def failures(table: pd.DataFrame) -> list[Failure]:
    """Lists the runs that did not succeed, each with the command that repeats it."""
    failed = table[table["outcome"] != SUCCESS]
    shown = failed[["run", "outcome", "reason", "command"]]
    return [Failure(*row) for row in shown.itertuples(index=False)]


def _cost(costs: pd.DataFrame) -> str | None:
    """Says what a run took; None where none has a result."""
    if costs.empty:
        return None
    wall, memory = costs["wall_s"].median(), costs["memory_mb"].max()
    return f"A run took {wall:.0f} s (median) and at most {memory:.0f} MB."


def _picture(figure: SweepFigure) -> Picture:
    caption = SUCCESS_CAPTION if len(figure.fields) == 1 else OUTCOMES_CAPTION
    title = caption.title.format(" and ".join(figure.fields))
    uri = data_uri(figure.path)
    return Picture(figure.path.stem, uri, Caption(title, caption.text))
