"""Euclidean clusters against the paper's flood fill."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from footfall.systems.perception.obstacles.clusters import cluster_points


def flood(points: np.ndarray, radius: float) -> np.ndarray:
    """The room paper's algorithm on the horizontal places, word for word."""
    tree = cKDTree(points[:, :2])
    label = np.full(len(points), -1)
    for seed in range(len(points)):
        if label[seed] >= 0:
            continue
        queue = [seed]
        label[seed] = label.max() + 1
        for p in queue:
            for neighbour in tree.query_ball_point(points[p, :2], radius):
                if label[neighbour] < 0:
                    label[neighbour] = label[seed]
                    queue.append(neighbour)
    return label


@pytest.mark.parametrize("seed", range(10))
def test_clusters_are_those_of_the_flood_fill(seed: int) -> None:
    """With columns so small that each holds one point both agree, numbers included."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(0.0, 2.0, (600, 3))
    found = cluster_points(points, 0.08, 1e-7)
    assert found.max() > 10
    np.testing.assert_array_equal(found, flood(points, 0.08))


def test_gap_and_height() -> None:
    """A gap above the radius separates, a height does not."""
    x = np.arange(0.0, 0.5, 0.02)
    row = np.column_stack([x, np.zeros_like(x), np.zeros_like(x)])
    above, beside, apart = (row + d for d in ([0, 0, 1.0], [0, 0.04, 0], [0, 0.15, 0]))
    labels = cluster_points(np.vstack([row, above, beside, apart]), 0.06, 0.02)
    assert labels.tolist() == [0] * 75 + [1] * 25


def test_nothing_is_no_cluster() -> None:
    """An empty cloud has no labels, a point has one."""
    assert cluster_points(np.zeros((0, 3)), 0.06, 0.02).shape == (0,)
    assert cluster_points(np.zeros((1, 3)), 0.06, 0.02).tolist() == [0]
