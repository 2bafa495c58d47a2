"""A summary as a table on the terminal."""

import json
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from footfall.diagrams.judge.summary import Summary
from footfall.models.values.value import Json


def print_summary(summary: Summary, folder: Path) -> None:
    """Prints how a run went, its figures in a row each, and where it was written.

    Long tables are left out: timings, versions and what was perceived.
    """
    data = summary.to_json()
    color = "green" if summary.outcome == "completed" else "red"
    console = Console(highlight=False)
    console.print(
        f"[bold {color}]{summary.outcome}[/]",
        escape(summary.reason),
        sep=": ",
        soft_wrap=True,
    )
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    skipped = {"outcome", "reason", "timing_us", "versions", "perception"}
    for name, value in data.items():
        if name in skipped or name.endswith("_joint"):
            continue
        stem = name.removesuffix("_fraction").removesuffix("_s")
        joint = data.get(f"{stem}_joint")
        note = f" ({joint})" if joint else ""
        for row, shown in summary_rows(name, value):
            table.add_row(row, shown + note)
    console.print(table)
    console.print(f"written to {folder}", markup=False, soft_wrap=True)


def print_line(summary: Summary, folder: Path) -> None:
    """Prints in one line how a run went, and where it was written."""
    said = f"{summary.scenario}: {summary.outcome}: {summary.reason}; {folder}"
    print(" ".join(said.split()))


def print_json(summary: Summary, folder: Path) -> None:
    """Prints a summary as JSON in one line, `folder` first."""
    data = {"folder": str(folder)} | summary.to_json()
    print(json.dumps(data, allow_nan=False))


def summary_rows(name: str, value: Json) -> list[tuple[str, str]]:
    """Lists a figure of the summary as rows of name and text, nested ones name by name.

    Args:
        name: of the figure.
        value: as plain JSON data.
    """
    if isinstance(value, dict):
        return [
            row
            for key, part in value.items()
            for row in summary_rows(f"{name}.{key}", part)
        ]
    if isinstance(value, list) and any(isinstance(part, dict) for part in value):
        only = len(value) == 1
        return [
            row
            for index, part in enumerate(value)
            for row in summary_rows(name if only else f"{name}[{index}]", part)
        ]
    return [(name, _shown(value))]


def _shown(value: Json) -> str:
    """Shows a figure to four digits."""
    if value is None:
        return "not measured"
    if isinstance(value, list):
        return ", ".join(_shown(part) for part in value) or "none"
    return f"{value:.4g}" if isinstance(value, float) else str(value)
