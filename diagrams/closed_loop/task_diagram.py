"""What a task's builder hands to whoever runs it."""

from dataclasses import dataclass

from pydrake.geometry import Meshcat, MeshcatVisualizer
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import (
    Context,
    Diagram,
    DiagramBuilder,
    OutputPort,
    System,
)

from footfall.diagrams.closed_loop.station import Station
from footfall.diagrams.closed_loop.walking import Stand
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.signals import SignalRecorder
from footfall.models.robots.robot import RobotModel
from footfall.models.scenes.scene import SceneParams
from footfall.models.values.planned import TaskStatus
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_abstract


@dataclass(frozen=True, kw_only=True)
class TaskDiagram:
    """A closed loop that is ready to run: its default context is where it starts."""

    kind: str
    """What is to be done, one of `task_params.TASKS`."""
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


def build_diagram(
    builder: DiagramBuilder,
    scenario: Scenario,
    station: Station,
    stand: Stand,
    executive: System,
    signals: SignalRecorder,
    *,
    goal: Vector | None = None,
    meshcat: Meshcat | None = None,
) -> TaskDiagram:
    """Builds the closed loop once everything is wired.

    Args:
        builder: of the diagram, which is named after the scenario's kind of task.
        scenario: what it was wired from.
        station: robot and scene.
        stand: where the robot stands in the default context.
        executive: its `status` says how the task is going.
        signals: what is logged.
        goal: midpoint of the feet and heading at the end in W, (3,), m and rad; None
            where the task has none.
        meshcat: where the run is to be shown live, if anywhere.
    """
    if meshcat is not None:
        MeshcatVisualizer.AddToBuilder(builder, station.scene_graph, meshcat)
    station.plant.SetDefaultPositions(station.instance, stand.positions)
    diagram = builder.Build()
    diagram.set_name(scenario.task.kind)
    return TaskDiagram(
        kind=scenario.task.kind,
        diagram=diagram,
        plant=station.plant,
        robot_instance=station.instance,
        robot=station.robot,
        scene=scenario.scene,
        signals=signals,
        status=executive.GetOutputPort("status"),
        goal=None if goal is None else (goal[0], goal[1], goal[2]),
        meshcat=meshcat,
    )
