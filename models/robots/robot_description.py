"""A robot of one's own: what its YAML file says, field by field.

Only `urdf` and `foot_bodies` must be given; what else is left out is read off the URDF
(`robot_derivation.py`) or is a capability the robot does not have.
`footfall check-robot FILE` prints what was derived and what is missing.
`models/robots/jvrc1.yaml` says everything, docs/robots/ has shorter ones.

Joints are named by shell patterns where a field says so: `leg_*_joint` for several,
`*` for all.
"""

from dataclasses import dataclass, field
from pathlib import Path

from pydrake.common.yaml import yaml_load_typed

from footfall.models.robots.robot import Sole
from footfall.models.values.validation import Parameters, number

DEFAULT_FILE = Path(__file__).with_name("jvrc1.yaml")
"""The robot of whoever names none."""


@dataclass(kw_only=True)
class FeetDescription(Parameters):
    """A name for either foot."""

    left: str = ""
    """Of the left foot."""
    right: str = ""
    """Of the right foot."""


@dataclass(kw_only=True)
class LegsDescription(Parameters):
    """The joints of both legs."""

    left: list[str] = field(default_factory=list)
    """Of the left leg, hip to ankle."""
    right: list[str] = field(default_factory=list)
    """Of the right leg, in the same order."""


@dataclass(kw_only=True)
class SoleDescription(Parameters):
    """The flat rectangle that a foot stands on, seen from the ankle."""

    heel: float = number(0.1, "m", above=0.0)
    """From under the ankle back to the heel edge, m, positive."""
    toe: float = number(0.1, "m", above=0.0)
    """From under the ankle forward to the toe edge, m."""
    half_width: float = number(0.05, "m", above=0.0)
    """Half the width, m."""
    ankle_height: float = number(0.1, "m", above=0.0)
    """Height of the ankle above the sole, m."""


@dataclass(kw_only=True)
class ServoDescription(Parameters):
    """The position servo of some joints."""

    joints: list[str] = field(default_factory=list)
    """Which: names or patterns."""
    stiffness: float = number(1000.0, "Nm/rad", above=0.0)
    """Proportional gain, Nm/rad (N/m of a prismatic joint)."""
    damping: float = number(40.0, "Nm s/rad", least=0.0)
    """Derivative gain, Nm s/rad."""
    reflected_inertia: float = number(0.05, "kg m^2", least=0.0)
    """Rotor inertia times gear ratio squared, kg m^2: URDFs do not name it."""


@dataclass(kw_only=True)
class LimitsDescription(Parameters):
    """Limits of some joints, where the URDF gives none or others are wanted."""

    joints: list[str] = field(default_factory=list)
    """Which: names or patterns."""
    effort: float | None = number(None, "Nm", above=0.0)
    """Largest torque, Nm (force, N); the URDF's where it is left out."""
    speed: float | None = number(None, "rad/s", above=0.0)
    """Largest speed, rad/s (m/s); the URDF's where it is left out."""


