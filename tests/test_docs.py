"""The documentation is built without a warning, and what it shows can be done."""

import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

import pytest
import typer.main

from footfall.diagrams.cli.app import app
from footfall.diagrams.judge.summary import Summary
from footfall.diagrams.reference.system_docs import find_systems
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.sweep.definition import load_sweep_file
from footfall.diagrams.sweep_command import check_samples
from footfall.models.robots.robot_description import RobotDescription

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.glob("*.md"))


def blocks(language: str) -> list[tuple[str, str]]:
    """Every block of a language: the page it is on, and the text."""
    return [
        (page.stem, text)
        for page in PAGES
        for text in re.findall(
            rf"^```{language}\n(.*?)^```", page.read_text("utf-8"), re.M | re.S
        )
    ]


def commands() -> Iterator[str]:
    """Every call of footfall that a page shows."""
    for _, text in blocks("sh"):
        lines = (line.removeprefix(".venv/bin/") for line in text.splitlines())
        yield from (line for line in lines if line.startswith("footfall "))


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages, built as for the web; a warning is an error."""
    pytest.importorskip("sphinx", reason="needs the extra docs: footfall[docs]")
    pytest.importorskip("myst_nb", reason="needs the extra docs: footfall[docs]")
    folder = tmp_path_factory.mktemp("html")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q"]
    done = subprocess.run(
        [*command, "-d", str(folder / "trees"), str(DOCS), str(folder / "html")],
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    assert done.returncode == 0, done.stderr
    return folder / "html"


def test_every_system_has_a_page(built: Path) -> None:
    """With its ports, what they carry, and a picture of where it stands."""
    for system in find_systems():
        assert (built / "systems" / f"{system.__qualname__}.html").is_file()
    page = (built / "systems" / "Stabilizer.html").read_text("utf-8")
    for said in ("com_velocity", "vector of 3", "walking_control", "Stabilizer.svg"):
        assert said in page, said


def test_success_is_stated_in_numbers(built: Path) -> None:
    """They come from the judge itself."""
    page = (built / "success.html").read_text("utf-8")
    assert "slides by more than 3 cm" in page
    assert "{{" not in page


def test_every_figure_of_a_summary_is_explained() -> None:
    """Each that is a number has a formula, or a meaning that is one."""
    page = (DOCS / "summary.md").read_text("utf-8")
    counted = {"footsteps", "steps_climbed", "obstacles_crossed", "seed"}
    times = {"simulated_time_s", "wall_time_s"}
    numbers = {
        field.name
        for field in fields(Summary)
        if re.search(r"\b(float|int)\b", str(field.type))
        and "Mapping" not in str(field.type)
    }
    named = set(re.findall(r"`(\w+)`", page))
    assert numbers - named - counted - times == set()


@pytest.mark.parametrize("command", sorted(set(commands())))
def test_a_command_that_is_shown_exists(command: str) -> None:
    """With the options and the number of arguments that are shown."""
    group = typer.main.get_command(app)
    name, *arguments = shlex.split(command)[1:]
    shown = group.get_command(None, name)  # type: ignore[attr-defined]
    assert shown is not None
    shown.make_context(name, arguments)


@pytest.mark.parametrize(("page", "text"), blocks("yaml"))
def test_a_file_that_is_shown_can_be_used(page: str, text: str, tmp_path: Path) -> None:
    """A scenario, a sweep or a robot."""
    file = tmp_path / "mine.yaml"
    file.write_text(text, encoding="utf-8")
    if page == "own_sweep":
        check_samples(load_sweep_file(file), file)
    elif "urdf:" in text:
        keys = {field.name for field in fields(RobotDescription)}
        assert set(re.findall(r"^(\w+):", text, re.M)) <= keys
    elif "my_robot.yaml" not in text:
        load_scenario(file)


def test_the_system_of_your_own_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """And says what stands below it."""
    (text,) = [t for page, t in blocks("python") if page == "own_system" and "#" in t]
    exec(compile(text, "own_system.md", "exec"), {"__name__": "__main__"})
    said = re.findall(r"^# (.*)$", text, flags=re.M)
    assert capsys.readouterr().out.splitlines() == said


def test_a_run_is_read_as_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of a robot that stands for a moment."""
    from footfall.diagrams.closed_loop.tasks import build_task
    from footfall.diagrams.simulation import run_task

    monkeypatch.chdir(tmp_path)
    scenario = load_scenario("stand", ["task.stand_time=0.2"])
    run_task(build_task(scenario), scenario, tmp_path / "runs/stand-seed0")
    (text,) = [text for page, text in blocks("python") if page == "run_folder"]
    exec(compile(text, "run_folder.md", "exec"), {"__name__": "__main__"})
    said = re.findall(r"^# (.*)$", text, flags=re.M)
    assert capsys.readouterr().out.splitlines() == said
