"""Which solids a sole may stand on."""

import pytest

from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solid_names import is_box, is_ground
from footfall.models.scenes.staircase import StaircaseParams


def test_floor_and_steps_are_ground_and_nothing_else_is() -> None:
    """As the parts of a scene name their solids."""
    room = [solid.name for solid in RoomParams().solids()]
    assert [name for name in room if is_ground(name)] == ["room/floor"]
    assert all(is_ground(solid.name) for solid in StaircaseParams().solids())
    assert not is_ground(BoxParams(name="floor").solid().name)


@pytest.mark.parametrize("name", ["staircase/step_1", "room/floor", "room/wall_left"])
def test_only_boxes_are_boxes(name: str) -> None:
    """By the names that they are given."""
    assert is_box(BoxParams(name="trunk").solid().name)
    assert not is_box(name)
