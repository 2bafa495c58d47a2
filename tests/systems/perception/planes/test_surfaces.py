"""Pieces of surface of columns, their clusters and their planes."""

import numpy as np
import pytest

from footfall.systems.perception.planes.surface_planes import (
    bound_surfaces,
    fit_surfaces,
)
from footfall.systems.perception.planes.surfaces import (
    cluster_surfaces,
    cut_columns,
    level_noise,
    neighbours,
)

CELL = 0.02
FIT = {
    "offset": 0.015,
    "angle": 0.1,
    "tolerance": 0.015,
    "slope_tolerance": 0.26,
    "min_area": 0.02,
    "seed": 0,
}


def sheet(
    low: tuple[float, float], size: tuple[float, float], z: float, slope: float = 0.0
) -> np.ndarray:
    """Points every 7 mm of a surface that rises along x."""
    x = np.arange(low[0], low[0] + size[0], 0.007)
    y = np.arange(low[1], low[1] + size[1], 0.007)
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    return np.column_stack([grid, z + slope * (grid[:, 0] - low[0])])


def test_a_column_is_cut_where_nothing_is() -> None:
    """Two levels in one column are two pieces; a wall is one long piece."""
    levels = np.array([[0.01, 0.01, z] for z in (0.0, 0.004, 0.2, 0.206)])
    wall = np.array([[0.05, 0.01, z] for z in np.arange(0.0, 0.3, 0.02)])
    surfaces = cut_columns(np.concatenate([wall, levels]), CELL)
    np.testing.assert_array_equal(surfaces.count, [2, 2, 15])
    np.testing.assert_allclose(surfaces.mean[:2, 2], [0.002, 0.203])
    np.testing.assert_allclose(surfaces.high - surfaces.low, [0.004, 0.006, 0.28])
    # Pieces hold each point once.
    np.testing.assert_array_equal(np.sort(surfaces.order), np.arange(19))
    np.testing.assert_array_equal(
        np.sort(surfaces.points_of(np.array([0, 1]))), [15, 16, 17, 18]
    )


def test_no_cloud_has_no_pieces() -> None:
    """Nothing goes in, nothing comes out."""
    surfaces = cut_columns(np.zeros((0, 3)), CELL)
    assert len(surfaces.count) == 0
    clusters = cluster_surfaces(surfaces, None, offset=0.015, min_area=0.02)
    assert fit_surfaces(surfaces, clusters, **FIT) == ()


def test_pieces_far_apart_in_keys_are_sorted_all_the_same() -> None:
    """A cloud so wide that places do not fit beside keys in 64 bits."""
    points = np.concatenate([sheet((0, 0), (0.2, 0.2), 0.0), [[9e3, 9e3, 9e3]]])
    surfaces = cut_columns(points, 1e-3)
    np.testing.assert_array_equal(np.sort(surfaces.order), np.arange(len(points)))
    assert np.all(np.diff(surfaces.column) >= 0)


@pytest.mark.parametrize("noise", [0.002, 0.005, 0.008])
def test_noise_is_that_of_level_surfaces(noise: float) -> None:
    """Within a tenth, whatever walls are there."""
    rng = np.random.default_rng(0)
    floor = np.column_stack([rng.uniform(0, 1, (40_000, 2)), np.zeros(40_000)])
    wall = np.column_stack([np.zeros(9000), rng.uniform(0, 1, (9000, 2))])
    cloud = np.concatenate([floor, wall])
    cloud[:, 2] += rng.normal(0.0, noise, len(cloud))
    found = level_noise(cut_columns(cloud, CELL), cloud)
    assert found == pytest.approx(noise, rel=0.1)


def test_each_pair_of_neighbours_is_found_once() -> None:
    """A grid of k by k columns has 2 k (k - 1) + 2 (k - 1)^2 pairs, diagonals too."""
    k = 7
    x, y = np.meshgrid(np.arange(k), np.arange(k))
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(k * k)]) * CELL + 0.005
    surfaces = cut_columns(points, CELL)
    pairs = neighbours(surfaces, np.arange(k * k), 0.01)
    assert len(np.unique(np.sort(pairs, axis=1), axis=0)) == len(pairs)
    assert len(pairs) == 2 * k * (k - 1) + 2 * (k - 1) ** 2
    points[:, 2] += np.where(points[:, 0] < 3 * CELL, 0.0, 0.02)
    apart = neighbours(cut_columns(points, CELL), np.arange(k * k), 0.01)
    assert len(apart) == len(pairs) - k - 2 * (k - 1)


def test_levels_are_planes_and_walls_are_none() -> None:
    """A floor, a step and the riser between them; the eye sees no ceiling."""
    riser = sheet((0.0, 0.0), (0.2, 0.5), 0.0)[:, [2, 1, 0]] + [0.4, 0.0, 0.0]
    cloud = np.concatenate(
        [
            sheet((0.0, 0.0), (0.4, 0.5), 0.0),
            riser,
            sheet((0.4, 0.0), (0.3, 0.5), 0.2),
            sheet((0.0, 0.0), (0.7, 0.5), 2.4),
        ]
    )
    surfaces = cut_columns(cloud, CELL)
    for eye, heights in ((None, [0.0, 0.2, 2.4]), (np.array([0, 0, 1.5]), [0.0, 0.2])):
        clusters = cluster_surfaces(surfaces, eye, offset=0.015, min_area=0.02)
        planes = fit_surfaces(surfaces, clusters, **FIT)
        patches = bound_surfaces(surfaces, planes, cloud, 0.015)
        found = sorted(float(patch.center[2]) for patch in patches)
        np.testing.assert_allclose(found, heights, atol=0.001)
        (step,) = [p for p in patches if abs(p.center[2] - 0.2) < 0.01]
        np.testing.assert_allclose(step.extent[:2], [0.3, 0.5], atol=0.015)


def test_a_roof_is_two_planes() -> None:
    """Two slopes of 10 deg that meet hang together, and are told apart."""
    slope = np.tan(np.radians(10.0))
    up = sheet((0.0, 0.0), (0.5, 0.5), 0.0, slope)
    down = sheet((0.5, 0.0), (0.5, 0.5), 0.5 * slope, -slope)
    surfaces = cut_columns(np.concatenate([up, down]), CELL)
    clusters = cluster_surfaces(surfaces, None, offset=0.015, min_area=0.02)
    assert clusters.max() == 0
    planes = fit_surfaces(surfaces, clusters, **FIT)
    slopes = sorted(float(np.degrees(np.arcsin(plane.normal[0]))) for plane in planes)
    np.testing.assert_allclose(slopes, [-10.0, 10.0], atol=0.5)
