"""How near a robot comes to itself over a run."""

import numpy as np
import pytest

from footfall.diagrams.judge.self_distance import nearest_approach
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.values.vector import Vector

SHINS = ("L_KNEE_S", "R_KNEE_S")


@pytest.fixture(scope="module")
def meter() -> SelfDistanceMeter:
    """Built once."""
    return SelfDistanceMeter(JVRC1)


def postures(*rolls: float) -> Vector:
    """The robot with its left hip rolled, rad, a row each."""
    plant = robot_alone(JVRC1)
    context = plant.CreateDefaultContext()
    rows = []
    for roll in rolls:
        plant.GetJointByName("L_HIP_R").set_angle(context, roll)
        rows.append(plant.GetPositions(context))
    return np.array(rows)


def test_the_nearest_pair_is_named_with_its_time(meter: SelfDistanceMeter) -> None:
    """A leg that swings in comes nearer, in the end through the other."""
    time = np.array([0.0, 0.1, 0.2])
    near = nearest_approach(meter, time, postures(0.0, -0.05, 0.0))
    assert near is not None
    assert near.time == 0.1
    assert 0.0 < near.distance < 0.05
    inside = nearest_approach(meter, time, postures(-0.1, -0.2, -0.3))
    assert inside is not None
    assert inside.time == 0.2
    assert inside.distance < 0.0
    assert set(inside.bodies) == set(SHINS)


def test_it_is_looked_at_every_tick_of_a_run(meter: SelfDistanceMeter) -> None:
    """Of rows at 200 Hz every fifth; what lies between them is not seen."""
    time = np.arange(10) * 0.005
    rolls = np.zeros(10)
    rolls[5] = -0.3
    seen = nearest_approach(meter, time, postures(*rolls))
    assert seen is not None
    assert seen.time == pytest.approx(0.025)
    missed = nearest_approach(meter, time, postures(*np.roll(rolls, 1)))
    assert missed is not None
    assert missed.distance > 0.0


def test_bodies_that_are_far_have_no_distance(
    meter: SelfDistanceMeter, monkeypatch: pytest.MonkeyPatch
) -> None:
    """None where nothing came within reach."""
    monkeypatch.setattr("footfall.diagrams.judge.self_distance.REACH", 1e-4)
    assert nearest_approach(meter, np.array([0.0]), postures(0.0)) is None
