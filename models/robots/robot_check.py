"""Does a robot's file fit its URDF? Everything that does not, field by field."""

import difflib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from footfall.models.robots.link_geometry import link_shapes
from footfall.models.robots.robot_description import RobotDescription
from footfall.models.robots.robot_parts import (
    base_of,
    foot_links,
    kept_joints,
    knees_of,
    legs_of,
    limits_of,
    matching,
    moving_joints,
    named_links,
    posture_of,
    welded_of,
    working_range_of,
)
from footfall.models.robots.urdf import MOVING, Urdf, parse_xml, without_mass
from footfall.models.values.feet import FEET

TILT = 1e-3
"""How far the axes of a foot may be off those of the pelvis, rad: URDFs round theirs.
"""
SHOWN = 4
"""So many names of a kind are told; of the others only how many."""


def find_problems(
    description: RobotDescription, urdf: Urdf, packages: Mapping[str, Path]
) -> tuple[str, ...]:
    """Finds what keeps a robot from being simulated.

    Args:
        description: of the robot; its `validate` has passed.
        urdf: of the robot.
        packages: folders of packages by name.

    Returns:
        "field: reason" each. What presumes that something else is right, as the legs
        presume the feet, is told once that is.
    """
    links = [*_unknown_links(description, urdf)]
    joints = [*_unknown_joints(description, urdf)]
    found = [*links, *joints, *_kinds(description, urdf), *_files(urdf, packages)]
    if not links:
        found += _frames(description, urdf)
    if not (links or joints):
        found += _legs(description, urdf)
        found += _motors(description, urdf)
        found += _ranges(description, urdf)
    return tuple(dict.fromkeys(found))


