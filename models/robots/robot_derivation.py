"""From what a robot's file says to all that is to be known of it.

What a `RobotDescription` leaves out is read off its URDF: names and lengths off the
tree of links, the sole off the foot's geometry, where the CoM is off the masses in the
posture.
"""

import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

from footfall.models.robots.contact_geometry import SOLE_THICKNESS
from footfall.models.robots.package_paths import find_file
from footfall.models.robots.robot import JointGains, JointLimits, RobotModel, Sole
from footfall.models.robots.robot_check import find_problems
from footfall.models.robots.robot_description import (
    FeetDescription,
    LegsDescription,
    LimitsDescription,
    RobotDescription,
    ServoDescription,
    SoleDescription,
)
from footfall.models.robots.robot_errors import RobotError
from footfall.models.robots.robot_loader import bare_urdf, solid_points
from footfall.models.robots.robot_parts import (
    base_of,
    foot_links,
    knees_of,
    legs_of,
    limits_of,
    matching,
    moving_joints,
    posture_of,
    torso_of,
    welded_of,
    working_range_of,
)
from footfall.models.robots.urdf import Urdf, UrdfJoint, read_urdf
from footfall.models.values.feet import FEET, Foot

GRAVITY = 9.81
"""m/s^2."""
REFERENCE_MOMENT = 457.0
"""Weight times leg length, Nm, of the robot that the default servos are made for
(JVRC-1); those of others are in proportion."""
LEG_SERVO, ANKLE_SERVO, UPPER_SERVO = (
    JointGains(stiffness=1000.0, damping=100.0, reflected_inertia=0.1),
    JointGains(stiffness=150.0, damping=8.0, reflected_inertia=0.05),
    JointGains(stiffness=1000.0, damping=40.0, reflected_inertia=0.05),
)
"""Soft legs and softer ankles let the feed-forward wrench act: a stiff leg turns every
millimetre of ground that is not where it was planned into hundreds of newtons. The
inertia is what geared humanoid joints of this size typically reflect."""
STRAIGHTEST_KNEE = 0.2
"""How far the knees keep off the straight leg, rad."""
REACH_SHARE = 0.97
"""`leg_reach` over the length of the straight leg."""
BODY_SHARE = 0.56
"""`body_radius` over `footprint_radius`."""
LOWEST_WAIST_SHARE = 0.73
"""The hips' lowest height over that on straight legs."""
CROSSING_STEP_SHARE, CROSSING_WAIST_SHARE = 0.56, 0.89
"""The typical step over the leg's length, and the hips' height in it over that on
straight legs."""


def robot_model(description: RobotDescription, file: Path) -> RobotModel:
    """Makes the complete robot of a description.

    Args:
        description: what is said of it; its `validate` has passed.
        file: that says so; paths start in its folder, and messages begin with it.

    Raises:
        RobotError: it does not fit its URDF; the message says everything that does not.
    """
    packages = {name: file.parent / path for name, path in description.packages.items()}
    try:
        urdf_file = find_file(description.urdf, file, packages)
    except ValueError as error:
        raise RobotError(str(file), [f"urdf: {error}"]) from None
    urdf = read_urdf(urdf_file)
    problems = find_problems(description, urdf, packages)
    if problems:
        raise RobotError(str(file), problems)
    robot = _skeleton(description, urdf, file.stem, packages)
    try:
        robot = _with_sole(description, robot)
    except ValueError as error:
        raise RobotError(str(file), [str(error)]) from None
    return _with_posture(description, urdf, robot)


