"""The definition of a sweep: what is refused, by file and field."""

import json
from pathlib import Path

import pytest

from footfall.diagrams.sweep.definition import (
    Range,
    SweepError,
    load_sweep_file,
    sweep_from_json,
    sweep_to_json,
)


def test_a_definition_is_read(tmp_path: Path) -> None:
    """Ranges, lists, seeds by number; a file beside it by its path."""
    (tmp_path / "own.yaml").write_text("scene: {}")
    file = tmp_path / "study.yaml"
    file.write_text(
        "scenario: own.yaml\n"
        "set: [task.mode=dynamic]\n"
        "fields:\n"
        "  scene.staircase.rise: {from: 0.1, to: 0.2, levels: 3}\n"
        "  scene.staircase.steps: {from: 2, to: 4}\n"
        "  scene.staircase.closed_risers: [true, false]\n"
        "seeds: 2\n"
        "cases: {walk: [], creep: [task.mode=quasi_static]}\n"
        "group_by: [scene.staircase.rise, case]\n"
        "show: [climb_time_s]\n"
    )
    sweep = load_sweep_file(file)
    assert sweep.scenario == str(tmp_path / "own.yaml")
    assert sweep.seeds == (0, 1)
    assert dict(sweep.fields) == {
        "scene.staircase.rise": Range(0.1, 0.2, 3),
        "scene.staircase.steps": Range(2, 4, None, whole=True),
        "scene.staircase.closed_risers": (True, False),
    }
    assert sweep.cases == (("walk", ()), ("creep", ("task.mode=quasi_static",)))
    assert sweep.show == ("climb_time_s",)
    assert (sweep.name, sweep.keep) == ("study", "failures")
    assert sweep_from_json(json.loads(json.dumps(sweep_to_json(sweep)))) == sweep


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[]", "must hold the fields of a sweep"),
        ("scenario: [", "line 1: not YAML"),
        ("fields: {}", "scenario: must name a scenario or a file"),
        ("scenario: a\ncolour: red", "colour: no such field; there are scenario, set"),
        ("scenario: a\nfields: {x: 3}", r"fields\.x: must be a list, or a range"),
        ("scenario: a\nfields: {x: []}", r"fields\.x: must have at least one element"),
        ("scenario: a\nfields: {x: {from: 1}}", r"fields\.x\.to: must be given"),
        (
            "scenario: a\nfields: {x: {from: 2, to: 1}}",
            r"fields\.x\.to: must exceed from, 2, got 1",
        ),
        (
            "scenario: a\nfields: {x: {from: 0.1, to: 0.2}}",
            r"fields\.x\.levels: must be given for a grid",
        ),
        ("scenario: a\nfields: {x: {min: 1}}", r"a range has from, to and levels, got"),
        ("scenario: a\ncount: 3", "count: a grid has as many runs as it has points"),
        ("scenario: a\nsampling: sobol", "sampling: must be one of grid, random, lat"),
        ("scenario: a\nseeds: [-1]", r"seeds\[0\]: must be a whole number of 0 to"),
        ("scenario: a\ngroup_by: [x]", "group_by: x is none of the fields varied"),
        ("scenario: a\ngroup_by: [case]", "group_by: case is none of the fields"),
        ("scenario: a\ncases: [x]", "cases: must hold names of cases and what is set"),
        ("scenario: a\ncases: {x: a=1}", r"cases\.x: must be a list of texts"),
        ("scenario: a\nshow: [hope]", "show: hope is no figure of a summary"),
        ("scenario: a\ntimeout: 0", "timeout: must be finite and at least 1, got 0"),
        ("scenario: a\nkeep: some", "keep: must be one of all, failures, none, got"),
    ],
)
def test_what_is_wrong_is_told(tmp_path: Path, text: str, message: str) -> None:
    """In one line, with file and field."""
    file = tmp_path / "bad.yaml"
    file.write_text(text)
    with pytest.raises(SweepError, match=message) as told:
        load_sweep_file(file)
    assert str(told.value).startswith(f"{file}: ")
    assert "\n" not in str(told.value)


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    """By its name."""
    with pytest.raises(SweepError, match=r"none\.yaml: no such file"):
        load_sweep_file(tmp_path / "none.yaml")
