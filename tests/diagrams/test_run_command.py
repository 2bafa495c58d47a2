"""`footfall run`, ended early: what is kept, printed, and told to the shell."""

import json
import os
import signal
import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest
from pydrake.systems.framework import Context
from typer.testing import CliRunner

import footfall.diagrams.simulation
from footfall.diagrams.cli.app import app
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.scenario import save_scenario
from footfall.diagrams.signals import load_run
from footfall.diagrams.simulation import summarize
from footfall.models.values.planned import TaskStatus
from tests.diagrams.test_signal_files import room_for

BOTH = [(signal.SIGINT, 130), (signal.SIGTERM, 143)]


def footfall_run(*arguments: object):
    """Runs `footfall run`; gives exit code, stdout, stderr."""
    handlers = [signal.getsignal(number) for number, _ in BOTH]
    result = CliRunner().invoke(app, ["run", *map(str, arguments)])
    assert [signal.getsignal(number) for number, _ in BOTH] == handlers
    return result


@pytest.fixture
def stand(monkeypatch, standing, tmp_path):
    """Makes every scenario a robot that stands for 0.1 s; gives the path of one."""
    tasks = ModuleType("footfall.diagrams.closed_loop.tasks")
    tasks.build_task = lambda scenario, meshcat=None: standing.task(
        0.1, TaskStatus("finished", "stand", "stood")
    )
    monkeypatch.setitem(sys.modules, "footfall.diagrams.closed_loop.tasks", tasks)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "standing.yaml"
    save_scenario(standing.scenario(), path)
    return path


@pytest.mark.parametrize(("number", "status"), BOTH)
def test_a_signal_ends_a_run_in_good_order(
    stand, monkeypatch, tmp_path, number, status
) -> None:
    """It is judged as interrupted, printed, not drawn; one line says so."""
    task_status = TaskDiagram.task_status

    def look(task: TaskDiagram, context: Context) -> TaskStatus:
        os.kill(os.getpid(), number)
        return task_status(task, context)

    monkeypatch.setattr(TaskDiagram, "task_status", look)
    result = footfall_run(stand, "--out", "out")
    assert result.exit_code == status
    assert result.stdout.startswith("interrupted: interrupted at 0.05 s")
    (line,) = result.stderr.splitlines()
    assert line == "footfall: interrupted; `footfall plot out` draws what is missing"
    run = load_run("out")
    assert run.summary["outcome"] == "interrupted"
    assert len(run.signals["plant.state"]) >= 10
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        *("scenario.yaml", "summary.json", "signals")
    }


@pytest.mark.parametrize(("number", "status"), BOTH)
def test_a_signal_while_it_is_judged_loses_nothing(
    stand, monkeypatch, tmp_path, number, status
) -> None:
    """The run was over: it is what it was. It is not drawn any more."""

    def judge(*arguments: object):
        os.kill(os.getpid(), number)
        return summarize(*arguments)

    monkeypatch.setattr(footfall.diagrams.simulation, "summarize", judge)
    result = footfall_run(stand, "--out", "out")
    assert result.exit_code == status
    assert result.stdout.startswith("completed: ")
    assert len(result.stderr.splitlines()) == 1
    assert load_run("out").summary["outcome"] == "completed"
    assert not (tmp_path / "out" / "figures").exists()


@pytest.mark.parametrize(("number", "status"), BOTH)
def test_a_signal_while_it_is_drawn_keeps_what_there_is(
    stand, monkeypatch, tmp_path, number, status
) -> None:
    """Summary printed, replay and block diagram there, no half picture; one line."""

    def print_png(_: object, path: str) -> None:
        open(path, "w").close()
        os.kill(os.getpid(), number)

    monkeypatch.setattr(
        "footfall.diagrams.figures.run_figures.FigureCanvasAgg.print_png", print_png
    )
    result = footfall_run(stand, "--out", "out")
    assert result.exit_code == status
    assert result.stdout.startswith("completed: ")
    assert len(result.stderr.splitlines()) == 1
    assert load_run("out").summary["outcome"] == "completed"
    assert (tmp_path / "out" / "replay.html").exists()
    assert (tmp_path / "out" / "diagram.svg").exists()
    assert list((tmp_path / "out" / "figures").iterdir()) == []


def test_the_summary_is_printed_before_anything_is_drawn(stand, monkeypatch) -> None:
    """And written."""

    def illustrate(folder, _: object) -> list[str]:
        print("drawing a run that is", load_run(folder).summary["outcome"])
        return []

    monkeypatch.setattr("footfall.diagrams.run_command.illustrate", illustrate)
    lines = footfall_run(stand).stdout.splitlines()
    assert lines[0].startswith("completed: ")
    assert lines[-1] == "drawing a run that is completed"


