"""What the README shows runs as it stands there."""

import re
from pathlib import Path

import pytest

README = Path(__file__).resolve().parents[1] / "README.md"
TEXT = README.read_text(encoding="utf-8")
SNIPPETS = re.findall(r"^```python\n(.*?)^```", TEXT, flags=re.MULTILINE | re.DOTALL)
LINKS = re.findall(r"\]\((?!https?:)([^)#]+)\)", TEXT)


def test_there_is_a_diagram_to_copy() -> None:
    """At least one snippet builds a diagram."""
    assert any("DiagramBuilder" in snippet for snippet in SNIPPETS)


@pytest.mark.parametrize("snippet", [s for s in SNIPPETS if "DiagramBuilder" in s])
def test_snippets_run(snippet: str, capsys: pytest.CaptureFixture[str]) -> None:
    """And print what the comments below them say."""
    exec(compile(snippet, str(README), "exec"), {"__name__": "__main__"})
    said = re.findall(r"^#> (.*)$", snippet, flags=re.MULTILINE)
    assert said
    assert capsys.readouterr().out.splitlines() == said


@pytest.mark.parametrize("link", sorted(set(LINKS)))
def test_links_lead_to_files_of_the_tree(link: str) -> None:
    """A picture that moved would be a hole."""
    assert (README.parent / link).exists()
