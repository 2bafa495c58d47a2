"""Open3D loads on a machine that has no libusb: it comes from the environment."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LOADER = ROOT / "systems" / "open3d_loader.py"
SOURCES = ("diagrams", "models", "systems", "tests", "notebooks")


def imported(source: str) -> set[str]:
    """Names of the top-level modules that a piece of Python imports anywhere."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module.partition(".")[0])
    return found


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere wheels hold their own")
def test_the_libusb_in_use_lies_in_the_environment() -> None:
    """Whether the system has one or not; asked in a process of its own."""
    code = (
        "from footfall.systems.open3d_loader import open3d; "
        "print(len(open3d.core.Tensor([1, 2]))); print(open('/proc/self/maps').read())"
    )
    run = subprocess.run(
        [sys.executable, "-c", code],
        check=True,
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    length, *maps = run.stdout.splitlines()
    assert length == "2"
    used = {Path(line.split(maxsplit=5)[5]) for line in maps if "libusb" in line}
    assert len(used) == 1
    assert used.pop().resolve().is_relative_to(Path(sys.prefix).resolve())


def test_open3d_is_imported_in_one_place() -> None:
    """Any other import would fail where no libusb is installed."""
    importers = [
        path
        for folder in SOURCES
        for path in sorted((ROOT / folder).rglob("*.py"))
        if "open3d" in imported(path.read_text(encoding="utf-8"))
    ]
    assert importers == [LOADER]
    assert imported("def f():\n    from open3d.t import geometry") == {"open3d"}
    for notebook in (ROOT / "notebooks").glob("*.ipynb"):
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        lines = "".join(
            line.rstrip("\n") + "\n"
            for cell in cells
            if cell["cell_type"] == "code"
            for line in cell["source"]
            if not line.startswith("%")
        )
        assert "open3d" not in imported(lines), notebook
