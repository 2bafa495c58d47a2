"""Voxels and Filter 2."""

import numpy as np

from footfall.systems.perception.planes.voxels import (
    adjacent_voxels,
    filter_sparse,
    keep_pairs,
    usable_points,
    voxelize,
)


def test_each_point_is_in_its_voxel() -> None:
    """Counts, means and representatives agree with a plain loop."""
    rng = np.random.default_rng(1)
    points = rng.uniform(-0.3, 0.3, (500, 3))
    grid = voxelize(points, 0.1)
    cells = np.floor(points / 0.1).astype(int)
    assert len(grid.keys) == len({tuple(cell) for cell in cells})
    assert grid.count.sum() == 500
    for voxel in range(len(grid.keys)):
        members = np.flatnonzero(grid.voxel_of_point == voxel)
        assert len({tuple(cell) for cell in cells[members]}) == 1
        mean = points[members].mean(axis=0)
        np.testing.assert_allclose(grid.mean[voxel], mean)
        distance = np.linalg.norm(points[members] - mean, axis=1)
        assert grid.representative[voxel] == members[np.argmin(distance)]


def test_neighbours_touch() -> None:
    """The pairs are those whose coordinates differ by one at most, each once."""
    rng = np.random.default_rng(2)
    grid = voxelize(rng.uniform(-0.4, 0.4, (150, 3)), 0.1)
    pairs = {tuple(sorted(pair)) for pair in adjacent_voxels(grid).tolist()}
    assert len(pairs) == len(adjacent_voxels(grid))
    apart = np.abs(grid.index[:, None] - grid.index[None]).max(axis=2)
    i, j = np.nonzero(np.triu(apart == 1))
    assert pairs == set(zip(i.tolist(), j.tolist(), strict=True))


def test_filter_2_drops_the_rim_of_a_sheet() -> None:
    """In a sheet of 5 x 5 voxels only the inner 3 x 3 have more than 5 neighbours."""
    x, y = np.meshgrid(np.arange(5) + 0.5, np.arange(5) + 0.5, indexing="ij")
    grid = voxelize(np.column_stack([x.ravel(), y.ravel(), np.full(25, 0.5)]), 1.0)
    pairs = adjacent_voxels(grid)
    kept = filter_sparse(pairs, 25, 5)
    inner = np.all((grid.mean[:, :2] > 1.0) & (grid.mean[:, :2] < 4.0), axis=1)
    np.testing.assert_array_equal(kept, inner)
    left = keep_pairs(pairs, kept)
    assert len(left) == 20
    assert left.max() == 8


def test_no_points_have_no_voxels() -> None:
    """The empty cloud passes through."""
    grid = voxelize(np.zeros((0, 3)), 0.02)
    assert len(grid.keys) == len(grid.mean) == len(adjacent_voxels(grid)) == 0


def test_points_that_are_no_points_are_left_out() -> None:
    """NaN, infinity and what no sensor sees go; the rest stays in order."""
    good = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    bad = np.array([[np.nan, 0, 0], [0, np.inf, 0], [0, 0, -np.inf], [1e9, 0, 0]])
    cloud = np.concatenate([good[:1], bad, good[1:]])
    np.testing.assert_array_equal(usable_points(cloud), good)
