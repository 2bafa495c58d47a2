"""The table of a sweep: a row a run, success by group, and how to repeat a failure."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd
from scipy.stats import binomtest

from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.sweep.definition import CASE, Sweep
from footfall.diagrams.sweep.runner import command_of, read_result
from footfall.diagrams.sweep.sampling import jobs_of

TABLE_FILE, REPORT_FILE, COST_FILE = "table.parquet", "report.md", "cost.parquet"
NO_RESULT = "no result"
"""Outcome of a run whose worker died or hung, or that was not yet tried."""
SUCCESS = "completed"
COST = ("wall_s", "cpu_s", "memory_mb")
LEFT_OUT = ("wall_time_s", "real_time_factor", "scenario", "seed", "outcome", "reason")
"""Of a summary: what differs from one machine to another, and what has its column."""
BINS = 4
"""Into so many classes of equal width a drawn field is put to count success."""


@dataclass(frozen=True)
class Rate:
    """How often something succeeded."""

    successes: int
    runs: int

    @property
    def share(self) -> float:
        """Successes over runs."""
        return self.successes / self.runs

    def interval(self) -> tuple[float, float]:
        """Computes Wilson's interval of 95 % confidence (Wilson 1927)."""
        test = binomtest(self.successes, self.runs)
        interval = test.proportion_ci(confidence_level=0.95, method="wilson")
        return float(interval.low), float(interval.high)

    def __str__(self) -> str:
        """Says it in one line."""
        low, high = self.interval()
        return (
            f"{self.successes} of {self.runs}, {100 * self.share:.0f} % "
            f"({100 * low:.0f} to {100 * high:.0f} %)"
        )


def make_table(sweep: Sweep, folder: Path) -> pd.DataFrame:
    """Reads the results of a sweep into a table, a row a run in the sweep's order.

    Columns are `run`, `case` where there are cases, the varied fields by their paths,
    `seed`, `outcome`, `reason`, the figures of the summary that are numbers or texts,
    and `command`. What depends on the machine is in `make_costs`.
    """
    rows = []
    for job in jobs_of(sweep):
        result = read_result(sweep, job, folder)
        summary = result["summary"] if result else {}
        figures = {
            name: value
            for name, value in summary.items()
            if name not in LEFT_OUT and isinstance(value, int | float | str | None)
        }
        rows.append(
            {
                "run": job.number,
                **({CASE: job.case} if sweep.cases else {}),
                **dict(job.values),
                "seed": job.seed,
                "outcome": summary.get("outcome", NO_RESULT),
                "reason": summary.get("reason", ""),
                **figures,
                "command": command_of(sweep, job),
            }
        )
    table = pd.DataFrame(rows)
    last = table.pop("command")
    table["command"] = last
    return table


def make_costs(sweep: Sweep, folder: Path) -> pd.DataFrame:
    """Reads what each run took: wall and processor time, s, and memory, MB."""
    rows = []
    for job in jobs_of(sweep):
        if (result := read_result(sweep, job, folder)) is not None:
            rows.append({"run": job.number, **{name: result[name] for name in COST}})
    return pd.DataFrame(rows, columns=["run", *COST])


def groups_of(table: pd.DataFrame, field: str) -> pd.Series:
    """Groups the runs by a field: by its values, or by classes where many differ."""
    column = table[field]
    if column.nunique() <= 2 * BINS or not pd.api.types.is_numeric_dtype(column):
        return column.astype(str)
    return pd.cut(column, BINS).astype(str)


def rate_of(table: pd.DataFrame) -> Rate:
    """Counts the successes of the runs that have a result."""
    with_result = table[table["outcome"] != NO_RESULT]
    return Rate(int((with_result["outcome"] == SUCCESS).sum()), len(with_result))


