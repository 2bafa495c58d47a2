"""Axes of time in which long standing is folded, so that the motions are wide.

A robot that scans stands for seconds in which nothing happens that a figure shows.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator

from footfall.diagrams.figures.colors import LIGHT_GREY
from footfall.diagrams.run_data import RunData
from footfall.models.values.vector import Vector

MOVING = ("move", "walk")
"""What the executive calls it while the robot is to move."""
MARGIN = 0.7
"""So much of standing is shown as it is before and after what is folded, s."""
FOLDED = 0.8
"""As wide as so many seconds is what is folded."""
WORTH_IT = 2.0
"""What is folded is at least so long, s."""
STILL = 0.03
"""The CoM of a robot that stands still keeps inside so much along each axis, m; one
that is pushed, or falls, does not, and is shown."""
MOST_TICKS = 12
STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
"""Between ticks, s."""


@dataclass(frozen=True, eq=False)
class FoldedTime:
    """A map of time, s, to places on an axis, of which some stretches are narrow."""

    stretches: tuple[tuple[float, float], ...]
    """What is folded: begin and end of each, s, in order, each longer than `FOLDED`."""

    def places(self, time: Vector) -> Vector:
        """Maps times of any shape to places on the axis."""
        times, places = self._knots()
        return _through(time, times, places)

    def times(self, places: Vector) -> Vector:
        """Maps places on the axis back to times."""
        knots, known = self._knots()
        return _through(places, known, knots)

    def ticks(self, begin: float, end: float) -> list[float]:
        """Chooses round times between two, s, none of them inside what is folded."""
        low, high = self.places(np.array([begin, end]))
        fitting = [step for step in STEPS if (high - low) / step <= MOST_TICKS]
        step = fitting[0] if fitting else STEPS[-1]
        ticks: list[float] = []
        for tick in step * np.arange(np.ceil(begin / step), end / step + 1e-9):
            if any(first < tick < last for first, last in self.stretches):
                continue
            place = self.places(np.array([tick]))[0]
            before = self.places(np.array(ticks[-1:]))
            if not len(before) or place - before[0] > 0.6 * step:
                ticks.append(float(tick))
        return ticks

    def _knots(self) -> tuple[Vector, Vector]:
        times: Vector = np.array(self.stretches, dtype=np.float64).ravel()
        widths = np.diff(times, prepend=times[:1])
        widths[1::2] = FOLDED
        return times, times[:1] + np.cumsum(widths)


def _through(x: Vector, knots: Vector, values: Vector) -> Vector:
    """Interpolates linearly between knots; beyond them the slope is 1."""
    x = np.asarray(x, dtype=np.float64)
    if not len(knots):
        return x
    beyond = np.minimum(x - knots[0], 0.0) + np.maximum(x - knots[-1], 0.0)
    inside: Vector = np.interp(x, knots, values) + beyond
    return inside


def standing_stretches(data: RunData) -> tuple[tuple[float, float], ...]:
    """Finds when the robot stood still for long between motions, and before and after.

    Of a run without motions nothing is found: then standing is what it shows.

    Returns:
        Begin and end of what may be folded, s, in order.
    """
    if "executive.status" not in data.run.value_names:
        return ()
    end = float(data.motion.time[-1])
    entries = data.run.values("executive.status")
    moments = [*(time for time, _ in entries), end]
    moving = [status.get("activity") in MOVING for _, status in entries]
    if not any(moving):
        return ()
    stretches: list[tuple[float, float]] = []
    for moves, start, stop in zip(moving, moments, moments[1:], strict=False):
        if moves:
            continue
        if stretches and stretches[-1][1] == start:
            stretches[-1] = (stretches[-1][0], stop)
        else:
            stretches.append((start, stop))
    inner = [(start + MARGIN, stop - MARGIN) for start, stop in stretches]
    return tuple(
        (start, stop)
        for start, stop in inner
        if stop - start > WORTH_IT and _still(data, start, stop)
    )


def _still(data: RunData, start: float, stop: float) -> bool:
    within = (data.motion.time >= start) & (data.motion.time <= stop)
    com = data.motion.com[within]
    return bool(len(com)) and bool((np.ptp(com, axis=0) < STILL).all())


def fold_time(axes: Sequence[Axes], data: RunData) -> None:
    """Labels axes of time that lie one above the other, and folds long standing.

    To be called when all is drawn, and before the legends are, which say what is
    folded.

    Args:
        axes: from top to bottom.
        data: of the run.
    """
    axes[-1].set_xlabel("time [s]")
    stretches = standing_stretches(data)
    if not stretches:
        return
    begin, end = float(data.motion.time[0]), float(data.motion.time[-1])
    folded = FoldedTime(stretches)
    ticks = folded.ticks(begin, end)
    low, high = folded.places(np.array([begin, end]))
    room = 0.02 * (high - low)
    limits = folded.times(np.array([low - room, high + room]))
    for ax in axes:
        ax.set_xscale("function", functions=(folded.places, folded.times))
        ax.set_xlim(*limits)
        ax.xaxis.set_major_locator(FixedLocator(ticks))
        for index, (start, stop) in enumerate(stretches):
            ax.axvspan(
                start,
                stop,
                fill=False,
                ec=LIGHT_GREY,
                hatch="////",
                lw=0.0,
                # Above what is filled, below what is drawn.
                zorder=1.5,
                label="_" if index else "stands still, folded",
            )
