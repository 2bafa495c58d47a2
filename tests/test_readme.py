"""What the README shows runs as it stands there."""

import re
from pathlib import Path

import pytest

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.figures.block_diagram import topology
from footfall.diagrams.judge.meanings import meanings_table
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.shipped import list_scenarios
from tests.models.scenes.scene_meshes import profile_steps
from tests.models.scenes.test_scene_model import SDF

README = Path(__file__).resolve().parents[1] / "README.md"
TEXT = README.read_text(encoding="utf-8")
SNIPPETS = re.findall(r"^```python\n(.*?)^```", TEXT, flags=re.MULTILINE | re.DOTALL)
LINKS = re.findall(r"\]\((?!https?:)([^)#]+)\)", TEXT)


def test_there_is_a_diagram_to_copy() -> None:
    """At least one snippet builds a diagram."""
    assert any("DiagramBuilder" in snippet for snippet in SNIPPETS)


@pytest.mark.parametrize("snippet", [s for s in SNIPPETS if "DiagramBuilder" in s])
def test_snippets_run(snippet: str, capsys: pytest.CaptureFixture[str]) -> None:
    """And print what the comments at their end say."""
    exec(compile(snippet, str(README), "exec"), {"__name__": "__main__"})
    said = re.findall(r"^# (.*)$", snippet, flags=re.MULTILINE)
    assert said
    assert capsys.readouterr().out.splitlines() == said


def test_the_figures_of_the_summary_are_explained() -> None:
    """As where they are declared; `meanings_table` writes it again."""
    assert meanings_table() in TEXT


def test_every_scenario_is_listed() -> None:
    """With what the robot is to do in it."""
    names = {name for name, _ in list_scenarios()}
    assert {name for name in names if f"| `{name}` |" not in TEXT} == set()


def test_the_scenarios_that_are_shown_can_be_used(tmp_path: Path) -> None:
    """Whole scenarios, as the README says; beside them the files that they name."""
    stairs = profile_steps([0.17] * 3, [0.28] * 3)
    stairs.apply_scale(1000.0).export(tmp_path / "stairs.stl")
    (tmp_path / "handrail.sdf").write_text(SDF, encoding="utf-8")
    texts = re.findall(r"^```yaml\n(.*?)^```", TEXT, flags=re.MULTILINE | re.DOTALL)
    assert len(texts) == 2
    for text in texts:
        path = tmp_path / "mine.yaml"
        path.write_text(text, encoding="utf-8")
        assert len(load_scenario(path).scene.treads()) > 2


def test_the_block_diagram_is_the_present_one() -> None:
    """`footfall diagram stairs-exp1 --out notebooks/images/diagram.svg` renews it."""
    picture = (README.parent / "notebooks/images/diagram.svg").read_text("utf-8")
    drawn = set(re.findall(r'class="node">\s*<title>(.*?)</title>', picture))
    blocks, _ = topology(build_task(load_scenario("stairs-exp1")).diagram)
    assert drawn == {block.name for block in blocks}


@pytest.mark.parametrize("link", sorted(set(LINKS)))
def test_links_lead_to_files_of_the_tree(link: str) -> None:
    """A picture that moved would be a hole."""
    assert (README.parent / link).exists()
