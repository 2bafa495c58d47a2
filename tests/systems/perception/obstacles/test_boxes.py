"""Upright boxes from points that a camera above could have seen."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue

from footfall.models.values.room import FloorEstimate, FloorPlane, ObstacleBox
from footfall.systems.perception.depth_cloud import point_cloud
from footfall.systems.perception.obstacles.boxes import (
    ObstacleClustererParams,
    even_rectangle,
    find_boxes,
    fit_box,
    top_height,
)
from footfall.systems.perception.obstacles.obstacle_clusterer import ObstacleClusterer
from footfall.systems.perception.range_noise import RangeNoise

EYE = np.array([0.0, -0.5, 2.9])
FLOOR = FloorPlane(
    np.array([0.0, 0.0, 1.0, 0.0]),
    np.array([[-3.0, -2, 0], [3, -2, 0], [3, 2, 0], [-3, 2, 0]]),
)


def seen_box(box: ObstacleBox, seed: int, count: int = 4000) -> np.ndarray:
    """Noisy points of the faces of a box that the eye sees, evenly in its picture."""
    rng = np.random.default_rng(seed)
    X_WB = box.X_WB
    eye_B = X_WB.inverse().multiply(EYE)
    points, weights = [], []
    for axis in range(3):
        side = np.sign(eye_B[axis])
        if abs(eye_B[axis]) <= box.size[axis] / 2.0:
            continue
        p_B = rng.uniform(-0.5, 0.5, (count, 3)) * box.size
        p_B[:, axis] = side * box.size[axis] / 2.0
        ray = p_B - eye_B
        distance = np.linalg.norm(ray, axis=1)
        points.append(np.array(X_WB.multiply(p_B.T)).T)
        area = np.prod(np.delete(box.size, axis))
        weights.append(area * np.abs(ray[:, axis]) / distance**3)
    points, weights = np.vstack(points), np.concatenate(weights)
    chosen = points[rng.choice(len(points), 1500, p=weights / weights.sum())]
    ray = chosen - EYE
    distance = np.linalg.norm(ray, axis=1)
    error = RangeNoise().deviation(distance) * rng.standard_normal(len(ray))
    chosen = chosen + ray * (error / distance)[:, None]
    return chosen[chosen[:, 2] > 0.06]


def random_box(rng: np.random.Generator) -> ObstacleBox:
    """A box of 20 cm and more somewhere on the floor."""
    size = np.append(rng.uniform(0.2, 0.6, 2), rng.uniform(0.2, 0.8))
    center = np.append(rng.uniform([-2.0, -1.5], [2.0, 1.5]), size[2] / 2.0)
    return ObstacleBox("box", center, float(rng.uniform(-np.pi, np.pi)), size)


def assert_close(found: ObstacleBox, true: ObstacleBox) -> None:
    """Centre within 3 cm and sides within 5 cm, whichever side is called x."""
    assert np.linalg.norm(found.center - true.center) < 0.03
    quarters = round((found.yaw - true.yaw) / (np.pi / 2.0))
    size = true.size[[1, 0, 2]] if quarters % 2 else true.size
    np.testing.assert_allclose(found.size, size, atol=0.05)


@pytest.mark.parametrize("seed", range(40))
def test_box_of_a_noisy_view(seed: int) -> None:
    """Random boxes, turned any way, are within the issue's bounds."""
    true = random_box(np.random.default_rng(seed))
    points = seen_box(true, seed)
    assert_close(fit_box(points, FLOOR, EYE, ObstacleClustererParams()), true)


def test_a_tower_is_as_high_as_its_top() -> None:
    """A small block on a large one counts; a lone point above does not."""
    rng = np.random.default_rng(0)
    large, small = rng.uniform(0, 1, 1000) * 0.01 + 0.3, np.full(500, 0.5)
    z = np.concatenate([large, small, [0.9]])
    assert top_height(z, 0.02, 0.35) == pytest.approx(0.5, abs=1e-6)
    assert top_height(z, 0.02, 0.6) == pytest.approx(0.305, abs=1e-3)


@pytest.mark.parametrize("yaw_deg", [-42.0, -20.0, 0.0, 13.5, 42.0])
def test_rectangle_of_even_points(yaw_deg: float) -> None:
    """Middle, yaw and sides of a filled rectangle; stray points do not matter."""
    rng = np.random.default_rng(1)
    yaw = np.radians(yaw_deg)
    turn = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])
    plan = rng.uniform(-0.5, 0.5, (3000, 2)) * [0.5, 0.25] @ turn + [1.0, -2.0]
    plan = np.vstack([plan, rng.uniform([0.5, -2.5], [1.5, -1.5], (20, 2))])
    middle, found, extent = even_rectangle(plan, 0.04)
    np.testing.assert_allclose(middle, [1.0, -2.0], atol=0.004)
    assert found == pytest.approx(yaw, abs=np.radians(1.6))
    np.testing.assert_allclose(extent, [0.5, 0.25], atol=0.012)


