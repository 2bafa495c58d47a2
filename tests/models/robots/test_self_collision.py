"""A robot's own bodies meet, but for neighbours in the chain."""

from collections.abc import Mapping

import numpy as np
import pytest
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.robots.self_collision import NEIGHBOURS, joints_between
from footfall.models.robots.self_distance import SelfDistance, SelfDistanceMeter

NEAR = 0.03


@pytest.fixture(scope="module")
def meter() -> SelfDistanceMeter:
    """Built once."""
    return SelfDistanceMeter(JVRC1)


@pytest.fixture(scope="module")
def plant() -> MultibodyPlant:
    """The robot alone."""
    return robot_alone(JVRC1)


def nearest(
    meter: SelfDistanceMeter, plant: MultibodyPlant, angles: Mapping[str, float]
) -> SelfDistance:
    """The nearest two bodies with some joints at angles, deg, the others at rest."""
    context = plant.CreateDefaultContext()
    for name, angle in angles.items():
        plant.GetJointByName(name).set_angle(context, np.radians(angle))
    return meter.nearest(plant.GetPositions(context), NEAR)


def test_a_robot_that_stands_does_not_meet_itself(meter, plant) -> None:
    """Although the hulls of neighbours overlap at every joint."""
    standing = {name: np.degrees(angle) for name, angle in JVRC1.posture.items()}
    assert nearest(meter, plant, standing).distance > 0.0


@pytest.mark.parametrize(
    ("angles", "bodies"),
    [
        ({"L_HIP_R": -12.0, "R_HIP_R": 12.0}, {"L_KNEE_S", "R_KNEE_S"}),
        ({"L_SHOULDER_R": -8.0}, {"L_HIP_Y_S", "L_LTHUMB_S"}),
        ({"L_ELBOW_P": -110.0, "L_SHOULDER_Y": -90.0}, {"L_ELBOW_Y_S", "WAIST_R_S"}),
        (
            {"R_HIP_P": -77.0, "R_HIP_R": 10.0, "R_HIP_Y": 20.0},
            {"PELVIS_S", "R_HIP_Y_S"},
        ),
    ],
)
def test_what_meets_is_found_and_named(meter, plant, angles, bodies) -> None:
    """Leg and leg, hand and thigh, forearm and torso, thigh and pelvis."""
    found = nearest(meter, plant, angles)
    assert found.distance < 0.0
    assert set(found.bodies) == bodies


def test_pieces_of_the_pelvis_follow_its_surface(meter, plant) -> None:
    """Pelvis and folded thigh are 8.3 mm apart; their hulls overlap by 14.6 mm."""
    folded = nearest(meter, plant, {"R_HIP_P": -90.0})
    assert set(folded.bodies) == {"PELVIS_S", "R_HIP_Y_S"}
    assert folded.distance == pytest.approx(0.0083, abs=0.001)


def test_far_bodies_are_not_looked_at(meter, plant) -> None:
    """Then the distance is what was looked within."""
    context = plant.CreateDefaultContext()
    found = meter.nearest(plant.GetPositions(context), 0.001)
    assert found == SelfDistance(0.001, ("", ""))


@pytest.mark.parametrize(
    ("a", "b", "count"),
    [((), (), 0), ((1,), (), 1), ((2, 1), (1,), 1), ((2, 1), (4, 3, 1), 3)],
)
def test_joints_between_bodies_are_counted(a, b, count) -> None:
    """Along the chain and across a fork."""
    assert joints_between(a, b) == count
    assert joints_between(b, a) == count
    assert NEIGHBOURS == 2
