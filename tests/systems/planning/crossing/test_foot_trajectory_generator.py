"""FTG: the foot's way over an obstacle and to the ground."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.foot_trajectory_generator import (
    Crossing,
    FootTrajectoryParams,
    foot_trajectory,
)
from footfall.systems.planning.crossing.leg_clearance import Section, outline_gap
from footfall.systems.planning.whole_body.leg_model import rotations
from tests.systems.planning.crossing.crossing_cases import body

DURATION = 1.3
TIME: Vector = np.linspace(0.0, DURATION, 261)
OVER = Section(0.14, 0.195)


def _way(params: FootTrajectoryParams, leads: bool, over: bool = True) -> Vector:
    leg = body().leg
    end = np.zeros(6)
    end[0] = 0.41
    front = leg.outline.toe + 0.004
    return foot_trajectory(
        np.zeros(6),
        end,
        TIME,
        DURATION,
        Crossing(OVER, front, leads) if over else None,
        leg.outline,
        leg.sole.ankle_height,
        params,
    )


def _feet(poses: Vector) -> Vector:
    """Corners of the foot's outline before the obstacle's front face, (n, 4, 2)."""
    leg = body().leg
    R = rotations(poses[:, 3:])
    p_A = np.zeros((4, 3))
    p_A[:, [0, 2]] = leg.outline.foot
    p_A[:, 2] += leg.sole.ankle_height
    points = poses[:, None, :3] + np.einsum("nij,kj->nki", R, p_A)
    planar = points[:, :, [0, 2]]
    planar[:, :, 0] -= leg.outline.toe + 0.004
    return np.asarray(planar)


@pytest.mark.parametrize("leads", [True, False])
def test_the_foot_keeps_off_the_inflated_obstacle(leads: bool) -> None:
    """The whole outline of the foot, at every moment."""
    poses = _way(FootTrajectoryParams(), leads)
    assert outline_gap(_feet(poses), OVER).min() > 0.0


@pytest.mark.parametrize("over", [True, False])
def test_it_starts_and_ends_at_rest_where_it_is_to(over: bool) -> None:
    """Position, velocity and a foot that never sinks into the ground."""
    poses = _way(FootTrajectoryParams(), True, over)
    np.testing.assert_allclose(poses[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(poses[-1, :3], [0.41, 0.0, 0.0], atol=1e-9)
    rate = np.gradient(poses, TIME, axis=0)
    assert np.abs(rate[[0, -1]]).max() < 0.05
    assert _feet(poses)[:, :, 1].min() > -1e-3


def test_it_lands_more_slowly_than_the_polynomial() -> None:
    """Speed a centimetre above the ground, the paper's reason for splines."""
    speeds = []
    for profile in ("splines", "polynomial"):
        params = replace(FootTrajectoryParams(), profile=profile)
        z = _way(params, True)[:, 2]
        falling = np.flatnonzero(z > 0.01)[-1]
        speeds.append(-np.gradient(z, TIME)[falling])
    assert 0.0 < speeds[0] < speeds[1]


def test_a_shift_moves_the_way_to_the_rear() -> None:
    """The first repair: start and end stay."""
    leg, params = body().leg, FootTrajectoryParams()
    crossing = Crossing(OVER, leg.outline.toe + 0.004, False)
    end = np.zeros(6)
    end[0] = 0.41
    ways = [
        foot_trajectory(
            np.zeros(6),
            end,
            TIME,
            DURATION,
            crossing,
            leg.outline,
            leg.sole.ankle_height,
            params,
            shift,
        )
        for shift in (0.0, 0.05)
    ]
    np.testing.assert_allclose(ways[0][[0, -1]], ways[1][[0, -1]], atol=1e-9)
    assert (ways[1][:, 0] - ways[0][:, 0]).min() < -0.04


def test_validation() -> None:
    """A field out of range is named."""
    with pytest.raises(ValueError, match="lifted: must be less than lowering"):
        replace(FootTrajectoryParams(), lifted=0.8).validate()
    with pytest.raises(ValueError, match="profile: must be"):
        replace(FootTrajectoryParams(), profile="circle").validate()


def test_a_step_aside_and_a_turn_are_taken_on_the_way() -> None:
    """Not at once: as a blend from start to end."""
    leg = body().leg
    end: Vector = np.array([0.3, 0.1, 0.0, 0.0, 0.0, 0.4])
    poses = foot_trajectory(
        np.zeros(6),
        end,
        TIME,
        DURATION,
        None,
        leg.outline,
        leg.sole.ankle_height,
        FootTrajectoryParams(),
    )
    np.testing.assert_allclose(poses[[0, -1]], [np.zeros(6), end], atol=1e-9)
    middle = poses[len(poses) // 2]
    assert middle[5] == pytest.approx(0.2, abs=1e-6)
    aside = np.array([-np.sin(0.4), np.cos(0.4)])
    whole = float(end[:2] @ aside)
    assert middle[:2] @ aside == pytest.approx(0.5 * whole, abs=1e-6)
    assert np.abs(np.diff(poses[:, 5])).max() < 0.01
    # The quintic blend: neither speed nor acceleration where the foot leaves and lands.
    u = TIME / DURATION
    blend = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    np.testing.assert_allclose(poses[:, 5] / 0.4, blend, atol=1e-9)
    np.testing.assert_allclose(poses[:, :2] @ aside / whole, blend, atol=1e-9)


def test_the_first_foot_lifts_its_toes_the_second_its_heel() -> None:
    """Over the obstacle, by what the parameters say; level at both ends."""
    params = FootTrajectoryParams()
    lead, trail = (_way(params, leads)[:, 4] for leads in (True, False))
    assert lead.min() == pytest.approx(params.lead_pitch, abs=0.03)
    assert lead.max() < 0.02
    assert trail.max() == pytest.approx(params.trail_pitch, abs=0.03)
    for pitch in (lead, trail):
        np.testing.assert_allclose(pitch[[0, -1]], 0.0, atol=1e-9)


def test_the_foot_draws_back_as_far_as_the_obstacle_is_near() -> None:
    """Further than the retraction where the toe would meet the front face."""
    leg, params = body().leg, FootTrajectoryParams()
    end = np.zeros(6)
    end[0] = 0.41
    least = []
    for front in (leg.outline.toe + 0.05, leg.outline.toe - 0.07):
        way = foot_trajectory(
            np.zeros(6),
            end,
            TIME,
            DURATION,
            Crossing(OVER, front, True),
            leg.outline,
            leg.sole.ankle_height,
            params,
        )
        least.append(way[:, 0].min())
    assert least[0] == pytest.approx(-params.retraction, abs=0.015)
    assert least[1] == pytest.approx(-0.07, abs=0.015)
