"""How near the robot's own bodies truly came to each other."""

from dataclasses import dataclass

import numpy as np
from pydrake.geometry import QueryObject, SceneGraph
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import Context, Diagram, DiagramBuilder

from models.robot import RobotModel
from models.robot_loader import add_robot
from systems.ports import Vector, eval_abstract

TICK = 0.025
"""Between the postures that are looked at, s."""
REACH = 0.1
"""Bodies farther apart than this are not measured, m."""


@dataclass(frozen=True)
class SelfDistance:
    """The nearest that two bodies of a robot came to each other."""

    distance: float
    """m; negative where they were inside each other."""
    bodies: tuple[str, str]
    """Which two."""
    time: float
    """s."""


@dataclass(frozen=True)
class LoneRobot:
    """A robot without a scene, with its collision geometry and its filters."""

    diagram: Diagram
    plant: MultibodyPlant
    scene_graph: SceneGraph
    instance: ModelInstanceIndex


def lone_robot(robot: RobotModel) -> LoneRobot:
    """Builds the robot; only pairs of its bodies that may collide are measured."""
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    instance = add_robot(plant, scene_graph, robot)
    plant.Finalize()
    return LoneRobot(builder.Build(), plant, scene_graph, instance)


def least_self_distance(
    alone: LoneRobot, time: Vector, state: Vector
) -> SelfDistance | None:
    """The least distance between two of a robot's bodies that may collide.

    Args:
        alone: the robot.
        time: (n,), s.
        state: positions, then velocities, (n, nq + nv).

    Returns:
        The nearest pair; None where no two bodies came within `REACH`, or none may
        collide.
    """
    root = alone.diagram.CreateDefaultContext()
    at = alone.plant.GetMyMutableContextFromRoot(root)
    scene: Context = alone.scene_graph.GetMyContextFromRoot(root)
    query_port = alone.scene_graph.get_query_output_port()
    step = max(1, round(TICK / float(np.median(np.diff(time))))) if len(time) > 1 else 1
    best: SelfDistance | None = None
    for row in range(0, len(time), step):
        alone.plant.SetPositionsAndVelocities(at, alone.instance, state[row])
        query = eval_abstract(query_port, scene, QueryObject)
        reach = REACH if best is None else best.distance
        if reach <= 0.0:
            reach = 1e-3  # what is deeper inside each other is still found
        for pair in query.ComputeSignedDistancePairwiseClosestPoints(reach):
            if best is None or pair.distance < best.distance:
                bodies = sorted(
                    _body(alone, query, geometry) for geometry in (pair.id_A, pair.id_B)
                )
                best = SelfDistance(
                    float(pair.distance), (bodies[0], bodies[1]), float(time[row])
                )
    return best


def _body(alone: LoneRobot, query: QueryObject, geometry: object) -> str:
    frame = query.inspector().GetFrameId(geometry)  # type: ignore[arg-type]
    body = alone.plant.GetBodyFromFrameId(frame)
    assert body is not None
    return str(body.name())
