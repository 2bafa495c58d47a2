"""What the figures of a run share: titles, legends, support and true ZMP."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import ACTIVITIES
from footfall.diagrams.judge.evidence_measures import zmp_of_feet
from footfall.diagrams.judge.measures import LIFTED
from footfall.diagrams.run_data import RunData
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector


def new_figure(width: float, height: float) -> Figure:
    """Makes an empty figure, inches, that has room for its labels."""
    return Figure(figsize=(width, height), layout="constrained")


def set_title(figure: Figure, data: RunData, what: str) -> None:
    """Says above a figure which run it shows, how that ended, and what is shown."""
    summary = data.run.summary
    name, outcome = summary.get("scenario"), summary.get("outcome")
    figure.suptitle(f"{name}, {outcome}: {what}", fontsize=11)


def legend_outside(ax: Axes) -> None:
    """Puts the legend to the right of the axes, where it hides nothing."""
    if ax.get_legend_handles_labels()[0]:
        ax.legend(
            loc="upper left", bbox_to_anchor=(1.005, 1.0), fontsize=8, frameon=False
        )


def shade_activities(ax: Axes, data: RunData) -> None:
    """Marks when the executive was scanning or planning."""
    if "executive.status" not in data.run.value_names:
        return
    entries = data.run.values("executive.status")
    ends = [*(time for time, _ in entries[1:]), float(data.motion.time[-1])]
    for (start, status), end in zip(entries, ends, strict=True):
        activity = str(status.get("activity"))
        color = ACTIVITIES.get(activity)
        if color is not None:
            labelled = activity in ax.get_legend_handles_labels()[1]
            label = "_" if labelled else activity
            ax.axvspan(start, end, color=color, lw=0, zorder=0, label=label)


def plot_column(
    ax: Axes,
    frame: pd.DataFrame | None,
    axis: int,
    color: str,
    label: str,
    dashed: bool = True,
) -> None:
    """Draws one element of a signal over time; nothing where it was not logged."""
    if frame is not None:
        samples = frame.to_numpy(dtype=np.float64)
        style = "--" if dashed else "-"
        ax.plot(
            samples[:, 0],
            samples[:, 1 + axis],
            color=color,
            lw=0.9,
            ls=style,
            alpha=0.8,
            label=label,
        )


def reference_signal(data: RunData, port: str) -> pd.DataFrame | None:
    """Reads the reference of CoM, DCM or ZMP."""
    return data.first_signal(f"reference.{port}", f"stabilizer.{port}")


def true_zmp(data: RunData) -> Vector | None:
    """Computes the ZMP from the true contact wrenches, (n, 2), m; None without them."""
    if data.wrenches is None:
        return None
    return zmp_of_feet(data.motion, data.wrenches, data.limits.weight)


def support_edges(data: RunData, direction: Vector) -> tuple[Vector, Vector]:
    """Extent of the soles on the ground along a direction, (n,) each; nan without any.

    Args:
        data: the run.
        direction: horizontal unit vector, (2,).
    """
    count = len(data.motion.time)
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    for foot in FEET:
        corners = data.motion.sole_corners[foot][:, :, :2] @ direction
        down = np.ones(count, dtype=bool)
        if data.wrenches is not None:
            down = data.wrenches[foot][:, 2] > LIFTED * data.limits.weight
        low = np.where(down, np.minimum(low, corners.min(axis=1)), low)
        high = np.where(down, np.maximum(high, corners.max(axis=1)), high)
    none = ~np.isfinite(low)
    low[none] = high[none] = np.nan
    return low, high
