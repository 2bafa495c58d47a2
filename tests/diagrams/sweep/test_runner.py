"""Carrying a sweep out: what dies, what hangs, what is cut, and the table it gives."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from footfall.diagrams.sweep.definition import Sweep, SweepError
from footfall.diagrams.sweep.figures import draw_sweep
from footfall.diagrams.sweep.pools import LocalPool
from footfall.diagrams.sweep.runner import JobEnd, command_of, run_sweep
from footfall.diagrams.sweep.sampling import jobs_of
from footfall.diagrams.sweep.sweep_folder import load_sweep
from footfall.diagrams.sweep.table import (
    Rate,
    make_table,
    rate_of,
    report,
    write_tables,
)
from footfall.diagrams.sweep_command import sweep_scenario

STAND_IN = (sys.executable, str(Path(__file__).with_name("stand_in.py")))
SWEEP = Sweep(
    name="study",
    scenario="stairs-exp1",
    fields=(
        ("scene.staircase.rise", (0.1, 0.2)),
        ("scene.staircase.steps", (2, 5)),
    ),
    seeds=(0, 1, 2),
)
FAULTY = replace(
    SWEEP,
    fields=(("scene.staircase.steps", (2, 3, 4, 6, 7, 8, 9)),),
    seeds=(0,),
    timeout=3.0,
)


def pool(count: int) -> LocalPool:
    """Processes of this machine that only stand in."""
    return LocalPool(count, STAND_IN)


def tried(folder: Path) -> list[str]:
    """Which runs were begun."""
    return (folder / "tried").read_text().split()


def test_every_run_has_a_row(tmp_path: Path) -> None:
    """Success by group, and the command of each failure."""
    told = []
    ends = run_sweep(SWEEP, tmp_path / "s", pool(2), lambda *a: told.append(a))
    assert len(ends) == len(told) == 12
    assert told[-1][1:] == (12, 12)
    table = write_tables(SWEEP, tmp_path / "s")
    assert list(table["run"]) == list(range(12))
    assert rate_of(table) == Rate(6, 12)
    text = report(SWEEP, table)
    assert "Success: 6 of 12, 50 % (25 to 75 %)." in text
    assert "| 0.1 | 6 of 6, 100 % (61 to 100 %) |" in text
    failed = jobs_of(SWEEP)[-1]
    assert f"`{command_of(SWEEP, failed)}`" in text
    assert command_of(SWEEP, failed) == (
        "footfall run stairs-exp1 --seed 2 --set scene.staircase.rise=0.2 "
        "--set scene.staircase.steps=5"
    )
    back = load_sweep(tmp_path / "s")
    pd.testing.assert_frame_equal(back.table, table, check_dtype=False)
    assert list(back.costs["memory_mb"]) == [2.0] * 12
    assert back.report == text
    drawn = draw_sweep(SWEEP, table, tmp_path / "s")
    assert {one.path.name for one in drawn} >= {"success-scene.staircase.rise.png"}
    assert all(one.path.stat().st_size > 5000 for one in drawn)


def test_cases_have_a_column_and_figures_are_shown(tmp_path: Path) -> None:
    """Success is counted by case where nothing else is asked for."""
    cases = (("low", ("scene.staircase.rise=0.1",)), ("high", ()))
    sweep = replace(
        SWEEP,
        cases=cases,
        fields=(),
        seeds=(0, 1),
        changes=("scene.staircase.rise=0.2",),
        show=("climb_time_s", "max_foot_slip_m"),
    )
    run_sweep(sweep, tmp_path / "s", pool(2))
    table = write_tables(sweep, tmp_path / "s")
    assert list(table["case"]) == ["low", "low", "high", "high"]
    assert list(table["outcome"]) == ["completed"] * 2 + ["fell"] * 2
    text = report(sweep, table)
    assert "## By `case`\n\n| | success |\n|---|---|\n| low | 2 of 2" in text
    assert "| 1 | low | 1 | completed | 2 |  |" in text
    assert load_sweep(tmp_path / "s").sweep == sweep


def test_what_dies_or_hangs_is_told_and_the_rest_goes_on(tmp_path: Path) -> None:
    """It has no result, and is tried again; a worker that is gone is begun again."""
    folder = tmp_path / "s"
    ends = {e.job.number: e for e in run_sweep(FAULTY, folder, pool(2))}
    assert [ends[n].end for n in range(7)] == [
        *("done", "died", "hung", "died", "died", "died", "done")
    ]
    assert ends[1].reason == "exit status 3: a bad day"
    assert "within 3 s" in ends[2].reason
    assert "exit status 1: OSError: [Errno 28] No space left" in ends[3].reason
    assert ends[4].reason == "exit status -9: it said nothing"
    assert ends[5].reason == "its worker, -9: it said nothing"
    table = make_table(FAULTY, folder)
    none = ["no result"] * 5
    assert list(table["outcome"]) == ["completed", *none, "completed"]
    assert "Without a result: 5" in report(FAULTY, table)
    run_sweep(FAULTY, folder, pool(3))
    again = [f"{number:05d}" for number in range(1, 6)]
    assert sorted(tried(folder)) == sorted(["00000", "00006", *again, *again])


def test_a_result_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    """The disk is full for one of twelve, which is tried again."""
    folder, told = tmp_path / "s", []

    def fill(ended: JobEnd, done: int, of: int) -> None:
        told.append(ended)
        if done == 1:
            (folder / "results" / "00004.json.partial").symlink_to("/dev/full")

    run_sweep(SWEEP, folder, pool(1), fill)
    assert [ended.end for ended in told].count("done") == 11
    assert told[4].reason.startswith("its result cannot be written: [Errno 28]")
    assert [e.job.number for e in run_sweep(SWEEP, folder, pool(1))] == [4]


def test_a_sweep_that_was_cut_gives_the_same_table(tmp_path: Path) -> None:
    """Byte for byte, though some of its runs were made before; none is made twice."""
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    run_sweep(SWEEP, whole, pool(2))
    run_sweep(SWEEP, cut, pool(2))
    for number in (3, 7, 8):
        (cut / "results" / f"{number:05d}.json").unlink()
    (cut / "results" / "00009.json").write_text('{"key": "half')
    run_sweep(SWEEP, cut, pool(2))
    assert sorted(tried(cut)) == sorted(
        [*(f"{n:05d}" for n in range(12)), "00003", "00007", "00008", "00009"]
    )
    for folder in (whole, cut):
        write_tables(SWEEP, folder)
    for name in ("table.parquet", "report.md"):
        assert (whole / name).read_bytes() == (cut / name).read_bytes()


def test_a_folder_of_another_sweep_is_refused(tmp_path: Path) -> None:
    """And one that holds something else."""
    run_sweep(SWEEP, tmp_path / "s", pool(2))
    with pytest.raises(SweepError, match="holds another sweep than study"):
        run_sweep(replace(SWEEP, seeds=(5,)), tmp_path / "s", pool(2))
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "mine.txt").write_text("mine")
    with pytest.raises(SweepError, match="is not an empty folder"):
        run_sweep(SWEEP, tmp_path / "other", pool(2))


def test_what_a_scenario_refuses_is_told_before_anything_runs(tmp_path: Path) -> None:
    """By the sweep's file, the run and the field."""
    file = tmp_path / "study.yaml"
    file.write_text(
        "scenario: stairs-exp1\nfields: {scene.staircase.rise: [0.1, -0.1]}"
    )
    with pytest.raises(SweepError, match=r"study\.yaml: run 1: .*rise: must be pos"):
        sweep_scenario(file, tmp_path / "s", pool(1), print)
    assert not (tmp_path / "s").exists()


