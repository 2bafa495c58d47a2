"""From a scenario to the closed loop that it asks for."""

from pydrake.geometry import Meshcat

from diagrams.obstacle_crossing import build_obstacle_crossing
from diagrams.room_crossing import build_room_crossing
from diagrams.scenario import Scenario, ScenarioError
from diagrams.stair_climbing import build_stair_climbing
from diagrams.task_diagram import TaskDiagram

BUILDERS = {
    "obstacle_crossing": build_obstacle_crossing,
    "room_crossing": build_room_crossing,
    "stair_climbing": build_stair_climbing,
}
"""Who builds which kind of task."""


def build_task(scenario: Scenario, meshcat: Meshcat | None = None) -> TaskDiagram:
    """Builds the closed loop of a scenario.

    Args:
        scenario: what to build.
        meshcat: where the run is to be shown live, if anywhere.

    Raises:
        ScenarioError: there is no such task.
    """
    kind = scenario.task.kind
    if kind not in BUILDERS:
        raise ScenarioError(
            f"{scenario.name}: task.kind: must be one of {', '.join(BUILDERS)}, "
            f"got {kind!r}"
        )
    return BUILDERS[kind](scenario, meshcat=meshcat)
