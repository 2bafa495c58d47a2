"""A sweep as a page: success with intervals, and the command of each failure."""

import sys
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from footfall.diagrams.report.any_report import write_report
from footfall.diagrams.report.sweep_report import rate_row, sweep_sentence
from footfall.diagrams.sweep.definition import Sweep, SweepError
from footfall.diagrams.sweep.pools import LocalPool
from footfall.diagrams.sweep.runner import command_of, run_sweep
from footfall.diagrams.sweep.sampling import jobs_of
from footfall.diagrams.sweep.table import Rate, write_tables
from tests.diagrams.report.pages import Page

STAND_IN = (
    sys.executable,
    str(Path(__file__).parents[1] / "sweep" / "stand_in.py"),
)
SWEEP = Sweep(
    name="study",
    scenario="stairs-exp1",
    changes=("robot.x=0.1",),
    fields=(("scene.staircase.rise", (0.1, 0.2)), ("scene.staircase.run", (0.3, 0.4))),
    seeds=(0, 1),
)


def test_a_sweep_is_one_page(tmp_path: Path) -> None:
    """Rates by group, figures, what failed and how to repeat it."""
    folder = tmp_path / "s"
    run_sweep(SWEEP, folder, LocalPool(4, STAND_IN))
    with pytest.raises(SweepError, match=r"has no table\.parquet"):
        write_report(folder)
    table = write_tables(SWEEP, folder)
    path, complaints = write_report(folder)
    assert (path, complaints) == (folder / "report.html", [])
    page = Page(path)
    assert page.outer_addresses == []
    assert sweep_sentence(SWEEP, table) in page.text
    assert "By scene.staircase.rise" in page.text
    assert "0.1 4 of 4, 100 % (51 to 100 %)" in page.text
    assert "0.2 0 of 4, 0 % (0 to 49 %)" in page.text
    assert "Outcomes over scene.staircase.rise and scene.staircase.run." in page.text
    pictures = [one for one in page.addresses if one.startswith("data:image/png")]
    assert len(pictures) == 3
    for job in jobs_of(SWEEP):
        failed = dict(job.values)["scene.staircase.rise"] > 0.15
        assert (command_of(SWEEP, job) in page.text) == failed
    (folder / "sweep.json").write_text('{"keys": []}')
    with pytest.raises(SweepError, match=r"sweep\.json: holds no sweep: 'sweep'"):
        write_report(folder)


def test_a_sweep_is_said_in_a_sentence() -> None:
    """What was varied, how often it went well, what is missing."""
    outcomes = ["completed", "fell", "no result", "completed"]
    table = pd.DataFrame({"outcome": outcomes})
    assert sweep_sentence(replace(SWEEP, fields=(), seeds=(0,)), table) == (
        "4 runs over seeds alone, 1 seed each. 2 of 3 succeeded: 67 %, with a 95 % "
        "interval from 21 to 94 %. 1 have no result."
    )


def test_a_rate_without_runs_has_no_bar() -> None:
    """And one with runs lies inside its interval."""
    assert rate_row("a", Rate(0, 0)).rate == "no result yet"
    row = rate_row("a", Rate(3, 4))
    assert row.low < row.share == 75.0 < row.high
