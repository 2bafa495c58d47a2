"""Which links and joints of a URDF are the parts that a robot's file describes."""

from collections.abc import Iterable
from fnmatch import fnmatchcase

import numpy as np

from footfall.models.robots.robot_description import RobotDescription
from footfall.models.robots.urdf import Urdf, UrdfJoint, without_mass
from footfall.models.values.feet import Foot


def matching(patterns: Iterable[str], names: Iterable[str]) -> tuple[str, ...]:
    """Finds the names that one of the patterns fits, in the order of the patterns."""
    known = tuple(names)
    found = [
        name for pattern in patterns for name in known if fnmatchcase(name, pattern)
    ]
    return tuple(dict.fromkeys(found))


def named_links(description: RobotDescription) -> frozenset[str]:
    """Finds the links that a description names."""
    feet = description.foot_bodies
    names = (
        description.base_body,
        description.torso_body,
        description.head_body,
        feet.left,
        feet.right,
    )
    return frozenset(name for name in names if name)


def kept_joints(description: RobotDescription, urdf: Urdf) -> tuple[UrdfJoint, ...]:
    """Finds the joints between links that Drake is to see, in the URDF's order."""
    dropped = without_mass(urdf, named_links(description))
    return tuple(
        joint
        for joint in urdf.joints.values()
        if not {joint.parent, joint.child} & dropped
    )


def base_of(description: RobotDescription, urdf: Urdf) -> str:
    """Finds the pelvis: the one that is named, or the root of what has mass."""
    if description.base_body is not None:
        return description.base_body
    carried = {joint.child for joint in kept_joints(description, urdf)}
    dropped = without_mass(urdf, named_links(description))
    return next(
        link for link in urdf.masses if link not in carried and link not in dropped
    )


def foot_links(description: RobotDescription) -> dict[Foot, str]:
    """Finds the link of either foot."""
    feet = description.foot_bodies
    return {"left": feet.left, "right": feet.right}


def legs_of(description: RobotDescription, urdf: Urdf) -> dict[Foot, tuple[str, ...]]:
    """Finds the joints of both legs: those named, or all from pelvis to foot."""
    if description.leg_joints is not None:
        legs = description.leg_joints
        return {"left": tuple(legs.left), "right": tuple(legs.right)}
    base = base_of(description, urdf)
    return {
        foot: tuple(joint.name for joint in urdf.between(base, link) if joint.moves)
        for foot, link in foot_links(description).items()
    }


def knees_of(description: RobotDescription, urdf: Urdf) -> dict[Foot, str]:
    """Finds the joints of the knees: those named, or the farthest from both ends."""
    if description.knee_joints is not None:
        knees = description.knee_joints
        return {"left": knees.left, "right": knees.right}
    base = base_of(description, urdf)
    found: dict[Foot, str] = {}
    for foot, names in legs_of(description, urdf).items():
        points = np.array(
            [urdf.pose(base, urdf.joints[name].child).translation() for name in names]
        )
        to_ends = np.minimum(
            np.linalg.norm(points - points[0], axis=1),
            np.linalg.norm(points - points[-1], axis=1),
        )
        found[foot] = names[int(np.argmax(to_ends))]
    return found


def torso_of(description: RobotDescription, urdf: Urdf) -> str:
    """Finds the trunk: the one that is named, or the heaviest link outside the legs."""
    if description.torso_body is not None:
        return description.torso_body
    legs = {
        link
        for names in legs_of(description, urdf).values()
        for link in urdf.below(urdf.joints[names[0]].child)
    }
    return max(
        (link for link in urdf.masses if link not in legs),
        key=lambda link: urdf.masses[link],
    )


def welded_of(description: RobotDescription, urdf: Urdf) -> tuple[str, ...]:
    """Finds the fixed joints: those named, what mimics, and what carries no mass."""
    joints = kept_joints(description, urdf)
    named = matching(description.welded_joints, (joint.name for joint in joints))
    besides = (
        joint.name
        for joint in joints
        if joint.moves and (joint.mimics or urdf.mass_below(joint.child) == 0.0)
    )
    return tuple(dict.fromkeys((*named, *besides)))


def moving_joints(description: RobotDescription, urdf: Urdf) -> tuple[UrdfJoint, ...]:
    """Finds the joints that get a motor, in the URDF's order."""
    welded = set(welded_of(description, urdf))
    return tuple(
        joint
        for joint in kept_joints(description, urdf)
        if joint.moves and joint.name not in welded
    )


def posture_of(description: RobotDescription, urdf: Urdf) -> dict[str, float]:
    """Gives the angle of every joint of the posture, rad; the last pattern counts."""
    names = [joint.name for joint in kept_joints(description, urdf) if joint.moves]
    return {
        name: angle
        for pattern, angle in description.posture.items()
        for name in matching([pattern], names)
    }


def working_range_of(
    description: RobotDescription, urdf: Urdf
) -> dict[str, tuple[float, float]]:
    """Gives the range of every joint that the description gives one, rad."""
    names = [joint.name for joint in moving_joints(description, urdf)]
    return {
        name: (least, most)
        for pattern, (least, most) in description.working_range.items()
        for name in matching([pattern], names)
    }


def limits_of(
    description: RobotDescription, joint: UrdfJoint
) -> tuple[float | None, float | None]:
    """Effort and speed limit of a joint; None where neither file nor URDF has one."""
    effort, speed = joint.effort, joint.speed
    for group in description.limits:
        if matching(group.joints, [joint.name]):
            effort = effort if group.effort is None else group.effort
            speed = speed if group.speed is None else group.speed
    return effort, speed
