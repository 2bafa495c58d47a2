"""How long stability polygons take, beside what pip offers, and preview of a walk.

Run with `pytest -n 0 --benchmark-only tests/benchmarks/test_stability_speed.py`.
"""

from collections.abc import Callable
from itertools import cycle
from typing import Any

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from scipy.spatial import ConvexHull

from footfall.systems.balance.contact_wrench_cone import (
    Contact,
    point_contact,
    stance_generators,
)
from footfall.systems.balance.convex_polygon import hausdorff_distance
from footfall.systems.balance.stability_polygon import (
    robust_polygon,
    static_polygon,
    zmp_support_area,
)
from footfall.systems.balance.zmp_preview import (
    ZmpPreviewParams,
    generate,
    preview_gains,
)
from footfall.systems.balance.zmp_tracking import generate_varying_height

Stance = list[Contact]


def foot(position: list[float], *rpy: float) -> Contact:
    """A sole of 24 x 14 cm."""
    angles = RollPitchYaw(*rpy) if rpy else RollPitchYaw(0.0, 0.0, 0.0)
    return Contact(RigidTransform(angles, position), 0.12, 0.07, 0.7)


def two_feet_on_stairs() -> list[Stance]:
    """Rises of 15 to 25 cm, both ways round, feet turned out a little."""
    rng = np.random.default_rng(0)
    stances = []
    for _ in range(40):
        rise, depth = rng.uniform(0.15, 0.25), rng.uniform(0.25, 0.32)
        yaw = rng.uniform(-0.2, 0.2, 2)
        side = rng.choice([-0.1, 0.1])
        stances.append(
            [
                foot([0.0, side, 0.0], 0.0, 0.0, yaw[0]),
                foot([depth, -side, rise], 0.0, 0.0, yaw[1]),
            ]
        )
    return stances


def two_tilted_feet() -> list[Stance]:
    """The same, each sole rolled and pitched by up to 20 deg."""
    rng = np.random.default_rng(1)
    tilted = []
    for stance in two_feet_on_stairs():
        tilts = rng.uniform(-0.35, 0.35, (2, 2))
        tilted.append(
            [
                foot(list(c.X_WC.translation()), *tilt, rng.uniform(-0.2, 0.2))
                for c, tilt in zip(stance, tilts, strict=True)
            ]
        )
    return tilted


def with_a_hand(stances: list[Stance], point: bool) -> list[Stance]:
    """With a hand on a rail beside the robot, as a point or as 8 x 8 cm."""
    rng = np.random.default_rng(2)
    held = []
    for stance in stances:
        X = RigidTransform(
            RollPitchYaw(*rng.uniform(-0.5, 0.5, 3)), rng.uniform(0.2, 0.5, 3) + 0.4
        )
        hand = point_contact(X, 0.5) if point else Contact(X, 0.04, 0.04, 0.5)
        held.append([*stance, hand])
    return held


STANCES: dict[str, Callable[[], list[Stance]]] = {
    "two feet on stairs": two_feet_on_stairs,
    "two tilted feet": two_tilted_feet,
    "stairs and hand point": lambda: with_a_hand(two_feet_on_stairs(), True),
    "stairs and hand patch": lambda: with_a_hand(two_feet_on_stairs(), False),
    "tilted and hand patch": lambda: with_a_hand(two_tilted_feet(), False),
}


def pypoman_polygon(stance: Stance) -> np.ndarray:
    """The same polygon as one writes it with pypoman: face matrix, cut, hull."""
    pypoman = pytest.importorskip("pypoman", reason="the peer; pip install pypoman")
    weight = 62.0 * 9.81
    H = pypoman.compute_cone_face_matrix(stance_generators(stance))
    B = weight * np.column_stack([-H[:, 4], H[:, 3]])
    return np.array(pypoman.compute_polygon_hull(B, -weight * H[:, 2]))


@pytest.mark.parametrize("name", STANCES)
@pytest.mark.parametrize("method", ["section", "double_description", "projection"])
def test_static_polygon(benchmark: Any, name: str, method: Any) -> None:
    """One polygon, check included, over forty stances in turn."""
    benchmark.group = name
    stances = cycle(STANCES[name]())
    polygon = benchmark.pedantic(
        lambda: static_polygon(next(stances), method),
        rounds=40 if method == "projection" else 200,
        warmup_rounds=5,
    )
    assert polygon.status == "ok"


@pytest.mark.parametrize("name", STANCES)
def test_pypoman(benchmark: Any, name: str) -> None:
    """The peer on the same stances; how many it gets wrong is in `extra_info`."""
    benchmark.group = name
    stances = STANCES[name]()
    results: list[tuple[Stance, np.ndarray | None]] = []
    turn = cycle(stances)

    def attempt() -> None:
        stance = next(turn)
        try:
            results.append((stance, pypoman_polygon(stance)))
        except Exception:  # whatever it raises is a stance without an answer
            results.append((stance, None))

    benchmark.pedantic(attempt, rounds=len(stances), warmup_rounds=0)
    wrong = 0
    for stance, points in results:
        ours = static_polygon(stance).vertices
        if points is None:
            wrong += 1
        else:
            theirs = points[ConvexHull(points).vertices]
            wrong += hausdorff_distance(ours, theirs) > 1e-4
    benchmark.extra_info["wrong"] = f"{wrong} of {len(stances)}"


@pytest.mark.parametrize("question", ["robust", "zmp"])
def test_other_areas(benchmark: Any, question: str) -> None:
    """Two tilted feet: bounded accelerations (eight corners), ZMP support area."""
    stances = cycle(two_tilted_feet())
    com, bound = np.array([0.13, 0.0, 0.9]), np.array([0.3, 0.3, 0.3])
    if question == "robust":
        benchmark(lambda: robust_polygon(next(stances), 0.9, bound))
    else:
        benchmark(lambda: zmp_support_area(next(stances), com, 0.1))


@pytest.mark.parametrize("method", ["preview", "tracking"])
def test_ten_seconds_of_walk(benchmark: Any, method: str) -> None:
    """2000 ticks of both axes."""
    params = ZmpPreviewParams()
    gains = preview_gains(params)
    steps = np.floor(np.arange(2000) * 0.005 / 0.8)
    reference = np.column_stack([0.3 * steps, 0.1 * (-1.0) ** steps])
    c = np.full(2000, 0.083)
    if method == "preview":
        benchmark(lambda: generate(gains, reference))
    else:
        benchmark(lambda: generate_varying_height(reference, c, params))