def _unknown_links(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    feet = description.foot_bodies
    named = {
        "foot_bodies.left": feet.left,
        "foot_bodies.right": feet.right,
        "base_body": description.base_body,
        "torso_body": description.torso_body,
        "head_body": description.head_body,
    } | {f"convex_pieces.{link}": link for link in description.convex_pieces}
    for field, link in named.items():
        if link is None:
            continue
        if link not in urdf.masses:
            yield f"{field}: there is no link {link!r}{_hint(link, [*urdf.masses])}"
        elif field.startswith(("base", "torso", "foot")) and not urdf.masses[link]:
            near = [
                *(joint.child for joint in urdf.children(link)),
                *(joint.parent for joint in urdf.chain(link)[-1:]),
            ]
            heavy = [name for name in near if urdf.masses[name]]
            hint = f"; is it {heavy[0]}?" if heavy else ""
            yield f"{field}: the link {link!r} is a frame without mass{hint}"
    if feet.left == feet.right:
        yield f"foot_bodies: must be two links, got {feet.left!r} twice"


def _unknown_joints(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    known = [joint.name for joint in kept_joints(description, urdf) if joint.moves]
    named: list[tuple[str, Sequence[str]]] = [
        ("swing_joints", description.swing_joints),
        ("welded_joints", description.welded_joints),
        ("posture", [*description.posture]),
        ("working_range", [*description.working_range]),
    ]
    groups = [
        *((f"servos[{i}]", item.joints) for i, item in enumerate(description.servos)),
        *((f"limits[{i}]", item.joints) for i, item in enumerate(description.limits)),
    ]
    for group, names in groups:
        named.append((f"{group}.joints", names))
        if not names:
            yield f"{group}.joints: names no joint"
    for kind, item in (
        ("leg_joints", description.leg_joints),
        ("knee_joints", description.knee_joints),
    ):
        if item is not None:
            for foot in FEET:
                part = getattr(item, foot)
                several = [part] if isinstance(part, str) else part
                named.append((f"{kind}.{foot}", several))
    for field, patterns in named:
        for pattern in patterns:
            if not matching([pattern], known):
                fixed = urdf.joints.get(pattern)
                reason = (
                    f"the joint {pattern!r} is {fixed.kind} and does not move"
                    if fixed is not None and not fixed.moves
                    else f"there is no joint {pattern!r} that moves"
                    + _hint(pattern, known)
                )
                yield f"{field}: {reason}"


def _kinds(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    for joint in kept_joints(description, urdf):
        if joint.kind not in (*MOVING, "fixed"):
            yield (
                f"urdf: the joint {joint.name} is of type {joint.kind!r}: must be "
                f"{', '.join(MOVING)} or fixed"
            )
        elif joint.moves and not joint.axis.any():
            yield f"urdf: the joint {joint.name} turns about no axis"


def _files(urdf: Urdf, packages: Mapping[str, Path]) -> Iterator[str]:
    """Shapes that cannot be read, the same reason once."""
    reasons: dict[str, list[str]] = {}
    root = parse_xml(urdf.path)
    for link in root.findall("link"):
        for use in ("visual", "collision"):
            try:
                link_shapes(link, use, urdf.path, packages, {})
            except ValueError as error:
                where, _, reason = str(error).partition(f": {use}: ")
                reasons.setdefault(reason, []).append(f"{where}: {use}")
    for reason, places in reasons.items():
        yield f"urdf: {_several(places)}: {reason}"


def _frames(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    base = base_of(description, urdf)
    dropped = without_mass(urdf, named_links(description))
    tops = [name for name in urdf.masses if name not in dropped]
    carried = {joint.child for joint in kept_joints(description, urdf)}
    root = next(name for name in tops if name not in carried)
    if base != root:
        yield (
            f"base_body: must be the root of the tree, {root}, which floats; "
            f"got {base!r}, which {urdf.above[base].name} carries"
        )
    for foot, link in foot_links(description).items():
        if not urdf.between(base, link):
            yield f"foot_bodies.{foot}: {link!r} does not hang from {base!r}"
            continue
        R = urdf.pose(base, link).rotation()
        if R.ToAngleAxis().angle() > TILT:
            x, z = (np.round(R.matrix()[:, i], 2).tolist() for i in (0, 2))
            yield (
                f"foot_bodies.{foot}: the axes of {link!r} must be those of {base!r} "
                f"(x to the toes, z up) with all joints at zero; its x is {x}, its z "
                f"{z} there"
            )


def _legs(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    base, welded = base_of(description, urdf), set(welded_of(description, urdf))
    legs = legs_of(description, urdf)
    for foot, link in foot_links(description).items():
        chain = [item.name for item in urdf.between(base, link) if item.moves]
        if not chain:
            if urdf.between(base, link):
                yield f"foot_bodies.{foot}: no joint moves between {base} and {link}"
            continue
        if [*legs[foot]] != chain:
            yield (
                f"leg_joints.{foot}: must be what moves from {base} to {link}, "
                f"{', '.join(chain)}, got {', '.join(legs[foot]) or 'none'}"
            )
        for name in chain:
            if name in welded:
                reason = (
                    f"follows {urdf.joints[name].mimics}"
                    if urdf.joints[name].mimics
                    else "is welded"
                )
                yield f"leg_joints.{foot}: {name} {reason}: a leg's joints need motors"
        if urdf.between(base, link)[-1].kind == "fixed":
            carrier = urdf.joints[chain[-1]].child
            yield (
                f"foot_bodies.{foot}: {link!r} is fixed to {carrier!r}: must be the "
                "link that the last joint moves, its origin the ankle"
            )
    if len(legs["left"]) != len(legs["right"]):
        yield (
            f"leg_joints: both legs must have as many joints, got "
            f"{len(legs['left'])} and {len(legs['right'])}"
        )
    if all(legs.values()):
        for foot, knee in knees_of(description, urdf).items():
            if knee not in legs[foot]:
                yield f"knee_joints.{foot}: {knee!r} is none of the leg's joints"


def _motors(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    """Limits that neither the file nor the URDF gives."""
    missing: dict[str, list[str]] = {"effort": [], "speed": []}
    for joint in moving_joints(description, urdf):
        effort, speed = limits_of(description, joint)
        if effort is None:
            missing["effort"].append(joint.name)
        if speed is None:
            missing["speed"].append(joint.name)
    for kind, names in missing.items():
        if names:
            yield (
                f"limits: the URDF gives no {kind} limit above 0 of {_several(names)}: "
                f"say it here, or weld what is not driven"
            )


def _ranges(description: RobotDescription, urdf: Urdf) -> Iterator[str]:
    """Postures and working ranges outside the joints' own limits, and within each."""
    posture = posture_of(description, urdf)
    ranges = working_range_of(description, urdf)
    welded = set(welded_of(description, urdf))
    for joint in kept_joints(description, urdf):
        if not joint.moves:
            continue
        angle = posture.get(joint.name, 0.0)
        if not joint.lower <= angle <= joint.upper and not (
            joint.name in welded and joint.name not in posture
        ):
            said = "" if joint.name in posture else " (not named, so 0)"
            yield (
                f"posture.{joint.name}: must lie between {joint.lower:g} and "
                f"{joint.upper:g}, got {angle:g}{said}"
            )
        least, most = ranges.get(joint.name, (joint.lower, joint.upper))
        if not joint.lower <= least <= most <= joint.upper:
            yield (
                f"working_range.{joint.name}: must lie within {joint.lower:g} and "
                f"{joint.upper:g}, got [{least:g}, {most:g}]"
            )


def _hint(name: str, known: Sequence[str]) -> str:
    close = difflib.get_close_matches(name, known, n=1)
    return f"; did you mean {close[0]}?" if close else ""


def _several(names: Sequence[str]) -> str:
    """Writes the first few names, and how many more."""
    more = len(names) - SHOWN
    shown = ", ".join(names[:SHOWN])
    return f"{shown} and {more} more" if more > 0 else shown
