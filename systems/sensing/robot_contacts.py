"""The robot's contacts of one plant step: which part met what, with what force."""

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from pydrake.geometry import GeometryId, Role, SceneGraphInspector
from pydrake.multibody.plant import ContactResults, MultibodyPlant
from pydrake.multibody.tree import BodyIndex, ModelInstanceIndex

from footfall.models.values.vector import Vector


class Part(NamedTuple):
    """Whose collision geometry it is."""

    body: int
    """Index into `WatchedGeometry.bodies`."""
    sole: bool


class Pair(NamedTuple):
    """What it is when two geometries meet: see `RobotContact`."""

    body: int
    sole: bool
    other: int
    allowed: bool
    sign: float
    """Of the force on the first of the pair."""


@dataclass(frozen=True)
class WatchedGeometry:
    """The collision geometries of a robot and of all that is around it."""

    bodies: tuple[str, ...]
    """The robot's bodies that have any."""
    feet: tuple[int, ...]
    """Which of them are the feet, left first."""
    solids: tuple[str, ...]
    """The scene's solids."""
    ground: frozenset[int]
    """Which of them soles may touch."""
    part_of: Mapping[GeometryId, Part]
    solid_of: Mapping[GeometryId, int]
    """Index into `solids`."""
    pairs: dict[tuple[int, int], Pair | None] = field(default_factory=dict)
    """Those that have met so far, by the ids' values."""

    @property
    def others(self) -> tuple[str, ...]:
        """What a body may meet: the solids, then the robot's own bodies."""
        return self.solids + self.bodies


class RobotContact(NamedTuple):
    """One contact of one of the robot's bodies."""

    body: int
    """Index into `WatchedGeometry.bodies`."""
    sole: bool
    """Whether the body's sole is in contact, and not the rest of it."""
    other: int
    """Index into `WatchedGeometry.others`."""
    allowed: bool
    """Whether it is a sole on what soles may stand on."""
    force: Vector
    """On the body, in W, (3,), N."""


def watched_geometry(
    plant: MultibodyPlant,
    inspector: SceneGraphInspector,
    robot: ModelInstanceIndex,
    feet: tuple[str, ...],
    is_sole: Callable[[str], bool],
    ground: Container[str],
) -> WatchedGeometry:
    """Finds the robot's collision geometries and those of everything else.

    Args:
        plant: the finalised plant.
        inspector: of the scene graph that the plant is registered with.
        robot: the robot's model instance.
        feet: names of the bodies that carry the soles, left first.
        is_sole: tells a sole's geometry by its name.
        ground: names (without scope) of the solids that soles may touch.

    Raises:
        ValueError: a foot has no collision geometry.
    """
    bodies: list[str] = []
    part_of: dict[GeometryId, Part] = {}
    for index in plant.GetBodyIndices(robot):
        body = plant.get_body(index)
        geometries = collision_geometries(plant, inspector, index)
        for geometry in geometries:
            sole = is_sole(inspector.GetName(geometry))
            part_of[geometry] = Part(len(bodies), sole)
        if geometries:
            bodies.append(body.name())
    missing = [foot for foot in feet if foot not in bodies]
    if missing:
        raise ValueError(f"feet: {missing[0]} has no collision geometry")
    solids: list[str] = []
    solid_of: dict[GeometryId, int] = {}
    for number in range(plant.num_bodies()):
        body = plant.get_body(BodyIndex(number))
        if body.model_instance() == robot:
            continue
        for geometry in collision_geometries(plant, inspector, body.index()):
            solid_of[geometry] = len(solids)
            solids.append(inspector.GetName(geometry).rpartition("::")[2])
    return WatchedGeometry(
        tuple(bodies),
        tuple(bodies.index(foot) for foot in feet),
        tuple(solids),
        frozenset(index for index, name in enumerate(solids) if name in ground),
        part_of,
        solid_of,
    )


def collision_geometries(
    plant: MultibodyPlant, inspector: SceneGraphInspector, body: BodyIndex
) -> list[GeometryId]:
    """Finds the collision geometries of a body.

    Ids that the plant gives keep it alive for as long as they are kept; these do not.
    """
    frame = plant.GetBodyFrameIdOrThrow(body)
    found: list[GeometryId] = inspector.GetGeometries(frame, Role.kProximity)
    return found


def robot_contacts(
    results: ContactResults, watched: WatchedGeometry
) -> list[RobotContact]:
    """Finds the contacts of the robot; point pairs and hydroelastic surfaces.

    One between two of its own bodies comes once, as one of the body that comes first.
    """
    contacts = []
    for index in range(results.num_point_pair_contacts()):
        info = results.point_pair_contact_info(index)
        pair = info.point_pair()
        # Drake gives the force on the second of the pair.
        contact = _contact(watched, pair.id_B, pair.id_A, info.contact_force())
        if contact is not None:
            contacts.append(contact)
    for index in range(results.num_hydroelastic_contacts()):
        patch = results.hydroelastic_contact_info(index)
        surface, force = patch.contact_surface(), patch.F_Ac_W().translational()
        contact = _contact(watched, surface.id_M(), surface.id_N(), force)
        if contact is not None:
            contacts.append(contact)
    return contacts


def _contact(
    watched: WatchedGeometry, pushed: GeometryId, other: GeometryId, force: Vector
) -> RobotContact | None:
    """Gives the contact of `pushed`, on which the force acts, with `other`."""
    key = (pushed.get_value(), other.get_value())
    if key not in watched.pairs:
        watched.pairs[key] = _pair(watched, pushed, other)
    pair = watched.pairs[key]
    if pair is None:
        return None
    acting = force if pair.sign > 0.0 else -force
    return RobotContact(pair.body, pair.sole, pair.other, pair.allowed, acting)


def _pair(
    watched: WatchedGeometry, pushed: GeometryId, other: GeometryId
) -> Pair | None:
    """Tells what it is when two geometries meet; None where the robot has no part."""
    part, sign = watched.part_of.get(pushed), 1.0
    if part is None:
        part, other, sign = watched.part_of.get(other), pushed, -1.0
    if part is None:
        return None
    solid = watched.solid_of.get(other)
    if solid is None:
        met = watched.part_of[other]
        if met.body < part.body:  # the pair has one order, whichever is pushed
            part, met, sign = met, part, -sign
        index = len(watched.solids) + met.body
        return Pair(part.body, part.sole, index, False, sign)
    allowed = part.sole and solid in watched.ground
    return Pair(part.body, part.sole, solid, allowed, sign)


def scene_forces(contacts: list[RobotContact], watched: WatchedGeometry) -> Vector:
    """Total force of the scene on each foot and on all but the soles, in W, (3, 3), N.

    Rows: the left foot, the right foot, everything that is no sole. What a foot's body
    bears beside its sole is in two of them.
    """
    forces = np.zeros((3, 3))
    left, right = watched.feet
    for body, sole, other, _, force in contacts:
        if other >= len(watched.solids):
            continue
        if body == left:
            forces[0] += force
        elif body == right:
            forces[1] += force
        if not sole:
            forces[2] += force
    return forces
