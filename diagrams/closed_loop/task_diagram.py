"""What a task's builder hands to whoever runs it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from pydrake.geometry import Meshcat, SceneGraph
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import Context, Diagram, OutputPort, System

from footfall.diagrams.closed_loop.leaf_systems import eval_output, find_system
from footfall.diagrams.signals import SignalRecorder
from footfall.models.robots.robot import RobotModel
from footfall.models.scenes.scene import SceneParams
from footfall.models.values.planned import TaskStatus
from footfall.systems.ports import eval_abstract


@dataclass(frozen=True, kw_only=True)
class TaskDiagram:
    """A closed loop that is ready to run: its default context is where it starts."""

    kind: str
    """What is to be done, one of `task_params.TASKS`."""
    diagram: Diagram
    plant: MultibodyPlant
    """The true robot and scene."""
    scene_graph: SceneGraph
    """Their shapes."""
    robot_instance: ModelInstanceIndex
    """The robot in the plant."""
    robot: RobotModel
    """The names of its parts."""
    scene: SceneParams
    """What truly stands around it."""
    signals: SignalRecorder
    """The ports that are logged."""
    status: OutputPort
    """The executive's `TaskStatus`."""
    goal: tuple[float, float, float] | None = None
    """Where the midpoint of the feet is to come to, x, y, yaw in W, where the task has
    a goal."""
    meshcat: Meshcat | None = None
    """Where the run can be watched live, where that was asked for."""
    replaced: Mapping[str, str] = field(default_factory=dict)
    """The class of every part that a user has put in the place of ours, by its name."""

    def task_status(self, root_context: Context) -> TaskStatus:
        """How the executive says the task is going."""
        system: System = self.status.get_system()  # type: ignore[assignment]
        context = system.GetMyContextFromRoot(root_context)
        return eval_abstract(self.status, context, TaskStatus)

    def system(self, name: str) -> System:
        """Finds a System of the closed loop by its name, or a station.

        Raises:
            LookupError: there is none; the message lists those that there are.
        """
        return find_system(self.diagram, name)

    def output(self, name: str, root_context: Context) -> Any:
        """Evaluates any output port of the closed loop.

        Args:
            name: "SYSTEM.PORT".
            root_context: the diagram's.

        Returns:
            The vector, (n,), or the value.

        Raises:
            LookupError: there is no such port; the message lists those that there are.
        """
        return eval_output(self.diagram, name, root_context)