def spelt_out(robot: RobotModel) -> RobotDescription:
    """Spells the description out, with nothing left to derive; `robot_model` reads it.

    Args:
        robot: complete.
    """
    feet, legs, knees = robot.foot_bodies, robot.leg_joints, robot.knee_joints
    sole = robot.sole
    servos: dict[JointGains, list[str]] = {}
    limits: dict[JointLimits, list[str]] = {}
    for name, gains in robot.gains.items():
        servos.setdefault(gains, []).append(name)
    for name, limit in robot.limits.items():
        limits.setdefault(limit, []).append(name)
    return RobotDescription(
        name=robot.name,
        urdf=str(robot.urdf),
        packages={name: str(folder) for name, folder in robot.packages.items()},
        foot_bodies=FeetDescription(left=feet["left"], right=feet["right"]),
        base_body=robot.base_body,
        torso_body=robot.torso_body,
        head_body=robot.head_body,
        lidar_position=[*robot.lidar_position],
        leg_joints=LegsDescription(left=[*legs["left"]], right=[*legs["right"]]),
        knee_joints=FeetDescription(left=knees["left"], right=knees["right"]),
        sole=SoleDescription(
            heel=sole.heel,
            toe=sole.toe,
            half_width=sole.half_width,
            ankle_height=sole.ankle_height,
        ),
        swing_joints=[*robot.swing_joints],
        welded_joints=[*robot.welded_joints],
        posture={**robot.posture, **robot.welded_at},
        working_range={name: [*ends] for name, ends in robot.working_range.items()},
        servos=[
            ServoDescription(
                joints=names,
                stiffness=gains.stiffness,
                damping=gains.damping,
                reflected_inertia=gains.reflected_inertia,
            )
            for gains, names in servos.items()
        ],
        limits=[
            LimitsDescription(joints=names, effort=limit.effort, speed=limit.speed)
            for limit, names in limits.items()
        ],
        convex_pieces=dict(robot.convex_pieces),
        standing_com=[*robot.standing_com],
        hip_from_com=[*robot.hip_from_com],
        leg_reach=robot.leg_reach,
        stance_width=robot.stance_width,
        footprint_radius=robot.footprint_radius,
        body_radius=robot.body_radius,
        lowest_waist=robot.lowest_waist,
        crossing_stance=[*robot.crossing_stance],
    )


def _skeleton(
    description: RobotDescription, urdf: Urdf, name: str, packages: dict[str, Path]
) -> RobotModel:
    """Reads what the tree of links says; what needs more is zero."""
    base, legs = base_of(description, urdf), legs_of(description, urdf)
    knees, joints = knees_of(description, urdf), moving_joints(description, urdf)
    posture, welded = posture_of(description, urdf), welded_of(description, urdf)
    lidar = description.lidar_position
    length = leg_length(urdf, base, legs["left"], knees["left"])
    moment = sum(urdf.masses.values()) * GRAVITY * length
    names = [joint.name for joint in joints]
    ankles = [urdf.pose(base, link).translation() for link in _feet(description)]
    apart = float(ankles[0][1] - ankles[1][1])
    return RobotModel(
        name=description.name or name,
        urdf=urdf.path,
        packages=packages,
        base_body=base,
        torso_body=torso_of(description, urdf),
        head_body=description.head_body,
        foot_bodies=foot_links(description),
        sole=Sole(0.0, 0.0, 0.0, 0.0),
        welded_joints=welded,
        welded_at={name: posture[name] for name in welded if name in posture},
        leg_joints=legs,
        knee_joints=knees,
        posture={name: posture[name] for name in posture if name not in welded},
        swing_joints=matching(description.swing_joints, names),
        working_range=_working_range(description, urdf, knees),
        gains={
            item.name: _gains(description, urdf, item, legs, moment) for item in joints
        },
        limits={item.name: _limits(description, item) for item in joints},
        lidar_position=(lidar[0], lidar[1], lidar[2]),
        standing_com=(0.0, 0.0),
        hip_from_com=(0.0, 0.0),
        convex_pieces=dict(description.convex_pieces),
        leg_reach=description.leg_reach or round(REACH_SHARE * length, 3),
        stance_width=description.stance_width or round(apart, 3),
        footprint_radius=0.0,
        body_radius=0.0,
        lowest_waist=0.0,
        crossing_stance=(0.0, 0.0),
    )


