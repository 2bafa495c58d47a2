"""How far a robot's own bodies are from each other in a posture."""

from typing import NamedTuple

from pydrake.geometry import QueryObject, Role
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder

from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import add_robot
from footfall.models.values.vector import Vector


class SelfDistance(NamedTuple):
    """The two bodies that are nearest to each other, of those that can meet."""

    distance: float
    """m; negative by how deep they are in each other."""
    bodies: tuple[str, str]
    """Their names, in alphabetical order; empty where none are near."""


class SelfDistanceMeter:
    """Measures on a copy of the robot's collision geometry that stands in no scene."""

    def __init__(self, robot: RobotModel) -> None:
        """Builds the copy.

        Args:
            robot: which robot.
        """
        builder = DiagramBuilder()
        self._plant, self._scene_graph = AddMultibodyPlantSceneGraph(builder, 0.0)
        instance = add_robot(self._plant, self._scene_graph, robot)
        self._plant.Finalize()
        self._root = builder.Build().CreateDefaultContext()
        self._context = self._plant.GetMyMutableContextFromRoot(self._root)
        self._query_context = self._scene_graph.GetMyContextFromRoot(self._root)
        # Ids that the plant itself gives would keep it alive.
        inspector = self._scene_graph.model_inspector()
        self._body_of = {
            geometry: body.name()
            for body in map(self._plant.get_body, self._plant.GetBodyIndices(instance))
            for geometry in inspector.GetGeometries(
                self._plant.GetBodyFrameIdOrThrow(body.index()), Role.kProximity
            )
        }

    def nearest(self, positions: Vector, within: float) -> SelfDistance:
        """Finds the nearest two bodies.

        Args:
            positions: q of the robot, floating base first, (nq,).
            within: bodies farther apart than this are not looked at, m.

        Returns:
            The nearest; `within` and no names where none are that near.
        """
        self._plant.SetPositions(self._context, positions)
        query = self._scene_graph.get_query_output_port().Eval(self._query_context)
        assert isinstance(query, QueryObject)
        pairs = query.ComputeSignedDistancePairwiseClosestPoints(within)
        if not pairs:
            return SelfDistance(within, ("", ""))
        pair = min(pairs, key=lambda found: found.distance)
        first, second = sorted((self._body_of[pair.id_A], self._body_of[pair.id_B]))
        return SelfDistance(pair.distance, (first, second))
