"""The stair paper's Fig. 7 of a run: support areas and CoM in the transverse plane."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from diagrams.run_data import RunData
from models.staircase import Tread
from systems.ports import Vector

POLYGON_SIGNAL = "static_stability.polygon"
STAIR, AREA, COM = "#a0703c", "#1c7ed6", "#e03131"
SAME = 5e-3
"""Areas whose corners all lie this near to those before are drawn once, m."""


def transverse_view(data: RunData) -> Figure:
    """Consecutive static-stability polygons (blue), CoM (dotted red), stairs (brown).

    The sagittal direction of the stairs points to the right.

    Args:
        data: a run that logged `POLYGON_SIGNAL`.
    """
    figure = Figure(figsize=(11.0, 5.0), layout="constrained")
    ax = figure.subplots()
    for tread in data.treads:
        ax.add_patch(
            Polygon(_outline(tread), fc=STAIR, ec="#5c3d1e", alpha=0.6, lw=1.2)
        )
    areas = support_areas(data)
    for area in areas:
        ax.add_patch(Polygon(area, fc=AREA, ec="none", alpha=0.12))
        ax.add_patch(Polygon(area, fill=False, ec="#1864ab", lw=0.9, alpha=0.8))
    ax.plot(*data.motion.com[:, :2].T, color=COM, ls=":", lw=2.0, label="true CoM")
    _show(ax, areas, data.motion.com)
    for color, label in ((AREA, "static-stability polygon"), (STAIR, "tread")):
        ax.plot([], [], color=color, lw=6, alpha=0.5, label=label)
    ax.legend(loc="upper left", fontsize=8)
    summary = data.run.summary
    margin = summary.get("min_static_margin_m")
    least = f", least margin {margin:.3f} m" if isinstance(margin, float) else ""
    figure.suptitle(
        f"{summary.get('scenario')}, {summary.get('outcome')}: static stability{least}",
        fontsize=11,
    )
    return figure


def support_areas(data: RunData) -> list[Vector]:
    """The polygons of the run that differ from the one before, (k, 2) each, m."""
    areas: list[Vector] = []
    for _, value in data.run.values(POLYGON_SIGNAL):
        vertices = np.array(value["vertices"], dtype=np.float64).reshape(-1, 2)
        if len(vertices) > 2 and not (areas and _same(areas[-1], vertices)):
            areas.append(vertices)
    return areas


def _same(a: Vector, b: Vector) -> bool:
    """Whether each corner of one polygon is near to one of the other."""
    apart = np.linalg.norm(a[:, None] - b[None], axis=2)
    return bool(max(apart.min(axis=0).max(), apart.min(axis=1).max()) < SAME)


def _outline(tread: Tread) -> Vector:
    half = tread.size / 2.0
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners: Vector = np.array(tread.X_WR.multiply((signs * [*half, 0.0]).T)).T
    return corners[:, :2]


def _show(ax: Axes, areas: list[Vector], com: Vector) -> None:
    points = np.vstack([com[:, :2], *areas])
    low, high = points.min(axis=0) - 0.15, points.max(axis=0) + 0.15
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(alpha=0.3)
