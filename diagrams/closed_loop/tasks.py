"""From a scenario to the closed loop that it asks for."""

from pydrake.geometry import Meshcat

from footfall.diagrams.closed_loop.obstacle_crossing import build_obstacle_crossing
from footfall.diagrams.closed_loop.room_crossing import build_room_crossing
from footfall.diagrams.closed_loop.stair_climbing import build_stair_climbing
from footfall.diagrams.closed_loop.standing import build_standing
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.scenario import Scenario, ScenarioError

BUILDERS = {
    "obstacle_crossing": build_obstacle_crossing,
    "room_crossing": build_room_crossing,
    "stair_climbing": build_stair_climbing,
    "stand": build_standing,
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
