"""What the command line answers in rooms that cannot be crossed: status and line."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from footfall.diagrams.cli.app import app
from footfall.diagrams.signals import load_run

ROOM = """<environment>
  <floor>
    <vertex x="-5" y="-3"/> <vertex x="5" y="-3"/>
    <vertex x="5" y="3"/> <vertex x="-5" y="3"/>
  </floor>
  <box name="bucket">
    <center x="2.5" y="0.1" z="0.2"/>
    <size x="0.4" y="{depth}" z="0.4"/>
  </box>
</environment>
"""


@pytest.fixture
def cross(monkeypatch, tmp_path):
    """Runs a room whose clutter is replaced by what is set, without its pictures."""
    monkeypatch.setattr(
        "footfall.diagrams.figures.illustrations.illustrate", lambda *_: []
    )
    monkeypatch.chdir(tmp_path)

    def run(*changes: str) -> Result:
        options = [part for change in changes for part in ("--set", change)]
        arguments = ["run", "room", "--out", "out", "--set", "scene.clutter=null"]
        return CliRunner().invoke(app, [*arguments, *options])

    return run


@pytest.mark.parametrize(
    ("changes", "answer"),
    [
        (
            [
                "scene.boxes=[{name: bin, x: 1, y: 0, size: [0.5, 0.5, 0.5]}]",
                "task.goal=[1, 0, 0]",
            ],
            "the goal (1.00, 0.00) m is inside box_",
        ),
        (["task.goal=[9, 0, 0]"], "the goal (9.00, 0.00) m is outside the floor that"),
        (
            ["scene.boxes=[{name: bin, x: -2.1, y: 0, size: [0.2, 0.5, 0.5]}]"],
            "the start (-2.50, 0.00) m is in collision: 0.3",
        ),
        (["sensors.camera.target=[0, -0.8, 3]"], "no floor in view: "),
        (
            ["scene.boxes=[{name: shelf, x: 0, y: 0, size: [0.4, 6.6, 0.5]}]"],
            "no path exists: boxes and the floor's edge cut the goal off",
        ),
    ],
    ids=["goal in a box", "outside", "start in collision", "no floor", "no way"],
)
def test_what_cannot_be_done_is_said(cross, changes: list[str], answer: str) -> None:
    """Exit status 1, the reason first, and the run folder is there to look into."""
    result = cross(*changes)
    assert result.exit_code == 1
    assert result.stdout.startswith(f"infeasible: {answer}"), result.output
    summary = load_run("out").summary
    assert summary["outcome"] == "infeasible"
    assert summary["footsteps"] == 0
    assert summary["simulated_time_s"] < 1.0


def test_clutter_that_has_no_room_is_bad_input(cross) -> None:
    """Exit status 2, and nothing is run."""
    result = cross("scene.clutter={min_count: 60, max_count: 60}")
    assert result.exit_code == 2
    assert "scene.clutter: max_count: no room for 60 boxes" in result.stderr
    assert not Path("out").exists()


def test_an_environment_by_hand_takes_the_cameras_place(cross) -> None:
    """Its boxes are believed, under their names, though nothing stands there."""
    Path("room.xml").write_text(ROOM.format(depth=0.3))
    result = cross("task.environment=room.xml")
    assert result.exit_code == 1
    assert result.stdout.startswith(
        "infeasible: the goal (2.50, 0.00) m is inside bucket"
    )
    run = load_run("out")
    assert run.summary["perception"] is None
    # Nothing has to be made out in a file: it is planned on as soon as the robot looks.
    begun = [
        time for time, v in run.values("executive.status") if v["activity"] == "plan"
    ]
    settled = run.scenario.parameters.path_executive.settle_time
    assert begun == [pytest.approx(settled, abs=0.026)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            ROOM.format(depth=-0.3),
            "room.xml:6: box: size must be positive, got 0.4, -0.3",
        ),
        (ROOM[:90], "room.xml:4: not well-formed XML: unclosed token"),
        (None, "room.xml: No such file or directory"),
    ],
)
def test_a_wrong_environment_is_bad_input(cross, text: str, message: str) -> None:
    """Exit status 2, one line with the file and its line."""
    if text is not None:
        Path("room.xml").write_text(text)
    result = cross("task.environment=room.xml")
    assert result.exit_code == 2
    assert result.stderr.startswith(f"footfall: {message}"), result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert not Path("out").exists()
