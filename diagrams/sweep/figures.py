"""The figures of a sweep: success over one field, outcomes over two."""

from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import BLACK, OUTCOMES
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.sweep.definition import Sweep
from footfall.diagrams.sweep.table import NO_RESULT, groups_of, rate_of

FIGURES_FOLDER = "figures"
MOST_PAIRS = 3
"""So many pairs of fields are drawn."""


@dataclass(frozen=True)
class SweepFigure:
    """A figure of a sweep."""

    path: Path
    fields: tuple[str, ...]
    """Over one field success is drawn, over two outcomes."""


def draw_sweep(sweep: Sweep, table: pd.DataFrame, folder: Path) -> list[SweepFigure]:
    """Draws success over every field and outcomes over pairs of fields.

    Args:
        sweep: what was run.
        table: its table.
        folder: of the sweep; the pictures go into `figures`.

    Returns:
        What was drawn.
    """
    (folder / FIGURES_FOLDER).mkdir(exist_ok=True)
    names = [name for name, _ in sweep.fields if table[name].nunique() > 1]
    numbers = [n for n in names if pd.api.types.is_numeric_dtype(table[n])]
    drawn = []
    for name in names:
        figure = Figure(figsize=(6.0, 3.6), layout="constrained")
        _success(figure.subplots(), table, name)
        path = _save(figure, folder, f"success-{name}")
        drawn.append(SweepFigure(path, (name,)))
    for x, y in list(combinations(numbers, 2))[:MOST_PAIRS]:
        figure = Figure(figsize=(6.0, 4.5), layout="constrained")
        _outcomes(figure.subplots(), table, x, y)
        path = _save(figure, folder, f"outcomes-{x}-{y}")
        drawn.append(SweepFigure(path, (x, y)))
    return drawn


def _success(ax: Axes, table: pd.DataFrame, name: str) -> None:
    """Draws the success rate of every group with its interval."""
    groups = groups_of(table, name)
    labels = list(dict.fromkeys(groups[table[name].argsort(kind="stable")]))
    rates = [rate_of(table[groups == label]) for label in labels]
    for place, rate in enumerate(rates):
        if rate.runs:
            low, high = rate.interval()
            ax.plot(
                [place, place],
                [100.0 * low, 100.0 * high],
                color=OUTCOMES["completed"],
                lw=2,
            )
            ax.plot(place, 100.0 * rate.share, "o", color=OUTCOMES["completed"], ms=8)
            ax.annotate(f"{rate.successes}/{rate.runs}", (place, 105.0), ha="center")
    ax.set_xticks(np.arange(len(labels)), labels)
    ax.set(xlabel=name, ylabel="success [%]", ylim=(-3.0, 114.0))
    ax.set_yticks(np.arange(0.0, 101.0, 20.0))
    ax.set_xlim(-0.5, len(labels) - 0.5)
    ax.grid(axis="y", alpha=0.3)


def _outcomes(ax: Axes, table: pd.DataFrame, x: str, y: str) -> None:
    """Draws every run where it lies, by its outcome."""
    for outcome, runs in table.groupby("outcome", sort=True):
        color = OUTCOMES.get(str(outcome), BLACK)
        face = "none" if outcome == NO_RESULT else color
        ax.scatter(
            runs[x], runs[y], s=45, facecolors=face, edgecolors=color, label=outcome
        )
    ax.set(xlabel=x, ylabel=y)
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)


def _save(figure: Figure, folder: Path, name: str) -> Path:
    path = folder / FIGURES_FOLDER / f"{name.replace('/', '_')}.png"
    with whole_file(path) as partial, mpl.rc_context({"savefig.dpi": 130}):
        figure.savefig(partial, format="png")
    return path
