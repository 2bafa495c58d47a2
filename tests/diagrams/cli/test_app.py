"""The command line: exit status, one-line errors, what it writes and prints."""

import json
import math
import shlex
import sys
from types import ModuleType

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from footfall.diagrams.cli.app import COMMANDS as ALL_COMMANDS
from footfall.diagrams.cli.app import app
from footfall.diagrams.cli.arguments import complete_scenario
from footfall.diagrams.cli.run import LOCAL_HOST
from footfall.diagrams.cli.segment import SLOPE
from footfall.diagrams.figures.live_view import LOCAL_HOST as DEFAULT_HOST
from footfall.diagrams.scenario import save_scenario
from footfall.diagrams.shipped import list_scenarios
from footfall.diagrams.signals import load_run
from footfall.models.values.planned import TaskStatus
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams

COMMANDS = (
    *("list", "run", "segment", "plot", "replay", "render", "diagram"),
    *("check-robot", "report"),
)


def footfall(*arguments: object):
    """Runs the command line; gives exit code, stdout, stderr."""
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def stand(monkeypatch, standing, tmp_path):
    """Makes every scenario a robot that stands; gives the path of one."""
    tasks = ModuleType("footfall.diagrams.closed_loop.tasks")
    tasks.last = TaskStatus("finished", "stand", "stood")

    def build_task(scenario, meshcat=None):
        return standing.task(end=0.1, last=tasks.last)

    tasks.build_task = build_task
    monkeypatch.setitem(sys.modules, "footfall.diagrams.closed_loop.tasks", tasks)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "standing.yaml"
    save_scenario(standing.scenario(), path)
    return path


def test_help_names_every_command_and_the_exit_status() -> None:
    """And needs nothing that takes long to import."""
    result = footfall("--help")
    assert result.exit_code == 0
    assert all(command in result.stdout for command in COMMANDS)
    assert "Exit status" in result.stdout
    for command in COMMANDS:
        assert footfall(command, "--help").exit_code == 0


@pytest.mark.parametrize(
    "example", [line for _, _, examples in ALL_COMMANDS for line in examples]
)
def test_examples_can_be_typed(example) -> None:
    """Each is in the help text of its command, whose options it uses right."""
    program, name, *arguments = shlex.split(example)
    assert program == "footfall"
    command = typer.main.get_command(app).commands[name]
    command.make_context(name, list(arguments))
    shown = " ".join(footfall(name, "--help").stdout.replace("│", "").split())
    assert " ".join(example.split()) in shown


def test_the_shell_completes_scenarios(tmp_path, monkeypatch) -> None:
    """Shipped ones by name, files and folders by path."""
    (tmp_path / "rooms").mkdir()
    (tmp_path / "rooms" / "mine.yaml").touch()
    (tmp_path / "rooms" / "notes.txt").touch()
    monkeypatch.chdir(tmp_path)
    assert complete_scenario("room") == ["room", "room-moving", "rooms/"]
    assert complete_scenario("rooms/") == ["rooms/mine.yaml"]
    assert complete_scenario("nowhere/") == []
    words = {"COMP_WORDS": "footfall run obstacle-1", "COMP_CWORD": "2"}
    result = CliRunner().invoke(
        app, env={"_FOOTFALL_COMPLETE": "complete_bash", **words}, prog_name="footfall"
    )
    assert result.stdout.split() == ["obstacle-15cm"]


def test_list_has_a_line_a_scenario() -> None:
    """Name first."""
    lines = footfall("list").stdout.splitlines()
    assert [line.split()[0] for line in lines] == [name for name, _ in list_scenarios()]
    assert all(line.split(maxsplit=1)[1] for line in lines)


def test_run_writes_the_run_folder(stand, tmp_path) -> None:
    """All that the design lists, and the summary on stdout."""
    result = footfall("run", stand, "--seed", 5, "--out", tmp_path / "out")
    assert result.exit_code == 0, result.output
    run = load_run(tmp_path / "out")
    assert (run.summary["outcome"], run.summary["seed"]) == ("completed", 5)
    assert run.scenario.simulation.seed == 5
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        *("scenario.yaml", "summary.json", "signals", "replay.html", "figures"),
        "diagram.svg",
    }
    assert result.stdout.startswith("completed: the robot rests")
    assert "max_torque_fraction" in result.stdout
    assert "climb_time_s" in result.stdout
    assert "not measured" in result.stdout


def test_a_scenario_written_by_a_run_runs_again(stand, tmp_path) -> None:
    """Under its own name, with every field resolved."""
    quick = ("--no-draw", "--out")
    footfall("run", stand, "--set", "simulation.max_time=0.3", *quick, "a")
    again = tmp_path / "a" / "scenario.yaml"
    assert footfall("run", again, *quick, "b").exit_code in (0, 1)
    assert load_run(tmp_path / "b").scenario == load_run(tmp_path / "a").scenario


