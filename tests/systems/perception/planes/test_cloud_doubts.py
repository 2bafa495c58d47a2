"""What is said of clouds without planes: each common mistake by its own words."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.cloud_doubts import (
    describe_cloud,
    doubt_cloud,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.voxels import point_spacing

PARAMS = PlaneSegmenterParams()
DOWN = np.array([0.0, 0.0, -9.81])
SOLE = 48
"""Voxels that a sole covers."""


def plate(spacing: float = 0.01, low: float = 0.5) -> Vector:
    """A level grid of points, 2 x 1 m, as high as it is off the origin."""
    x, y = np.meshgrid(np.arange(0.0, 2.0, spacing), np.arange(0.0, 1.0, spacing))
    points: Vector = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    return points + low


def leaning(degrees: float) -> Vector:
    """The plate pitched up about y."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return plate() @ np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.zeros((100, 3)), "all points lie at the origin"),
        (np.vstack([np.zeros((30_000, 3)), plate()]), "60% of the points lie at the"),
        (0.002 * plate(low=0.0), "within 0.004 m of the origin: are these metres?"),
        (0.002 * plate() + 5.0, "within 0.004 m of each other: are these metres?"),
        (1000.0 * plate(), "1,950 m across with points 10 m apart: are these millim"),
        (100.0 * plate(), "195 m across with points 1 m apart: are these centimetres"),
        (
            np.vstack([plate() + np.array([4e5, y, 0.0]) for y in (5e6, 5.003e6)]),
            "5,0.*m from the origin.*subtract an offset",
        ),
        (leaning(90.0) + np.array([4e5, 5e6, 0.0]), "leans by 90 deg"),
        (plate(0.05), r"farther apart \(0.05 m\) than voxels are large \(0.02 m\)"),
        (plate()[:40], "fewer points than a sole has voxels"),
        (leaning(90.0), "leans by 90 deg.*with gravity along -1,0,0"),
        (leaning(20.0), "leans by 20 deg.*more than 15 deg.*along 0.34,0,-0.94"),
    ],
)
def test_each_mistake_has_its_words(points: Vector, words: str) -> None:
    """The likely one alone is told."""
    (doubt,) = doubt_cloud(points, DOWN, PARAMS, SOLE)
    with pytest.raises(AssertionError, match=words):
        raise AssertionError(doubt)


def test_a_cloud_of_noise_is_not_flat() -> None:
    """Where neither scale nor gravity is to blame."""
    points = np.random.default_rng(0).uniform(0.0, 0.5, (20_000, 3))
    (doubt,) = doubt_cloud(points, DOWN, PARAMS, SOLE)
    assert doubt.startswith("nothing in it is flat, level and as large as a sole")


def test_gravity_that_points_along_the_surface() -> None:
    """A cloud of a camera, y down, taken for one with z up."""
    points = plate() @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]])
    (doubt,) = doubt_cloud(points, DOWN, PARAMS, SOLE)
    assert "leans by 90 deg" in doubt
    assert "along 0,1,0" in doubt or "along 0,-1,0" in doubt


def test_a_cloud_in_a_line() -> None:
    """Number, extent and spacing; a lone point has none."""
    said = "20,000 points in 1.99 x 0.99 x 0 m, typically 0.01 m apart"
    assert describe_cloud(plate()) == said
    assert describe_cloud(np.ones((1, 3))) == (
        "1 point in 0 x 0 x 0 m, typically 0 m apart"
    )
    assert describe_cloud(1e4 * plate())[:33] == "20,000 points in 19,900 x 9,900 x"
    assert point_spacing(plate()) == pytest.approx(0.01)


def test_no_point_is_near_enough_to_be_looked_at() -> None:
    """Two dense heaps beyond the range that is kept: still an answer."""
    far = np.array([0.0, 0.0, 2e4])
    points = np.vstack([plate() + far, plate() - far])
    assert len(doubt_cloud(points, DOWN, PARAMS, SOLE)) == 1
