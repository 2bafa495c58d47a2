"""Supervoxels, merging, Filter 3."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.supervoxels import (
    choose_seeds,
    cluster_supervoxels,
    filter_small,
    merge_supervoxels,
    supervoxel_distance,
)
from footfall.systems.perception.planes.voxels import adjacent_voxels, voxelize

UP = np.array([0.0, 0.0, 1.0])


def sheet(x0: float, z: float, length: float = 0.6, width: float = 0.4) -> Vector:
    """Centres of the 2 cm voxels of a level sheet, (n, 3)."""
    x, y = np.meshgrid(
        np.arange(x0 + 0.01, x0 + length, 0.02), np.arange(0.01, width, 0.02)
    )
    return np.column_stack([x.ravel(), y.ravel(), np.full(x.size, z)])


def test_distance_is_eq_1() -> None:
    """D by hand: a tenth of a metre apart and at right angles."""
    d = supervoxel_distance(
        np.zeros(3),
        UP,
        np.array([0.1, 0.0, 0.0]),
        np.array([1.0, 0.0, 0.0]),
        seed_resolution=0.1,
        influence=0.2,
    )
    assert d == pytest.approx(np.sqrt(0.2 / 3.0 + 0.8))


def test_one_seed_a_cell() -> None:
    """Each occupied cell of R_seed has the voxel nearest to its middle as seed."""
    points = sheet(0.0, 0.05)
    seeds = choose_seeds(points, 0.1, np.arange(len(points)))
    assert len(seeds) == 6 * 4
    middle = np.abs(points[seeds, :2] / 0.1 % 1.0 - 0.5)
    assert middle.max() < 0.101


def test_supervoxels_cover_a_sheet() -> None:
    """All voxels are taken; centres are the members' means, none reaches too far."""
    points = sheet(0.0, 0.05)
    grid = voxelize(points, 0.02)
    p = points[grid.representative]
    found = cluster_supervoxels(
        p,
        np.tile(UP, (len(p), 1)),
        adjacent_voxels(grid),
        seed_resolution=0.1,
        influence=0.2,
    )
    assert found.labels.min() == 0
    assert found.count.sum() == len(p)
    assert 20 <= len(found.count) <= 30
    for label in range(len(found.count)):
        members = p[found.labels == label]
        np.testing.assert_allclose(found.center[label], members.mean(axis=0))
        assert np.linalg.norm(members - found.center[label], axis=1).max() < 0.12


def test_normals_keep_supervoxels_apart() -> None:
    """Where the normals turn by 20 deg within one cell the border follows them."""
    points = sheet(0.0, 0.05)
    tilted = np.array([np.sin(0.35), 0.0, np.cos(0.35)])
    grid = voxelize(points, 0.02)
    p = points[grid.representative]
    right = p[:, 0] > 0.36
    found = cluster_supervoxels(
        p,
        np.where(right[:, None], tilted, UP),
        adjacent_voxels(grid),
        seed_resolution=0.1,
        influence=0.01,
    )
    strays = 0
    for label in range(len(found.count)):
        share = right[found.labels == label].mean()
        strays += min(share, 1.0 - share) * found.count[label]
    assert strays <= 0.1 * len(p)


def test_a_voxel_between_two_goes_to_the_nearer_in_d() -> None:
    """Reached by two supervoxels at once it goes where its normal fits (Eq. 1)."""
    x = np.array([0.01, 0.03, 0.05, 0.07, 0.09, 0.11, 0.13])
    points = np.column_stack([x, np.full(7, 0.05), np.full(7, 0.05)])
    tilted = np.array([np.sin(0.5), 0.0, np.cos(0.5)])
    pairs = np.column_stack([np.arange(6), np.arange(1, 7)])
    for first_tilted in (4, 5):
        normals = np.where((np.arange(7) >= first_tilted)[:, None], tilted, UP)
        found = cluster_supervoxels(
            points, normals, pairs, seed_resolution=0.1, influence=0.2
        )
        wanted = (np.arange(7) >= first_tilted).astype(int)
        np.testing.assert_array_equal(found.labels, wanted)


def test_a_step_is_not_merged() -> None:
    """Sheets that touch in plan but lie 10 cm apart are two clusters, one sheet one."""
    points = np.concatenate([sheet(0.0, 0.01), sheet(0.6, 0.11)])
    riser = sheet(0.0, 0.0, 0.02)
    faces = [riser + np.array([0.59, 0.0, z]) for z in (0.03, 0.05, 0.07, 0.09)]
    points = np.concatenate([points, *faces])
    grid = voxelize(points, 0.02)
    p, pairs = points[grid.representative], adjacent_voxels(grid)
    found = cluster_supervoxels(
        p, np.tile(UP, (len(p), 1)), pairs, seed_resolution=0.1, influence=0.2
    )
    clusters = merge_supervoxels(found, pairs, angle=0.14, offset=0.015)
    clusters = filter_small(clusters, 0.02, 0.02)
    assert clusters.max() == 1
    for z in (0.01, 0.11):
        inside = np.abs(p[:, 2] - z) < 1e-6
        assert len(np.unique(clusters[inside & (np.abs(p[:, 0] - 0.6) > 0.15)])) == 1


def test_filter_3_drops_what_is_smaller_than_a_foot() -> None:
    """Of clusters of 3, 4 and 5 voxels of 4 cm^2 those under 16 cm^2 go."""
    clusters = np.repeat([0, 1, 2, -1], [3, 4, 5, 2])
    found = filter_small(clusters, 0.02, 0.0016 - 1e-9)
    np.testing.assert_array_equal(found, np.repeat([-1, 0, 1, -1], [3, 4, 5, 2]))