def descendants(pid: int) -> set[int]:
    """The processes that a process has begun, and those that they have."""
    found: set[int] = set()
    for threads in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in map(int, threads.read_text().split()):
            found |= {child} | descendants(child)
    return found


def assert_gone(pids: set[int], within: float) -> None:
    """None of these processes lives on, s."""
    end = time.monotonic() + within
    while alive := {pid for pid in pids if Path(f"/proc/{pid}/exe").exists()}:
        assert time.monotonic() < end, alive
        time.sleep(0.05)


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_ctrl_c_ends_what_goes_on(tmp_path: Path) -> None:
    """Exit status 130, one line that says how it goes on, and no process is left."""
    file = tmp_path / "stand.yaml"
    file.write_text("scenario: stand\nset: [task.stand_time=60.0]\nseeds: 2\n")
    command = [sys.executable, "-m", "footfall", "sweep", str(file), "--jobs", "2"]
    process = subprocess.Popen(
        [*command, "--out", str(tmp_path / "s")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    runs = tmp_path / "s" / "runs"
    while not (runs.exists() and len(list(runs.iterdir())) == 2):
        assert process.poll() is None
        time.sleep(0.05)
    begun = descendants(process.pid)
    assert len(begun) == 4  # two workers, and a run of each
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=30.0)
    assert process.returncode == 130
    assert said == (
        "",
        "footfall: interrupted; the same command goes on where it was\n",
    )
    assert_gone(begun, 5.0)


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_real_runs_killed_half_way_and_resumed(tmp_path: Path) -> None:
    """By SIGKILL, workers and runs go too; the same command goes on to the same table.

    That is the table of a sweep that nobody cut, byte for byte.
    """
    file = tmp_path / "stand.yaml"
    file.write_text(
        "scenario: stand\nfields: {task.stand_time: [0.1, 0.2, 0.3]}\nkeep: none\n"
    )
    folder, whole = tmp_path / "s", tmp_path / "whole"
    command = [sys.executable, "-m", "footfall", "sweep", str(file), "--jobs", "1"]
    first = subprocess.Popen([*command, "--out", str(folder)], start_new_session=True)
    results = folder / "results"
    while not (results.exists() and list(results.iterdir())):
        assert first.poll() is None
        time.sleep(0.05)
    begun = descendants(first.pid)
    assert begun
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    assert_gone(begun, 5.0)
    again = subprocess.run(
        [*command, "--out", str(folder)], capture_output=True, text=True, check=True
    )
    assert "3/3  run 2  completed" in again.stdout
    assert "1/3" not in again.stdout
    assert "success: 3 of 3" in again.stdout
    sweep_scenario(file, whole, LocalPool(2), lambda line: None)
    for name in ("table.parquet", "report.md"):
        assert (whole / name).read_bytes() == (folder / name).read_bytes()
    assert list(load_sweep(folder).table["task.stand_time"]) == [0.1, 0.2, 0.3]
    assert not (folder / "runs" / "00000" / "signals").exists()
    assert (folder / "runs" / "00000" / "scenario.yaml").exists()