def test_default_folders_are_numbered(stand, tmp_path) -> None:
    """No run is ever written over another."""
    for _ in range(2):
        assert footfall("run", stand, "--no-draw").exit_code == 0
    names = sorted(path.name for path in (tmp_path / "runs").iterdir())
    assert names == ["standing-seed0", "standing-seed0-2"]


def test_a_task_that_was_not_done_is_status_1(stand, tmp_path) -> None:
    """Its reason is printed and in the summary."""
    sys.modules["footfall.diagrams.closed_loop.tasks"].last = TaskStatus(
        "infeasible", "plan", "too high"
    )
    result = footfall("run", stand, "--out", tmp_path / "out")
    assert result.exit_code == 1
    assert result.stdout.startswith("infeasible: too high")
    assert load_run(tmp_path / "out").summary["reason"] == "too high"


def test_the_reason_stays_one_line_as_it_is(stand, tmp_path) -> None:
    """However long, brackets and all; nothing else is said where no terminal is."""
    reason = " and ".join(f"boxes[{number}] is in the way" for number in range(9))
    sys.modules["footfall.diagrams.closed_loop.tasks"].last = TaskStatus(
        "infeasible", "plan", reason
    )
    result = footfall("run", stand, "--out", tmp_path / "out")
    assert result.stdout.splitlines()[0] == f"infeasible: {reason}"
    assert result.stderr == ""


@pytest.mark.parametrize(
    ("arguments", "names"),
    [
        (("run", "stairs-exp9"), ("stairs-exp9", "no such scenario")),
        (("run", "stairs-exp1", "--set", "scene.stares=1"), ("scene.stares",)),
        (("run", "stairs-exp1", "--set", "simulation.max_time=soon"), ("max_time",)),
        (("run", "nowhere/x.yaml"), ("nowhere/x.yaml", "no such file")),
        (("diagram", "stairs-exp9"), ("stairs-exp9",)),
        (("plot", "nowhere"), ("nowhere", "no such folder")),
        (("replay", "."), ("not a run folder", "scenario.yaml")),
        (("plot", ".", "--format", "png,tiff"), ("--format", "'png,tiff'")),
        (("render", ".", "--video", "v.avi"), ("--video v.avi", "end with .mp4")),
        (
            ("sweep", "x.yaml", "--jobs", "2", "--scheduler", "tcp://h:1"),
            ("--jobs", "as many as its workers' threads"),
        ),
        (("report", "."), ("neither a run's folder nor a sweep's",)),
        (("segment", "nowhere.pcd"), ("nowhere.pcd",)),
        (("segment", "x.pcd", "--gravity", "0,0"), ("--gravity", "'0,0'")),
        (("segment", "x.pcd", "--gravity", "0,0,0"), ("--gravity",)),
        (("segment", "x.pcd", "--slope", "90"), ("--slope", "got 90")),
        (("segment", "x.pcd", "--slope", "0"), ("--slope", "between 0 and 90")),
        (("segment", "x.pcd", "--slope", "nan"), ("--slope", "got nan")),
        (("run", "stairs-exp1", "--out", "."), ("--out .", "not an empty folder")),
        (
            ("run", "stairs-exp1", "--out", "standing.yaml/x"),
            ("--out standing.yaml/x", "cannot be written"),
        ),
    ],
)
def test_bad_input_is_one_line_and_status_2(stand, arguments, names) -> None:
    """It names the file and the field, without a traceback."""
    result = footfall(*arguments)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    assert line.startswith("footfall: ")
    assert all(name in line for name in names)
    assert "Traceback" not in result.output


def test_an_empty_cloud_is_bad_input(tmp_path) -> None:
    """Named by its file."""
    cloud = tmp_path / "empty.xyz"
    cloud.write_text("")
    result = footfall("segment", cloud, "--out", tmp_path / "out")
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    assert "empty.xyz" in line


def test_a_cloud_without_planes_says_what_is_likely(tmp_path) -> None:
    """What was seen and a question, below the count; neither where planes are."""
    x, y = (v.ravel() for v in np.meshgrid(*2 * [np.arange(0.0, 1.0, 0.01)]))
    level = np.column_stack([x, y, 0.0 * x])
    said = {}
    for name, scale in (("metres", 1.0), ("millimetres", 1000.0)):
        np.save(tmp_path / f"{name}.npy", scale * level)
        result = footfall("segment", tmp_path / f"{name}.npy", "--out", tmp_path / name)
        assert result.exit_code == 0, result.output
        said[name] = result.stdout
    assert said["millimetres"].splitlines()[:3] == [
        "10000 points: 0 planes, 0 treads",
        "  10,000 points in 990 x 990 x 0 m, typically 10 m apart",
        "  it is 970 m across with points 10 m apart: are these centimetres or "
        "millimetres?",
    ]
    assert "are these" not in said["metres"]


