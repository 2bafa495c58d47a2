"""What the robot believed of itself against the truth, over time."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import AXES
from footfall.diagrams.figures.figure_parts import (
    legend_outside,
    new_figure,
    set_title,
    shade_activities,
)
from footfall.diagrams.figures.time_axis import fold_time
from footfall.diagrams.judge.estimate_errors import EstimateErrors, estimate_errors
from footfall.diagrams.run_data import RunData
from footfall.models.values.vector import Vector


def has_estimate(data: RunData) -> bool:
    """Tells whether the run was on an estimate that was logged."""
    return estimate_errors(data.run.signals) is not None


def estimate_figure(data: RunData) -> Figure:
    """Errors of place, turn and velocity of the base, with twice their deviations."""
    errors = estimate_errors(data.run.signals)
    assert errors is not None
    figure = new_figure(11.0, 8.0)
    rows = figure.subplots(3, 1, sharex=True)
    for ax, values, first, scale, label in zip(
        rows,
        (errors.position, errors.turn, errors.velocity),
        (6, 0, 3),
        (1e3, 180.0 / np.pi, 1e3),
        ("place [mm]", "turn [deg]", "velocity [mm/s]"),
        strict=True,
    ):
        shade_activities(ax, data)
        deviation = None
        if errors.deviation is not None:
            deviation = scale * errors.deviation[:, first : first + 3]
        _draw(ax, errors, scale * values, deviation)
        ax.set_ylabel(f"error of {label}")
    fold_time(rows, data)
    for ax in rows:
        legend_outside(ax)
    set_title(figure, data, "estimate less truth of the pelvis")
    return figure


def _draw(
    ax: Axes, errors: EstimateErrors, values: Vector, deviation: Vector | None
) -> None:
    limit = 1.3 * float(np.quantile(np.abs(values), 0.999)) + 1e-9
    for axis, (name, color) in enumerate(zip("xyz", AXES, strict=True)):
        ax.plot(errors.time, values[:, axis], color=color, lw=0.9, label=name)
        if deviation is not None:
            for sign in (-2.0, 2.0):
                ax.plot(
                    errors.time,
                    sign * deviation[:, axis],
                    color=color,
                    lw=0.7,
                    ls=":",
                    label=f"{name}, 2 deviations" if sign > 0 else "_",
                )
    ax.set_ylim(-limit, limit)
    ax.grid(alpha=0.3)
