"""How low a CoM goes for its legs: by plain geometry, and in the plans of walks."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.planning.motion.leg_reach import height_excess, step_drops
from footfall.systems.planning.motion.step_timing import TimedStep
from footfall.systems.planning.whole_body.whole_body_plan import (
    WholeBody,
    body_motion,
    waist_above_com,
)
from tests.systems.planning.crossing.crossing_cases import body as crossing_body

MARGIN = 0.15
WIDTH = 0.1
"""Half the distance between the feet, m."""


@pytest.fixture(scope="module", name="body")
def planned_body() -> WholeBody:
    """The robot as plans see it."""
    return crossing_body()


def feet(apart: float) -> Vector:
    """Level soles, the left one ahead, (1, 2, 6)."""
    poses = np.zeros((1, 2, 6))
    poses[0, 0, :2] = 0.5 * apart, WIDTH
    poses[0, 1, :2] = -0.5 * apart, -WIDTH
    return poses


@pytest.mark.parametrize("apart", [0.5, 0.6, 0.7])
def test_a_pelvis_lowered_by_the_excess_has_bent_knees(
    body: WholeBody, apart: float
) -> None:
    """As far as the margin says, and no farther."""
    com, upright = np.array([[0.0, 0.0, 0.88]]), np.zeros((1, 3))
    poses = feet(apart)
    assert height_excess(body, com, upright, poses, MARGIN)[0] > 0.005
    # As the pelvis is lowered it moves a little over the feet, too.
    for _ in range(4):
        com[:, 2] -= height_excess(body, com, upright, poses, MARGIN)
    height = com[:, 2] + waist_above_com(body)
    found = body_motion(body, com[:, :2], height, upright, poses, 0.0)
    bent = found.angles[0, :, 3] - body.leg.lower[:, 3]
    assert bent.min() == pytest.approx(MARGIN, abs=0.01)


def test_feet_under_a_bent_robot_ask_for_nothing(body: WholeBody) -> None:
    """Nor does a foot that no height would reach."""
    upright = np.zeros((1, 3))
    low = np.array([[0.0, 0.0, 0.8]])
    assert height_excess(body, low, upright, feet(0.1), MARGIN)[0] == 0.0
    assert height_excess(body, low, upright, feet(3.0), MARGIN)[0] == 0.0


def test_each_step_is_as_low_as_it_and_the_next_one_ask() -> None:
    """A step counts from the landing before it to its own."""
    time = np.arange(0.0, 4.0, 0.5)
    excess = np.array([0.0, 0.01, 0.0, 0.0, 0.03, 0.0, 0.0, 0.02])
    pose = np.zeros(6)
    steps = tuple(
        TimedStep("left", pose, pose, pose, land - 0.5, land - 0.4, land)
        for land in (1.0, 2.0, 3.0)
    )
    assert step_drops(time, excess, steps) == pytest.approx((0.01, 0.03, 0.03))
