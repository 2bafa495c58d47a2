"""Runs the notebooks and keeps their outputs, as readers see them before they run any.

    python -m tests.keep_outputs [NAME ...]

What differs from machine to machine is not kept: where a folder lay, and what a cell
wrote to its standard error.
"""

import argparse
import base64
import io
import re
import socket
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "notebooks"
TIMEOUT = 600
"""For one cell, s."""
PNG, COLORS = "image/png", 128
"""Pictures, and how many colours are kept of one."""
TOPS = "|".join((*("home", "root", "tmp", "Users", "opt", "usr", "var"), ROOT.parts[1]))
"""Where machines have files; the last is where this checkout is."""
PATH = re.compile(rf"(?<![\w.:/<])/(?:{TOPS})/[^\s\"',)]*")
"""The path of a file on somebody's machine."""


def execute(path: Path) -> nbformat.NotebookNode:
    """Runs a notebook in a kernel of its own."""
    notebook = nbformat.read(path, as_version=4)
    resources = {"metadata": {"path": str(path.parent)}}
    NotebookClient(
        notebook, timeout=TIMEOUT, kernel_name="python3", resources=resources
    ).execute()
    return notebook


def texts(notebook: nbformat.NotebookNode) -> list[str]:
    """Every text among the outputs."""
    found = []
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            found.append(output.get("text", ""))
            data = output.get("data", {})
            found += [str(data[kind]) for kind in data if kind.startswith("text/")]
    return found


def places(notebook: nbformat.NotebookNode) -> list[str]:
    """What among the outputs names a path or a host."""
    hosts = {socket.gethostname(), socket.getfqdn()} - {"", "localhost"}
    return [
        text
        for text in texts(notebook)
        if PATH.search(text)
        or any(re.search(rf"\b{re.escape(h)}\b", text) for h in hosts)
    ]


def clean(notebook: nbformat.NotebookNode) -> None:
    """Drops of a notebook that ran what is of this machine alone; makes it small."""
    for cell in notebook.cells:
        cell.metadata = nbformat.NotebookNode()
        for output in cell.get("outputs", ()):
            if PNG in output.get("data", {}):
                output.data[PNG] = smaller(output.data[PNG])
    kept = {"display_name": "Python 3", "language": "python", "name": "python3"}
    notebook.metadata = nbformat.from_dict(
        {"kernelspec": kept, "language_info": {"name": "python"}}
    )


def smaller(picture: str) -> str:
    """Writes a PNG, base64, with a palette: a quarter of the size, alike to the eye."""
    image = Image.open(io.BytesIO(base64.b64decode(picture))).convert("RGB")
    buffer = io.BytesIO()
    image.quantize(COLORS).save(buffer, format="PNG", optimize=True)
    return base64.b64encode(buffer.getvalue()).decode("ascii")


def main() -> None:
    """Runs the notebooks and writes them back."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="without .ipynb; all by default")
    names = parser.parse_args().names
    for path in sorted(FOLDER.glob("*.ipynb")):
        if names and path.stem not in names:
            continue
        notebook = execute(path)
        clean(notebook)
        if found := places(notebook):
            raise SystemExit(f"{path.name}: names a place: {found[0]}")
        nbformat.write(notebook, path)
        print(path.name, flush=True)


if __name__ == "__main__":
    main()
