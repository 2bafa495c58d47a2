"""Time in which long standing is folded."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from footfall.diagrams.figures.time_axis import (
    FOLDED,
    MARGIN,
    FoldedTime,
    fold_time,
    standing_stretches,
)

STATUS = (
    *((0.0, "stand"), (0.5, "scan"), (6.0, "plan"), (7.0, "move"), (12.0, "scan")),
    *((13.5, "walk"), (16.0, "scan"), (22.0, "finished")),
)
"""When the robot began to do what."""


def a_run(sway=0.0, status=STATUS, end=25.0):
    """What of a run the axes look at; between 16 and 25 s the CoM sways so far, m."""
    time = np.linspace(0.0, end, 501)
    com = np.zeros((len(time), 3))
    moving = (time > 7.0) & (time < 16.0)
    com[moving, 0] = np.sin(time[moving])
    com[:, 1] = sway * np.sin(time) * (time > 16.0)
    entries = [(moment, {"activity": activity}) for moment, activity in status]
    run = SimpleNamespace(
        value_names=("executive.status",), values=lambda _: list(entries)
    )
    return SimpleNamespace(run=run, motion=SimpleNamespace(time=time, com=com))


def test_standing_is_found_between_motions() -> None:
    """Scan and plan are one; a short look is no standing; before and after count."""
    assert standing_stretches(a_run()) == (
        (MARGIN, 7.0 - MARGIN),
        (16.0 + MARGIN, 25.0 - MARGIN),
    )


def test_a_robot_that_sways_is_shown() -> None:
    """It is pushed, or falls."""
    assert standing_stretches(a_run(sway=0.05)) == ((MARGIN, 7.0 - MARGIN),)


def test_a_run_without_motions_is_shown_whole() -> None:
    """And one that did not log what its executive did."""
    assert standing_stretches(a_run(status=((0.0, "stand"),))) == ()
    bare = a_run()
    bare.run.value_names = ()
    assert standing_stretches(bare) == ()


def test_the_map_is_narrow_where_it_is_folded() -> None:
    """Everywhere else a second is a second; back and forth is where it was."""
    folded = FoldedTime(((2.0, 8.0), (11.0, 20.0)))
    assert np.diff(folded.places(np.array([2.0, 8.0]))) == pytest.approx(FOLDED)
    assert np.diff(folded.places(np.array([8.0, 11.0]))) == pytest.approx(3.0)
    assert np.diff(folded.places(np.array([11.0, 20.0]))) == pytest.approx(FOLDED)
    for begin in (-5.0, 20.0):
        assert np.diff(folded.places(np.array([begin, begin + 2]))) == pytest.approx(2)
    time = np.linspace(-3.0, 30.0, 100)
    np.testing.assert_allclose(folded.times(folded.places(time)), time, atol=1e-9)
    assert (np.diff(folded.places(time)) > 0.0).all()
    np.testing.assert_array_equal(FoldedTime(()).places(time), time)


def test_ticks_are_round_and_outside_what_is_folded() -> None:
    """None too near to the one before."""
    folded = FoldedTime(((2.0, 8.2), (11.0, 20.0)))
    assert folded.ticks(0.0, 22.0) == [0.0, 1.0, 2.0, 9.0, 10.0, 11.0, 20.0, 21.0, 22.0]


def test_axes_are_folded_and_say_so() -> None:
    """All that share their time, to the ends of the run."""
    figure = Figure()
    top, bottom = figure.subplots(2, 1, sharex=True)
    fold_time((top, bottom), a_run())
    assert bottom.get_xlabel() == "time [s]"
    ends = top.transData.transform([(0.0, 0.0), (25.0, 0.0), (7.0, 0.0), (16.0, 0.0)])
    whole, moving = np.diff(ends[:, 0])[[0, 2]]
    assert moving / whole == pytest.approx(9.0 / (25.0 - 13.2 + 2 * FOLDED), rel=1e-3)
    for ax in (top, bottom):
        assert "stands still, folded" in ax.get_legend_handles_labels()[1]
        assert not any(MARGIN < tick < 6.3 for tick in ax.get_xticks())
    fold_time((top, bottom), a_run(status=((0.0, "stand"),)))
