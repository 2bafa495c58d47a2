"""JVRC-1, the humanoid of the Japan Virtual Robotics Challenge (`jvrc-description`)."""

from pathlib import Path

import jvrc_description

from footfall.models.robots.robot import JointGains, RobotModel, Sole
from footfall.models.values.feet import Foot

_LEG = ("HIP_P", "HIP_R", "HIP_Y", "KNEE", "ANKLE_R", "ANKLE_P")
_ARM = (
    "SHOULDER_P",
    "SHOULDER_R",
    "SHOULDER_Y",
    "ELBOW_P",
    "ELBOW_Y",
    "WRIST_R",
    "WRIST_Y",
)
_FINGERS = ("UTHUMB", "LTHUMB", "UINDEX", "LINDEX", "ULITTLE", "LLITTLE")
_WAIST = ("WAIST_Y", "WAIST_P", "WAIST_R")
_NECK = ("NECK_Y", "NECK_R", "NECK_P")


def _sides(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{side}_{name}" for side in ("R", "L") for name in names)


# The description names no rotor inertia; these are what geared humanoid joints of
# this size typically reflect. Soft legs and softer ankles let the feed-forward wrench
# act: a stiff leg turns every millimetre of ground that is not where it was planned
# into hundreds of newtons.
_LEG_GAINS = JointGains(stiffness=1000.0, damping=100.0, reflected_inertia=0.1)
_ANKLE = JointGains(stiffness=150.0, damping=8.0, reflected_inertia=0.05)
_UPPER = JointGains(stiffness=1000.0, damping=40.0, reflected_inertia=0.05)
_GAINS = (
    {joint: _LEG_GAINS for joint in (*_sides(_LEG[:4]), *_WAIST)}
    | {joint: _ANKLE for joint in _sides(_LEG[4:])}
    | {joint: _UPPER for joint in (*_NECK, *_sides(_ARM))}
)

_POSTURE = {
    "R_HIP_P": -0.42,
    "L_HIP_P": -0.42,
    "R_KNEE": 0.82,
    "L_KNEE": 0.82,
    "R_ANKLE_P": -0.40,
    "L_ANKLE_P": -0.40,
    "R_SHOULDER_P": 0.25,
    "L_SHOULDER_P": 0.25,
    "R_SHOULDER_R": -0.20,
    "L_SHOULDER_R": 0.20,
    "R_ELBOW_P": -0.60,
    "L_ELBOW_P": -0.60,
}

_FEET: dict[Foot, str] = {"left": "L_ANKLE_P_S", "right": "R_ANKLE_P_S"}
_LEGS: dict[Foot, tuple[str, ...]] = {
    "left": tuple(f"L_{name}" for name in _LEG),
    "right": tuple(f"R_{name}" for name in _LEG),
}

JVRC1 = RobotModel(
    name="jvrc1",
    urdf=Path(jvrc_description.urdf_path),
    package_path=Path(jvrc_description.path),
    base_body="PELVIS_S",
    torso_body="WAIST_R_S",
    head_body="NECK_P_S",
    foot_bodies=_FEET,
    sole=Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077),
    welded_joints=_sides(_FINGERS),
    leg_joints=_LEGS,
    waist_joints=_WAIST,
    posture=_POSTURE,
    swing_joints=_sides(("SHOULDER_P",)),
    working_range={"R_KNEE": (0.2, 2.4), "L_KNEE": (0.2, 2.4)},
    gains=_GAINS,
    lidar_position=(0.15, 0.0, 0.12),
    standing_com=(0.035, 0.85),
    hip_from_com=(-0.03, -0.04),
    # A thigh that is folded by 90 degrees is 8 mm from the surface of the pelvis, but
    # 15 mm inside its hull; six pieces are within a millimetre of the surface there.
    convex_pieces={"PELVIS_S": 6},
    leg_reach=0.725,
)