def leg_length(urdf: Urdf, base: str, leg: tuple[str, ...], knee: str) -> float:
    """Hip to knee to ankle in a line, m.

    Args:
        urdf: of the robot.
        base: the pelvis.
        leg: the leg's joints.
        knee: the one that bends it.
    """
    hip, middle, ankle = (
        np.array(urdf.pose(base, urdf.joints[name].child).translation())
        for name in (leg[0], knee, leg[-1])
    )
    # A hip's joints may lie apart; what bends is in the plane of x and z.
    sagittal = [0, 2]
    return float(
        np.linalg.norm((middle - hip)[sagittal])
        + np.linalg.norm((ankle - middle)[sagittal])
    )


def _feet(description: RobotDescription) -> tuple[str, str]:
    feet = foot_links(description)
    return feet["left"], feet["right"]


def _limits(description: RobotDescription, joint: UrdfJoint) -> JointLimits:
    effort, speed = limits_of(description, joint)
    if effort is None or speed is None:
        raise ValueError(f"limits: {joint.name} has none")
    return JointLimits(effort, speed)


def _gains(
    description: RobotDescription,
    urdf: Urdf,
    joint: UrdfJoint,
    legs: dict[Foot, tuple[str, ...]],
    moment: float,
) -> JointGains:
    """Chooses a joint's servo: the description's, or its share of the defaults."""
    for group in reversed(description.servos):
        if matching(group.joints, [joint.name]):
            return JointGains(group.stiffness, group.damping, group.reflected_inertia)
    default, knees = UPPER_SERVO, knees_of(description, urdf)
    for foot, names in legs.items():
        if joint.name in names:
            below = names.index(joint.name) > names.index(knees[foot])
            default = ANKLE_SERVO if below else LEG_SERVO
    share = moment / REFERENCE_MOMENT
    return JointGains(
        round(share * default.stiffness, 1),
        round(share * default.damping, 2),
        round(share * default.reflected_inertia, 4),
    )


def _working_range(
    description: RobotDescription, urdf: Urdf, knees: dict[Foot, str]
) -> dict[str, tuple[float, float]]:
    ranges = working_range_of(description, urdf)
    for knee in knees.values():
        joint = urdf.joints[knee]
        if knee in ranges or not np.isfinite([joint.lower, joint.upper]).all():
            continue
        # It folds to the side of the posture, or the one that it turns farther to.
        bent = posture_of(description, urdf).get(knee, 0.0)
        folds_up = bent > 0.0 or (bent == 0.0 and joint.upper > -joint.lower)
        least = max(joint.lower, STRAIGHTEST_KNEE) if folds_up else joint.lower
        most = joint.upper if folds_up else min(joint.upper, -STRAIGHTEST_KNEE)
        ranges[knee] = (least, most)
    return ranges


def _with_sole(description: RobotDescription, robot: RobotModel) -> RobotModel:
    """With the sole that is said, or the one that the feet's geometry has."""
    said = description.sole
    if said is not None:
        sole = Sole(said.heel, said.toe, said.half_width, said.ankle_height)
        return replace(robot, sole=sole)
    soles, solids = [], solid_points(robot)
    for link in robot.foot_bodies.values():
        points = solids.get(link)
        if points is None:
            raise ValueError(f"sole: must be given, as {link!r} has no geometry")
        bottom = points[points[:, 2] < points[:, 2].min() + SOLE_THICKNESS]
        (back, right, _), (front, left, _) = bottom.min(axis=0), bottom.max(axis=0)
        soles.append([-back, front, min(left, -right), -bottom[:, 2].min()])
    least = np.round(np.min(soles, axis=0), 4)
    heel, toe, half_width, height = (float(number) for number in least)
    if min(heel, toe, half_width, height) <= 0.0:
        raise ValueError(
            "sole: must be given, as the origin of "
            f"{robot.foot_bodies['left']!r} is not above its underside"
        )
    return replace(robot, sole=Sole(heel, toe, half_width, height))


