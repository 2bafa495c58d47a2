"""What soles stand on carries them, wherever it is, with the friction that is told."""

import numpy as np
import pytest
from pydrake.geometry import Box as BoxShape
from pydrake.math import RigidTransform
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    ContactResults,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import PrismaticJoint, SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.diagrams.closed_loop.robot_station import DRAKE_CONTACT_MODELS
from footfall.models.robots.contact_geometry import (
    CONTACT_MODELS,
    PLATE_RECESS,
    ContactModel,
    add_soles,
    is_sole,
    sole_properties,
    surface_properties,
)
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.scenes.solids import Box, add_solids, upright_pose
from footfall.models.values.feet import FEET
from footfall.systems.sensing.foot_wrench_sensor import SoleFrame, sum_wrenches

SOLE = JVRC1.sole
GREY = (0.5, 0.5, 0.5, 1.0)


def slat(x: float, z: float, width: float = 0.02) -> Box:
    """A slat across the way whose middle is at x and whose top is at z."""
    size = np.array([width, 1.0, 0.1])
    return Box("slat", upright_pose(x, 0.0, z - 0.05), size, 0.8, GREY)


def feet_on(model: ContactModel, solid: Box) -> np.ndarray:
    """Wrenches on both soles that hover at z = 0, in F, (2, 6)."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(
        MultibodyPlantConfig(
            time_step=0.0025,
            contact_model=DRAKE_CONTACT_MODELS[model],
            use_sampled_output_ports=False,
        ),
        builder,
    )
    instance = plant.AddModelInstance("feet")
    poses = []
    for foot, y in zip(FEET, (0.1, -0.1), strict=True):
        body = plant.AddRigidBody(
            JVRC1.foot_bodies[foot],
            instance,
            SpatialInertia.SolidBoxWithMass(30.0, 0.2, 0.1, 0.1),
        )
        pose = RigidTransform([0.0, y, SOLE.ankle_height])
        plant.SetDefaultFloatingBaseBodyPose(body, pose)
        poses.append(RigidTransform([0.0, y, 0.0]))
    add_soles(plant, instance, JVRC1, model)
    add_solids(plant, [solid])
    plant.Finalize()
    context = plant.GetMyContextFromRoot(builder.Build().CreateDefaultContext())
    results = plant.get_contact_results_output_port().Eval(context)
    assert isinstance(results, ContactResults)
    frames = [SoleFrame(X.rotation().matrix(), X.translation()) for X in poses]
    return sum_wrenches(results, foot_of(plant), frames)


def foot_of(plant: MultibodyPlant) -> dict[int, int]:
    """Which foot each geometry belongs to."""
    return {
        geometry.get_value(): k
        for k, foot in enumerate(FEET)
        for geometry in plant.GetCollisionGeometriesForBody(
            plant.GetBodyByName(JVRC1.foot_bodies[foot])
        )
    }


@pytest.mark.parametrize("x", np.linspace(-SOLE.heel + 0.01, SOLE.toe - 0.01, 12))
@pytest.mark.parametrize("model", CONTACT_MODELS)
def test_a_slat_anywhere_under_a_sole_carries(model: ContactModel, x: float) -> None:
    """Between the places where point contact has its spheres as well, and there."""
    for wrench in feet_on(model, slat(x, PLATE_RECESS + 0.0005)):
        assert wrench[2] > 100.0
        assert -wrench[4] / wrench[2] == pytest.approx(x, abs=0.011)


def test_rubber_carries_as_soon_as_it_is_touched() -> None:
    """An edge between the corners sinks into it no farther than the ground does."""
    for wrench in feet_on("hydroelastic", slat(0.07, 0.0001)):
        assert wrench[2] > 100.0


@pytest.mark.parametrize("model", CONTACT_MODELS)
@pytest.mark.parametrize("x", [-SOLE.heel - 0.015, SOLE.toe + 0.015])
def test_nothing_carries_beside_a_sole(model: ContactModel, x: float) -> None:
    """A slat before the toes or behind the heel."""
    np.testing.assert_array_equal(feet_on(model, slat(x, 0.0015)), 0.0)


@pytest.mark.parametrize("model", CONTACT_MODELS)
def test_soles_end_at_their_plane(model: ContactModel) -> None:
    """What stays below it does not touch."""
    np.testing.assert_array_equal(feet_on(model, slat(0.0, -1e-6, width=0.5)), 0.0)


@pytest.mark.parametrize("model", CONTACT_MODELS)
@pytest.mark.parametrize("friction", [0.3, 0.8, 1.2])
@pytest.mark.parametrize(("share", "slides"), [(0.95, False), (1.05, True)])
def test_the_friction_of_a_scene_is_what_acts(
    model: ContactModel, friction: float, share: float, slides: bool
) -> None:
    """A block with a sole's rubber slides from mu times its weight on."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(
        MultibodyPlantConfig(
            time_step=0.001,
            contact_model=DRAKE_CONTACT_MODELS[model],
            discrete_contact_approximation="sap",
        ),
        builder,
    )
    carriage = plant.AddRigidBody(
        "carriage", SpatialInertia.SolidBoxWithMass(1e-3, 0.1, 0.1, 0.1)
    )
    block = plant.AddRigidBody(
        "block", SpatialInertia.SolidBoxWithMass(10.0, 0.2, 0.2, 0.1)
    )
    for parent, child, axis in (
        (plant.world_body(), carriage, [0.0, 0.0, 1.0]),
        (carriage, block, [1.0, 0.0, 0.0]),
    ):
        plant.AddJoint(
            PrismaticJoint(
                child.name(), parent.body_frame(), child.body_frame(), np.array(axis)
            )
        )
    plant.AddJointActuator("push", plant.GetJointByName("block"))
    plant.RegisterCollisionGeometry(
        block,
        RigidTransform([0.0, 0.0, 0.05]),
        BoxShape(0.2, 0.2, 0.1),
        "rubber",
        sole_properties(),
    )
    floor = Box("floor", upright_pose(z=-0.05), np.array([9, 9, 0.1]), friction, GREY)
    add_solids(plant, [floor])
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.get_actuation_input_port().FixValue(context, np.zeros(1))
    simulator.AdvanceTo(0.5)
    force = share * friction * 10.001 * 9.81
    plant.get_actuation_input_port().FixValue(context, np.array([force]))
    simulator.AdvanceTo(1.0)
    moved = plant.GetJointByName("block").get_translation(context)
    assert (moved > 0.01) == slides


@pytest.mark.parametrize("friction", [0.0, -0.1, 2.0, float("nan"), float("inf")])
def test_a_friction_that_no_surface_has_is_refused(friction: float) -> None:
    """With the reason."""
    with pytest.raises(ValueError, match="friction: must be above 0"):
        surface_properties(friction)


def test_soles_are_known_by_name() -> None:
    """With or without the scope that Drake puts before it."""
    assert is_sole("sole_left_0")
    assert is_sole("jvrc1::sole_left_0")
    assert not is_sole("L_ANKLE_P_S_0_hull")
