"""Fields by their paths."""

from footfall.diagrams.fields.flat_fields import flat_fields
from footfall.diagrams.scenario import load_scenario


def test_fields_are_listed_by_path() -> None:
    """Groups opened, lists whole, what does not act left out."""
    fields = flat_fields(load_scenario("stairs-exp1", ["scene.staircase.rise=0.18"]))
    assert fields["scene.staircase.rise"] == 0.18
    assert fields["scene.boxes"] == []
    assert fields["scene.clutter"] is None
    assert "scene.staircase" not in fields
    assert "task.stand_time" not in fields
