"""The tree of links and joints of a URDF, as far as the loader needs it.

Only the tree is read here: geometry is read by `link_geometry.py`, and inertias
by Drake's parser.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot_errors import RobotError
from footfall.models.values.vector import Vector

MOVING = ("revolute", "continuous", "prismatic")
"""Types of the joints that a motor can drive."""


@dataclass(frozen=True, eq=False)
class UrdfJoint:
    """One joint: what it connects, how it moves and how far, fast and hard."""

    name: str
    kind: str
    """The URDF's `type`: "revolute", "continuous", "prismatic", "fixed", ..."""
    parent: str
    child: str
    X_PC: RigidTransform
    """Pose of the child in the parent with the joint at zero."""
    axis: Vector
    """In the child's frame, (3,), unit."""
    lower: float
    upper: float
    """Range, rad or m; infinite where the URDF gives none."""
    effort: float | None
    """Nm or N; None where the URDF gives none that is positive and finite."""
    speed: float | None
    """rad/s or m/s; likewise."""
    mimics: str
    """The joint that it follows; empty where it follows none."""

    @property
    def moves(self) -> bool:
        """Whether a motor can drive it."""
        return self.kind in MOVING


@dataclass(frozen=True, eq=False)
class Urdf:
    """Links and joints by name; the joints form one tree."""

    path: Path
    masses: Mapping[str, float]
    """Mass of every link, kg; 0 where it has no inertia."""
    joints: Mapping[str, UrdfJoint]
    above: Mapping[str, UrdfJoint]
    """The joint that carries a link, by link; the root has none."""

    @property
    def root(self) -> str:
        """The link that no joint carries."""
        return next(name for name in self.masses if name not in self.above)

    def children(self, link: str) -> tuple[UrdfJoint, ...]:
        """Finds the joints that a link carries."""
        return tuple(item for item in self.joints.values() if item.parent == link)

    def below(self, link: str) -> tuple[str, ...]:
        """Finds a link and all that hangs from it."""
        found = [link]
        for name in found:
            found += [joint.child for joint in self.children(name)]
        return tuple(found)

    def chain(self, link: str) -> tuple[UrdfJoint, ...]:
        """Finds the joints between the root and a link, from the root."""
        joints: list[UrdfJoint] = []
        while link in self.above:
            joints.append(self.above[link])
            link = self.above[link].parent
        return tuple(reversed(joints))

    def between(self, base: str, link: str) -> tuple[UrdfJoint, ...]:
        """Finds the joints between a link and one below it, from the upper one.

        Empty where the second does not hang from the first.
        """
        joints = self.chain(link)
        starts = [i for i, joint in enumerate(joints) if joint.parent == base]
        return joints[starts[0] :] if starts else ()

    def pose(self, base: str, link: str) -> RigidTransform:
        """Pose of a link in one that carries it, all joints at zero."""
        X = RigidTransform()
        for joint in self.between(base, link):
            X = X.multiply(joint.X_PC)
        return X

    def mass_below(self, link: str) -> float:
        """Mass of a link and of all that hangs from it, kg."""
        return sum(self.masses[name] for name in self.below(link))


def read_urdf(path: Path) -> Urdf:
    """Reads the tree of a URDF.

    Raises:
        RobotError: the file cannot be read, is not XML, or holds no single tree.
    """
    root = parse_xml(path)
    masses = {link.get("name", ""): _mass(link) for link in root.findall("link")}
    joints, problems = {}, []
    for element in root.findall("joint"):
        joint = _joint(element)
        problems += [
            f"joint {joint.name}: there is no link {link!r}"
            for link in (joint.parent, joint.child)
            if link not in masses
        ]
        joints[joint.name] = joint
    above: dict[str, UrdfJoint] = {}
    for joint in joints.values():
        if joint.child in above:
            problems.append(
                f"link {joint.child}: is carried by two joints, "
                f"{above[joint.child].name} and {joint.name}"
            )
        above[joint.child] = joint
    roots = [name for name in masses if name not in above]
    if len(roots) != 1:
        problems.append(
            f"must be one tree, has {len(roots)} links that no joint carries"
            + (f": {', '.join(roots[:4])}" if roots else "")
        )
    if problems:
        raise RobotError(str(path), problems)
    return Urdf(path, masses, joints, above)


