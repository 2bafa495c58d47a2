"""FTA: the three repairs in their order, each as long as it helps."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.obstacle import Obstacle
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.feet_adaptor import (
    FAR,
    KNOTS,
    RAISE,
    SHIFT,
    LegPoses,
    Repairs,
    adapt,
    ankle_displacement,
    leg_gaps,
    penetration_path,
)
from footfall.systems.planning.crossing.leg_clearance import Section
from tests.systems.planning.crossing.crossing_cases import body

KNEES = (np.array([0.3, 0.3]), np.array([2.0, 2.0]))


def _adapted(
    gap: Callable[[Repairs], float],
    knee: Callable[[Repairs], float] = lambda repairs: 1.0,
    room: float = 0.1,
    tries: int = 10,
) -> Repairs:
    """FTA with gaps and knees that depend on the repairs by formula."""
    tried: list[Repairs] = []

    def poses_of(repairs: Repairs) -> LegPoses:
        tried.append(repairs)
        return LegPoses(np.full((1, 2, 6), knee(repairs)), np.zeros((1, 2, 6)))

    def second(poses: LegPoses, repairs: Repairs) -> Repairs:
        pushed = np.zeros(KNOTS) if not repairs.path.size else repairs.path
        return replace(repairs, path=pushed - 0.01)

    return adapt(
        poses_of,
        lambda poses: np.full((1, 1, 2), gap(tried[-1])),
        second,
        KNEES,
        room,
        tries,
    )


def test_nothing_is_repaired_that_is_free() -> None:
    """No gap, no change."""
    assert _adapted(lambda repairs: 0.01) == Repairs()


def test_the_foot_is_shifted_first() -> None:
    """As far as it takes, and nothing else."""
    found = _adapted(lambda repairs: -0.025 + repairs.shift)
    assert found.shift == pytest.approx(3 * SHIFT)
    assert found.raised == 0.0
    assert not found.path.size


def test_then_the_waist_is_raised_and_last_the_foot_yields() -> None:
    """Each repair ends where it no longer helps."""
    found = _adapted(
        lambda repairs: (
            -0.05
            + min(repairs.shift, 0.02)
            + min(repairs.raised, 0.01)
            - (repairs.path.min() if repairs.path.size else 0.0)
        )
    )
    assert found.shift == pytest.approx(2 * SHIFT)
    assert found.raised == pytest.approx(RAISE)
    np.testing.assert_allclose(found.path, -0.03)


def test_the_waist_rises_no_higher_than_the_stance_leg_reaches() -> None:
    """In the first round, for the knees, and as the second repair."""
    for knee in (1.0, 2.5):
        found = _adapted(
            lambda repairs: -1.0 + repairs.raised,
            lambda repairs, knee=knee: knee,  # type: ignore[misc]
            room=0.035,
        )
        assert found.raised == pytest.approx(0.03)


def test_a_stretched_knee_lowers_the_waist_a_folded_one_raises_it() -> None:
    """Until neither is."""
    low = _adapted(lambda repairs: 1.0, lambda repairs: 0.25 + 2.0 * repairs.lowered)
    assert low.lowered == pytest.approx(0.03)
    assert low.raised == 0.0
    high = _adapted(lambda repairs: 1.0, lambda repairs: 2.1 - 5.0 * repairs.raised)
    assert high.raised == pytest.approx(0.02)
    assert high.lowered == 0.0


def test_it_gives_up_after_its_tries_with_the_best_it_found() -> None:
    """Which may still meet the obstacle."""
    found = _adapted(lambda repairs: -1.0 + repairs.shift, tries=4)
    assert found.shift == pytest.approx(4 * SHIFT)


def test_the_path_pushes_to_the_rear_where_the_leg_is_deep() -> None:
    """Smoothly, not at the ends, more for a point with more leverage, and adding up."""
    share = np.linspace(0.0, 1.0, 101)
    depth = np.where(np.abs(share - 0.4) < 0.03, 0.008, 0.0)
    one = penetration_path(depth, share, np.ones(101), np.zeros(0))
    two = penetration_path(depth, share, np.full(101, 2.0), np.zeros(0))
    assert one is not None
    assert two is not None
    assert one.min() == pytest.approx(-0.010, abs=5e-4)
    assert two.min() == pytest.approx(-0.018, abs=1e-3)
    assert abs(np.linspace(0, 1, KNOTS)[np.argmin(one)] - 0.4) < 0.05
    assert (one <= 0.0).all()
    early = penetration_path(
        np.where(share < 0.03, 0.02, 0.0), share, np.ones(101), np.zeros(0)
    )
    assert early is not None
    assert early[[0, -1]] == pytest.approx(0.0)
    again = penetration_path(depth, share, np.ones(101), one)
    np.testing.assert_allclose(again, 2.0 * one)
    assert penetration_path(0.0 * depth, share, np.ones(101), one) is None


@pytest.mark.parametrize("x", [-1.0, -0.2, 0.6, 1.0])
def test_far_legs_are_told_by_how_far_at_least(x: float) -> None:
    """Near ones exactly: the same legs, an obstacle before or behind them."""
    leg = body().leg
    angles: Vector = np.tile([-0.6, 0.0, 0.0, 1.1, 0.0, -0.5], (1, 2, 1))
    obstacle = Obstacle(np.array([x, 0.0]), 0.0, 0.05, 0.15, 1.0)
    gaps = leg_gaps(
        leg,
        angles,
        np.zeros((1, 2, 6)),
        (obstacle,),
        (Section(0.05, 0.15),),
        [0.0],
        0.0,
    )
    assert gaps.shape == (1, 1, 2)
    toe, heel = leg.outline.toe, leg.outline.heel
    reach = x - 0.025 - toe if x > 0.0 else -x - 0.025 - heel
    # Shin and knee may be ahead of the toes.
    assert (gaps <= reach + 1e-9).all()
    assert (gaps > reach - 0.1).all()
    assert (gaps > FAR).all() == (abs(x) > 0.5)


@pytest.mark.parametrize("yaw", [0.0, 0.5])
def test_the_gap_is_to_the_inflated_front_and_back(yaw: float) -> None:
    """A section whose front is before the obstacle's by its margin, behind likewise."""
    leg = body().leg
    angles: Vector = np.tile([-0.4, 0.0, 0.0, 0.7, 0.0, -0.3], (1, 2, 1))
    soles = np.zeros((1, 2, 6))
    soles[..., 5] = yaw
    ahead, width, margin = np.array([np.cos(yaw), np.sin(yaw)]), 0.06, 0.04
    toe, heel = leg.outline.toe, leg.outline.heel
    for free in (0.01, 0.02):
        # As low as a sole is thick, so that the feet alone come near.
        for x in (toe + margin + free, -heel - margin - width - free):
            obstacle = Obstacle((x + 0.5 * width) * ahead, yaw, width, 0.001, 1.0)
            gaps = leg_gaps(
                leg,
                angles,
                soles,
                (obstacle,),
                (Section(width + 2.0 * margin, 0.001),),
                [margin],
                0.0,
            )
            assert gaps.min() == pytest.approx(free, abs=1e-9)


