"""The figures of a run."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from footfall.diagrams.figures.colors import (
    COM,
    DCM,
    SIDES,
    SUPPORT,
    TREAD,
    TREAD_EDGE,
    ZMP,
)
from footfall.diagrams.figures.crossing_data import CrossingData, read_crossings
from footfall.diagrams.figures.crossing_figures import (
    adaptation_figure,
    ahead_figure,
    sideways_figure,
)
from footfall.diagrams.figures.estimate_figure import estimate_figure, has_estimate
from footfall.diagrams.figures.figure_parts import (
    legend_outside,
    new_figure,
    plot_column,
    reference_signal,
    set_title,
    shade_activities,
    support_edges,
    true_zmp,
)
from footfall.diagrams.figures.joints_figure import joints_figure
from footfall.diagrams.figures.room_view import draw_room
from footfall.diagrams.figures.stick_diagram import stick_diagram
from footfall.diagrams.figures.time_axis import fold_time
from footfall.diagrams.figures.transverse_view import transverse_view
from footfall.diagrams.judge.evidence_measures import dcm_distances
from footfall.diagrams.judge.measures import contact_intervals
from footfall.diagrams.run_data import RunData, read_run_data
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signal_names import POLYGON_SIGNAL
from footfall.models.scenes.tread import Tread
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector

FIGURES_FOLDER = "figures"
FORMATS = ("png", "pdf", "svg")
"""What figures may be drawn as; the latter two for papers."""
DPI = 120
CROSSING_FIGURES: dict[str, Callable[[CrossingData], Figure]] = {
    "fig5_stick_diagram": stick_diagram,
    "fig7_adaptation": adaptation_figure,
    "fig8_ahead": ahead_figure,
    "fig9_sideways": sideways_figure,
}
"""By the obstacle paper's numbers."""


