"""The supporting plane: found, measured, told from tables, walls and ceilings."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.common.yaml import yaml_load_typed

from footfall.systems.perception.depth_cloud import point_cloud
from footfall.systems.perception.range_noise import RangeNoise
from footfall.systems.perception.room import floor
from footfall.systems.perception.room.floor import FloorParams, extract_floor
from footfall.systems.perception.room.floor_extractor import FloorExtractor

EYE = np.array([0.0, -0.5, 2.9])
NOISE = RangeNoise()


def scatter(points: np.ndarray, seed: int, eye: np.ndarray = EYE) -> np.ndarray:
    """Points with the sensor's error along their rays."""
    rng = np.random.default_rng(seed)
    ray = points - eye
    distance = np.linalg.norm(ray, axis=1)
    error = NOISE.deviation(distance) * rng.standard_normal(len(points))
    return points + ray * (error / distance)[:, None]


def sheet(low: list[float], high: list[float], count: int, seed: int = 0) -> np.ndarray:
    """Points spread evenly over a box between two corners, flat where they agree."""
    return np.random.default_rng(seed).uniform(low, high, (count, 3))


RAISED = np.array([0.0, 0.0, 0.5])
FLOOR = sheet([-3, -2, 0], [3, 2, 0], 60_000)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("slope", [0.0, 0.03])
def test_floor_under_boxes(seed: int, slope: float) -> None:
    """Plane, share, outline and the points above, at the sensor's noise."""
    tilt = np.array([[1, 0, 0], [0, 1, 0], [slope, 0, 1]])
    tops = sheet([-1, -1, 0.4], [1, 1, 0.6], 20_000, seed)
    cloud = np.vstack([FLOOR @ tilt.T, tops])
    estimate, above = extract_floor(scatter(cloud, seed), EYE, FloorParams(seed=seed))
    assert estimate.floor is not None
    a, b, c, d = estimate.floor.coefficients
    assert np.linalg.norm([a, b, c]) == pytest.approx(1.0)
    assert -a / c == pytest.approx(slope, abs=0.001)
    assert -b / c == pytest.approx(0.0, abs=0.001)
    assert -d / c == pytest.approx(0.0, abs=0.002)
    # Three quarters of the points are floor; 3.5 deviations hold nearly all of them.
    assert estimate.floor.inlier_share == pytest.approx(0.75, abs=0.002)
    assert abs(len(above) - 20_000) < 100
    assert (above @ [a, b, c] + d).min() > 0.01
    low, high = estimate.floor.polygon.min(axis=0), estimate.floor.polygon.max(axis=0)
    np.testing.assert_allclose(low[:2], [-3, -2], atol=0.05)
    np.testing.assert_allclose(high[:2], [3, 2], atol=0.05)
    on_plane = estimate.floor.polygon @ [a, b, c] + d
    np.testing.assert_allclose(on_plane, 0.0, atol=1e-12)
    x, y = estimate.floor.polygon[:, 0], estimate.floor.polygon[:, 1]
    assert np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) > 0.0