def shank_of(angles: Vector, x: float, z: float) -> Vector:
    """A point of the left shank, from its knee, in a frame of the waist, (3,), m."""
    leg, c, s = body().leg, np.cos(angles[:4]), np.sin(angles[:4])
    pitch, knee = (
        np.array([[c[i], 0.0, s[i]], [0.0, 1.0, 0.0], [-s[i], 0.0, c[i]]])
        for i in (0, 3)
    )
    roll = np.array([[1.0, 0.0, 0.0], [0.0, c[1], -s[1]], [0.0, s[1], c[1]]])
    yaw = np.array([[c[2], -s[2], 0.0], [s[2], c[2], 0.0], [0.0, 0.0, 1.0]])
    thigh = np.array([leg.thigh[0], 0.0, leg.thigh[1]])
    return leg.hips["left"] + pitch @ roll @ yaw @ (
        thigh + knee @ np.array([x, 0.0, z])
    )


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75, 1.0])
@pytest.mark.parametrize(
    "angles",
    [(-0.6, 0.0, 0.0, 1.1, 0.0, -0.5), (-0.4, 0.1, -0.15, 1.3, 0.05, -0.7)],
)
def test_the_ankle_yields_for_a_point_of_the_shank(
    angles: tuple[float, ...], share: float
) -> None:
    """Eq. 25, dP = J_p J_s^+ dS: the least joint motion that moves the point by dS.

    The Jacobians by differences of the leg's kinematics written out. The ankle is
    farther from the hip than the point, and moves farther; by as much when it is it.
    """
    leg, q = body().leg, np.array(angles)
    step = 1e-6

    def jacobian(x: float, z: float) -> Vector:
        columns = []
        for joint in range(4):
            ahead, behind = q.copy(), q.copy()
            ahead[joint] += step
            behind[joint] -= step
            change = shank_of(ahead, x, z) - shank_of(behind, x, z)
            columns.append(change / (2.0 * step))
        return np.array(columns).T

    point = share * leg.shank
    J_s, J_p = jacobian(*point), jacobian(*leg.shank)
    dS = np.array([0.01, 0.0, 0.0])
    dq = np.linalg.lstsq(J_s, dS, rcond=None)[0]
    np.testing.assert_allclose(J_s @ dq, dS, atol=1e-9)
    moved = ankle_displacement(leg, "left", q, point, 0.01)
    assert moved == pytest.approx((J_p @ dq)[0], abs=1e-7)
    if share == 1.0:
        assert moved == pytest.approx(0.01)
    else:
        assert moved > 0.0105
