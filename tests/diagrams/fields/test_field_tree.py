"""Every field of a scenario by its path, and what is said of a path that is none."""

import pytest

from footfall.diagrams.fields.field_tree import select_fields, walk_fields
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.schema import FieldError

FIELDS = tuple(walk_fields(Scenario))


def test_every_field_of_a_scenario_has_a_text() -> None:
    """Who asks for one gets an answer."""
    assert [one.path for one in FIELDS if not one.item.text] == []
    assert len({one.path for one in FIELDS}) == len(FIELDS) > 350


def test_defaults_are_those_of_the_scenario() -> None:
    """Of the preview it is not the paper's value of the class."""
    (preview,) = select_fields(FIELDS, "parameters.zmp_preview.preview_time")
    assert preview.item.default == 2.4


@pytest.mark.parametrize("key", ["scene.boxes", "scene.boxes[]", "scene.boxes[3]"])
def test_a_group_comes_with_what_it_holds(key: str) -> None:
    """Of a list with or without an index."""
    paths = [one.path for one in select_fields(FIELDS, key)]
    assert paths[:2] == ["scene.boxes[]", "scene.boxes[].name"]
    assert all(path.startswith("scene.boxes[]") for path in paths)


def test_what_is_shared_is_not_a_field_of_its_own() -> None:
    """Its value is another's."""
    paths = [one.path for one in select_fields(FIELDS, "parameters.zmp_preview")]
    assert "parameters.zmp_preview.period" not in paths


@pytest.mark.parametrize(
    ("key", "hint"),
    [
        ("parameters.stabiliser", "did you mean parameters.stabilizer?"),
        ("friction", "did you mean parameters.friction or scene.room.friction or "),
        ("parameters.zmp", "did you mean parameters.zmp_preview?"),
        ("parameters.ik.period", "did you mean parameters.control_period?"),
        ("task.kinds", "did you mean task.kind?"),
        ("xyzzy", "there are name, description, robot, scene, sensors, task, "),
        (".", "there are name, "),
    ],
)
def test_an_unknown_key_is_refused_with_the_nearest(key: str, hint: str) -> None:
    """In one line."""
    with pytest.raises(FieldError) as raised:
        select_fields(FIELDS, key)
    assert str(raised.value).startswith(f"{key}: no such field; {hint}")
