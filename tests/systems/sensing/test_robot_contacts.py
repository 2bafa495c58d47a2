"""Contacts of point pairs and of hydroelastic surfaces, told alike."""

import numpy as np
import pytest
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Box,
    ProximityProperties,
    Sphere,
)
from pydrake.math import RigidTransform
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    ContactResults,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.systems.sensing.robot_contacts import (
    RobotContact,
    WatchedGeometry,
    robot_contacts,
    scene_forces,
    watched_geometry,
)
from tests.systems.sensing.ball_scene import (
    FEET,
    FRICTION,
    GROUND,
    WEIGHT,
    is_sole,
)

RADIUS = 0.1


def settled(
    model: str, slab_first: bool, heaped: bool = False
) -> tuple[list[RobotContact], WatchedGeometry]:
    """A sole on a slab, or a shin on top of it, after they have come to rest."""
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(
        MultibodyPlantConfig(time_step=0.002, contact_model=model), builder
    )

    def add_slab() -> None:
        soft = ProximityProperties()
        AddRigidHydroelasticProperties(0.5, soft)
        AddContactMaterial(friction=FRICTION, properties=soft)
        X_WS = RigidTransform([0.0, 0.0, -0.5])
        plant.RegisterCollisionGeometry(
            plant.world_body(), X_WS, Box(4.0, 4.0, 1.0), "room/floor", soft
        )

    if slab_first:
        add_slab()
    robot = plant.AddModelInstance("robot")
    for name, ball in (("LEFT", "sole"), ("RIGHT", "right"), ("SHIN", "shin")):
        inertia = SpatialInertia.SolidSphereWithMass(1.0, RADIUS)
        body = plant.AddRigidBody(name, robot, inertia)
        soft = ProximityProperties()
        AddCompliantHydroelasticProperties(0.05, 1e6, soft)
        AddContactMaterial(friction=FRICTION, properties=soft)
        plant.RegisterCollisionGeometry(
            body, RigidTransform(), Sphere(RADIUS), f"{ball}_hull", soft
        )
    if not slab_first:
        add_slab()
    plant.Finalize()
    heights = {"LEFT": 0.0995, "RIGHT": 50.0, "SHIN": 0.298 if heaped else 60.0}
    for name, height in heights.items():
        X_WB = RigidTransform([0.0, 0.0, height])
        plant.SetDefaultFloatingBaseBodyPose(plant.GetBodyByName(name), X_WB)
    diagram = builder.Build()
    simulator = Simulator(diagram)
    simulator.AdvanceTo(0.2)
    watched = watched_geometry(
        plant, scene_graph.model_inspector(), robot, FEET, is_sole, GROUND
    )
    context = plant.GetMyContextFromRoot(simulator.get_context())
    results = plant.get_contact_results_output_port().Eval(context)
    assert isinstance(results, ContactResults)
    return robot_contacts(results, watched), watched


@pytest.mark.parametrize("slab_first", [True, False])
@pytest.mark.parametrize("model", ["point", "hydroelastic_with_fallback"])
def test_a_sole_bears_its_weight(model: str, slab_first: bool) -> None:
    """Upwards on the foot, whichever of the pair comes first."""
    contacts, watched = settled(model, slab_first)
    assert {contact.allowed for contact in contacts} == {True}
    forces = scene_forces(contacts, watched)
    np.testing.assert_allclose(forces[0], [0.0, 0.0, WEIGHT], atol=0.1)
    np.testing.assert_allclose(forces[1:], 0.0)


@pytest.mark.parametrize("model", ["point", "hydroelastic_with_fallback"])
def test_what_stands_on_a_foot_is_a_touch_and_no_ground(model: str) -> None:
    """The foot bears both weights; what is on it is told once, and forbidden."""
    contacts, watched = settled(model, True, heaped=True)
    own = [contact for contact in contacts if not contact.allowed]
    assert {
        (watched.bodies[contact.body], watched.others[contact.other]) for contact in own
    } == {("LEFT", "SHIN")}
    pushed = sum(contact.force for contact in own)
    np.testing.assert_allclose(pushed, [0.0, 0.0, -WEIGHT], atol=0.5)
    forces = scene_forces(contacts, watched)
    np.testing.assert_allclose(forces[0], [0.0, 0.0, 2.0 * WEIGHT], atol=0.5)
    np.testing.assert_allclose(forces[2], 0.0)


def test_a_foot_without_contact_geometry_is_refused() -> None:
    """It could not be seen to bear anything."""
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(
        MultibodyPlantConfig(time_step=0.002), builder
    )
    robot = plant.AddModelInstance("robot")
    plant.AddRigidBody("LEFT", robot, SpatialInertia.SolidSphereWithMass(1.0, 0.1))
    plant.Finalize()
    with pytest.raises(ValueError, match="feet: LEFT has no collision geometry"):
        watched_geometry(
            plant,
            scene_graph.model_inspector(),
            robot,
            ("LEFT",),
            is_sole,
            GROUND,
        )
