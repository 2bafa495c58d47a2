"""From a scenario to the closed loop that it asks for."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

from pydrake.geometry import Meshcat
from pydrake.systems.framework import System

from footfall.diagrams.closed_loop.estimation import build_estimation
from footfall.diagrams.closed_loop.loop_builder import LoopBuilder
from footfall.diagrams.closed_loop.obstacle_stations import (
    build_obstacle_perception,
    build_obstacle_planning,
)
from footfall.diagrams.closed_loop.parts import Parts
from footfall.diagrams.closed_loop.robot_station import (
    RobotStation,
    build_robot_station,
)
from footfall.diagrams.closed_loop.room_perception import build_room_perception
from footfall.diagrams.closed_loop.room_planning import build_room_planning
from footfall.diagrams.closed_loop.setup import Setup, set_up
from footfall.diagrams.closed_loop.stair_stations import (
    build_stair_perception,
    build_stair_planning,
)
from footfall.diagrams.closed_loop.standing import build_stand_planning
from footfall.diagrams.closed_loop.station_builder import Station, choose_station
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.closed_loop.walking_control import build_walking_control
from footfall.diagrams.closed_loop.walking_signals import log_walking
from footfall.diagrams.scenario import Scenario, ScenarioError


class TaskStations(NamedTuple):
    """Who builds the stations in which tasks differ."""

    planning: Callable[[Setup], Station]
    perception: Callable[[Setup, RobotStation], Station] | None = None


STATIONS = {
    "obstacle_crossing": TaskStations(
        build_obstacle_planning, build_obstacle_perception
    ),
    "room_crossing": TaskStations(build_room_planning, build_room_perception),
    "stair_climbing": TaskStations(build_stair_planning, build_stair_perception),
    "stand": TaskStations(build_stand_planning),
}
"""By kind of task."""


def build_task(
    scenario: Scenario,
    meshcat: Meshcat | None = None,
    *,
    replace: Mapping[str, System] | None = None,
    extend: Callable[[LoopBuilder], None] | None = None,
) -> TaskDiagram:
    """Builds the closed loop of a scenario.

    It is made of stations, Diagrams that are connected by the signals they exchange:
    `robot_station`, `estimation`, `perception` (but for a robot that only stands),
    `planning` and `walking_control`; the functions `build_...` of this folder say which
    parts each has and which signals it takes and gives.

    Args:
        scenario: what to build.
        meshcat: where the run is to be shown live, if anywhere.
        replace: Systems of one's own in the places of ours, by the name of the part or
            of the station, as `footfall diagram` shows them. Their ports have the names
            and types of ours; inputs that one does not need may be missing. Not
            replaced are the parts by which a run is judged.
        extend: is called before the diagram is built, to add Systems and to log ports.

    Raises:
        ScenarioError: there is no such task.
        PartError: a part of one's own does not fit; in one line with port and type.
        EnvironmentFileError: the scenario's environment cannot be read.
        RobotError: the robot lacks what the task needs.
    """
    kind = scenario.task.kind
    if kind not in STATIONS:
        raise ScenarioError(
            f"{scenario.name}: task.kind: must be one of {', '.join(STATIONS)}, "
            f"got {kind!r}"
        )
    parts = Parts(replace or {})
    parts.fix("robot_station", "a run is judged by it; replace one of its parts")
    setup = set_up(scenario, parts)
    true = build_robot_station(setup, meshcat)
    planning, perception = STATIONS[kind]
    makers: dict[str, Callable[[], Station]] = {
        "estimation": partial(build_estimation, setup),
        "planning": partial(planning, setup),
        "walking_control": partial(build_walking_control, setup),
    }
    if perception is not None:
        makers = {"perception": partial(perception, setup, true)} | makers
    stations = [true.station]
    for name, make in makers.items():
        stations.append(choose_station(name, parts, make))
    parts.check_all_known()

    loop = LoopBuilder(stations)
    log_walking(loop, setup, true)
    for station in stations:
        for value in station.values:
            if loop.find_output(value) is not None:
                loop.log(value)
    if extend is not None:
        extend(loop)
    status = loop.output("planning.status")
    return TaskDiagram(
        kind=kind,
        diagram=loop.build(kind),
        plant=true.plant,
        scene_graph=true.scene_graph,
        robot_instance=true.instance,
        robot=setup.robot,
        scene=scenario.scene,
        signals=loop.signals,
        status=status,
        goal=_goal(scenario),
        meshcat=meshcat,
        replaced=parts.named(),
    )


def _goal(scenario: Scenario) -> tuple[float, float, float] | None:
    """Finds where the midpoint of the feet is to be at the end, where it matters."""
    kind, start = scenario.task.kind, scenario.robot
    if kind == "stair_climbing":
        return None
    if kind == "stand":
        return start.x, start.y, start.yaw
    x, y, yaw = scenario.task.goal
    return float(x), float(y), float(yaw)
