"""Soles on treads and on the floor."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.diagrams.judge.ground import (
    FLOOR,
    Ground,
    carried_outlines,
    corner_heights,
    share_over,
    stands_flat,
    tread_ground,
)
from footfall.diagrams.judge.true_motion import sole_corners_F
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.vector import Vector


def sole(
    x: float, y: float = 0.0, z: float = 0.0, pitch: float = 0.0, yaw: float = 0.0
) -> Vector:
    """Corners of a sole in W, (1, 4, 3)."""
    X_WF = RigidTransform(RollPitchYaw(0.0, pitch, yaw), np.array([x, y, z]))
    return np.array(X_WF.multiply(sole_corners_F(JVRC1.sole).T)).T[None]


@pytest.fixture
def treads() -> tuple[Ground, ...]:
    """Two treads that go up along y, so that no axis is taken for granted."""
    params = StaircaseParams(steps=2, rise=0.2, run=0.27, x=0.0, yaw=np.pi / 2)
    return tuple(tread_ground(tread, tread.name) for tread in params.treads())


@pytest.mark.parametrize(
    ("p", "expected"),
    [
        ((0.0, 0.36, 0.4), True),
        ((0.0, 0.36, 0.4049), True),
        ((0.0, 0.36, 0.4051), False),
        ((0.0, 0.36, 0.3971), True),
        ((0.0, 0.36, 0.3969), False),
        ((0.0, 0.30, 0.4), True),  # the heel overhangs by 4.5 cm of 22.5
        ((0.0, 0.28, 0.4), False),  # by 6.5 cm
        ((0.5, 0.36, 0.4), False),
    ],
)
def test_a_sole_stands_on_the_tread_that_bears_it(treads, p, expected) -> None:
    """Within 5 mm above and 3 mm below, three quarters of its area over the tread."""
    corners = sole(*p, yaw=np.pi / 2)
    assert stands_flat(corners, treads[1])[0] == expected
    assert not stands_flat(corners, treads[0])[0]


def test_a_tilted_sole_does_not_stand(treads) -> None:
    """One corner 3 cm up is not at rest."""
    tilted = sole(0.0, 0.36, 0.4, pitch=-0.2, yaw=np.pi / 2)
    assert not stands_flat(tilted, treads[1])[0]


def test_what_is_not_a_number_stands_nowhere() -> None:
    """Nor does it keep others from standing."""
    corners = np.concatenate([sole(0.0), sole(0.0)])
    corners[0, 2, 1] = np.nan
    assert list(stands_flat(corners, FLOOR)) == [False, True]


def test_heights_are_those_above_the_ground(treads) -> None:
    """Of every corner, on the floor and on a tread."""
    corners = sole(0.0, 0.36, 0.42, yaw=np.pi / 2)
    np.testing.assert_allclose(corner_heights(corners, treads[1]), 0.02, atol=1e-12)
    np.testing.assert_allclose(corner_heights(corners, FLOOR), 0.42, atol=1e-12)


def test_only_what_lies_over_the_tread_is_carried(treads) -> None:
    """Its share and its outline; the floor has no end."""
    corners = sole(0.0, 0.30, 0.4, yaw=np.pi / 2)
    assert share_over(corners, treads[1])[0] == pytest.approx(0.8)
    assert carried_outlines(corners, treads[1])[0].bounds[1] == pytest.approx(0.27)
    assert share_over(corners, FLOOR)[0] == 1.0
    assert carried_outlines(corners, FLOOR)[0].bounds[1] == pytest.approx(0.225)
