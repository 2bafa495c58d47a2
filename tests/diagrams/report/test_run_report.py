"""A run as a page: whole, true, and needing nothing beside it."""

import base64
import gzip
import json

import pytest

from footfall.diagrams.figures.captions import CAPTIONS
from footfall.diagrams.judge.meanings import summary_meanings
from footfall.diagrams.report.any_report import write_report
from footfall.diagrams.report.run_report import figure_rows, run_sentence
from footfall.diagrams.signals import RunError
from footfall.diagrams.simulation import run_task
from tests.diagrams.report.pages import Page


@pytest.fixture
def run_folder(tmp_path, standing):
    """A run of a moment in front of a staircase."""
    scenario = standing.scenario()
    run_task(standing.task(end=0.01, scene=scenario.scene), scenario, tmp_path / "run")
    return tmp_path / "run"


def test_a_run_is_one_page_that_needs_nothing_beside_it(run_folder) -> None:
    """Sentence, strip, replay, figures with captions, summary, command."""
    path, complaints = write_report(run_folder)
    assert (path, complaints) == (run_folder / "report.html", [])
    page = Page(path)
    assert page.outer_addresses == []
    assert "url(" not in page.scripts["style"]
    summary = json.loads((run_folder / "summary.json").read_text())
    assert run_sentence(summary) in page.text
    pictures = [one for one in page.addresses if one.startswith("data:image/png")]
    names = ("film_strip", "top_view", "side_view", "balance", "feet", "joints")
    assert len(pictures) == len(names)
    for name in names:
        assert f"{CAPTIONS[name].title}." in page.text
    packed = base64.b64decode(page.scripts["replay-data"])
    assert gzip.decompress(packed) == (run_folder / "replay.html").read_bytes()
    for meaning in summary_meanings():
        assert all(name in page.text for name in meaning.names), meaning.names
        assert meaning.text.split("`")[0].strip() in page.text
    assert f"footfall run {run_folder}/scenario.yaml" in page.text
    scenario = (run_folder / "scenario.yaml").read_bytes()
    saved = f"data:text/plain;base64,{base64.b64encode(scenario).decode()}"
    assert saved in page.addresses


def test_a_cut_run_without_its_state_has_a_page_that_says_so(run_folder) -> None:
    """Pictures that cannot be drawn are named, on the page and to the caller."""
    (run_folder / "signals" / "plant.state.parquet").unlink()
    (run_folder / "summary.json").unlink()
    path, complaints = write_report(run_folder)
    assert [line.partition(":")[0] for line in complaints] == [
        *("no film strip", "no replay", "no figures")
    ]
    page = Page(path)
    assert all(f"Not on this page, {line}" in page.text for line in complaints)
    assert "The run broke off: the run was killed" in page.text
    assert "replay-data" not in page.scripts


def test_what_users_name_is_text_on_the_page(run_folder) -> None:
    """A description with markup in it stays what it is."""
    file = run_folder / "scenario.yaml"
    text = file.read_text().replace("description: ''", "description: <b>&amp;</b>")
    assert "<b>" in text
    file.write_text(text)
    (run_folder / "signals" / "plant.state.parquet").unlink()
    path, _ = write_report(run_folder)
    assert "<b>&amp;</b>" in Page(path).text


def test_a_folder_that_holds_neither_is_told(tmp_path) -> None:
    """With what it lacks."""
    with pytest.raises(RunError, match="no such folder"):
        write_report(tmp_path / "nowhere")
    with pytest.raises(RunError, match=r"no scenario\.yaml and no sweep\.json"):
        write_report(tmp_path)


@pytest.mark.parametrize(
    ("summary", "sentence"),
    [
        (
            {
                "outcome": "completed",
                "reason": "both feet rest on the top tread, number 3",
                "footsteps": 9,
                "steps_climbed": 3,
                "obstacles_crossed": None,
                "simulated_time_s": 35.82,
            },
            "The robot did what it was to do: both feet rest on the top tread, number "
            "3. It took 9 footsteps and climbed 3 steps in 35.8 s of simulated time.",
        ),
        (
            {
                "outcome": "fell",
                "reason": "the robot fell at 1.00 s",
                "footsteps": 1,
                "steps_climbed": 0,
                "simulated_time_s": 3,
            },
            "It did not do what it was to do: the robot fell at 1.00 s. It took 1 "
            "footstep in 3.0 s of simulated time.",
        ),
        (
            {"outcome": "infeasible", "reason": "too high", "simulated_time_s": 7.0},
            "The robot refused what it was to do: too high. All of it took 7.0 s of "
            "simulated time.",
        ),
        ({"outcome": "cut", "reason": "killed"}, "The run broke off: killed."),
    ],
)
def test_what_happened_is_said_in_a_sentence(summary, sentence) -> None:
    """Counts that were not taken, or are none, are left out."""
    assert run_sentence(summary) == sentence


def test_figures_that_go_together_share_a_row() -> None:
    """Nested ones are listed one by one; what was not measured says so."""
    rows = figure_rows(
        {
            "max_torque_fraction": 0.51234,
            "max_torque_joint": "L_KNEE",
            "crossing": {"keys": {"a": 1}},
            "replaced": {},
        }
    )
    by_first = {row.values[0][0]: row for row in rows}
    torque = by_first["max_torque_fraction"]
    assert torque.values == (
        ("max_torque_fraction", "0.5123"),
        ("max_torque_joint", "L_KNEE"),
    )
    assert torque.measured
    assert by_first["crossing.keys.a"].measured
    assert by_first["replaced"].values == (("replaced", "none"),)
    assert not by_first["replaced"].measured
    assert by_first["climb_time_s"].values == (("climb_time_s", "not measured"),)
    assert "timing_us" not in by_first
