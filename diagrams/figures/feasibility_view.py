"""The obstacle paper's Fig. 2 for our robots: how they can straddle an obstacle."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import FEASIBLE, INFEASIBLE
from footfall.diagrams.figures.figure_parts import new_figure
from footfall.models.values.obstacle import KeyConfiguration
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feasibility_maps import FeasibilityMaps


def feasibility_figure(
    maps: FeasibilityMaps, title: str, key: KeyConfiguration | None = None
) -> Figure:
    """Fig. 2's maps: three of a quasi-static phase 2, and the dynamic one beside them.

    Blue is where some constraint is always violated, red where none is.

    Args:
        maps: what is drawn.
        title: what it is drawn for.
        key: the feasibility unit's answer, marked in the dynamic map.
    """
    figure = new_figure(13.0, 3.9)
    axes = figure.subplots(1, 4, sharex=True, sharey=True)
    for ax, shown, name in (
        (axes[0], maps.begin, "quasi-static: begins (Eq. 6)"),
        (axes[1], maps.within, "quasi-static: within (Eq. 7)"),
        (axes[2], maps.end, "quasi-static: ends (Eq. 8)"),
        (axes[3], maps.dynamic, "dynamic (Eqs. 10 to 13, 22)"),
    ):
        _draw_map(ax, maps, shown)
        ax.set_title(f"{name}, {100.0 * shown.mean():.0f} %", fontsize=10)
        ax.set_xlabel("$X_{ads}$ [m]")
    axes[0].set_ylabel("$Z_{hds}$ [m]")
    if key is not None:
        axes[3].plot(key.X_ads, key.Z_hds, "o", mfc="white", mec="black", ms=8)
        axes[3].annotate(
            "key configuration",
            (key.X_ads, key.Z_hds),
            xytext=(0, 9),
            textcoords="offset points",
            ha="center",
            fontsize=9,
            bbox={"fc": "white", "ec": "none", "pad": 1, "alpha": 0.7},
        )
    figure.suptitle(title, fontsize=11)
    return figure


def _draw_map(ax: Axes, maps: FeasibilityMaps, shown: Vector) -> None:
    x, z = (
        np.concatenate(
            [
                v[:1] - np.diff(v)[0] / 2,
                (v[1:] + v[:-1]) / 2,
                v[-1:] + np.diff(v)[-1] / 2,
            ]
        )
        for v in (maps.X_ads, maps.Z_hds)
    )
    colors = ListedColormap([INFEASIBLE, FEASIBLE])
    ax.pcolormesh(x, z, shown, cmap=colors, vmin=0.0, vmax=1.0)
