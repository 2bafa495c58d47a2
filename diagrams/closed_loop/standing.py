"""Stand where one is, under pushes if there are any: the least that a robot must do."""

from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.systems.planning.executive.stand_executive import StandExecutive


def build_stand_planning(setup: Setup) -> Station:
    """Builds what says how long to stand, and that nothing moves.

    Takes nothing; gives `motion_plan`, `footstep_plan` and `status`. Parts:
    `executive`.
    """
    station = StationBuilder("planning", setup.parts)
    station.add(
        "executive",
        lambda: StandExecutive(setup.stand.plan, setup.scenario.task.stand_time),
    )
    for signal in ("motion_plan", "footstep_plan", "status"):
        station.give(signal, f"executive.{signal}")
    return station.build()
