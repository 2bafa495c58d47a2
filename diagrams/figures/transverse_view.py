"""The stair paper's Fig. 7 of a run: support areas and CoM in the transverse plane."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from footfall.diagrams.figures.colors import (
    COM,
    STATIC_SUPPORT,
    TREAD,
    TREAD_EDGE,
)
from footfall.diagrams.run_data import RunData
from footfall.diagrams.signal_names import POLYGON_SIGNAL
from footfall.models.scenes.tread import Tread
from footfall.models.values.vector import Vector

WIDTH, MARGINS = 10.0, 1.0
"""Of the picture, and what title, legend and labels take of its height, inches."""
SAME = 5e-3
"""Areas whose corners all lie this near to those before are drawn once, m."""


def transverse_view(data: RunData) -> Figure:
    """Consecutive static-stability polygons (blue), CoM (dotted), stairs (brown).

    The sagittal direction of the stairs points to the right.

    Args:
        data: a run that logged `POLYGON_SIGNAL`.
    """
    areas = support_areas(data)
    low, high = _bounds(areas, data.motion.com)
    width, height = high - low
    figure = Figure(
        figsize=(WIDTH, WIDTH * height / width + MARGINS), layout="constrained"
    )
    ax = figure.subplots()
    for tread in data.treads:
        ax.add_patch(
            Polygon(_outline(tread), fc=TREAD, ec=TREAD_EDGE, alpha=0.45, lw=1.2)
        )
    for k, area in enumerate(areas):
        if not any(_same(area, before) for before in areas[:k]):
            ax.add_patch(Polygon(area, fc=STATIC_SUPPORT, ec="none", alpha=0.2))
            ax.add_patch(Polygon(area, fill=False, ec=STATIC_SUPPORT, lw=1.1))
    com = data.motion.com[:, :2]
    ax.plot(*com.T, color=COM, ls=":", lw=2.2, label="true CoM")
    for point, marker, label in ((com[0], "o", "start"), (com[-1], "s", "end")):
        ax.plot(*point, marker, color=COM, ms=6, label=label)
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(alpha=0.3)
    for color, label in (
        (STATIC_SUPPORT, "static-stability polygon"),
        (TREAD, "tread"),
    ):
        ax.plot([], [], color=color, lw=6, alpha=0.5, label=label)
    figure.legend(loc="outside lower center", ncols=5, fontsize=9)
    summary = data.run.summary
    margin = summary.get("min_static_margin_m")
    least = f", least margin {margin:.3f} m" if isinstance(margin, float) else ""
    figure.suptitle(
        f"{summary.get('scenario')}, {summary.get('outcome')}: static stability{least}",
        fontsize=11,
    )
    return figure


def support_areas(data: RunData) -> list[Vector]:
    """Reads the polygons of the run that differ from the one before, (k, 2) each, m."""
    areas: list[Vector] = []
    for _, value in data.run.values(POLYGON_SIGNAL):
        vertices = np.array(value["vertices"], dtype=np.float64).reshape(-1, 2)
        if len(vertices) > 2 and not (areas and _same(areas[-1], vertices)):
            areas.append(vertices)
    return areas


def _same(a: Vector, b: Vector) -> bool:
    """Tells whether each corner of one polygon is near to one of the other."""
    apart = np.linalg.norm(a[:, None] - b[None], axis=2)
    return bool(max(apart.min(axis=0).max(), apart.min(axis=1).max()) < SAME)


def _outline(tread: Tread) -> Vector:
    half = tread.size / 2.0
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners: Vector = np.array(tread.X_WR.multiply((signs * [*half, 0.0]).T)).T
    return corners[:, :2]


def _bounds(areas: list[Vector], com: Vector) -> tuple[Vector, Vector]:
    """Lower left and upper right of what is shown, (2,) each, m."""
    points = np.vstack([com[:, :2], *areas])
    return points.min(axis=0) - 0.1, points.max(axis=0) + 0.1