def plot_run(folder: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Draws the figures of a run into its folder `figures`; gives their paths.

    `balance.png` CoM, DCM and ZMP over time against the support, the CoM's height and
    the DCM's error; `top_view.png` treads, boxes, path, footsteps and CoM from above;
    `side_view.png` how the feet passed the steps; `static_stability.png` where the CoM
    might rest, as in the stair paper's Fig. 7; `feet.png` heights of and forces on the
    feet; `joints.png` torques and speeds as shares of their limits; `estimate.png`
    errors of what the robot believed of itself. What was not logged is left out of
    them.

    Where obstacles were crossed, the obstacle paper's figures are added:
    `fig5_stick_diagram.png`, `fig7_adaptation.png`, `fig8_ahead.png` and
    `fig9_sideways.png`.

    Args:
        folder: of the run.
        formats: of `FORMATS`, each figure in each of them.

    Raises:
        RunError: the folder holds no run, or one without the plant's state.
        ScenarioError: its scenario cannot be read.
        ValueError: there is no such format.
    """
    if unknown := sorted(set(formats) - set(FORMATS)):
        known = ", ".join(FORMATS)
        raise ValueError(f"formats: must be of {known}, got {', '.join(unknown)}")
    data = read_run_data(folder)
    crossings = read_crossings(data)
    figures: dict[str, Callable[[], Figure]] = {
        name: partial(draw, data)
        for name, (draw, shows) in RUN_FIGURES.items()
        if shows(data)
    }
    if crossings is not None:
        for name, draw_crossing in CROSSING_FIGURES.items():
            figures[name] = partial(draw_crossing, crossings)
    target = folder / FIGURES_FOLDER
    target.mkdir(exist_ok=True)
    paths = []
    for name, draw in figures.items():
        figure = draw()
        for kind in formats:
            path = target / f"{name}.{kind}"
            with whole_file(path) as partial_path:
                _save(figure, partial_path, kind)
            paths.append(path)
    return paths


def _save(figure: Figure, path: Path, kind: str) -> None:
    """Writes a figure; vector graphics with text that can be searched and edited."""
    if kind == "png":
        canvas = FigureCanvasAgg(figure)
        canvas.figure.set_dpi(DPI)
        canvas.print_png(str(path))  # type: ignore[no-untyped-call]
        return
    # Without a date and with names that are not drawn, the same run is the same file.
    date = {"pdf": "CreationDate", "svg": "Date"}[kind]
    with mpl.rc_context(
        {"pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "footfall"}
    ):
        figure.savefig(path, format=kind, metadata={date: None})


def balance_figure(data: RunData) -> Figure:
    """CoM, DCM and ZMP over time with the support, CoM's height and DCM's error."""
    figure = new_figure(11.0, 10.0)
    axes = figure.subplots(4, 1, sharex=True, height_ratios=(1.4, 1.4, 1.0, 1.0))
    time, motion = data.motion.time, data.motion
    measured_dcm = data.signal("balance_state.dcm")
    zmp = true_zmp(data)
    for axis, (ax, letter) in enumerate(zip(axes[:2], "xy", strict=True)):
        shade_activities(ax, data)
        low, high = support_edges(data, np.eye(2)[axis])
        ax.fill_between(time, low, high, color=SUPPORT, lw=0, label="support")
        if zmp is not None:
            ax.plot(time, zmp[:, axis], color=ZMP, lw=0.9, label="ZMP")
        plot_column(ax, reference_signal(data, "zmp"), axis, ZMP, "ZMP wanted")
        if measured_dcm is not None:
            plot_column(ax, measured_dcm, axis, DCM, "DCM", dashed=False)
        plot_column(ax, reference_signal(data, "dcm"), axis, DCM, "DCM wanted")
        ax.plot(time, motion.com[:, axis], color=COM, lw=1.4, label="CoM")
        plot_column(ax, reference_signal(data, "com"), axis, COM, "CoM wanted")
        ax.set_ylabel(f"{letter} [m]")
        ax.grid(alpha=0.3)
    height, error = axes[2:]
    reference = reference_signal(data, "com")
    height.plot(time, motion.com[:, 2], color=COM, lw=1.4, label="CoM")
    plot_column(height, reference, 2, COM, "CoM wanted")
    height.set_ylabel("CoM z [m]")
    # A reference without velocity has no DCM.
    if reference is not None and reference.shape[1] >= 1 + 6:
        distances = 1e3 * dcm_distances(motion, reference)
        error.plot(time, distances, color=DCM, lw=1.0, label="DCM from wanted")
    else:
        error.text(0.5, 0.5, "not logged", transform=error.transAxes, ha="center")
    error.set_ylabel("DCM error [mm]")
    for ax in (height, error):
        shade_activities(ax, data)
        ax.grid(alpha=0.3)
    fold_time(axes, data)
    legend_outside(axes[0])
    set_title(figure, data, "balance")
    return figure


def top_view(data: RunData) -> Figure:
    """Treads, boxes, trees, path, footsteps, CoM and ZMP from above."""
    figure = new_figure(11.0, 6.5)
    ax = figure.subplots()
    draw_room(ax, data.run)
    for tread in data.treads:
        _draw_rectangle(ax, tread)
    for foot in FEET:
        corners = data.motion.sole_corners[foot]
        for index in _standing_samples(data, foot):
            outline = corners[index][:, :2]
            ax.add_patch(Polygon(outline, fc=SIDES[foot], ec=SIDES[foot], alpha=0.25))
            ax.add_patch(Polygon(outline, fill=False, ec=SIDES[foot], lw=1.0))
        ax.plot([], [], color=SIDES[foot], lw=6, alpha=0.4, label=f"{foot} sole")
    zmp = true_zmp(data)
    if zmp is not None:
        ax.plot(*zmp.T, color=ZMP, lw=0.8, alpha=0.8, label="ZMP")
    ax.plot(*data.motion.com[:, :2].T, color=COM, lw=1.5, label="CoM")
    ax.set_aspect("equal", adjustable="datalim")
    ax.autoscale_view()
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(alpha=0.3)
    legend_outside(ax)
    set_title(figure, data, "from above")
    return figure


def side_view(data: RunData) -> Figure:
    """Paths of toes and heels over the profile of the stairs."""
    figure = new_figure(11.0, 6.5)
    ax = figure.subplots()
    X_RW = data.treads[0].X_WR.inverse()
    offset = data.treads[0].size[0] / 2.0

    def along(points: Vector) -> tuple[Vector, Vector]:
        """Distance from the first riser and height."""
        p_R = np.array(X_RW.multiply(points.T))
        return p_R[0] + offset, points[:, 2]

    corners = np.stack([data.motion.sole_corners[foot] for foot in FEET])
    begin = min(along(corners[:, 0].reshape(-1, 3))[0].min() - 0.1, -0.3)
    profile = [(begin, 0.0), (0.0, 0.0)]
    for tread in data.treads:
        centre = np.array(tread.X_WR.translation())[None]
        middle, half, height = along(centre)[0][0], tread.size[0] / 2.0, centre[0, 2]
        profile += [(middle - half, height), (middle + half, height)]
    ground = np.array(profile)
    ax.fill_between(ground[:, 0], ground[:, 1], -0.05, color=TREAD, alpha=0.5, lw=0)
    ax.plot(*ground.T, color=TREAD_EDGE, lw=1.2)
    for foot in FEET:
        sole = data.motion.sole_corners[foot]
        toe, heel = sole[:, [1, 2]].mean(axis=1), sole[:, [0, 3]].mean(axis=1)
        ax.plot(*along(toe), color=SIDES[foot], lw=1.3, label=f"{foot} toe")
        ax.plot(*along(heel), color=SIDES[foot], lw=0.9, ls=":", label=f"{foot} heel")
        for index in _standing_samples(data, foot):
            ends = np.stack([heel[index], toe[index]])
            ax.plot(*along(ends), color=SIDES[foot], lw=4, alpha=0.5)
    ax.plot(*along(data.motion.com), color=COM, lw=1.3, label="CoM")
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("along the stairs from the first riser [m]")
    ax.set_ylabel("height [m]")
    ax.grid(alpha=0.3)
    legend_outside(ax)
    set_title(figure, data, "from the side")
    return figure


def feet_figure(data: RunData) -> Figure:
    """Heights of the soles, and the forces on them."""
    figure = new_figure(11.0, 7.0)
    heights, forces = figure.subplots(2, 1, sharex=True)
    time = data.motion.time
    for ax in (heights, forces):
        shade_activities(ax, data)
        ax.grid(alpha=0.3)
    for tread in data.treads:
        height = float(tread.X_WR.translation()[2])
        heights.axhline(height, color=TREAD, lw=1.5, zorder=0)
    for foot in FEET:
        color = SIDES[foot]
        lowest = data.motion.sole_corners[foot][:, :, 2].min(axis=1)
        heights.plot(time, lowest, color=color, lw=1.3, label=f"{foot} sole, lowest")
        if data.wrenches is not None:
            share = data.wrenches[foot][:, 2] / data.limits.weight
            forces.plot(time, share, color=color, lw=1.0, label=f"{foot} foot")
    heights.set_ylabel("height [m]")
    forces.set_ylabel("normal force [body weights]")
    fold_time((heights, forces), data)
    legend_outside(heights)
    if data.wrenches is None:
        forces.text(0.5, 0.5, "not logged", transform=forces.transAxes, ha="center")
    else:
        legend_outside(forces)
    set_title(figure, data, "feet")
    return figure


def _standing_samples(data: RunData, foot: Foot) -> list[int]:
    """Picks a sample in the middle of every contact of a foot."""
    if data.wrenches is None:
        return [0, len(data.motion.time) - 1]
    force = data.wrenches[foot][:, 2]
    return [
        (interval.start + interval.end) // 2
        for interval in contact_intervals(force, data.limits.weight)
    ]


def _draw_rectangle(ax: Axes, tread: Tread) -> None:
    half = tread.size / 2.0
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners = np.array(tread.X_WR.multiply((signs * [*half, 0.0]).T)).T
    ax.add_patch(
        Polygon(corners[:, :2], fc=TREAD, ec=TREAD_EDGE, alpha=0.35, lw=1.0, zorder=0)
    )


def _always(_: RunData) -> bool:
    return True


def _has_treads(data: RunData) -> bool:
    return bool(data.treads)


def _has_polygons(data: RunData) -> bool:
    return bool(data.treads) and POLYGON_SIGNAL in data.run.value_names


RUN_FIGURES: dict[
    str, tuple[Callable[[RunData], Figure], Callable[[RunData], bool]]
] = {
    "top_view": (top_view, _always),
    "side_view": (side_view, _has_treads),
    "balance": (balance_figure, _always),
    "static_stability": (transverse_view, _has_polygons),
    "feet": (feet_figure, _always),
    "joints": (joints_figure, _always),
    "estimate": (estimate_figure, has_estimate),
}
"""What draws each figure, and whether a run has what it shows."""