def test_share_may_be_less_than_the_papers() -> None:
    """A floor with 30 % of the points, most of the rest on boxes, is found."""
    tops = [
        sheet([-3, -2, z], [3, 2, z + 0.1], 7_000, 3) for z in np.arange(0.3, 2, 0.1)
    ]
    cloud = scatter(np.vstack([FLOOR[:50_000], *tops]), 1)
    estimate, _ = extract_floor(cloud, EYE, FloorParams())
    assert estimate.floor is not None
    assert estimate.floor.inlier_share == pytest.approx(0.3, abs=0.01)
    np.testing.assert_allclose(estimate.floor.coefficients, [0, 0, 1, 0], atol=0.003)


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
def test_as_many_planes_are_tried_as_the_share_asks_for(
    share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Three points, each on the floor with its share, all three once in 999 of 1000."""
    tried = 0
    judge = floor._planes

    def counting(triple: np.ndarray, max_tilt: float) -> np.ndarray:
        nonlocal tried
        tried += len(triple)
        return judge(triple, max_tilt)

    monkeypatch.setattr(floor, "_planes", counting)
    total = 20_000
    level = sheet([-3, -2, 0], [3, 2, 0], round(share * total))
    above = sheet([-3, -2, 0.3], [3, 2, 2.0], total - len(level))
    # Each point judges and gets a normal, that the share is just that.
    params = FloorParams(normal_points=total, noise=RangeNoise(near=0.0, growth=0.0))
    estimate, _ = extract_floor(np.vstack([level, above]), EYE, params)
    assert estimate.floor is not None
    found = estimate.floor.inlier_share
    assert found == pytest.approx(share, abs=0.01)
    missed = (1.0 - min(found, params.expected_share) ** 3) ** tried
    assert missed <= 1.0 - params.confidence
    fewer = (1.0 - min(found, params.expected_share) ** 3) ** (tried - floor.BATCH)
    assert fewer > 1.0 - params.confidence


@pytest.mark.parametrize(
    ("cloud", "reason"),
    [
        (np.zeros((0, 3)), "0 points"),
        (np.zeros((2, 3)), "2 points"),
        (sheet([1, -2, 0], [1, 2, 3], 20_000), "no level plane"),
        (sheet([-2, -2, 0], [2, 2, 2.5], 20_000), "no level plane"),
        (sheet([-2, -2, 3.5], [2, 2, 3.5], 20_000), "no level plane"),
        (sheet([-2, 0, 0], [2, 0, 0], 20_000), "no floor in view"),
    ],
    ids=["empty", "two points", "wall", "fog", "ceiling", "line"],
)
def test_no_floor_in_view_is_told(cloud: np.ndarray, reason: str) -> None:
    """Walls, ceilings and clouds without a plane are no floor."""
    estimate, above = extract_floor(cloud, EYE, FloorParams())
    assert estimate.floor is None
    assert reason in estimate.reason
    assert estimate.reason.startswith("no floor in view")
    assert above.shape == (0, 3)


def test_a_table_is_no_floor() -> None:
    """A larger plane with a floor seen beneath it supports nothing."""
    table = sheet([-1.5, -2, 0.7], [3, 2, 0.7], 40_000)
    floor = sheet([-3, -2, 0], [-1.5, 2, 0], 20_000)
    estimate, above = extract_floor(
        scatter(np.vstack([table, floor]), 0), EYE, FloorParams()
    )
    assert estimate.floor is not None
    np.testing.assert_allclose(estimate.floor.coefficients, [0, 0, 1, 0], atol=0.004)
    assert abs(len(above) - 40_000) < 100


def test_what_hangs_high_stands_in_no_ones_way() -> None:
    """Points above the height of interest are left out."""
    lamp = sheet([0, 0, 2.4], [0.3, 0.3, 2.5], 500)
    _, above = extract_floor(np.vstack([FLOOR, lamp]), EYE, FloorParams(max_height=2.2))
    assert len(above) == 0


def test_result_is_repeatable() -> None:
    """The same cloud gives the same floor bit for bit."""
    cloud = scatter(FLOOR, 0)
    first, second = (extract_floor(cloud, EYE, FloorParams()) for _ in range(2))
    assert first[0] == second[0]
    assert np.array_equal(first[1], second[1])


def test_system_gives_what_the_core_finds() -> None:
    """Floor, obstacles and share on the ports."""
    cloud = point_cloud(scatter(np.vstack([FLOOR, FLOOR[:9000] + RAISED]), 0))
    system = FloorExtractor()
    context = system.CreateDefaultContext()
    system.GetInputPort("cloud").FixValue(context, AbstractValue.Make(cloud))
    system.GetInputPort("viewpoint").FixValue(context, EYE)
    points = cloud.xyzs().T.astype(float)
    estimate, above = extract_floor(points, EYE, FloorParams())
    assert system.GetOutputPort("floor").Eval(context) == estimate
    obstacles = system.GetOutputPort("obstacles").Eval(context)
    np.testing.assert_array_equal(obstacles.xyzs().T, above.astype(np.float32))
    share = system.GetOutputPort("inlier_share").Eval(context)[0]
    assert share == estimate.floor.inlier_share
    system.GetInputPort("cloud").FixValue(
        context, AbstractValue.Make(point_cloud(above))
    )
    raised = system.GetOutputPort("floor").Eval(context).floor
    assert raised.coefficients[3] == pytest.approx(-0.5, abs=0.003)


def test_parameters_load_from_yaml() -> None:
    """A scenario can set them, the noise included."""
    loaded = yaml_load_typed(
        schema=FloorParams, data="{min_share: 0.4, noise: {near: 0.001}}"
    )
    assert (loaded.min_share, loaded.noise.near) == (0.4, 0.001)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("expected_share", 1.0),
        ("min_share", 0.0),
        ("max_tilt", 0.0),
        ("deviations", -1),
    ],
)
def test_wrong_parameters_are_named(field: str, value: float) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        FloorExtractor(replace(FloorParams(), **{field: value}))
