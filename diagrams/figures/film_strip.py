"""A run as pictures in a row, rendered without a display.

So the stair paper shows a climb (Fig. 8) and the obstacle paper a crossing (Fig. 10).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from footfall.diagrams.figures.crossing_data import PlannedCrossing, planned_crossings
from footfall.diagrams.figures.rendering import (
    CROSSING_VIEW,
    VIEW,
    render_states,
    turned,
)
from footfall.diagrams.run_data import mover_positions
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signal_names import PLAN_SIGNAL, STATE_SIGNAL
from footfall.diagrams.signals import Run, RunError, load_run
from footfall.models.values.vector import Vector

STRIP_FILE = "figures/film_strip.png"
COLUMNS = 6
FALL_SHOWN = 4.5
"""Of a run that fell so much of its end is shown, s: a fall is watched for 3 s."""


def render_run(
    folder: Path, frames: int = 12, start: float | None = None, end: float | None = None
) -> Path:
    """Renders a run as a film strip into its folder; gives the picture's path.

    Args:
        folder: of the run.
        frames: how many pictures.
        start: when the first is taken, s; None for when the robot first moves or,
            where it crosses obstacles, a step before phase 1.
        end: when the last is taken, s; None for when it last moves, a step after
            phase 3, or when it lies. Without both what lies between two motions is
            left out, but for a fall.

    Raises:
        RunError: the folder holds no run, one without the plant's state, or nothing
            between start and end.
        ScenarioError: its scenario cannot be read.
    """
    shown = shown_part(folder, start, end)
    moments = spread(shown.stretches, frames)
    rows = np.minimum(np.searchsorted(shown.time, moments), len(shown.time) - 1)
    movers = mover_positions(shown.run, shown.time[rows])
    pictures = render_states(shown.run, shown.state[rows], shown.view, movers)
    path = folder / STRIP_FILE
    path.parent.mkdir(exist_ok=True)
    figure = strip_figure(list(pictures), moments - shown.stretches[0][0])
    with whole_file(path) as partial:
        FigureCanvasAgg(figure).print_png(str(partial))  # type: ignore[no-untyped-call]
    return path


@dataclass(frozen=True, eq=False)
class ShownPart:
    """What of a run is rendered, and from where."""

    run: Run
    time: Vector
    """Of all samples, (n,), s."""
    state: Vector
    """Positions, then velocities of the robot, (n, nq + nv)."""
    stretches: tuple[tuple[float, float], ...]
    """Begin and end of each stretch of time that is shown, in order, s."""
    view: Vector
    """From the robot's base to the camera in W, (3,), m."""


def shown_part(folder: Path, start: float | None, end: float | None) -> ShownPart:
    """Reads of a run what is worth being shown; see `render_run`.

    Raises:
        RunError: the folder holds no run, one without the plant's state, or nothing
            between start and end.
        ScenarioError: its scenario cannot be read.
    """
    run = load_run(folder)
    if STATE_SIGNAL not in run.signals:
        raise RunError(f"{folder}: the run did not log {STATE_SIGNAL}")
    samples = run.signals[STATE_SIGNAL].to_numpy(dtype=np.float64)
    time, state = samples[:, 0], samples[:, 1:]
    crossings = _crossings(run)
    fell = run.summary["outcome"] == "fell"
    stretches = _moving(run, time)
    if fell:
        stretches = with_fall(stretches, float(time[-1]))
    elif crossings:
        both = np.array([plan.stretch() for plan in crossings])
        stretches = [(float(both.min()), float(both.max()))]
    if start is not None or end is not None:
        first = stretches[0][0] if start is None else max(start, float(time[0]))
        last = stretches[-1][1] if end is None else min(end, float(time[-1]))
        stretches = [(first, last)]
    first, last = stretches[0][0], stretches[-1][1]
    if not first < last:
        raise RunError(f"{folder}: nothing to render between {first:g} and {last:g} s")
    view = turned(CROSSING_VIEW, crossings[0].obstacles[0].yaw) if crossings else VIEW
    return ShownPart(run, time, state, tuple(stretches), view)


def strip_figure(pictures: list[Vector], moments: Vector) -> Figure:
    """Pictures in rows with their time stamps, s, below them."""
    columns = min(COLUMNS, len(pictures))
    rows = -(-len(pictures) // columns)
    figure = Figure(figsize=(1.9 * columns, 3.1 * rows), dpi=120, layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False)
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, picture, moment in zip(axes.flat, pictures, moments, strict=False):
        ax.imshow(picture)
        ax.set_title(f"{moment:.1f} s", y=-0.09, fontsize=10)
    return figure


def _crossings(run: Run) -> tuple[PlannedCrossing, ...]:
    """Reads what was crossed, if anything."""
    if PLAN_SIGNAL not in run.value_names:
        return ()
    return planned_crossings(run.values(PLAN_SIGNAL))


def spread(stretches: Sequence[tuple[float, float]], count: int) -> Vector:
    """Moments at equal distances over stretches of time put end to end, (count,), s.

    Args:
        stretches: begin and end of each, s, in order.
        count: how many moments; the first is the begin of all, the last the end.
    """
    begins, ends = np.array(stretches, dtype=np.float64).T
    passed = np.concatenate([[0.0], np.cumsum(ends - begins)])
    wanted = np.linspace(0.0, passed[-1], count)
    index = np.clip(np.searchsorted(passed, wanted) - 1, 0, len(begins) - 1)
    moments: Vector = begins[index] + wanted - passed[index]
    return moments


def with_fall(
    stretches: Sequence[tuple[float, float]], end: float
) -> list[tuple[float, float]]:
    """Adds the end of a run that fell, standing or moving, to what is shown, s."""
    begin = max(end - FALL_SHOWN, 0.0)
    before = [(start, min(stop, begin)) for start, stop in stretches if start < begin]
    if before and before[-1][1] == begin:
        begin = before.pop()[0]
    return [*before, (begin, end)]


def _moving(run: Run, time: Vector) -> list[tuple[float, float]]:
    """Finds when the robot moved, by its executive; all of the run without one."""
    always = [(float(time[0]), float(time[-1]))]
    if "executive.status" not in run.value_names:
        return always
    entries = run.values("executive.status")
    ends = [*(moment for moment, _ in entries[1:]), float(time[-1])]
    moves = [
        (moment, end)
        for (moment, status), end in zip(entries, ends, strict=True)
        if status.get("activity") in ("move", "walk") and end > moment
    ]
    return moves or always
