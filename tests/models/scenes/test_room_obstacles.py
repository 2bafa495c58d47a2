"""Random clutter: apart, clear of start and goal, within its bounds, repeatable."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from footfall.models.scenes.room_obstacles import ClutterParams, place_boxes

CLEAR = np.array([[-2.5, 0.0], [2.5, 0.0]])


def _footprint(box: object) -> shapely.Polygon:
    solid = box.solid()
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * solid.size[:2] / 2.0
    corners = np.hstack([half, np.zeros((4, 1))])
    return shapely.Polygon(np.array(solid.X_WB.multiply(corners.T)).T[:, :2])


@pytest.mark.parametrize("seed", range(20))
def test_boxes_are_as_asked_for(seed: int) -> None:
    """Count, sides, gaps and clear places hold for every seed."""
    params = ClutterParams(seed=seed)
    boxes = place_boxes(params, CLEAR)
    assert params.min_count <= len(boxes) <= params.max_count
    prints = [_footprint(box) for box in boxes]
    for i, (box, outline) in enumerate(zip(boxes, prints, strict=True)):
        assert params.area[0] <= box.x <= params.area[1]
        assert params.area[2] <= box.y <= params.area[3]
        assert min(box.size) >= params.min_side
        assert max(box.size[:2]) <= params.max_side
        assert box.size[2] <= params.max_height
        assert all(outline.distance(other) >= params.gap for other in prints[:i])
        for p in CLEAR:
            assert outline.distance(shapely.Point(p)) >= params.keep_clear


def test_same_seed_same_room() -> None:
    """A seed fixes the room; another gives another."""
    assert place_boxes(ClutterParams(seed=4), CLEAR) == place_boxes(
        ClutterParams(seed=4), CLEAR
    )
    assert place_boxes(ClutterParams(seed=4), CLEAR) != place_boxes(
        ClutterParams(seed=5), CLEAR
    )


def test_a_full_room_is_an_error() -> None:
    """Where there is no room for the boxes it says so."""
    params = ClutterParams(area=[-0.2, 0.2, -0.2, 0.2], min_count=6)
    with pytest.raises(ValueError, match="no room"):
        place_boxes(params, CLEAR)


@pytest.mark.parametrize(
    ("field", "value"),
    [("area", [1.0, -1.0, 0.0, 1.0]), ("max_count", 2), ("min_side", 0.0)],
)
def test_wrong_parameters_are_named(field: str, value: object) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        place_boxes(replace(ClutterParams(), **{field: value}), CLEAR)
