"""What is installed: our own packages, all of them, with their types and command."""

import importlib
import os
import subprocess
import sys
import tomllib
from importlib.metadata import distribution, entry_points
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[1]
TOP_LEVEL = ("diagrams", "models", "systems")
"""The folders that `footfall` links to."""
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def packages_of_the_tree() -> list[str]:
    """Every folder below the top-level ones that holds Python files."""
    return sorted(
        {
            ".".join(("footfall", *path.parent.relative_to(ROOT).parts))
            for name in TOP_LEVEL
            for path in (ROOT / name).rglob("*.py")
        }
    )


@pytest.mark.parametrize("name", TOP_LEVEL)
def test_footfall_holds_the_top_level(name: str) -> None:
    """Each folder is imported as a part of footfall, and lies here once."""
    link = ROOT / "footfall" / name
    assert link.is_symlink()
    assert link.resolve() == ROOT / name
    module = importlib.import_module(f"footfall.{name}")
    assert module.__file__ is not None
    assert Path(module.__file__).resolve() == ROOT / name / "__init__.py"


def test_nothing_but_footfall_is_installed() -> None:
    """A user has a folder `models` of his own; PyPI has a popular `diagrams`."""
    code = (
        "import importlib.util as u, footfall.diagrams.cli.app; "
        f"print([name for name in {TOP_LEVEL} if u.find_spec(name)])"
    )
    run = subprocess.run(
        [sys.executable, "-P", "-c", code],
        check=True,
        capture_output=True,
        text=True,
        cwd=ROOT / "tests",
        env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"},
    )
    assert run.stdout.strip() == "[]"


def test_folders_of_the_users_hide_nothing(tmp_path: Path) -> None:
    """A script that lies beside folders of the same names imports both."""
    for name in TOP_LEVEL:
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("OWNER = 'the user'\n")
    script = tmp_path / "script.py"
    script.write_text(
        "import diagrams, models, systems\n"
        "from footfall.diagrams import schema\n"
        "from footfall.models.values import feet\n"
        "from footfall.systems import callbacks\n"
        "print(diagrams.OWNER, models.OWNER, systems.OWNER)\n"
    )
    run = subprocess.run(
        [sys.executable, str(script)],
        check=True,
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert run.stdout.strip() == "the user the user the user"


def test_every_package_of_the_tree_is_shipped() -> None:
    """What setuptools is told to take has every folder, each a package."""
    found = PROJECT["tool"]["setuptools"]["packages"]["find"]
    assert found["include"] == ["footfall", "footfall.*"]
    for package in packages_of_the_tree():
        assert (ROOT / package.replace(".", "/") / "__init__.py").is_file(), package


def test_types_are_shipped() -> None:
    """Type checkers want a `py.typed` in each package, and setuptools to copy it."""
    data = PROJECT["tool"]["setuptools"]["package-data"]
    assert "py.typed" in data["*"]
    for package in ("footfall", *packages_of_the_tree()):
        if package != "footfall.diagrams.scenarios":
            assert (ROOT / package.replace(".", "/") / "py.typed").is_file(), package


def test_every_kind_of_data_file_exists() -> None:
    """A pattern that matches nothing is left over, or misspelt."""
    data = PROJECT["tool"]["setuptools"]["package-data"]
    for package, patterns in data.items():
        folder = ROOT if package == "*" else ROOT / package.replace(".", "/")
        for pattern in patterns:
            found = folder.rglob(pattern) if package == "*" else folder.glob(pattern)
            assert any(found), (package, pattern)


def test_every_scenario_is_shipped() -> None:
    """They are data files, which setuptools leaves behind unless told."""
    folder = ROOT / "diagrams" / "scenarios"
    others = [path for path in folder.iterdir() if path.suffix not in (".py", ".yaml")]
    assert [path.name for path in others if path.is_file()] == []
    data = PROJECT["tool"]["setuptools"]["package-data"]
    assert "*.yaml" in data["footfall.diagrams.scenarios"]


def test_the_command_is_there() -> None:
    """`footfall` is installed and leads to the command line."""
    (command,) = entry_points(group="console_scripts", name="footfall")
    from footfall.__main__ import main

    assert command.load() is main


def test_the_citation_is_of_this_version() -> None:
    """As is the newest release of the changelog."""
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    version = PROJECT["project"]["version"]
    assert cited["version"] == version
    assert cited["license"] == PROJECT["project"]["license"]
    assert len(cited["references"]) == 3
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    released = [line for line in changes.splitlines() if line.startswith("## ")][1:]
    assert released[0] == f"## {version}"


def test_constraints_hold_every_requirement() -> None:
    """What pyproject.toml asks for is pinned, and the pins name no place."""
    text = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    pins = [line for line in text.splitlines() if not line.startswith("#")]
    assert all("==" in pin for pin in pins)
    assert "/" not in "".join(pins)
    pinned = {_normal(pin.partition("==")[0]) for pin in pins}
    wanted = {
        _normal(requirement)
        for requirement in distribution("footfall").requires or ()
        # Linux on x86-64, where the tests run, has open3d-cpu in its place.
        if _normal(requirement) != "open3d"
    }
    assert wanted - pinned == set()


def _normal(requirement: str) -> str:
    """The name of a package in a requirement, as an index spells it."""
    name = requirement
    for mark in "<>=!~; [(":
        name = name.partition(mark)[0]
    return name.strip().lower().replace("_", "-").replace(".", "-")
