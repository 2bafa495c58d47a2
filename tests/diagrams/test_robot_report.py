"""`footfall check-robot`: a robot of one's own stands, and what it lacks is told."""

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from footfall.diagrams.cli.app import app
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.robot_report import check_robot
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.simulation import simulate, summarize
from footfall.models.robots.package_paths import find_file
from tests.models.robots.biped import write_biped

DOCS = Path(__file__).resolve().parents[2] / "docs/robots"


def test_a_biped_of_three_lines_stands(tmp_path: Path) -> None:
    """On contact, under the library's servos and stabiliser, its soles held."""
    report = check_robot(write_biped(tmp_path, transmissions=True))
    able = {item.name: item.able for item in report.capabilities}
    assert able == {"stands": True, "walks": True, "sees": False}
    lines = "\n".join(report.lines())
    assert "derived  sole: heel 0.08, toe 0.14, half_width 0.045" in lines
    assert "ignored  friction of " in lines
    assert "transmissions" in lines
    assert "sees     no   head_body: " in lines


def test_the_command_tells_everything_that_is_wrong(tmp_path: Path) -> None:
    """A line each, exit status 2."""
    file = write_biped(tmp_path)
    file.write_text(file.read_text() + "head_body: hed\nswing_joints: [arm]\n")
    result = CliRunner().invoke(app, ["check-robot", str(file)])
    assert result.exit_code == 2
    head, swing = result.stderr.splitlines()
    assert head.startswith(f"footfall: {file}: head_body: there is no link 'hed'")
    assert swing.startswith(f"footfall: {file}: swing_joints: ")


@pytest.mark.parametrize("kind", ["stair_climbing", "obstacle_crossing"])
def test_a_robot_without_eyes_is_refused_where_it_must_see(
    tmp_path: Path, monkeypatch, kind: str
) -> None:
    """In one line that names the field."""
    write_biped(tmp_path)
    monkeypatch.chdir(tmp_path)
    name = "stairs-exp1" if kind == "stair_climbing" else "obstacle-15cm"
    arguments = ["run", name, "--set", "robot=biped.yaml", "--out", "out"]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 2
    assert "head_body: must be given" in result.stderr


def _installed(urdf: str) -> bool:
    try:
        find_file(urdf, DOCS / "none.yaml", {})
    except ValueError:
        return False
    return True


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_published_humanoids_stand(name: str) -> None:
    """93 kg and 33 kg, for two seconds, their soles where they were put."""
    (line,) = (
        line
        for line in (DOCS / f"{name}.yaml").read_text("utf-8").splitlines()
        if line.startswith("urdf: ")
    )
    if not _installed(line.removeprefix("urdf: ")):
        pytest.skip("example-robot-data is not installed")
    scenario = load_scenario(
        "stand", [f"robot={DOCS / name}.yaml", "task.stand_time=2.0"]
    )
    task = build_task(scenario)
    summary = summarize(task, scenario, simulate(task, 10.0))
    assert summary.outcome == "completed"
    assert summary.max_foot_slip_m is not None
    assert summary.max_foot_slip_m < 1e-3
    assert summary.min_zmp_margin_m is not None
    assert summary.min_zmp_margin_m > 0.03
    assert np.isclose(summary.simulated_time_s, 3.0, atol=0.1)
