"""The samples of a sweep: the same for the same definition, within what is meant."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.sweep.definition import Range, Sweep, SweepError
from footfall.diagrams.sweep.sampling import jobs_of

SWEEP = Sweep(
    name="study",
    scenario="stairs-exp1",
    changes=("a=1",),
    fields=(
        ("rise", Range(0.1, 0.2, 3)),
        ("steps", Range(2, 4, None, whole=True)),
        ("closed", (True, False)),
    ),
    seeds=(0, 7),
)


def test_a_grid_has_every_point_with_every_seed() -> None:
    """In the order of the definition."""
    jobs = jobs_of(SWEEP)
    assert len(jobs) == 3 * 3 * 2 * 2
    assert [job.number for job in jobs] == list(range(36))
    assert jobs[0].changes(SWEEP) == ["a=1", "rise=0.1", "steps=2", "closed=true"]
    assert [job.seed for job in jobs[:3]] == [0, 7, 0]
    assert sorted({dict(job.values)["rise"] for job in jobs}) == [0.1, 0.15, 0.2]


def test_each_case_is_run_with_all_that_varies() -> None:
    """Its changes come after those of the sweep, and before what is drawn."""
    cases = (("flat", ("b=2", "c=3")), ("none", ()))
    sweep = replace(SWEEP, cases=cases, fields=(("steps", (2, 3)),), seeds=(5,))
    jobs = jobs_of(sweep)
    assert [(job.case, dict(job.values)["steps"]) for job in jobs] == [
        *(("flat", 2), ("flat", 3), ("none", 2), ("none", 3))
    ]
    assert jobs[1].changes(sweep) == ["a=1", "b=2", "c=3", "steps=3"]
    assert jobs[2].changes(sweep) == ["a=1", "steps=2"]


@pytest.mark.parametrize("sampling", ["random", "latin_hypercube"])
def test_what_is_drawn_lies_within_and_is_the_same_again(sampling) -> None:
    """Another seed of the draw gives others."""
    sweep = replace(SWEEP, sampling=sampling, count=40, seeds=(0,))
    jobs = jobs_of(sweep)
    assert jobs == jobs_of(sweep)
    assert jobs != jobs_of(replace(sweep, draw_seed=1))
    values = [dict(job.values) for job in jobs]
    rises = np.array([value["rise"] for value in values])
    assert rises.min() >= 0.1
    assert rises.max() <= 0.2
    assert {value["steps"] for value in values} == {2, 3, 4}
    assert {value["closed"] for value in values} == {True, False}
    if sampling == "latin_hypercube":
        counts = np.histogram(rises, np.linspace(0.1, 0.2, 41))[0]
        assert counts.max() <= 2
        assert sum(value["closed"] for value in values) == 20


def test_too_many_runs_are_refused() -> None:
    """Before one of them begins."""
    with pytest.raises(SweepError, match="runs are more than 100000"):
        jobs_of(replace(SWEEP, fields=(("x", Range(1, 200_000, None, whole=True)),)))
