"""The fields of a scenario on 80 columns."""

import pytest

from footfall.diagrams.fields_command import fields_text
from footfall.diagrams.schema import FieldError


def test_a_field_is_a_head_and_its_meaning() -> None:
    """Key, default and unit to the left, what it may be to the right."""
    head, text = fields_text("scene.staircase.rise").splitlines()
    assert head.startswith("scene.staircase.rise = 0.2 m  ")
    assert head.endswith("  number in (0, 1000] m")
    assert len(head) == 80
    assert text == "    Height of each step, m (stair paper, experiment 1)."


def test_all_lines_fit() -> None:
    """But for keys that are longer by themselves; there are none."""
    lines = fields_text().splitlines()
    assert len(lines) > 800
    assert max(map(len, lines)) <= 80


def test_a_task_leaves_out_what_never_acts_in_it() -> None:
    """And what does so sometimes says when."""
    stairs = fields_text(task="stair_climbing")
    assert "parameters.path_planner" not in stairs
    assert "parameters.segmenter.voxel_size" in stairs
    assert "parameters.path_planner" in fields_text(task="room_crossing")
    quasi = fields_text("parameters.crossing.quasi_static")
    assert (
        "Acts where task.kind is obstacle_crossing and task.mode is quasi_static."
        in " ".join(quasi.split())
    )


@pytest.mark.parametrize(
    ("key", "task", "message"),
    [
        ("", "stairs", "--task stairs: no such task; did you mean stair_climbing?"),
        ("", "zz", "--task zz: no such task; there are stair_climbing, room_"),
        ("sensors.camera", "stair_climbing", "sensors.camera: does not act in the"),
    ],
)
def test_what_cannot_be_shown_is_refused(key: str, task: str, message: str) -> None:
    """In one line."""
    with pytest.raises(FieldError) as raised:
        fields_text(key, task)
    assert str(raised.value).startswith(message)
