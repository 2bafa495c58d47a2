"""One finds one's way in: rooms of few files, and imports that only run down.

At every level of the tree the children of a folder, files and folders alike, import
each other without a circle. Imports inside functions and under TYPE_CHECKING count.
"""

import ast
import json
import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
TOP_LEVEL = ("models", "systems", "diagrams")
MAX_FILES = 21
"""The largest number of Python files in a folder: "about twenty"."""


def _sources(*folders: str) -> Iterator[Path]:
    for folder in folders:
        yield from (path for path in (ROOT / folder).rglob("*.py") if path.is_file())


def _imports(source: str) -> Iterator[str]:
    """The dotted names that a module imports, `from a import b` as a and a.b."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute"
            assert node.module is not None
            yield node.module
            yield from (f"{node.module}.{name.name}" for name in node.names)


def _modules() -> dict[str, set[str]]:
    """What each module of footfall imports of footfall, by dotted name."""
    paths = {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): path
        for path in _sources(*TOP_LEVEL)
        if path.name != "__init__.py"
    }
    found: dict[str, set[str]] = {}
    for name, path in paths.items():
        imported = {
            one.removeprefix("footfall.") for one in _imports(path.read_text("utf-8"))
        }
        found[name] = (imported & paths.keys()) - {name}
    return found


MODULES = _modules()


def _rooms() -> list[str]:
    """Every folder that holds modules or folders of them, "" for the top level."""
    rooms = {""}
    for name in MODULES:
        parts = name.split(".")
        rooms |= {".".join(parts[:depth]) for depth in range(1, len(parts))}
    return sorted(rooms)


def _children(room: str) -> dict[str, set[str]]:
    """By child of a folder, the children of that folder that it imports."""
    prefix = f"{room}." if room else ""

    def child(name: str) -> str:
        return name.removeprefix(prefix).split(".")[0]

    graph: dict[str, set[str]] = {}
    for name, imported in MODULES.items():
        if name.startswith(prefix):
            inside = {child(one) for one in imported if one.startswith(prefix)}
            graph.setdefault(child(name), set()).update(inside - {child(name)})
    return graph


@pytest.mark.parametrize("room", _rooms(), ids=lambda room: room or "top")
def test_imports_only_run_down(room: str) -> None:
    """Without circles a part can be lifted out with what lies below it."""
    try:
        tuple(TopologicalSorter(_children(room)).static_order())
    except CycleError as error:
        pytest.fail(f"{room or 'the top level'}: " + " <- ".join(error.args[1]))


def test_a_circle_is_found() -> None:
    """The check above can fail."""
    with pytest.raises(CycleError):
        TopologicalSorter({"a": {"b"}, "b": {"a"}}).prepare()
    assert _children("")["diagrams"] == {"models", "systems"}
    assert "values" in _children("models")["robots"]


@pytest.mark.parametrize("top", [*TOP_LEVEL, "tests"])
def test_no_folder_is_a_list(top: str) -> None:
    """Who has to scroll a folder guesses wrong."""
    for folder in {path.parent for path in _sources(top)}:
        files = [path for path in folder.glob("*.py") if path.name != "__init__.py"]
        assert len(files) <= MAX_FILES, f"{folder.relative_to(ROOT)}: {len(files)}"


def test_everything_is_imported_from_footfall() -> None:
    """A module that is imported by two names exists twice."""
    short = re.compile(rf"({'|'.join(TOP_LEVEL)})(\.|$)")
    texts = {
        path: path.read_text("utf-8")
        for path in _sources(*TOP_LEVEL, "tests", "footfall")
    }
    for path in (ROOT / "notebooks").glob("*.ipynb"):
        cells = json.loads(path.read_text("utf-8"))["cells"]
        code = [
            "".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"
        ]
        lines = "\n".join(code).splitlines()
        texts[path] = "\n".join(line for line in lines if line[:1] not in ("%", "!"))
    for path, text in texts.items():
        wrong = [name for name in _imports(text) if short.match(name)]
        assert wrong == [], path