def test_the_slope_decides_which_planes_are_kept(tmp_path) -> None:
    """One of 20 degrees is too steep by default, as for `PlaneSegmenterParams`."""
    assert math.radians(SLOPE) == pytest.approx(PlaneSegmenterParams().slope_tolerance)
    x, y = (v.ravel() for v in np.meshgrid(*2 * [np.arange(0.0, 1.0, 0.01)]))
    cloud = tmp_path / "ramp.xyz"
    np.savetxt(cloud, np.column_stack([x, y, math.tan(math.radians(20.0)) * x]))
    found = {}
    for slope in (SLOPE, 25.0):
        out = tmp_path / str(slope)
        result = footfall("segment", cloud, "--slope", slope, "--out", out)
        assert result.exit_code == 0, result.output
        found[slope] = len(json.loads((out / "planes.json").read_text())["planes"])
    assert found == {SLOPE: 0, 25.0: 1}


def test_a_programming_error_is_no_bad_input(stand, monkeypatch) -> None:
    """It keeps its traceback."""

    def broken(*_: object, **__: object) -> None:
        raise AssertionError("a bug")

    monkeypatch.setattr(
        sys.modules["footfall.diagrams.closed_loop.tasks"], "build_task", broken
    )
    with pytest.raises(AssertionError, match="a bug"):
        CliRunner().invoke(app, ["run", str(stand)], catch_exceptions=False)


def test_meshcat_listens_where_it_is_told(stand, tmp_path, monkeypatch) -> None:
    """On this machine by default; an interface that is not there is named."""
    seen = []

    def meshcat_at(host):
        if host == "192.0.2.1":
            raise RuntimeError("no such interface")
        seen.append(host)

    monkeypatch.setattr("footfall.diagrams.figures.live_view.meshcat_at", meshcat_at)
    quick = ("--no-draw", "--out")
    footfall("run", stand, *quick, "a", "--meshcat")
    footfall("run", stand, *quick, "b", "--meshcat", "--meshcat-host", "*")
    footfall("run", stand, *quick, "c")
    assert seen == [LOCAL_HOST, "*"]
    assert LOCAL_HOST == DEFAULT_HOST
    result = footfall("run", stand, "--meshcat", "--meshcat-host", "192.0.2.1")
    assert result.exit_code == 2
    assert result.stderr == "footfall: --meshcat-host 192.0.2.1: no such interface\n"


def test_ctrl_c_before_anything_is_simulated(stand, monkeypatch) -> None:
    """Status 130, and that is all that is said."""

    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(
        sys.modules["footfall.diagrams.closed_loop.tasks"], "build_task", interrupted
    )
    result = footfall("run", stand)
    assert (result.exit_code, result.output) == (130, "footfall: interrupted\n")


def test_pictures_of_a_run_are_made_again(stand, tmp_path) -> None:
    """By `plot`, `replay` and `report`; they print the paths, and what is missing."""
    footfall("run", stand, "--out", tmp_path / "out")
    plotted = footfall("plot", tmp_path / "out")
    assert plotted.exit_code == 0
    assert str(tmp_path / "out" / "figures" / "joints.png") in plotted.stdout
    plotted = footfall("plot", tmp_path / "out", "--format", "svg")
    assert str(tmp_path / "out" / "figures" / "joints.svg") in plotted.stdout
    replayed = footfall("replay", tmp_path / "out")
    assert replayed.stdout.strip() == str(tmp_path / "out" / "replay.html")
    (tmp_path / "out" / "signals" / "plant.state.parquet").unlink()
    reported = footfall("report", tmp_path / "out")
    assert (reported.exit_code, reported.stdout) == (0, f"{tmp_path}/out/report.html\n")
    assert reported.stderr.splitlines()[0].startswith("footfall: no film strip: ")


def test_a_video_needs_a_package_of_its_own(tmp_path, monkeypatch) -> None:
    """Which is named where it is missing."""
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.delitem(sys.modules, "footfall.diagrams.figures.video", raising=False)
    result = footfall("render", tmp_path, "--video", "v.mp4")
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    assert line.endswith("needs imageio-ffmpeg: pip install 'footfall[video]'")


def test_diagram_is_written(stand, tmp_path) -> None:
    """Where asked, and by default beside."""
    result = footfall("diagram", stand, "--out", tmp_path / "deep" / "d.svg")
    assert result.exit_code == 0
    assert (tmp_path / "deep" / "d.svg").read_text().startswith("<?xml")
    footfall("diagram", stand)
    assert (tmp_path / "standing.svg").exists()
