"""The robot of a scenario's file: its own file read in, and what follows from it."""

from pathlib import Path

from footfall.diagrams.robots.robot_files import (
    ROBOTS,
    described_robot,
    is_file,
    read_robot_file,
    resolved,
)
from footfall.diagrams.schema import Mapping, plain, set_field
from footfall.models.robots.robot import RobotModel

CLIMBING_FORWARD = 0.015
"""How far the ZMP is ahead of where it is in walking when the robot climbs, m: nearer
to the knee, which has less to carry."""


def name_robot(data: Mapping, folder: Path) -> None:
    """Writes `robot: NAME` as the field that it is, and a file's path in full.

    Args:
        data: of a scenario; changed in place.
        folder: that the path starts in.
    """
    if isinstance(data.get("robot"), str):
        data["robot"] = {"name": data["robot"]}
    robot = data.get("robot")
    name = robot.get("name") if isinstance(robot, dict) else None
    if isinstance(robot, dict) and isinstance(name, str) and is_file(name):
        robot["name"] = str(folder / name)


def expand_robot(data: Mapping, file: Path) -> None:
    """Spells out a robot of one's own, and the parameters that follow from the robot.

    Args:
        data: of a scenario, checked against its schema; changed in place. What it says
            of a parameter itself stays.
        file: of the scenario.

    Raises:
        RobotError: the robot's file cannot be used.
    """
    section = data.setdefault("robot", {}) or {}
    data["robot"] = section
    name, said = section.get("name", "jvrc1"), section.get("description")
    robot = ROBOTS.get(name)
    if is_file(name):
        source = Path(name)
        robot = described_robot(_merged(read_robot_file(source), said or {}), source)
        section["name"] = robot.name
    elif said is not None and robot is not None:
        robot = described_robot(_merged(plain(resolved(robot)), said), file)
    elif said is not None:
        robot = described_robot({"name": name, **said}, file)
    if robot is None:
        return
    if robot is not ROBOTS.get(name):
        section["description"] = plain(resolved(robot))
    for path, value in parameters_of(robot).items():
        if not _is_said(data, path):
            set_field(data, path, value)


def parameters_of(robot: RobotModel) -> dict[str, float]:
    """Gives the fields of a scenario that follow from the robot, by their paths."""
    ahead, height = robot.standing_com
    return {
        "parameters.com_height": height,
        "parameters.motion_planner.zmp_forward": ahead,
        "parameters.motion_planner.climb_zmp_forward": round(
            ahead + CLIMBING_FORWARD, 6
        ),
        "parameters.footstep_planner.stance_width": robot.stance_width,
        "parameters.path_planner.footprint_radius": robot.footprint_radius,
        "parameters.path_executive.body_radius": robot.body_radius,
        "parameters.crossing.feasibility.lowest_waist": robot.lowest_waist,
    }


def _is_said(data: Mapping, path: str) -> bool:
    """Tells whether a document has a field."""
    for part in path.split("."):
        if not isinstance(data, dict) or part not in data:
            return False
        data = data[part]
    return True


def _merged(below: Mapping, above: Mapping) -> Mapping:
    """Both documents; where both have a field, the second's counts."""
    merged = dict(below)
    for name, value in above.items():
        under = merged.get(name)
        if isinstance(under, dict) and isinstance(value, dict):
            value = _merged(under, value)
        merged[name] = value
    return merged
