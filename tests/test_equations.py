"""The index of equations names what there is."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
TEXT = (ROOT / "docs/equations.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (.*?) \| .*? \| `(.*?)` \| `(.*?)` \|$", TEXT, re.MULTILINE)


def test_there_are_equations() -> None:
    """Or the test below would test nothing."""
    assert len(ROWS) > 12


@pytest.mark.parametrize(("equation", "name", "file"), ROWS)
def test_an_equation_is_where_the_index_says(
    equation: str, name: str, file: str
) -> None:
    """Under that name, with its number in the file."""
    text = (ROOT / file).read_text(encoding="utf-8")
    assert re.search(rf"^(def|class) {name}\b", text, re.MULTILINE)
    assert equation.startswith(("Algorithm", "A of", "H and")) or "Eq" in text
