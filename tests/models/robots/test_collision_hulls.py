"""The hulls a robot collides with."""

import numpy as np
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder

from footfall.models.robots.collision_hulls import collision_hulls
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot_loader import add_robot


def test_are_those_of_the_plant() -> None:
    """Same extents as the geometry that the parser registers."""
    plant, scene_graph = AddMultibodyPlantSceneGraph(DiagramBuilder(), time_step=0.0)
    add_robot(plant, scene_graph, JVRC1)
    plant.Finalize()
    inspector = scene_graph.model_inspector()
    for hull in collision_hulls(JVRC1):
        meshes = [
            inspector.GetConvexHull(item)
            for item in plant.GetCollisionGeometriesForBody(
                plant.GetBodyByName(hull.body)
            )
            if "hull" in inspector.GetName(item)
        ]
        vertices = np.array(
            [mesh.vertex(i) for mesh in meshes for i in range(mesh.num_vertices())]
        )
        np.testing.assert_allclose(hull.vertices.min(0), vertices.min(0), atol=1e-6)
        np.testing.assert_allclose(hull.vertices.max(0), vertices.max(0), atol=1e-6)


def test_shins_are_as_long_as_the_robot() -> None:
    """Between knee and ankle."""
    hulls = {hull.body: hull.vertices for hull in collision_hulls(JVRC1)}
    for side in "LR":
        length = np.ptp(hulls[f"{side}_KNEE_S"][:, 2])
        assert 0.35 < length < 0.42
