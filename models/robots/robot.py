"""What the systems need to know of a humanoid: names, soles, postures and gains.

A `RobotModel` is complete. Users write a `RobotDescription` (`robot_description.py`), a
YAML file in which most fields may be left out; `robot_derivation.py` makes the one of
the other. How the URDF becomes something that Drake can simulate is `robot_loader.py`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from footfall.models.values.feet import Foot


@dataclass(frozen=True)
class Sole:
    """The flat rectangle a foot stands on, in the sole frame F."""

    heel: float
    """Distance from F's origin back to the heel edge, m, positive."""
    toe: float
    """Distance from F's origin forward to the toe edge, m."""
    half_width: float
    """Half the width, m; the sole is symmetric about F's x."""
    ankle_height: float
    """Height of the ankle above the sole, m."""

    @property
    def length(self) -> float:
        """Heel edge to toe edge, m."""
        return self.heel + self.toe

    @property
    def area(self) -> float:
        """m^2."""
        return 2.0 * self.half_width * self.length


@dataclass(frozen=True)
class JointGains:
    """Servo of one joint: reference q*, v* and feed-forward torque in, torque out."""

    stiffness: float
    """Proportional gain, Nm/rad."""
    damping: float
    """Derivative gain, Nm s/rad."""
    reflected_inertia: float
    """Rotor inertia seen at the joint (times gear ratio squared), kg m^2."""


@dataclass(frozen=True)
class JointLimits:
    """How hard and how fast a joint's motor moves it."""

    effort: float
    """Nm, of a prismatic joint N."""
    speed: float
    """rad/s, of a prismatic joint m/s."""


@dataclass(frozen=True)
class RobotModel:
    """One humanoid: where its description lies and what its parts are called."""

    name: str
    urdf: Path
    """The published description, used as it is but for what the loader prepares."""
    packages: Mapping[str, Path]
    """Folders that `package://NAME/` in the description stands for, by NAME, where they
    are not found by themselves; see `package_paths.py`."""
    base_body: str
    """The floating base (pelvis)."""
    torso_body: str
    head_body: str | None
    """The body that carries the laser scanner; None where the robot has none."""
    foot_bodies: Mapping[Foot, str]
    """The body whose origin is the ankle and that carries the sole; x to the toes and z
    up when the robot stands."""
    sole: Sole
    welded_joints: tuple[str, ...]
    """Joints that are fixed (fingers)."""
    welded_at: Mapping[str, float]
    """Where, rad; those that are not named at zero."""
    leg_joints: Mapping[Foot, tuple[str, ...]]
    """Hip to ankle."""
    knee_joints: Mapping[Foot, str]
    """Of the `leg_joints` those that bend the knees."""
    posture: Mapping[str, float]
    """Standing posture with bent knees, rad; joints that are not named are at zero."""
    swing_joints: tuple[str, ...]
    """The joints that pitch the arms; positive to the rear. Empty for none."""
    working_range: Mapping[str, tuple[float, float]]
    """Positions that are planned within, rad, where the joint's limits allow more: a
    knee that never straightens stays away from the leg's singularity."""
    gains: Mapping[str, JointGains]
    """Servo of each joint by name."""
    limits: Mapping[str, JointLimits]
    """Of each joint by name."""
    lidar_position: tuple[float, float, float]
    """Where the scanner's centre sits in the head body's frame, m."""
    standing_com: tuple[float, float]
    """CoM ahead of the ankles and above the soles when standing ready to walk, m."""
    hip_from_com: tuple[float, float]
    """About how far the hips are ahead of the CoM and above it when leaning, m."""
    convex_pieces: Mapping[str, int]
    """Into how many convex pieces the surface of a body is cut to collide with, where
    it is too hollow for its one convex hull."""
    leg_reach: float
    """Greatest distance from hip to ankle with the knee still bent, m."""
    stance_width: float
    """Between the two sole frames when standing side by side, m."""
    footprint_radius: float
    """Farthest part of the standing robot from the point midway between its ankles, in
    the horizontal plane, m."""
    body_radius: float
    """What the walking body takes around each sole, m."""
    lowest_waist: float
    """Height of the pelvis below which the knees ask for more torque than there is,
    m."""
    crossing_stance: tuple[float, float]
    """Step length over an obstacle and height of the pelvis at which the offset of CoM
    and pelvis is taken, m."""