def test_a_signal_before_the_simulation_leaves_no_folder(
    stand, monkeypatch, tmp_path
) -> None:
    """One line and no traceback."""
    monkeypatch.setattr(
        sys.modules["footfall.diagrams.closed_loop.tasks"],
        "build_task",
        lambda *_: os.kill(os.getpid(), signal.SIGTERM),
    )
    result = footfall_run(stand)
    assert (result.exit_code, result.stdout) == (143, "")
    assert result.stderr == "footfall: interrupted\n"
    assert [path.name for path in tmp_path.iterdir()] == ["standing.yaml"]


def test_a_disk_that_fills_up_is_status_1_and_one_line(stand) -> None:
    """It names the folder."""
    with room_for(30_000):
        result = footfall_run(stand, "--out", "out")
    assert (result.exit_code, result.stdout) == (1, "")
    assert isinstance(result.exception, SystemExit)
    (line,) = result.stderr.splitlines()
    assert line.startswith("footfall: out: cannot be written to at 0.5")
    assert load_run("out").summary["outcome"] == "cut"


def test_without_a_terminal_progress_is_a_line_now_and_then(stand, monkeypatch) -> None:
    """With what the robot is doing."""
    monkeypatch.setattr("footfall.diagrams.run_command.TOLD_EVERY", 0.25)
    lines = footfall_run(stand).stderr.splitlines()
    assert lines[:2] == [
        "0.25 s of at most 1 s: stand",
        "0.5 s of at most 1 s: stand",
    ]
    times = [float(line.partition(" ")[0]) for line in lines]
    assert times == [0.25 * (number + 1) for number in range(len(times))]


def test_the_default_folder_tells_what_was_set(stand, tmp_path) -> None:
    """Numbered where the same is run again."""
    for _ in range(2):
        footfall_run(stand, "--set", "simulation.max_time=0.3", "--seed", 2)
    assert sorted(path.name for path in (tmp_path / "runs").iterdir()) == [
        "standing-seed2-simulation.max_time=0.3",
        "standing-seed2-simulation.max_time=0.3-2",
    ]


def test_a_run_need_not_be_drawn(stand, monkeypatch) -> None:
    """It is simulated, judged and printed all the same."""

    def illustrate(folder, _: object) -> list[str]:
        raise AssertionError("drawn")

    monkeypatch.setattr("footfall.diagrams.run_command.illustrate", illustrate)
    result = footfall_run(stand, "--no-draw")
    assert result.exit_code == 0
    assert "completed" in result.stdout


def test_several_scenarios_are_run_one_after_the_other(
    stand, standing, tmp_path
) -> None:
    """Each in a folder of its own; one that is not done is status 1."""
    short = tmp_path / "short.yaml"
    save_scenario(replace(standing.scenario(max_time=0.05), name="short"), short)
    result = footfall_run(stand, short, "--no-draw", "--out", "both")
    assert result.exit_code == 1
    assert {path.name for path in (tmp_path / "both").iterdir()} == {
        "standing-seed0",
        "short-seed0",
    }
    assert load_run("both/short-seed0").summary["outcome"] == "timed_out"
    heads = [line for line in result.stderr.splitlines() if "/2  " in line]
    assert heads == ["1/2  standing", "2/2  short"]
    assert "timed_out: not done after 0.05 s" in result.stdout


def test_none_is_run_where_one_cannot_be_read(stand, tmp_path) -> None:
    """Told before the first."""
    result = footfall_run(stand, "nowhere/x.yaml")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "nowhere/x.yaml: no such file" in result.stderr
    assert not (tmp_path / "runs").exists()


def test_what_follows_a_run_that_is_ended_is_not_run(stand, monkeypatch) -> None:
    """Ctrl-C means all of it."""
    task_status = TaskDiagram.task_status

    def look(task: TaskDiagram, context: Context) -> TaskStatus:
        os.kill(os.getpid(), signal.SIGINT)
        return task_status(task, context)

    monkeypatch.setattr(TaskDiagram, "task_status", look)
    result = footfall_run(stand, stand, "--out", "both")
    assert result.exit_code == 130
    assert [path.name for path in Path("both").iterdir()] == ["standing-seed0"]


def test_a_quiet_run_says_one_line(stand, monkeypatch) -> None:
    """No progress; what could not be drawn is told all the same."""
    monkeypatch.setattr("footfall.diagrams.run_command.TOLD_EVERY", 0.25)
    monkeypatch.setattr(
        "footfall.diagrams.run_command.illustrate", lambda *_: ["no replay: why"]
    )
    result = footfall_run(stand, "--quiet", "--out", "out")
    assert result.exit_code == 0
    (line,) = result.stdout.splitlines()
    assert line.startswith("standing: completed: the robot rests")
    assert line.endswith("; out")
    assert result.stderr == "footfall: no replay: why\n"


def test_json_is_the_summary_in_a_line(stand) -> None:
    """With where it lies; nothing else is on stdout."""
    result = footfall_run(stand, "--no-draw", "--json", "--out", "out")
    (line,) = result.stdout.splitlines()
    summary = json.loads(Path("out/summary.json").read_text())
    assert json.loads(line) == {"folder": "out", **summary}
