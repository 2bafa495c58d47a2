"""The obstacle paper's Figs. 7, 8 and 9 of a run: waist, feet and ZMP over time."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import (
    BEFORE,
    COM,
    PHASES,
    SIDES,
    STAGES,
    SUPPORT,
    SUPPORT_EDGE,
    THING_AS_SEEN,
    WAIST,
    WANTED,
    ZMP,
)
from footfall.diagrams.figures.crossing_data import CrossingData, without_adaptation
from footfall.diagrams.figures.figure_parts import (
    legend_outside,
    new_figure,
    set_title,
    support_edges,
    true_zmp,
)
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import Repairs
from footfall.systems.planning.crossing.report import BodyCurves

CWTG1, CWTG2 = STAGES


def adaptation_figure(crossing: CrossingData) -> Figure:
    """Fig. 7: waist and second foot before and after the adaptation, and the true ones.

    Before is the same motion without the arms and the feet adaptor. The ZMP on top is
    the multibody one after CWTG2.
    """
    figure = new_figure(11.0, 10.5)
    axes = figure.subplots(5, 1, sharex=True)
    x, _ = crossing.axes
    motion = crossing.data.motion
    for plan in crossing.plans:
        bare = without_adaptation(crossing, plan)
        curves = bare.report.curves
        assert curves is not None
        start = bare.start_time
        _curve(axes[0], plan.time, plan.zmp @ x, WANTED, "--")
        _curve(axes[0], start + curves.time, curves.zmp_cwtg2 @ x, BEFORE, ":")
        _curve(axes[0], plan.curves.time, plan.curves.zmp_cwtg2 @ x, CWTG2)
        _waist(axes[1:3], start, curves, x, BEFORE, ":")
        _waist(axes[1:3], 0.0, plan.curves, x, WAIST, "--")
        time: Vector = start + bare.period * np.arange(float(len(bare.foot_poses)))
        for phases in plan.phases:
            i = FEET.index(phases.second)
            color = SIDES[phases.second]
            for poses, when, shade, style in (
                (bare.foot_poses[:, i], time, BEFORE, ":"),
                (plan.feet[:, i], plan.time, color, "--"),
            ):
                shown = (when >= phases.touch - 0.3) & (when <= phases.end + 0.3)
                _curve(axes[3], when[shown], poses[shown, :2] @ x, shade, style)
                _curve(axes[4], when[shown], poses[shown, 2], shade, style)
            shown = (motion.time >= phases.touch - 0.3) & (
                motion.time <= phases.end + 0.3
            )
            p_WF = motion.X_WF[phases.second][shown, :3, 3]
            _curve(axes[3], motion.time[shown], p_WF[:, :2] @ x, color)
            _curve(axes[4], motion.time[shown], p_WF[:, 2], color)
    zmp = true_zmp(crossing.data)
    if zmp is not None:
        axes[0].plot(motion.time, zmp @ x, color=ZMP, lw=0.8)
    axes[1].plot(motion.time, motion.base[:, :2] @ x, color=WAIST, lw=1.2)
    axes[2].plot(motion.time, motion.base[:, 2], color=WAIST, lw=1.2)
    foot = crossing.plans[0].phases[0].second
    _keys(
        axes[0],
        ("after CWTG2, before adaptation", BEFORE, ":"),
        ("after CWTG2, adapted", CWTG2, "-"),
        ("desired", WANTED, "--"),
        ("measured", ZMP, "-"),
    )
    _keys(
        axes[1],
        ("waist before adaptation", BEFORE, ":"),
        ("waist as planned", WAIST, "--"),
        ("true waist", WAIST, "-"),
    )
    _keys(
        axes[3],
        (f"{foot} foot before", BEFORE, ":"),
        (f"{foot} foot as planned", SIDES[foot], "--"),
        (f"true {foot} foot", SIDES[foot], "-"),
    )
    labels = ("ZMP x [m]", "waist x [m]", "waist z [m]", "foot x [m]", "foot z [m]")
    _finish(axes, crossing, labels)
    repairs = "; ".join(_repairs(plan.repairs) for plan in crossing.plans)
    set_title(
        figure,
        crossing.data,
        f"adaptation of waist and second foot (Fig. 7): {repairs}",
    )
    return figure


def ahead_figure(crossing: CrossingData) -> Figure:
    """Fig. 8: ZMP, waist and feet in the walking direction x, heights and pitch.

    The second panel magnifies what the first hides: how far the ZMP is from the
    desired one after CWTG1, after CWTG2 and in physics.
    """
    figure = new_figure(11.0, 12.0)
    axes = figure.subplots(6, 1, sharex=True, height_ratios=(1.4, 1, 1, 0.8, 1, 0.8))
    x, _ = crossing.axes
    motion = crossing.data.motion
    _zmp_panel(axes[0], crossing, x)
    axes[0].plot(
        motion.time, motion.base[:, :2] @ x, color=WAIST, lw=1.4, label="true waist"
    )
    _error_panel(axes[1], crossing, x)
    for plan in crossing.plans:
        for i, foot in enumerate(FEET):
            poses = plan.feet[:, i]
            for ax, values in (
                (axes[2], poses[:, :2] @ x),
                (axes[4], poses[:, 2]),
                (axes[5], np.degrees(poses[:, 4])),
            ):
                _curve(ax, plan.time, values, SIDES[foot], "--")
        _curve(axes[3], plan.curves.time, plan.curves.waist[:, 2], WAIST, "--")
        for obstacle, phases in zip(plan.obstacles, plan.phases, strict=True):
            axes[4].plot(
                [phases.begin, phases.end],
                [obstacle.height] * 2,
                color=THING_AS_SEEN,
                lw=2,
            )
    axes[3].plot(motion.time, motion.base[:, 2], color=WAIST, lw=1.2)
    for foot in FEET:
        X_WF = motion.X_WF[foot]
        pitch = np.degrees(-np.arcsin(X_WF[:, 2, 0]))
        for ax, values in (
            (axes[2], X_WF[:, :2, 3] @ x),
            (axes[4], X_WF[:, 2, 3]),
            (axes[5], pitch),
        ):
            _curve(ax, motion.time, values, SIDES[foot])
    legend_outside(axes[0])
    legend_outside(axes[1])
    styles = [
        (f"{how}{foot} foot", SIDES[foot], line)
        for foot in FEET
        for how, line in (("true ", "-"), ("planned ", "--"))
    ]
    _keys(axes[2], *styles)
    _keys(axes[3], ("true waist", WAIST, "-"), ("planned waist", WAIST, "--"))
    _keys(axes[4], ("obstacle as seen", THING_AS_SEEN, "-"))
    labels = (
        "x [m]",
        "ZMP error x [m]",
        "foot x [m]",
        "waist z [m]",
        "foot z [m]",
        "foot pitch [deg]",
    )
    _finish(axes, crossing, labels)
    set_title(figure, crossing.data, "ZMP, waist and feet along x (Fig. 8)")
    return figure


def sideways_figure(crossing: CrossingData) -> Figure:
    """Fig. 9: waist and ZMP sideways: desired, after CWTG1, after CWTG2, measured."""
    figure = new_figure(11.0, 8.0)
    axes = figure.subplots(3, 1, sharex=True, height_ratios=(1.2, 1.2, 1))
    _, y = crossing.axes
    motion = crossing.data.motion
    for plan in crossing.plans:
        _curve(axes[0], plan.time, plan.zmp @ y, WANTED, "--")
        _curve(axes[0], plan.curves.time, plan.curves.waist[:, :2] @ y, WAIST, "--")
    axes[0].plot(motion.time, motion.base[:, :2] @ y, color=WAIST, lw=1.2)
    axes[0].plot(motion.time, motion.com[:, :2] @ y, color=COM, lw=1.2)
    _keys(
        axes[0],
        ("ZMP desired", WANTED, "--"),
        ("planned waist", WAIST, "--"),
        ("true waist", WAIST, "-"),
        ("true CoM", COM, "-"),
    )
    _zmp_panel(axes[1], crossing, y)
    _error_panel(axes[2], crossing, y)
    legend_outside(axes[1])
    legend_outside(axes[2])
    _finish(axes, crossing, ("y [m]", "ZMP y [m]", "ZMP error y [m]"))
    set_title(figure, crossing.data, "ZMP and waist sideways (Fig. 9)")
    return figure


def _repairs(repairs: Repairs) -> str:
    """Says in a few words what the feet adaptor changed."""
    said = [
        f"{what} by {1e3 * size:.0f} mm"
        for what, size in (
            ("foot shifted to the rear", repairs.shift),
            ("waist raised", repairs.raised),
            ("waist lowered", repairs.lowered),
        )
        if size > 0.0
    ]
    if repairs.path.size:
        said.append(f"foot yields by up to {1e3 * np.abs(repairs.path).max():.0f} mm")
    return ", ".join(said) or "nothing to repair"


def _zmp_panel(ax: Axes, crossing: CrossingData, direction: Vector) -> None:
    """Draws every ZMP along a direction, and the edges of the support."""
    data = crossing.data
    low, high = support_edges(data, direction)
    ax.fill_between(
        data.motion.time, low, high, color=SUPPORT, lw=0, label="support, true"
    )
    for edge in (low, high):
        ax.plot(data.motion.time, edge, color=SUPPORT_EDGE, lw=0.8)
    zmp = true_zmp(data)
    if zmp is not None:
        ax.plot(
            data.motion.time, zmp @ direction, color=ZMP, lw=0.9, label="ZMP measured"
        )
    for k, plan in enumerate(crossing.plans):
        for values, color, label in _stages(plan.curves, direction):
            ax.plot(
                plan.curves.time, values, color=color, lw=1.1, label=_once(k, label)
            )
        ax.plot(
            plan.time,
            plan.zmp @ direction,
            color=WANTED,
            lw=0.9,
            ls="--",
            label=_once(k, "ZMP desired"),
        )


def _error_panel(ax: Axes, crossing: CrossingData, direction: Vector) -> None:
    """Draws how far every ZMP is from the desired one along a direction."""
    motion, zmp = crossing.data.motion, true_zmp(crossing.data)
    for k, plan in enumerate(crossing.plans):
        wanted = plan.zmp @ direction
        if zmp is not None:
            during = (motion.time >= plan.time[0]) & (motion.time <= plan.time[-1])
            error = (zmp @ direction)[during] - np.interp(
                motion.time[during], plan.time, wanted
            )
            label = _once(k, "measured")
            ax.plot(motion.time[during], error, color=ZMP, lw=0.7, label=label)
        for values, color, label in _stages(plan.curves, direction):
            error = values - np.interp(plan.curves.time, plan.time, wanted)
            ax.plot(plan.curves.time, error, color=color, lw=1.1, label=_once(k, label))
    ax.axhline(0.0, color=WANTED, lw=0.8, ls="--")


def _stages(
    curves: BodyCurves, direction: Vector
) -> tuple[tuple[Vector, str, str], ...]:
    """Gives both stages' multibody ZMP along a direction, with colour and label."""
    return (
        (curves.zmp_cwtg1 @ direction, CWTG1, "multibody, after CWTG1"),
        (curves.zmp_cwtg2 @ direction, CWTG2, "multibody, after CWTG2"),
    )


