"""A scene gathers its parts, each solid under a name of its own."""

import pytest

from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.staircase import StaircaseParams


def test_scene_gathers_room_stairs_and_boxes() -> None:
    """In that order, every name once."""
    scene = SceneParams(
        staircase=StaircaseParams(steps=2),
        boxes=[BoxParams(name="bar", x=1.0, z=0.1, size=[0.05, 1.0, 0.15])],
    )
    names = [solid.name for solid in scene.solids()]
    assert names[0] == "room/floor"
    assert names[-3:] == ["staircase/step_1", "staircase/step_2", "box/bar"]
    assert len(set(names)) == len(names) == 9
    bar = scene.solids()[-1]
    assert bar.X_WB.translation() == pytest.approx([1.0, 0.0, 0.175])
    assert [tread.name for tread in scene.treads()] == names[-3:-1]


def test_scene_without_stairs_has_no_treads() -> None:
    """An empty room has nothing to climb."""
    assert SceneParams().treads() == ()


def test_equal_names_are_refused() -> None:
    """A contact could not be traced otherwise."""
    scene = SceneParams(boxes=[BoxParams(name="a"), BoxParams(name="a")])
    with pytest.raises(ValueError, match=r"boxes\[1\].name: must be unique, got 'a'"):
        scene.solids()


@pytest.mark.parametrize(
    ("box", "message"),
    [
        (BoxParams(size=[1.0, 1.0]), "size: must have 3 elements, got 2"),
        (BoxParams(size=[1.0, 0.0, 1.0]), r"size\[1\]: must be positive, got 0 m"),
        (BoxParams(name=""), "name: must not be empty"),
    ],
)
def test_wrong_box_is_refused(box: BoxParams, message: str) -> None:
    """Every field that can be wrong is refused under its name."""
    with pytest.raises(ValueError, match=message):
        SceneParams(boxes=[box]).solids()


@pytest.mark.parametrize(
    ("stairs", "message"),
    [
        (StaircaseParams(x=4.8), "inside the room, has a corner at 5.61 m, -0.25 m"),
        (StaircaseParams(width=7.2), "staircase: must lie inside the room"),
        (StaircaseParams(x=0, y=3.0, yaw=1.5), "staircase: must lie inside the room"),
        (
            StaircaseParams(steps=15),
            "below the ceiling at 3 m, its top tread is at 3 m",
        ),
    ],
)
def test_staircase_must_fit_into_the_room(
    stairs: StaircaseParams, message: str
) -> None:
    """Neither walls nor ceiling may cut it off."""
    with pytest.raises(ValueError, match=message):
        SceneParams(staircase=stairs).solids()
