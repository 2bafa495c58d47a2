"""Which of a robot's bodies can meet each other: all but neighbours in the chain."""

from itertools import combinations

from pydrake.geometry import CollisionFilterDeclaration, GeometrySet, SceneGraph
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex, ModelInstanceIndex

NEIGHBOURS = 2
"""Bodies with at most this many joints between them overlap by construction: in the
joints' housings the hull of one is inside that of the other (JVRC-1: waist 87 mm, hip
70, shoulder 56, neck 50, ankle 37, wrist 30)."""


def filter_neighbours(
    plant: MultibodyPlant, scene_graph: SceneGraph, instance: ModelInstanceIndex
) -> None:
    """Lets every two bodies of a robot collide that are no neighbours.

    Args:
        plant: robot and scene, with all geometry of the robot, finalised or not.
        scene_graph: the one that the plant is registered with.
        instance: the robot.
    """
    manager = scene_graph.collision_filter_manager()
    geometry = {
        index: GeometrySet(plant.GetCollisionGeometriesForBody(plant.get_body(index)))
        for index in plant.GetBodyIndices(instance)
    }
    for shapes in geometry.values():
        manager.Apply(CollisionFilterDeclaration().ExcludeWithin(shapes))
    chains = _chains(plant, instance)
    for a, b in combinations(geometry, 2):
        if joints_between(chains[a], chains[b]) <= NEIGHBOURS:
            manager.Apply(
                CollisionFilterDeclaration().ExcludeBetween(geometry[a], geometry[b])
            )


def joints_between(a: tuple[int, ...], b: tuple[int, ...]) -> int:
    """Count the joints between two bodies.

    Args:
        a: the joints that move between a body and the root.
        b: the same of the other body.
    """
    return len(set(a) ^ set(b))


def _chains(
    plant: MultibodyPlant, instance: ModelInstanceIndex
) -> dict[BodyIndex, tuple[int, ...]]:
    """Computes the joints that move between every body and the root."""
    above = {
        joint.child_body().name(): joint
        for joint in map(plant.get_joint, plant.GetJointIndices(instance))
    }
    chains = {}
    for index in plant.GetBodyIndices(instance):
        chain, name = [], plant.get_body(index).name()
        while name in above:
            if above[name].num_velocities() > 0:
                chain.append(int(above[name].index()))
            name = above[name].parent_body().name()
        chains[index] = tuple(chain)
    return chains