def _waist(
    axes: Sequence[Axes],
    start: float,
    curves: BodyCurves,
    x: Vector,
    color: str,
    style: str,
) -> None:
    """Draws the waist's x and z in two panels."""
    for ax, values in zip(
        axes, (curves.waist[:, :2] @ x, curves.waist[:, 2]), strict=True
    ):
        _curve(ax, start + curves.time, values, color, style)


def _curve(
    ax: Axes, time: Vector, values: Vector, color: str, style: str = "-"
) -> None:
    ax.plot(time, values, color=color, ls=style, lw=1.2)


def _once(index: int, label: str) -> str:
    return "_" if index else label


def _keys(ax: Axes, *entries: tuple[str, str, str]) -> None:
    """Draws a legend of label, colour and line style beside the axes."""
    for label, color, style in entries:
        ax.plot([], [], color=color, ls=style, lw=1.4, label=label)
    legend_outside(ax)


def _finish(axes: Any, crossing: CrossingData, labels: Sequence[str]) -> None:
    """Phases, window, grid and labels; each panel as high as what it shows."""
    window = (
        min(plan.window()[0] for plan in crossing.plans),
        max(plan.window()[1] for plan in crossing.plans),
    )
    for ax, label in zip(axes, labels, strict=True):
        for plan in crossing.plans:
            for begin, touch, lift, end, *_ in plan.phases:
                spans = ((begin, touch), (touch, lift), (lift, end))
                for span, color in zip(spans, PHASES, strict=True):
                    ax.axvspan(*span, color=color, lw=0, zorder=0)
        ax.set_ylabel(label)
        ax.grid(alpha=0.3)
        _fit_height(ax, window)
    for plan in crossing.plans:
        for begin, touch, lift, end, *_ in plan.phases:
            for name, middle in (
                ("phase 1", (begin + touch) / 2),
                ("2", (touch + lift) / 2),
                ("3", (lift + end) / 2),
            ):
                axes[0].annotate(
                    name,
                    (middle, 1.0),
                    xycoords=("data", "axes fraction"),
                    ha="center",
                    va="bottom",
                    fontsize=8,
                )
    axes[0].set_xlim(*window)
    axes[-1].set_xlabel("time [s]")


def _fit_height(ax: Axes, window: tuple[float, float]) -> None:
    """Limits of y from what its lines show within a stretch of time."""
    low, high = np.inf, -np.inf
    for line in ax.get_lines():
        time, values = (np.asarray(v, dtype=np.float64) for v in line.get_data())
        if len(time) < 3:
            continue
        shown = values[(time >= window[0]) & (time <= window[1])]
        shown = shown[np.isfinite(shown)]
        if len(shown):
            low, high = min(low, shown.min()), max(high, shown.max())
    if high > low:
        room = 0.06 * (high - low)
        ax.set_ylim(low - room, high + room)