def parse_xml(path: Path) -> ET.Element:
    """Reads a file's XML.

    Raises:
        RobotError: it cannot be read or is not a URDF.
    """
    try:
        root = ET.fromstring(path.read_bytes())
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise RobotError(str(path), [f"cannot be read: {reason}"]) from None
    except ET.ParseError as error:
        raise RobotError(str(path), [f"not XML: {error}"]) from None
    if root.tag != "robot":
        raise RobotError(
            str(path), [f"not a URDF: its root is <{root.tag}>, not <robot>"]
        )
    return root


def numbers(text: str | None, default: str) -> Vector:
    """Reads the numbers of an attribute.

    Raises:
        ValueError: it holds something else.
    """
    return np.array((text or default).split(), dtype=np.float64)


def pose_of(element: ET.Element) -> RigidTransform:
    """Reads the `origin` of a joint, visual or collision; identity without one."""
    origin = element.find("origin")
    if origin is None:
        return RigidTransform()
    rpy = numbers(origin.get("rpy"), "0 0 0")
    return RigidTransform(RollPitchYaw(rpy), numbers(origin.get("xyz"), "0 0 0"))


def _mass(link: ET.Element) -> float:
    mass = link.find("inertial/mass")
    return 0.0 if mass is None else float(mass.get("value", "0"))


def _joint(element: ET.Element) -> UrdfJoint:
    limit, mimic, axis = (element.find(tag) for tag in ("limit", "mimic", "axis"))
    kind = element.get("type", "")
    ranged = None if kind == "continuous" else limit
    direction = numbers(None if axis is None else axis.get("xyz"), "1 0 0")
    length = float(np.linalg.norm(direction))
    return UrdfJoint(
        name=element.get("name", ""),
        kind=kind,
        parent=_link(element, "parent"),
        child=_link(element, "child"),
        X_PC=pose_of(element),
        axis=direction / length if length > 0.0 else direction,
        lower=-np.inf if ranged is None else float(ranged.get("lower", "0")),
        upper=np.inf if ranged is None else float(ranged.get("upper", "0")),
        effort=_limit(limit, "effort"),
        speed=_limit(limit, "velocity"),
        mimics="" if mimic is None else mimic.get("joint", ""),
    )


def _link(joint: ET.Element, end: str) -> str:
    element = joint.find(end)
    return "" if element is None else element.get("link", "")


def _limit(limit: ET.Element | None, key: str) -> float | None:
    """Reads one of a joint's limits, where it is one."""
    value = 0.0 if limit is None else float(limit.get(key, "0"))
    return value if 0.0 < value < np.inf else None


def without_mass(urdf: Urdf, named: frozenset[str]) -> frozenset[str]:
    """Gives the links that Drake is not to see: frames that nothing is done with.

    A massless root that only carries the robot, by a fixed or a floating joint, is one
    of them, and so are links of which, and below which, nothing has mass or is named.

    Args:
        urdf: the tree.
        named: links that are kept whatever they weigh.
    """
    dropped = {
        link
        for link in urdf.masses
        if urdf.mass_below(link) == 0.0 and not named.intersection(urdf.below(link))
    }
    root = urdf.root
    while urdf.masses[root] == 0.0 and root not in named:
        carried = [item for item in urdf.children(root) if item.child not in dropped]
        if len(carried) != 1 or carried[0].kind not in ("fixed", "floating"):
            break
        dropped.add(root)
        root = carried[0].child
    return frozenset(dropped)
