"""Treads that were found in a cloud beside those of the scene it was made of."""

from collections.abc import Callable
from typing import Any

import numpy as np

from footfall.models.values.perceived import PlaneSegmentation
from footfall.models.values.vector import Vector

Scan = Callable[..., Vector]


def check_treads(
    found: PlaneSegmentation,
    scene: Any,
    wanted: list[int],
    *,
    height: float = 0.003,
    edge: float = 0.01,
    yaw: float = 0.5,
) -> None:
    """Compares the treads that were found with those of the scene (m, m, deg)."""
    treads = found.staircase.treads
    assert len(treads) == len(wanted)
    R_WS = scene.rotation()
    for tread, index in zip(treads, wanted, strict=True):
        error = (tread.corners() - scene.tread_corners(index)) @ R_WS
        assert np.abs(error[:, 2]).max() < height
        assert np.abs(error[:, :2]).max() < edge
        x: Vector = R_WS.T @ tread.X_WR.rotation().matrix()[:, 0]
        assert abs(np.degrees(np.arctan2(x[1], x[0]))) < yaw
        assert np.degrees(np.arccos(tread.normal[2])) < 1.5
        np.testing.assert_allclose(tread.normal, tread.X_WR.rotation().matrix()[:, 2])
        assert tread in found.planes
