"""What a task's builder hands to whoever runs it."""

from dataclasses import dataclass

from pydrake.geometry import Meshcat
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import Context, Diagram, OutputPort, System

from diagrams.signals import SignalRecorder
from models.robot import RobotModel
from models.scene import SceneParams
from systems.ports import eval_abstract
from systems.values import TaskStatus


@dataclass(frozen=True, kw_only=True)
class TaskDiagram:
    """A closed loop that is ready to run: its default context is where it starts."""

    diagram: Diagram
    plant: MultibodyPlant
    """The true robot and scene."""
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

    def task_status(self, root_context: Context) -> TaskStatus:
        """How the executive says the task is going."""
        system: System = self.status.get_system()  # type: ignore[assignment]
        context = system.GetMyContextFromRoot(root_context)
        return eval_abstract(self.status, context, TaskStatus)
