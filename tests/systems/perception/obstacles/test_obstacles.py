"""Obstacles in clouds of a scene whose truth is known."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.obstacles import (
    ObstacleFinderParams,
    find_obstacles,
    floor_height,
    low_patches,
)

EYES: Vector = np.array([0.0, 0.0, 1.5])


def _cloud(
    boxes: list[tuple[float, float, float, float, float, float]], noise: float = 0.005
) -> Vector:
    """Floor, front faces and tops of boxes (x, y, yaw, width, length, height)."""
    rng = np.random.default_rng(5)
    parts = [
        np.column_stack(
            [rng.uniform([0.4, -1.5], [2.4, 1.5], (12000, 2)), np.zeros(12000)]
        )
    ]
    for x, y, yaw, width, length, height in boxes:
        c, s = np.cos(yaw), np.sin(yaw)
        across, along = np.array([c, s]), np.array([-s, c])
        for depth, face in ((width, False), (height, True)):
            n = int(20000 * depth * length)
            u = rng.uniform(0.0, 1.0, n) * depth
            v = rng.uniform(-0.5, 0.5, n) * length
            offset = -width / 2.0 if face else u - width / 2.0
            p = (
                np.array([x, y])
                + np.multiply.outer(np.broadcast_to(offset, n), across)
                + v[:, None] * along
            )
            parts.append(np.column_stack([p, u if face else np.full(n, height)]))
    points = np.vstack(parts)
    ray = points - EYES
    distance = np.linalg.norm(ray, axis=1)
    noisy: Vector = (
        points + (noise * rng.standard_normal(len(ray)) / distance)[:, None] * ray
    )
    return noisy


@pytest.mark.parametrize("yaw", [0.0, 0.26, -0.4])
@pytest.mark.parametrize("height", [0.08, 0.15, 0.25])
def test_size_place_and_yaw(yaw: float, height: float) -> None:
    """Within what the margins of a crossing have left."""
    seen = find_obstacles(
        _cloud([(1.2, 0.1, yaw, 0.05, 1.0, height)]), EYES, ObstacleFinderParams()
    )
    assert seen.status == "ok"
    assert seen.floor_height == pytest.approx(0.0, abs=1e-3)
    (found,) = seen.obstacles
    assert found.height == pytest.approx(height, abs=0.005)
    assert found.width == pytest.approx(0.05, abs=0.012)
    assert found.yaw == pytest.approx(yaw, abs=np.radians(1.0))
    ahead = np.array([np.cos(yaw), np.sin(yaw)])
    front = found.center @ ahead - found.width / 2.0
    assert front == pytest.approx(np.array([1.2, 0.1]) @ ahead - 0.025, abs=0.004)
    assert found.length == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("width", [0.05, 0.1, 0.2])
def test_no_obstacle_is_seen_narrower_than_it_is(width: float) -> None:
    """Its back edge lies up to a scan line beyond the last points: that is added."""
    cloud = _cloud([(1.2, 0.1, 0.2, width, 1.0, 0.15)])
    (found,) = find_obstacles(cloud, EYES, ObstacleFinderParams()).obstacles
    ahead = np.array([np.cos(0.2), np.sin(0.2)])
    back = found.center @ ahead + 0.5 * found.width
    true = np.array([1.2, 0.1]) @ ahead + 0.5 * width
    assert true <= back < true + 0.01


def test_the_allowance_moves_the_back_alone() -> None:
    """By as much as it is; front, height and length stay."""
    cloud = _cloud([(1.2, 0.1, 0.2, 0.05, 1.0, 0.15)])
    bare, allowed = (
        find_obstacles(
            cloud, EYES, replace(ObstacleFinderParams(), back_allowance=allowance)
        ).obstacles[0]
        for allowance in (0.0, 0.02)
    )
    ahead = np.array([np.cos(bare.yaw), np.sin(bare.yaw)])
    assert allowed.width - bare.width == pytest.approx(0.02)
    np.testing.assert_allclose(allowed.center - bare.center, 0.01 * ahead, atol=1e-12)
    assert (allowed.yaw, allowed.height) == (bare.yaw, bare.height)
    assert allowed.length == pytest.approx(bare.length)


def test_two_in_a_row_are_two_nearest_first() -> None:
    """60 cm apart."""
    boxes = [(1.7, 0.0, 0.0, 0.05, 1.0, 0.15), (1.1, 0.0, 0.0, 0.05, 1.0, 0.15)]
    seen = find_obstacles(_cloud(boxes), EYES, ObstacleFinderParams())
    assert [round(item.center[0], 1) for item in seen.obstacles] == [1.1, 1.7]


def test_bare_floor_has_none_and_nothing_has_no_floor() -> None:
    """A millimetre high is the floor too."""
    params = ObstacleFinderParams()
    assert find_obstacles(_cloud([]), EYES, params).obstacles == ()
    low = _cloud([(1.2, 0.0, 0.0, 0.05, 1.0, 0.001)])
    assert find_obstacles(low, EYES, params).obstacles == ()
    assert find_obstacles(np.zeros((0, 3)), EYES, params).status == "no floor"


def test_floor_height_is_the_densest_level() -> None:
    """Not the lowest points."""
    z = np.concatenate([np.full(50, 0.3), np.full(20, -0.2), np.full(10, 0.6)])
    assert floor_height(z, 0.02) == pytest.approx(0.3)


def test_validation() -> None:
    """A field out of range is named."""
    with pytest.raises(ValueError, match="tail: must be less than"):
        replace(ObstacleFinderParams(), tail=0.4).validate()


@pytest.mark.parametrize("height", [0.010, 0.015, 0.025])
def test_a_slat_lower_than_the_noise_is_seen(height: float) -> None:
    """Single points cannot tell it from the floor, the mean of a patch can."""
    seen = find_obstacles(
        _cloud([(1.2, 0.1, 0.2, 0.05, 1.0, height)]), EYES, ObstacleFinderParams()
    )
    (found,) = seen.obstacles
    assert found.height == pytest.approx(height, abs=0.006)
    assert found.width == pytest.approx(0.05, abs=0.03)
    assert found.center == pytest.approx([1.2, 0.1], abs=0.02)
    assert found.length == pytest.approx(1.0, abs=0.08)


@pytest.mark.parametrize("count", [4, 25, 100])
def test_a_patch_is_raised_by_five_deviations_of_its_mean(count: int) -> None:
    """Which falls with the root of its points: a little less is the floor's noise."""
    params = replace(ObstacleFinderParams(), low_height=1e-6)
    plan = np.random.default_rng(0).uniform(0.0, 0.02, (count, 2))
    points = np.column_stack([plan, np.zeros(count)])
    least = 5.0 * params.deviation / np.sqrt(count)
    for share, raised in ((0.95, False), (1.05, True)):
        height = np.full(count, share * least)
        wide = replace(params, min_height=1.0)
        assert (low_patches(points, height, wide) == raised).all()


@pytest.mark.parametrize("tail", [0.0, 0.02, 0.1])
def test_the_length_does_not_depend_on_the_tail(tail: float) -> None:
    """What the ends that are left out would span is added."""
    params = replace(ObstacleFinderParams(), tail=tail)
    cloud = _cloud([(1.2, 0.1, 0.2, 0.05, 1.0, 0.15)], noise=0.001)
    (found,) = find_obstacles(cloud, EYES, params).obstacles
    assert found.length == pytest.approx(1.0, abs=0.015)


def test_the_noise_of_the_floor_is_no_slat() -> None:
    """Patches with few points are believed less."""
    for seed in range(20):
        rng = np.random.default_rng(seed)
        floor = rng.uniform([0.4, -1.5], [2.9, 1.5], (12000, 2))
        z = 0.005 * rng.standard_normal(12000)
        seen = find_obstacles(np.column_stack([floor, z]), EYES, ObstacleFinderParams())
        assert seen.status == "ok"
        assert seen.obstacles == ()
