"""Figs. 7, 8 and 9 show the run: what lies on their axes is what was logged."""

import numpy as np
import pytest

from footfall.diagrams.figures.colors import (
    BEFORE,
    SIDES,
    SUPPORT_EDGE,
    WAIST,
    WANTED,
    ZMP,
)
from footfall.diagrams.figures.crossing_data import read_crossings
from footfall.diagrams.figures.crossing_figures import (
    CWTG1,
    CWTG2,
    adaptation_figure,
    ahead_figure,
    sideways_figure,
)
from footfall.diagrams.run_data import read_run_data


@pytest.fixture(scope="module")
def crossing(crossed_folder):
    """The crossing of the run over 15 cm."""
    return read_crossings(read_run_data(crossed_folder))


def lines(ax, color, style="-"):
    """Every curve of a colour and style, as (time, values)."""
    return [
        np.array(line.get_data())
        for line in ax.get_lines()
        if line.get_color() == color
        and line.get_linestyle() == style
        and len(line.get_xdata()) > 2
    ]


def within(curve, span):
    """Values of a curve in a stretch of time."""
    return curve[1][(curve[0] >= span[0]) & (curve[0] <= span[1])]


def test_fig_8_shows_zmp_waist_and_feet_along_x(crossing) -> None:
    """In six panels over the window, phases shaded."""
    axes = ahead_figure(crossing).axes
    plan, motion = crossing.plans[0], crossing.data.motion
    (phases,) = plan.phases
    span = (phases.begin, phases.end)
    assert len(axes) == 6
    assert axes[0].get_xlim() == pytest.approx(plan.window())
    (true,) = lines(axes[0], WAIST)
    np.testing.assert_allclose(true[1], motion.base[:, 0])
    (first,), (second,) = lines(axes[1], CWTG1), lines(axes[1], CWTG2)
    worst = [np.abs(within(curve, span)).max() for curve in (first, second)]
    assert worst[0] > 5.0 * worst[1]
    for foot in ("left", "right"):
        (height,) = lines(axes[4], SIDES[foot])
        np.testing.assert_allclose(height[1], motion.X_WF[foot][:, 2, 3])
        (planned,) = lines(axes[4], SIDES[foot], "--")
        assert within(planned, span).max() > 0.2
    (pitch,) = lines(axes[5], SIDES[phases.second])
    assert within(pitch, span).max() > 10.0
    assert axes[5].get_ylim()[1] > within(pitch, span).max()
    shades = [patch for patch in axes[2].patches if patch.get_width() < 3.0]
    edges = sorted(patch.get_x() for patch in shades)
    assert edges == pytest.approx([phases.begin, phases.touch, phases.lift])


def test_fig_9_shows_them_sideways(crossing) -> None:
    """The measured ZMP goes from sole to sole, with the edges of the support."""
    axes = sideways_figure(crossing).axes
    plan, motion = crossing.plans[0], crossing.data.motion
    (desired,) = lines(axes[1], WANTED, "--")
    np.testing.assert_allclose(desired[1], plan.zmp[:, 1])
    (measured,) = lines(axes[1], ZMP)
    inside = np.isfinite(measured[1])
    near = np.interp(plan.time, measured[0][inside], measured[1][inside])
    assert np.median(np.abs(near - plan.zmp[:, 1])) < 0.005
    low, high = lines(axes[1], SUPPORT_EDGE)
    both = np.isfinite(measured[1]) & np.isfinite(low[1])
    assert (measured[1][both] > low[1][both] - 1e-3).all()
    assert (measured[1][both] < high[1][both] + 1e-3).all()
    (waist,) = lines(axes[0], WAIST)
    np.testing.assert_allclose(waist[1], motion.base[:, 1])


def test_fig_7_shows_what_the_adaptation_changed(crossing) -> None:
    """The waist is lower than before, and the true one follows the planned."""
    figure = adaptation_figure(crossing)
    axes = figure.axes
    (phases,) = crossing.plans[0].phases
    span = (phases.touch, phases.lift)
    (before,) = lines(axes[2], BEFORE, ":")
    (planned,) = lines(axes[2], WAIST, "--")
    (true,) = lines(axes[2], WAIST)
    drop = within(before, span).mean() - within(planned, span).mean()
    assert drop == pytest.approx(crossing.plans[0].repairs.lowered, abs=1e-4)
    assert within(true, span).mean() == pytest.approx(
        within(planned, span).mean(), abs=3e-3
    )
    assert "waist lowered by" in figure.get_suptitle()
    (foot,) = lines(axes[3], SIDES[phases.second])
    ends = crossing.data.motion.X_WF[phases.second][[0, -1], 0, 3]
    assert ends[0] < foot[1][0] < 1.2 < foot[1][-1] < ends[1]
