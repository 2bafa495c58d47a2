"""What a robot of one's own can do here: its description measured and tried out."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.robots.robot_files import load_robot, read_robot_file, robot_file
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.diagrams.schema import plain
from footfall.diagrams.simulation import simulate, summarize
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_alone import robot_alone
from footfall.models.robots.robot_derivation import spelt_out, stance_of
from footfall.models.robots.robot_description import RobotDescription
from footfall.models.robots.robot_errors import RobotError
from footfall.models.robots.urdf import parse_xml, read_urdf
from footfall.systems.planning.whole_body.whole_body_plan import planning_body

STAND_TIME = 2.0
"""How long the robot is made to stand, s."""
FLAT = 0.02
"""Soles that tilt less than this in the posture stand flat enough to begin with, rad.
"""
SHOWN = 6
"""So many names of a list are printed."""
HIDDEN = ("name", "urdf", "packages", "servos", "limits")
"""Fields that are told of in another way."""


@dataclass(frozen=True)
class Capability:
    """Whether the robot can do something, and what that rests on."""

    name: str
    able: bool
    reasons: tuple[str, ...]
    """What is missing, field by field; of what it can do, how well it does."""


@dataclass(frozen=True)
class RobotReport:
    """What `check_robot` has found."""

    robot: RobotModel
    derived: tuple[tuple[str, str], ...]
    """Fields that the file leaves out, and what was read off the URDF for them."""
    left_out: tuple[str, ...]
    """What the URDF says that is not simulated."""
    capabilities: tuple[Capability, ...]

    @property
    def stands(self) -> bool:
        """Whether it stood."""
        return self.capabilities[0].able

    def lines(self) -> Iterator[str]:
        """Writes the report as it is printed."""
        robot = self.robot
        urdf = read_urdf(robot.urdf)
        yield (
            f"{robot.name}: {sum(urdf.masses.values()):.1f} kg, "
            f"{len(robot.gains)} joints move, {len(robot.welded_joints)} are fixed"
        )
        yield f"  {robot.urdf}"
        for field, value in self.derived:
            yield f"  derived  {field}: {value}"
        if self.left_out:
            yield f"  ignored  {', '.join(self.left_out)}"
        for item in self.capabilities:
            answer = "yes" if item.able else "no"
            for index, reason in enumerate(item.reasons):
                head = f"{item.name:<8} {answer:<4}" if not index else " " * 13
                yield f"  {head} {reason}"


def check_robot(name_or_path: str | Path) -> RobotReport:
    """Loads a robot, tells what was derived, and makes it stand on contact.

    Args:
        name_or_path: of a shipped robot, or a YAML file.

    Raises:
        RobotError: the file does not fit the URDF; a line for everything.
    """
    robot = load_robot(name_or_path)
    said = read_robot_file(robot_file(str(name_or_path), Path()))
    whole = spelt_out(robot)
    derived = tuple(
        (item.name, _shown(plain(getattr(whole, item.name))))
        for item in fields(RobotDescription)
        if item.name not in {*said, *HIDDEN}
        and getattr(whole, item.name)
        and (item.name != "lidar_position" or robot.head_body)
    )
    scenario = load_scenario(
        "stand", [f"robot.name={name_or_path}", f"task.stand_time={STAND_TIME}"]
    )
    return RobotReport(
        robot,
        (*derived, *_motors(robot, [*said])),
        tuple(_left_out(robot)),
        (_stands(robot, scenario), _walks(robot, scenario), _sees(robot)),
    )


def _motors(robot: RobotModel, said: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Says in one line each what was derived of servos and limits."""
    if "servos" not in said:
        knee = robot.gains[robot.knee_joints["left"]]
        ankle = robot.gains[robot.leg_joints["left"][-1]]
        yield (
            "servos",
            f"legs {knee.stiffness:g} Nm/rad, ankles {ankle.stiffness:g} Nm/rad",
        )


def _left_out(robot: RobotModel) -> Iterator[str]:
    root = parse_xml(robot.urdf)
    rough = len(root.findall("joint/dynamics[@friction]"))
    if rough:
        yield f"friction of {rough} joints"
    if root.find("transmission") is not None:
        yield "transmissions: every joint has a motor of its own"
    mimics = root.findall("joint/mimic")
    if mimics:
        yield f"mimicry of {len(mimics)} joints, which are fixed"


def _stands(robot: RobotModel, scenario: Scenario) -> Capability:
    """Simulates it under the servos and the stabiliser of every task."""
    task = build_task(scenario)
    summary = summarize(task, scenario, simulate(task, 10.0 * STAND_TIME))
    able = summary.outcome == "completed"
    if not able:
        tilt = stance_of(robot).tilt
        reasons = [f"{summary.outcome}: {summary.reason}"]
        if tilt > FLAT:
            reasons.append(f"posture: the soles tilt by {tilt:.2f} rad in it")
        return Capability("stands", False, tuple(reasons))
    return Capability(
        "stands",
        True,
        (
            f"{STAND_TIME:g} s on contact and at rest after it: soles slid "
            f"{1e3 * (summary.max_foot_slip_m or 0.0):.2f} mm, largest torque "
            f"{100.0 * (summary.max_torque_fraction or 0.0):.0f} % of "
            f"{summary.max_torque_joint}'s limit, ZMP "
            f"{1e2 * (summary.min_zmp_margin_m or 0.0):.1f} cm inside the support",
        ),
    )


def _walks(robot: RobotModel, scenario: Scenario) -> Capability:
    """Says whether the planners' closed-form leg fits it."""
    reasons: list[str] = []
    try:
        planning_body(robot, robot_alone(robot))
    except RobotError as error:
        reasons += error.problems
    try:
        scenario.parameters.footstep_planner.validate(robot.sole)
    except ValueError as error:
        reasons.append(f"parameters.footstep_planner.{error}")
    if reasons:
        return Capability("walks", False, tuple(reasons))
    swing = "its arms swing" if robot.swing_joints else "no swing_joints: arms hang"
    return Capability("walks", True, (f"the planners' leg fits; {swing}",))


def _sees(robot: RobotModel) -> Capability:
    """Says whether it has the scanner that stairs and obstacles are seen with."""
    if robot.head_body is None:
        return Capability("sees", False, ("head_body: no link carries the scanner",))
    place = ", ".join(f"{x:g}" for x in robot.lidar_position)
    return Capability(
        "sees", True, (f"scanner on {robot.head_body} at ({place}) m in its frame",)
    )


def _shown(value: object) -> str:
    """Shows a value as a person reads it, long lists cut short."""
    if isinstance(value, dict):
        items = [f"{key} {_shown(item)}" for key, item in value.items()]
        return _cut(items)
    if isinstance(value, list):
        return _cut([_shown(item) for item in value])
    return f"{value:g}" if isinstance(value, float) else str(value)


def _cut(items: list[str]) -> str:
    more = len(items) - SHOWN
    text = ", ".join(items[:SHOWN])
    return f"{text} and {more} more" if more > 0 else text
