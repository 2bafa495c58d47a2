"""How near a robot comes to itself."""

import numpy as np
import pytest
from pydrake.geometry import CollisionFilterDeclaration, GeometrySet

from diagrams.self_distance import LoneRobot, least_self_distance, lone_robot
from models.jvrc1 import JVRC1
from systems.ports import Vector

SHINS = ("L_KNEE_S", "R_KNEE_S")


@pytest.fixture
def shins() -> LoneRobot:
    """The robot, of which the two shins alone may collide."""
    alone = lone_robot(JVRC1)
    inspector = alone.scene_graph.model_inspector()
    every = GeometrySet(inspector.GetAllGeometryIds())
    pair = [
        GeometrySet(
            alone.plant.GetCollisionGeometriesForBody(alone.plant.GetBodyByName(name))
        )
        for name in SHINS
    ]
    filters = alone.scene_graph.collision_filter_manager()
    filters.Apply(CollisionFilterDeclaration().ExcludeWithin(every))
    filters.Apply(CollisionFilterDeclaration().AllowBetween(*pair))
    return alone


def states(alone: LoneRobot, rolls: list[float]) -> Vector:
    """The robot with its left hip rolled, a row each."""
    context = alone.plant.CreateDefaultContext()
    rows = []
    for roll in rolls:
        alone.plant.GetJointByName("L_HIP_R").set_angle(context, roll)
        rows.append(alone.plant.GetPositionsAndVelocities(context, alone.instance))
    return np.array(rows)


def test_the_nearest_pair_is_named_with_its_time(shins: LoneRobot) -> None:
    """A leg that swings in comes nearer, in the end through the other."""
    near = least_self_distance(
        shins, np.array([0.0, 0.1, 0.2]), states(shins, [0.0, -0.12, 0.0])
    )
    assert near is not None
    assert (near.bodies, near.time) == (SHINS, 0.1)
    assert 0.0 < near.distance < 0.1
    inside = least_self_distance(
        shins, np.array([0.0, 0.1, 0.2]), states(shins, [-0.12, -0.2, -0.5])
    )
    assert inside is not None
    assert inside.distance < 0.0
    assert inside.distance < near.distance


def test_bodies_that_may_not_collide_have_no_distance(shins: LoneRobot) -> None:
    """Nor have those that are far from each other."""
    assert least_self_distance(shins, np.array([0.0]), states(shins, [0.5])) is None
    filters = shins.scene_graph.collision_filter_manager()
    every = GeometrySet(shins.scene_graph.model_inspector().GetAllGeometryIds())
    filters.Apply(CollisionFilterDeclaration().ExcludeWithin(every))
    assert least_self_distance(shins, np.array([0.0]), states(shins, [-0.12])) is None
