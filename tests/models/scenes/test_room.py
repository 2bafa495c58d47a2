"""The room encloses exactly the space asked for."""

import numpy as np
import pytest

from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solids import Box, upright_pose


def _inside(box: Box, p_W: np.ndarray) -> bool:
    p_B = box.X_WB.inverse().multiply(p_W)
    return bool(np.all(np.abs(p_B) <= box.size / 2.0))


@pytest.mark.parametrize("yaw", [0.0, 0.7])
def test_walls_begin_where_the_room_ends(yaw: float) -> None:
    """Just inside is free, just outside is solid, at each side."""
    room = RoomParams(length=11.0, width=7.0, height=3.0, x=1.0, y=-2.0, yaw=yaw)
    solids = {box.name: box for box in room.solids()}
    X_WR = upright_pose(1.0, -2.0, 0.0, yaw)
    half, middle = np.array([5.5, 3.5, 1.5]), np.array([0.0, 0.0, 1.5])
    faces = {
        "room/wall_front": [1, 0, 0],
        "room/wall_back": [-1, 0, 0],
        "room/wall_left": [0, 1, 0],
        "room/wall_right": [0, -1, 0],
        "room/ceiling": [0, 0, 1],
        "room/floor": [0, 0, -1],
    }
    assert set(faces) == set(solids)
    for name, direction in faces.items():
        for offset, hit in ((-1e-6, False), (1e-6, True), (0.099, True)):
            p_R = middle + np.array(direction) * (half + offset)
            assert _inside(solids[name], X_WR.multiply(p_R)) is hit, (name, offset)


def test_floor_is_the_ground() -> None:
    """Its upper face is z = 0."""
    floor = RoomParams().solids()[0]
    assert floor.X_WB.translation()[2] + floor.size[2] / 2.0 == 0.0


def test_room_without_height_is_refused() -> None:
    """A flat room has no inside."""
    with pytest.raises(ValueError, match="height: must be positive, got 0 m"):
        RoomParams(height=0.0).solids()