def test_sides_swap_with_a_quarter_turn() -> None:
    """Yaw stays within 45 deg of x; a box turned by 80 deg is one turned by -10."""
    rng = np.random.default_rng(1)
    yaw = np.radians(80.0)
    turn = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])
    plan = rng.uniform(-0.5, 0.5, (3000, 2)) * [0.5, 0.25] @ turn
    _, found, extent = even_rectangle(plan, 0.04)
    assert found == pytest.approx(np.radians(-10.0), abs=np.radians(1.6))
    np.testing.assert_allclose(extent, [0.25, 0.5], atol=0.012)


def test_boxes_are_told_apart_and_noise_is_left_out() -> None:
    """Two boxes 12 cm apart and some specks give two boxes, named by their x."""
    side = np.array([0.3, 0.3, 0.4])
    left = ObstacleBox("box_0", np.array([-0.21, 0.0, 0.2]), 0.0, side)
    right = replace(left, name="box_1", center=np.array([0.21, 0.0, 0.2]))
    specks = np.random.default_rng(2).uniform([-3, 1, 0.1], [3, 2, 1], (60, 3))
    points = np.vstack([seen_box(right, 0), seen_box(left, 1), specks])
    boxes = find_boxes(points, FLOOR, EYE, ObstacleClustererParams())
    assert [box.name for box in boxes] == ["box_0", "box_1"]
    for found, true in zip(boxes, (left, right), strict=True):
        assert_close(found, true)
        assert 1000 < found.support_count <= 1500
    assert boxes == find_boxes(points, FLOOR, EYE, ObstacleClustererParams())


def test_boxes_reach_down_to_a_sloping_floor() -> None:
    """The foot of a box is the floor under its middle."""
    normal = np.array([0.05, 0.0, 1.0]) / np.linalg.norm([0.05, 0.0, 1.0])
    floor = replace(FLOOR, coefficients=np.append(normal, 0.0))
    true = ObstacleBox("", np.array([1.0, 0.0, 0.2]), 0.0, np.array([0.3, 0.3, 0.4]))
    found = fit_box(seen_box(true, 0), floor, EYE, ObstacleClustererParams())
    foot = found.center[2] - found.size[2] / 2.0
    assert foot == pytest.approx(-0.05 * found.center[0], abs=1e-9)
    assert foot + found.size[2] == pytest.approx(0.4, abs=0.01)


def test_aligned_box_contains_the_oriented_one() -> None:
    """Its corners are the extremes of the footprint and of the height."""
    box = random_box(np.random.default_rng(3))
    low, high = box.aligned()
    half = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    corners = np.array(box.X_WB.multiply((half * box.size / 2.0).T)).T
    np.testing.assert_allclose(corners.min(axis=0), low, atol=1e-12)
    np.testing.assert_allclose(corners.max(axis=0), high, atol=1e-12)


def test_system_gives_the_environment_or_the_reason() -> None:
    """Boxes on the floor; none and why where there is no floor."""
    true = ObstacleBox("", np.array([1.0, 0.0, 0.2]), 0.0, np.array([0.3, 0.3, 0.4]))
    system = ObstacleClusterer()
    context = system.CreateDefaultContext()
    floor = system.GetInputPort("floor")
    floor.FixValue(context, AbstractValue.Make(FloorEstimate(FLOOR)))
    system.GetInputPort("obstacles").FixValue(
        context, AbstractValue.Make(point_cloud(seen_box(true, 0)))
    )
    system.GetInputPort("viewpoint").FixValue(context, EYE)
    environment = system.GetOutputPort("environment").Eval(context)
    assert environment.floor == FLOOR
    assert len(environment.boxes) == 1
    assert_close(environment.boxes[0], true)
    missing = AbstractValue.Make(FloorEstimate(reason="no floor in view: fog"))
    floor.FixValue(context, missing)
    environment = system.GetOutputPort("environment").Eval(context)
    assert (environment.floor, environment.boxes) == (None, ())
    assert environment.reason == "no floor in view: fog"


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("radius", 0.0),
        ("cell", 0.5),
        ("min_points", 1),
        ("tail", 0.3),
        ("top_share", 0),
    ],
)
def test_wrong_parameters_are_named(field: str, value: float) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        ObstacleClusterer(replace(ObstacleClustererParams(), **{field: value}))


@pytest.mark.parametrize("tail", [0.0, 0.04, 0.2])
def test_what_the_tails_would_span_is_added(tail: float) -> None:
    """Of points that fill a rectangle evenly: its sides, whatever is left out."""
    x, y = np.meshgrid(np.linspace(-0.3, 0.3, 101), np.linspace(-0.2, 0.2, 101))
    angle = 0.2
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    plan = np.column_stack([x.ravel(), y.ravel()]) @ turn + [1.0, 2.0]
    # The yaw is less sure the more is left out.
    middle, _, extent = even_rectangle(plan, tail)
    np.testing.assert_allclose(middle, [1.0, 2.0], atol=2e-3)
    np.testing.assert_allclose(extent, [0.6, 0.4], atol=0.015)
