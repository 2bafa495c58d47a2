"""What is installed: our own packages, all of them, with their types and command."""

import importlib
import tomllib
from importlib.metadata import distribution, entry_points
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
TOP_LEVEL = ("diagrams", "footfall", "models", "systems")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def packages_of_the_tree() -> list[str]:
    """Every folder below the top-level packages that holds Python files."""
    return sorted(
        {
            ".".join(path.parent.relative_to(ROOT).parts)
            for name in TOP_LEVEL
            for path in (ROOT / name).rglob("*.py")
        }
    )


@pytest.mark.parametrize("name", TOP_LEVEL)
def test_the_package_that_is_imported_is_ours(name: str) -> None:
    """PyPI has a popular `diagrams` too."""
    module = importlib.import_module(name)
    assert module.__file__ is not None
    assert Path(module.__file__).resolve() == ROOT / name / "__init__.py"


def test_every_package_of_the_tree_is_shipped() -> None:
    """The list in pyproject.toml is written by hand."""
    shipped = sorted(PROJECT["tool"]["setuptools"]["packages"])
    assert shipped == packages_of_the_tree()
    for package in shipped:
        assert (ROOT / package.replace(".", "/") / "__init__.py").is_file(), package


def test_types_are_shipped() -> None:
    """Type checkers want a `py.typed` in each package, and setuptools to copy it."""
    data = PROJECT["tool"]["setuptools"]["package-data"]
    assert "py.typed" in data["*"]
    for name in TOP_LEVEL:
        assert (ROOT / name / "py.typed").is_file(), name


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
    assert "*.yaml" in data["diagrams.scenarios"]


def test_the_command_is_there() -> None:
    """`footfall` is installed and leads to the command line."""
    (command,) = entry_points(group="console_scripts", name="footfall")
    from footfall.__main__ import main

    assert command.load() is main


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