class Stance(NamedTuple):
    """Where things are when the robot stands in its posture."""

    com: tuple[float, float]
    """CoM ahead of the ankles and above the soles, m."""
    hip: tuple[float, float]
    """Hips ahead of the CoM and above it, m."""
    radius: float
    """Farthest part from the middle between the ankles, in plan, m."""
    tilt: float
    """Largest angle between a sole and the horizontal, rad."""


def stance_of(robot: RobotModel) -> Stance:
    """Measures the robot in its posture, the pelvis upright.

    Args:
        robot: with its sole.
    """
    root = bare_urdf(robot)
    for link in root.findall("link"):
        for use in ("visual", "collision"):
            for shape in link.findall(use):
                link.remove(shape)
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModelsFromString(ET.tostring(root, encoding="unicode"), "urdf")
    plant.Finalize()
    context = plant.CreateDefaultContext()
    q = plant.GetPositions(context)
    for name, angle in robot.posture.items():
        q[plant.GetJointByName(name).position_start()] = angle
    plant.SetPositions(context, q)
    feet = [
        plant.GetBodyByName(robot.foot_bodies[foot]).EvalPoseInWorld(context)
        for foot in FEET
    ]
    middle = np.mean([X.translation() for X in feet], axis=0)
    ground = middle[2] - robot.sole.ankle_height
    p_WCom = plant.CalcCenterOfMassPositionInWorld(context)
    hip = plant.GetJointByName(robot.leg_joints["left"][0]).child_body()
    p_CH = np.array(hip.EvalPoseInWorld(context).translation()) - np.array(p_WCom)
    radius = 0.0
    for body, points in solid_points(robot).items():
        X_WL = plant.GetBodyByName(body).EvalPoseInWorld(context)
        away = (X_WL.multiply(points.T).T - middle)[:, :2]
        radius = max(radius, float(np.linalg.norm(away, axis=1).max()))
    return Stance(
        (float(p_WCom[0] - middle[0]), float(p_WCom[2] - ground)),
        (float(p_CH[0]), float(p_CH[2])),
        radius,
        max(
            float(np.arccos(np.clip(X.rotation().matrix()[2, 2], -1, 1))) for X in feet
        ),
    )


def _with_posture(
    description: RobotDescription, urdf: Urdf, robot: RobotModel
) -> RobotModel:
    """With what depends on where the masses are in the standing posture."""
    said, sole = description, robot.sole
    com, hip, radius = said.standing_com, said.hip_from_com, said.footprint_radius
    if com is None or hip is None or radius is None:
        stance = stance_of(robot)
        middle = round((sole.toe - sole.heel) / 2.0, 3)
        com = com or [middle, round(stance.com[1], 3)]
        hip = hip or [round(x, 3) for x in stance.hip]
        radius = radius or round(stance.radius, 2)
    base, leg, knee = robot.base_body, robot.leg_joints, robot.knee_joints
    length = leg_length(urdf, base, leg["left"], knee["left"])
    p_BHip = urdf.pose(base, urdf.joints[leg["left"][0]].child).translation()
    above_hip, straight = -float(p_BHip[2]), length + sole.ankle_height
    crossing = said.crossing_stance or [
        round(CROSSING_STEP_SHARE * length, 2),
        round(above_hip + CROSSING_WAIST_SHARE * straight, 2),
    ]
    lowest = said.lowest_waist or round(above_hip + LOWEST_WAIST_SHARE * straight, 2)
    return replace(
        robot,
        standing_com=(com[0], com[1]),
        hip_from_com=(hip[0], hip[1]),
        footprint_radius=radius,
        body_radius=said.body_radius or round(BODY_SHARE * radius, 2),
        lowest_waist=lowest,
        crossing_stance=(crossing[0], crossing[1]),
    )
