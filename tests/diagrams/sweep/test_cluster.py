"""A sweep on a Dask cluster: the table that processes of one machine give."""

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from footfall.diagrams.sweep import pools
from footfall.diagrams.sweep.definition import Sweep, SweepError
from footfall.diagrams.sweep.pools import DaskPool, LocalPool
from footfall.diagrams.sweep.runner import run_sweep
from footfall.diagrams.sweep.table import write_tables

distributed = pytest.importorskip(
    "distributed", reason="Dask is not installed: pip install 'footfall[cluster]'"
)
STAND_IN = (sys.executable, str(Path(__file__).with_name("stand_in.py")))
SWEEP = Sweep(
    name="study",
    scenario="stairs-exp1",
    fields=(
        ("scene.staircase.rise", (0.1, 0.2)),
        ("scene.staircase.steps", (2, 3, 5)),
    ),
    seeds=(0, 1),
)


@pytest.fixture(scope="module")
def cluster() -> Iterator[str]:
    """Two workers, processes of this machine; the address of their scheduler."""
    # What Dask leaves open when it ends is no matter of ours.
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as local:
        yield local.scheduler_address


def test_a_cluster_gives_the_same_table(cluster: str, tmp_path: Path) -> None:
    """Byte for byte, with what died; the second time that alone is tried again."""
    here, there = tmp_path / "here", tmp_path / "there"
    ends = run_sweep(SWEEP, there, DaskPool(cluster, STAND_IN))
    run_sweep(SWEEP, here, LocalPool(2, STAND_IN))
    assert [end.end for end in ends].count("died") == 4
    assert {end.reason for end in ends if end.end == "died"} == {
        "exit status 3: a bad day"
    }
    for folder in (here, there):
        write_tables(SWEEP, folder)
    for name in ("table.parquet", "report.md"):
        assert (here / name).read_bytes() == (there / name).read_bytes()
    assert len(run_sweep(SWEEP, there, DaskPool(cluster, STAND_IN))) == 4


def test_two_real_runs_on_a_cluster(cluster: str, tmp_path: Path) -> None:
    """The robot stands as it does here."""
    sweep = Sweep("stand", "stand", fields=(("task.stand_time", (0.1, 0.2)),))
    ends = run_sweep(sweep, tmp_path / "there", DaskPool(cluster))
    assert [end.end for end in ends] == ["done"] * 2, ends
    run_sweep(sweep, tmp_path / "here", LocalPool(2))
    for folder in ("here", "there"):
        write_tables(sweep, tmp_path / folder)
    here, there = (tmp_path / name / "table.parquet" for name in ("here", "there"))
    assert here.read_bytes() == there.read_bytes()


def test_what_dies_or_hangs_there_is_told(cluster: str, tmp_path: Path) -> None:
    """Also what takes the cluster's worker with it each time; the rest goes on."""
    fields = (("scene.staircase.steps", (4, 5, "cluster")),)
    sweep = replace(SWEEP, fields=fields, timeout=5.0, seeds=(0,))
    ends = {
        end.job.number: end
        for end in run_sweep(sweep, tmp_path / "s", DaskPool(cluster, STAND_IN))
    }
    assert [ends[number].end for number in range(3)] == ["hung", "done", "died"]
    assert ends[2].reason.startswith("KilledWorker: ")


def test_a_cluster_that_is_not_there_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its address."""
    monkeypatch.setattr(pools, "CONNECT_TIMEOUT", 1.0)
    with pytest.raises(SweepError, match=r"--scheduler tcp://127\.0\.0\.1:9: "):
        run_sweep(SWEEP, tmp_path / "s", DaskPool("tcp://127.0.0.1:9", STAND_IN))
    with pytest.raises(SweepError, match="--scheduler nonsense://x: "):
        run_sweep(SWEEP, tmp_path / "s", DaskPool("nonsense://x", STAND_IN))
