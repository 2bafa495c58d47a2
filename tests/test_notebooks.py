"""The notebooks run from top to bottom; what is kept of them names no machine."""

from pathlib import Path

import nbformat
import pytest

from tests.keep_outputs import FOLDER, ROOT, execute, places, texts

NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
SAYS = {
    "analysing_a_sweep": ("9 of 9 runs have a result", "all: 4 of 9", "fell at"),
    "your_own_parts": (
        "completed: ",
        "interrupted: stopped at",
        "foot touches tread 1",
    ),
}
"""What a notebook is to print; else that its run is a success."""


def test_there_are_notebooks() -> None:
    """Or the tests below would test nothing."""
    names = {"stair_climbing", "crossing_a_room", "stepping_over", "your_own_parts"}
    assert names | {"analysing_a_sweep"} <= {path.stem for path in NOTEBOOKS}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_outputs_are_kept_without_a_place(path: Path) -> None:
    """Readers see pictures before they run anything, and no path or host of ours."""
    notebook = nbformat.read(path, as_version=4)
    assert places(notebook) == []
    assert_shows_what_it_should(path.stem, notebook)
    assert path.stat().st_size < 1_000_000


@pytest.mark.parametrize(
    "text", ["/home/me/footfall/runs", "saved to '/tmp/x1/run'", f"File {ROOT}/a.py, 3"]
)
def test_a_path_is_found(text: str) -> None:
    """But not a fraction, a unit, or an address on the web."""
    output = nbformat.v4.new_output("stream", text=text)
    cell = nbformat.v4.new_code_cell("1", outputs=[output])
    assert places(nbformat.v4.new_notebook(cells=[cell])) == [text]
    output.text = "2/3, m/s, https://example.org/home/you, </tmp/>, sweeps/x"
    assert places(nbformat.v4.new_notebook(cells=[cell])) == []


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every cell, in a kernel of its own; the run that it shows is a success."""
    # A backend that is set from outside would take the place of the inline one.
    monkeypatch.delenv("MPLBACKEND", raising=False)
    assert_shows_what_it_should(path.stem, execute(path))


def assert_shows_what_it_should(name: str, notebook: nbformat.NotebookNode) -> None:
    """Pictures, what is to be printed, and no warnings."""
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    outputs = [output for cell in cells for output in cell.outputs]
    printed = "".join(texts(notebook))
    for said in SAYS.get(name, ("completed: ",)):
        assert said in printed
    assert any("image/png" in output.get("data", {}) for output in outputs)
    assert not any(output.get("name") == "stderr" for output in outputs)