def write_tables(sweep: Sweep, folder: Path) -> pd.DataFrame:
    """Writes table, costs and report into a sweep's folder.

    Returns:
        The table.

    Raises:
        OSError: the folder cannot be written to.
    """
    table, costs = make_table(sweep, folder), make_costs(sweep, folder)
    for name, frame in ((TABLE_FILE, table), (COST_FILE, costs)):
        with whole_file(folder / name) as path:
            _plain(frame).to_parquet(path, index=False)
    with whole_file(folder / REPORT_FILE) as path:
        path.write_text(report(sweep, table), encoding="utf-8")
    return table


def _plain(frame: pd.DataFrame) -> pd.DataFrame:
    """Makes columns of lists, or of mixed kinds, texts: Parquet wants one kind."""
    plain = frame.copy()
    for name in plain.select_dtypes("object"):
        column = plain[name]
        if column.map(type).nunique() > 1 or column.map(_is_list).any():
            plain[name] = column.map(_text)
    return plain


def _is_list(value: object) -> bool:
    return isinstance(value, list)


def _text(value: object) -> str | None:
    missing = value is None or (isinstance(value, float) and math.isnan(value))
    return None if missing else str(value)


def varied_columns(sweep: Sweep) -> list[str]:
    """Lists the columns in which the runs of a sweep differ, but for their seeds."""
    return [*([CASE] if sweep.cases else []), *(name for name, _ in sweep.fields)]


def rates_by_field(
    sweep: Sweep, table: pd.DataFrame
) -> list[tuple[str, list[tuple[str, Rate]]]]:
    """Counts success by the groups of each field that a sweep is grouped by.

    Returns:
        Field by field the label and the rate of every group; all varied fields where
        the sweep does not say which.
    """
    return [
        (
            field,
            [
                (str(group), rate_of(runs))
                for group, runs in table.groupby(groups_of(table, field), sort=False)
            ],
        )
        for field in sweep.group_by or varied_columns(sweep)
    ]


def report(sweep: Sweep, table: pd.DataFrame) -> str:
    """Writes the table as Markdown, success first."""
    rate = rate_of(table)
    same = ", ".join(f"`{change}`" for change in sweep.changes)
    missing = int((table["outcome"] == NO_RESULT).sum())
    lines = [
        f"# {sweep.name}",
        "",
        f"`{Path(sweep.scenario).name}`{f' with {same}' if same else ''}, {len(table)} "
        f"runs. A run succeeds when its outcome is `{SUCCESS}`: the task was finished, "
        "the robot came to rest where it ends, and no rule of the judge was broken. "
        "Intervals are Wilson's, of 95 % confidence.",
        "",
        f"Success: {rate if rate.runs else 'no run has a result yet'}.",
    ]
    if missing:
        again = "the same command tries them again"
        lines += ["", f"Without a result: {missing}; {again}."]
    for field, rates in rates_by_field(sweep, table):
        lines += ["", f"## By `{field}`", "", "| | success |", "|---|---|"]
        for group, group_rate in rates:
            text = str(group_rate) if group_rate.runs else "no result yet"
            lines.append(f"| {group} | {text} |")
    failures = table[table["outcome"] != SUCCESS]
    if len(failures):
        lines += ["", "## What did not succeed", ""]
        lines += ["| run | outcome | reason | repeat |", "|---|---|---|---|"]
        for _, row in failures.iterrows():
            reason = str(row["reason"]).replace("|", "/")
            lines.append(
                f"| {row['run']} | {row['outcome']} | {reason} | `{row['command']}` |"
            )
    shown = ["run", *varied_columns(sweep), "seed", "outcome", *sweep.show]
    lines += ["", "## Runs", "", "| " + " | ".join(shown) + " |"]
    lines.append("|" + "---|" * len(shown))
    # A figure that no run has yet has no column.
    runs = table.reindex(columns=shown).astype(object)
    lines += [table_row(cells) for cells in runs.itertuples(index=False)]
    return "\n".join(lines) + "\n"


def table_row(cells: Iterable[Any]) -> str:
    """Writes a row of a Markdown table: four digits of a number, nothing for null."""
    return "| " + " | ".join(_cell(cell) for cell in cells) + " |"


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.4g}"
    return "" if value is None else str(value).replace("|", "/")
