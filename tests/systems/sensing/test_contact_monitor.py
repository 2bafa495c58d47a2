"""Contacts of the robot with what only its soles may touch."""

import pytest
from pydrake.geometry import Box, SceneGraph, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    CoulombFriction,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import ModelInstanceIndex, SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from systems.sensing.contact_monitor import (
    ContactMonitor,
    WatchedGeometry,
    watched_geometry,
)
from systems.values import Touches

STEP = 0.002
FRICTION = CoulombFriction(0.5, 0.5)


def add_scene(plant: MultibodyPlant, solid: str, ball: str) -> ModelInstanceIndex:
    """A slab with its top at z = 0 and a ball of 1 kg that rests on it."""
    slab = RigidTransform([0.0, 0.0, -0.5])
    plant.RegisterCollisionGeometry(
        plant.world_body(), slab, Box(4.0, 4.0, 1.0), solid, FRICTION
    )
    robot = plant.AddModelInstance("robot")
    body = plant.AddRigidBody(
        "SHIN", robot, SpatialInertia.SolidSphereWithMass(1.0, 0.1)
    )
    plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(0.1), ball, FRICTION)
    return robot


def simulate(
    solid: str = "staircase/step_1",
    ball: str = "SHIN_hull",
    height: float = 0.1,
    duration: float = 1.0,
) -> tuple[Touches, float, WatchedGeometry]:
    """Lets the ball go at a height of its centre; what the monitor says at the end."""
    builder = DiagramBuilder()
    config = MultibodyPlantConfig(time_step=STEP, contact_model="point")
    plant, scene_graph = AddMultibodyPlant(config, builder)
    robot = add_scene(plant, solid, ball)
    plant.Finalize()
    body = plant.GetBodyByName("SHIN")
    plant.SetDefaultFloatingBaseBodyPose(body, RigidTransform([0.0, 0.0, height]))
    watched = watched_geometry(
        plant,
        scene_graph.model_inspector(),
        robot,
        "staircase/",
        lambda name: name.rpartition("::")[2].startswith("sole"),
    )
    monitor = builder.AddNamedSystem("monitor", ContactMonitor(watched, STEP))
    builder.Connect(
        plant.get_contact_results_output_port(), monitor.GetInputPort("contact_results")
    )
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(duration)
    context = monitor.GetMyContextFromRoot(simulator.get_context())
    touches = monitor.GetOutputPort("touches").Eval(context)
    touching = monitor.GetOutputPort("touching").Eval(context)[0]
    return touches, touching, watched


def test_resting_part_is_named_with_duration_and_force() -> None:
    """A ball that rests weighs what it weighs, for as long as it rests."""
    touches, touching, _ = simulate(height=0.0995)
    (touch,) = touches.touches
    assert (touch.body, touch.solid) == ("SHIN", "staircase/step_1")
    assert touching == 1.0
    assert touch.duration == pytest.approx(1.0, abs=0.02)
    assert touch.peak_force >= 9.81 * 0.99


def test_the_peak_of_an_impact_is_kept() -> None:
    """A ball that has fallen 20 cm strikes harder than it weighs, and then rests."""
    touches, _, _ = simulate(height=0.3, duration=1.0)
    (touch,) = touches.touches
    assert touch.duration == pytest.approx(0.8, abs=0.05)
    assert touch.peak_force > 20.0 * 9.81


@pytest.mark.parametrize(
    ("solid", "ball"),
    [("staircase/step_1", "sole_left_00"), ("room/floor", "SHIN_hull")],
)
def test_soles_and_other_solids_may_touch(solid: str, ball: str) -> None:
    """A sole on a step, and anything on the floor, is not reported."""
    touches, touching, _ = simulate(solid, ball, height=0.0995)
    assert touches == Touches()
    assert touching == 0.0


def test_watched_are_bodies_without_soles_and_solids_by_prefix() -> None:
    """Names come without Drake's scope."""
    _, _, watched = simulate(duration=0.01)
    assert watched.bodies == ("SHIN",)
    assert watched.solids == ("staircase/step_1",)


def test_period_must_be_positive() -> None:
    """It is the plant's step."""
    plant, scene_graph = MultibodyPlant(STEP), SceneGraph()
    plant.RegisterAsSourceForSceneGraph(scene_graph)
    robot = add_scene(plant, "staircase/step_1", "SHIN_hull")
    plant.Finalize()
    watched = watched_geometry(
        plant, scene_graph.model_inspector(), robot, "staircase/", lambda name: False
    )
    with pytest.raises(ValueError, match=r"period: must be positive, got -1\.0 s"):
        ContactMonitor(watched, -1.0)
