"""Every figure of a summary is explained, once."""

import dataclasses

from footfall.diagrams.judge.meanings import meanings_table, summary_meanings
from footfall.diagrams.judge.summary import Summary


def test_every_figure_has_one_meaning() -> None:
    """Those that go together share it."""
    names = [name for meaning in summary_meanings() for name in meaning.names]
    assert names == [field.name for field in dataclasses.fields(Summary)]
    by_name = {name: m.text for m in summary_meanings() for name in m.names}
    assert by_name["max_torque_fraction"] == by_name["max_torque_joint"]
    assert by_name["max_torque_fraction"] == (
        "Largest torque of any joint over its limit in the URDF, and which joint's"
    )
    assert by_name["obstacles_crossed"] == "How many were stepped over"
    assert all("\n" not in text and len(text) > 10 for text in by_name.values())


def test_the_table_is_markdown() -> None:
    """A row a meaning."""
    lines = meanings_table().splitlines()
    assert lines[:2] == ["| figure | is |", "|---|---|"]
    assert lines[2].startswith("| `outcome`, `reason` | What became of the task")
    assert len(lines) == 2 + len(summary_meanings())
    assert all(line.count(" | ") == 1 for line in lines[2:])
