"""Stand where one is, under pushes if there are any: the least that a robot must do."""

import numpy as np
from pydrake.geometry import Meshcat
from pydrake.systems.framework import DiagramBuilder

from footfall.diagrams.closed_loop.station import add_station
from footfall.diagrams.closed_loop.task_diagram import TaskDiagram, build_diagram
from footfall.diagrams.closed_loop.walking import add_walking, initial_stand
from footfall.diagrams.closed_loop.walking_signals import record_walking
from footfall.diagrams.closed_loop.wiring import add_system
from footfall.diagrams.scenario import Scenario
from footfall.models.values.vector import Vector
from footfall.systems.planning.executive.stand_executive import StandExecutive


def build_standing(scenario: Scenario, meshcat: Meshcat | None = None) -> TaskDiagram:
    """Builds the closed loop of balance and tracking alone.

    Args:
        scenario: what to build.
        meshcat: where the run is to be shown live, if anywhere.

    Returns:
        The diagram, its default context where the robot starts.
    """
    params = scenario.controllers()
    robot = scenario.robot.model()
    builder = DiagramBuilder()
    station = add_station(builder, scenario, robot, params.control_period)
    stand = initial_stand(scenario, station)
    executive = add_system(
        builder, "executive", StandExecutive(stand.plan, scenario.task.stand_time)
    )
    walking = add_walking(builder, scenario, station, stand, executive, None)
    recorder = record_walking(builder, station, walking, executive)
    start = scenario.robot
    place: Vector = np.array([start.x, start.y, start.yaw])
    return build_diagram(
        builder,
        scenario,
        station,
        stand,
        executive,
        recorder,
        goal=place,
        meshcat=meshcat,
    )
