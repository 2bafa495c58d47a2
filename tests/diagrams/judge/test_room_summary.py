"""Perception measured against the true boxes of a room."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.judge.room_summary import (
    box_error,
    room_perception,
    stage_ms,
    standing_boxes,
    true_box,
)
from footfall.models.scenes.mover import MoverParams
from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.scene import SceneParams
from footfall.models.values.room import Environment, FloorPlane, ObstacleBox

BIN = BoxParams(name="bin", x=1.0, y=2.0, yaw=0.3, size=[0.3, 0.5, 0.4])
TRUE = true_box(BIN, BIN.x, BIN.y)
WALL = ObstacleBox("box_9", np.array([0.0, 3.5, 0.3]), 0.0, np.array([9.0, 0.1, 0.6]))
FLOOR = FloorPlane(np.array([0.0, 0.0, 1.0, 0.0]), np.zeros((0, 3)), 0.8)
TIMES = {"cloud": 20.123, "total": 20.123}


def seen(dx: float = 0.0, wider: float = 0.0, turn: float = 0.0) -> ObstacleBox:
    """The true box as it might be perceived."""
    size = TRUE.size + np.array([0.0, wider, 0.0])
    center = TRUE.center + np.array([dx, 0.0, 0.0])
    return ObstacleBox("box_0", center, TRUE.yaw + turn, size)


def test_errors_are_of_the_nearest_box() -> None:
    """Distance of the centres, worst side."""
    assert box_error(TRUE, (WALL, seen(0.02, -0.03))) == pytest.approx((0.02, 0.03))


@pytest.mark.parametrize("quarter", [-1, 1, 2, 3])
def test_a_quarter_turn_swaps_the_sides(quarter: int) -> None:
    """The same box by another name for its x."""
    turned = seen(turn=quarter * np.pi / 2.0 + 0.05)
    if quarter % 2:
        turned = replace(turned, size=turned.size[[1, 0, 2]])
    assert box_error(TRUE, (turned,)) == pytest.approx((0.0, 0.0))


def test_a_box_that_is_not_there_is_unseen() -> None:
    """Another one is not taken for it."""
    assert box_error(TRUE, (WALL,)) is None
    assert box_error(TRUE, ()) is None


def test_boxes_that_move_do_not_count_until_they_rest() -> None:
    """Before at their start, after at their end."""
    mover = MoverParams(name="cart", x=0.0, y=1.0, to_x=3.0, to_y=1.0, time=2.0)
    scene = SceneParams(boxes=[BIN], movers=[mover])
    places = {t: [b.center[0] for b in standing_boxes(scene, t)] for t in (1.9, 2.5, 4)}
    assert places == {1.9: [1.0, 0.0], 2.5: [1.0], 4: [1.0, 3.0]}


def test_a_run_is_summed_up() -> None:
    """Over all boxes of all frames; what was missed is counted."""
    looks = [
        (0.5, Environment(FLOOR, (seen(0.01), WALL))),
        (1.0, Environment(FLOOR, (seen(0.031, 0.02),))),
        (1.5, Environment(reason="no floor in view")),
    ]
    data = room_perception(looks, SceneParams(boxes=[BIN]), TIMES)
    assert data is not None
    assert data["frames"] == 3
    assert data["ms_per_frame"] == {"cloud": 20.12, "total": 20.12}
    assert data["floor_inlier_share"] == pytest.approx(1.6 / 3.0, abs=1e-4)
    assert data["errors"] == {
        "boxes": 3,
        "unseen": 1,
        "off": 1,
        "mean_center_m": pytest.approx(0.0205),
        "max_center_m": pytest.approx(0.031),
        "mean_size_m": pytest.approx(0.01),
        "max_size_m": pytest.approx(0.02),
    }
    empty = room_perception(looks, SceneParams(), TIMES)
    assert empty is not None
    assert empty["errors"] is None
    assert room_perception([], SceneParams(), TIMES) is None


def test_a_look_is_judged_by_when_it_was_taken() -> None:
    """Not by when it was worked out: the cart has begun to move since."""
    mover = MoverParams(name="cart", x=0.0, y=1.0, to_x=3.0, to_y=1.0, time=2.0)
    scene = SceneParams(movers=[mover])
    for sensed_at, counted in ((None, False), (1.9, True)):
        look = (2.1, Environment(FLOOR, (WALL,), sensed_at=sensed_at))
        data = room_perception([look], scene, TIMES)
        assert data is not None
        assert bool(data["errors"]) is counted


def test_a_task_without_a_camera_has_no_stages(standing) -> None:
    """Nor one of which no frame was used."""
    assert stage_ms(standing.task().diagram, 3) == {}