@dataclass(kw_only=True)
class RobotDescription(Parameters):
    """A humanoid with two legs, as its file describes it."""

    name: str = ""
    """What it is called in figures and messages; by default the file's name."""
    urdf: str = ""
    """Its URDF: a path from this file, or `package://NAME/PATH`, NAME being an
    installed Python package, a ROS package, or one of `packages`."""
    packages: dict[str, str] = field(default_factory=dict)
    """Folders of the packages that the URDF's `package://NAME/` means, by NAME, as
    paths from this file, where they are not found by themselves."""
    foot_bodies: FeetDescription = field(default_factory=FeetDescription)
    """The links whose origins are the ankles, the last that the legs' joints move; x to
    the toes and z up with all joints at zero."""

    base_body: str | None = None
    """The pelvis, which the legs hang from. By default the URDF's root, a root without
    mass aside."""
    torso_body: str | None = None
    """The trunk: pushes act on it, and its lean tells a fall. By default the heaviest
    link outside the legs."""
    head_body: str | None = None
    """The link that carries the laser scanner; a frame without mass will do. Without it
    the robot does not see: it can stand and cross rooms, whose camera is the room's."""
    lidar_position: list[float] = number([0.0, 0.0, 0.0], "m", length=3)
    """The scanner's centre in the head's frame, m: outside of what hides it."""
    leg_joints: LegsDescription | None = None
    """By default the joints that move between `base_body` and `foot_bodies`. Walking
    needs hip pitch, roll, yaw, knee, ankle roll, pitch, in this order."""
    knee_joints: FeetDescription | None = None
    """By default those of the leg's joints that are farthest from its two ends."""
    sole: SoleDescription | None = None
    """By default the rectangle around the lowest centimetre of the foot's geometry."""
    swing_joints: list[str] = field(default_factory=list)
    """Joints (names or patterns) that pitch the arms to the rear when they turn to
    positive; crossings swing them. None swings none."""
    welded_joints: list[str] = field(default_factory=list)
    """Joints (names or patterns) that are fixed where `posture` has them: fingers.
    Joints that mimic others are fixed too."""
    posture: dict[str, float] = field(default_factory=dict)
    """Angles of the standing posture, rad, by joint (a name or a pattern); all others
    are at zero. The knees have to be bent a little."""
    working_range: dict[str, list[float]] = field(default_factory=dict)
    """Least and greatest angle that is planned, rad, by joint, inside its limits. By
    default the knees keep 0.2 rad off the straight leg."""
    servos: list[ServoDescription] = field(default_factory=list)
    """Servos; the last group that names a joint counts. By default soft ankles and
    stiffer joints above, as JVRC-1's in proportion to weight times leg length."""
    limits: list[LimitsDescription] = field(default_factory=list)
    """Limits other than the URDF's; the last group that names a joint counts."""
    convex_pieces: dict[str, int] = field(default_factory=dict)
    """Into how many convex pieces a link's surface is cut to collide with, by link,
    where one convex hull would fill a hollow that another link moves in."""

    standing_com: list[float] | None = number(None, "m", length=2)
    """CoM ahead of the ankles and above the soles when ready to walk, m. By default
    over the middle of the sole, and as high as in `posture`."""
    hip_from_com: list[float] | None = number(None, "m", length=2)
    """How far the hips are ahead of the CoM and above it, m. By default as in
    `posture`."""
    leg_reach: float | None = number(None, "m", above=0.0)
    """Greatest distance from hip to ankle with the knee still bent, m. By default 97 %
    of the straight leg's."""
    stance_width: float | None = number(None, "m", above=0.0)
    """Between the soles' middles when standing, m. By default that of the ankles with
    all joints at zero."""
    footprint_radius: float | None = number(None, "m", above=0.0)
    """Farthest part of the standing robot from the middle between its ankles, in plan,
    m. By default measured on its geometry in `posture`."""
    body_radius: float | None = number(None, "m", above=0.0)
    """What the walking body takes around each sole, m. By default 0.56 of
    `footprint_radius`, as of JVRC-1: hips and shoulders without the arms' swing."""
    lowest_waist: float | None = number(None, "m", above=0.0)
    """Lowest pelvis in a crossing, m. By default the hips are at 0.73 of their height
    over straight legs."""
    crossing_stance: list[float] | None = number(None, "m", length=2)
    """A typical step length over an obstacle and the pelvis' height in it, m. By
    default in proportion to the leg."""

    def validate(self) -> None:
        """Checks every field, and that what must be given is.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        required = {
            "urdf": self.urdf,
            "foot_bodies.left": self.foot_bodies.left,
            "foot_bodies.right": self.foot_bodies.right,
        }
        missing = [name for name, value in required.items() if not value]
        if missing:
            raise ValueError(f"{', '.join(missing)}: must be given")
        for joint, bounds in self.working_range.items():
            if len(bounds) != 2 or not bounds[0] < bounds[1]:
                raise ValueError(
                    f"working_range.{joint}: must be the least and the greatest angle, "
                    f"got {bounds}"
                )
        for link, pieces in self.convex_pieces.items():
            if not 1 <= pieces <= 64:
                raise ValueError(
                    f"convex_pieces.{link}: must be between 1 and 64, got {pieces}"
                )


def read_description(file: Path) -> RobotDescription:
    """Reads a file that is known to be right.

    Raises:
        RuntimeError: it is not.
    """
    description: RobotDescription = yaml_load_typed(  # type: ignore[no-untyped-call]
        schema=RobotDescription, filename=str(file)
    )
    return description


def default_sole() -> Sole:
    """Gives the sole of the robot of whoever names none, without its URDF."""
    said = read_description(DEFAULT_FILE).sole
    assert said is not None
    return Sole(said.heel, said.toe, said.half_width, said.ankle_height)
