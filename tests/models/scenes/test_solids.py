"""Solids as a mesh and as contact geometry."""

import numpy as np
import pytest
from pydrake.geometry import Sphere
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    ContactModel,
    CoulombFriction,
)
from pydrake.multibody.tree import SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.models.robots.contact_geometry import SOLE_FRICTION
from footfall.models.scenes.solids import (
    Box,
    add_solids,
    solid_name,
    triangle_mesh,
    upright_pose,
)
from footfall.models.scenes.staircase import StaircaseParams


def _box(size: list[float], **pose: float) -> Box:
    return Box("crate", upright_pose(**pose), np.array(size), 0.7, (1, 1, 1, 1))


def test_mesh_is_closed_and_faces_outwards() -> None:
    """Volume and area of the mesh are those of the boxes."""
    solids = (
        _box([1.0, 2.0, 3.0], x=0.4, y=-1.0, z=2.0, yaw=0.3),
        _box([0.5, 0.5, 0.5], z=9.0),
    )
    vertices, triangles = triangle_mesh(solids)
    assert vertices.shape == (16, 3)
    assert triangles.shape == (24, 3)
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    # The divergence theorem: the volume comes out right, and positive, only if every
    # face is there and wound counter-clockwise seen from outside.
    volume = np.sum(np.linalg.det(np.stack([a, b, c], axis=1))) / 6.0
    np.testing.assert_allclose(volume, 6.0 + 0.125, rtol=1e-12)
    area = np.sum(np.linalg.norm(np.cross(b - a, c - a), axis=1)) / 2.0
    np.testing.assert_allclose(area, 22.0 + 1.5, rtol=1e-12)


def test_mesh_of_nothing_is_empty() -> None:
    """No solids, no triangles."""
    vertices, triangles = triangle_mesh(())
    assert vertices.shape == (0, 3)
    assert triangles.shape == (0, 3)


def test_solids_compare_by_value() -> None:
    """Pose and size count."""
    assert _box([1.0, 2.0, 3.0], x=0.4) == _box([1.0, 2.0, 3.0], x=0.4)
    assert _box([1.0, 2.0, 3.0], x=0.4) != _box([1.0, 2.0, 3.1], x=0.4)


def test_ball_rests_on_the_step_that_contact_names() -> None:
    """Contact acts on the step's face and carries its name and friction."""
    radius, mass = 0.02, 1.0
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=1e-3)
    plant.set_contact_model(ContactModel.kPoint)
    ball = plant.AddRigidBody("ball", SpatialInertia.SolidSphereWithMass(mass, radius))
    plant.RegisterCollisionGeometry(
        ball,
        upright_pose(),
        Sphere(radius),
        "ball",
        CoulombFriction(SOLE_FRICTION, SOLE_FRICTION),
    )
    stairs = StaircaseParams(steps=3, rise=0.2, run=0.3, x=0.5)
    add_solids(plant, stairs.solids())
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(
        context, ball, stairs.treads()[1].X_WR.multiply(upright_pose(z=radius))
    )
    simulator.AdvanceTo(0.5)
    assert plant.EvalBodyPoseInWorld(context, ball).translation() == pytest.approx(
        [0.5 + 0.45, 0.0, 0.4 + radius], abs=2e-3
    )
    contacts = plant.get_contact_results_output_port().Eval(context)
    assert contacts.num_point_pair_contacts() == 1
    pair = contacts.point_pair_contact_info(0).point_pair()
    query = plant.get_geometry_query_input_port().Eval(context)
    names = {solid_name(query.inspector(), item) for item in (pair.id_A, pair.id_B)}
    assert names == {"ball", "staircase/step_2"}
    force = contacts.point_pair_contact_info(0).contact_force()
    assert abs(force[2]) == pytest.approx(mass * 9.81, rel=1e-3)
    properties = [
        query.inspector().GetProximityProperties(item)
        for item in (pair.id_A, pair.id_B)
    ]
    mu = [item.GetProperty("material", "coulomb_friction") for item in properties]
    m1, m2 = (item.static_friction() for item in mu)
    assert 2.0 * m1 * m2 / (m1 + m2) == pytest.approx(stairs.friction)
