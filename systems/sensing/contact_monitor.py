"""Whether the robot touches the scene with anything but its soles."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydrake.common.value import AbstractValue, Value
from pydrake.geometry import GeometryId, Role, SceneGraphInspector
from pydrake.multibody.plant import ContactResults, MultibodyPlant
from pydrake.multibody.tree import BodyIndex, ModelInstanceIndex, RigidBody
from pydrake.systems.framework import (
    BasicVector,
    Context,
    DiscreteValues,
    LeafSystem,
)

from systems.ports import Vector, eval_abstract
from systems.timing import timed
from systems.values import Touch, Touches


class Contact(NamedTuple):
    """A watched pair that is in contact."""

    body: int
    """Index into `WatchedGeometry.bodies`."""
    solid: int
    """Index into `WatchedGeometry.solids`."""
    force: float
    """Magnitude of the contact force, N."""


@dataclass(frozen=True)
class WatchedGeometry:
    """Which geometries must not meet."""

    bodies: tuple[str, ...]
    """The robot's bodies."""
    solids: tuple[str, ...]
    """The scene's solids."""
    body_of: dict[GeometryId, int]
    """Index into `bodies` of each of the robot's collision geometries, but for the
    soles'."""
    solid_of: dict[GeometryId, int]
    """Index into `solids` of each of the scene's collision geometries."""


def watched_geometry(
    plant: MultibodyPlant,
    inspector: SceneGraphInspector,
    robot: ModelInstanceIndex,
    solid_prefix: str | tuple[str, ...],
    is_sole: Callable[[str], bool],
) -> WatchedGeometry:
    """Finds the robot's geometries that are no soles, and the scene's to keep off.

    Args:
        plant: the finalised plant.
        inspector: of the scene graph that the plant is registered with.
        robot: the robot's model instance.
        solid_prefix: what the names (without scope) of the solids begin with, one or
            several.
        is_sole: tells a sole's geometry by its name.
    """
    bodies: list[str] = []
    body_of: dict[GeometryId, int] = {}
    for index in plant.GetBodyIndices(robot):
        body = plant.get_body(index)
        geometries = [
            geometry
            for geometry in _collision_geometries(plant, inspector, body)
            if not is_sole(inspector.GetName(geometry))
        ]
        if geometries:
            body_of |= dict.fromkeys(geometries, len(bodies))
            bodies.append(body.name())
    solids: list[str] = []
    solid_of: dict[GeometryId, int] = {}
    for number in range(plant.num_bodies()):
        body = plant.get_body(BodyIndex(number))
        if body.model_instance() == robot:
            continue
        for geometry in _collision_geometries(plant, inspector, body):
            name = inspector.GetName(geometry).rpartition("::")[2]
            if name.startswith(solid_prefix):
                solid_of[geometry] = len(solids)
                solids.append(name)
    return WatchedGeometry(tuple(bodies), tuple(solids), body_of, solid_of)


def _collision_geometries(
    plant: MultibodyPlant, inspector: SceneGraphInspector, body: RigidBody
) -> list[GeometryId]:
    """Of a body. An id that the plant itself gives keeps the plant alive for ever."""
    frame = plant.GetBodyFrameIdOrThrow(body.index())
    found: list[GeometryId] = inspector.GetGeometries(frame, Role.kProximity)
    return found


def watched_contacts(
    results: ContactResults, watched: WatchedGeometry
) -> list[Contact]:
    """The contacts between what is watched; point pairs and hydroelastic surfaces."""
    contacts = []
    body_of, solid_of = watched.body_of, watched.solid_of
    for index in range(results.num_point_pair_contacts()):
        info = results.point_pair_contact_info(index)
        pair = info.point_pair()
        a, b = pair.id_A, pair.id_B
        body = body_of.get(a, body_of.get(b))
        solid = solid_of.get(a, solid_of.get(b))
        if body is not None and solid is not None:
            force = float(np.linalg.norm(info.contact_force()))
            contacts.append(Contact(body, solid, force))
    for index in range(results.num_hydroelastic_contacts()):
        surface = results.hydroelastic_contact_info(index)
        m, n = surface.contact_surface().id_M(), surface.contact_surface().id_N()
        body = body_of.get(m, body_of.get(n))
        solid = solid_of.get(m, solid_of.get(n))
        if body is not None and solid is not None:
            force = float(np.linalg.norm(surface.F_Ac_W().translational()))
            contacts.append(Contact(body, solid, force))
    return contacts


class ContactMonitor(LeafSystem):
    """Remembers what of the robot, but for its soles, has touched what of the scene.

    It looks at every step of the plant, so that a graze of one step is not missed;
    the state is discrete (a time and a force a pair), because an unrestricted update
    at that rate would slow the whole run down.

    .. pydrake_system::

        name: ContactMonitor
        input_ports:
        - contact_results
        output_ports:
        - touching
        - touches

    - `contact_results`: the plant's contacts, ContactResults.
    - `touching`: how many contacts there were at the last step, (1,).
    - `touches`: every pair that has met since the start, `Touches`.
    """

    def __init__(self, watched: WatchedGeometry, period: float) -> None:
        """Declares ports, state and the update.

        Args:
            watched: which geometries must not meet.
            period: the plant's time step, s.

        Raises:
            ValueError: the period is not positive.
        """
        super().__init__()
        if not period > 0.0:
            raise ValueError(f"period: must be positive, got {period} s")
        self._watched = watched
        self._period = period
        pairs = len(watched.bodies) * len(watched.solids)
        self._results = self.DeclareAbstractInputPort(
            "contact_results", Value(ContactResults())
        )
        touching = self.DeclareDiscreteState(1)
        durations = self.DeclareDiscreteState(pairs)
        forces = self.DeclareDiscreteState(pairs)
        self._touching, self._durations, self._forces = map(
            int, (touching, durations, forces)
        )
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))
        self.DeclareVectorOutputPort(
            "touching",
            1,
            timed(self, self._calc_touching),
            prerequisites_of_calc={self.discrete_state_ticket(touching)},
        )
        self.DeclareAbstractOutputPort(
            "touches",
            lambda: Value[object](Touches()),
            timed(self, self._calc_touches),  # type: ignore[arg-type]
            prerequisites_of_calc={
                self.discrete_state_ticket(durations),
                self.discrete_state_ticket(forces),
            },
        )

    def _update(self, context: Context, state: DiscreteValues) -> None:
        results = eval_abstract(self._results, context, ContactResults)
        contacts = watched_contacts(results, self._watched)
        state.get_mutable_vector(self._touching).SetAtIndex(0, len(contacts))
        if not contacts:
            return
        durations = state.get_mutable_value(self._durations)
        forces = state.get_mutable_value(self._forces)
        force_of: dict[int, float] = {}
        for contact in contacts:
            pair = contact.body * len(self._watched.solids) + contact.solid
            force_of[pair] = force_of.get(pair, 0.0) + contact.force
        for pair, force in force_of.items():
            durations[pair] += self._period
            forces[pair] = max(forces[pair], force)

    def _calc_touching(self, context: Context, touching: BasicVector) -> None:
        state = context.get_discrete_state(self._touching)
        touching.SetAtIndex(0, state.GetAtIndex(0))

    def _calc_touches(self, context: Context, touches: AbstractValue) -> None:
        durations: Vector = context.get_discrete_state(self._durations).value()
        forces: Vector = context.get_discrete_state(self._forces).value()
        solids = self._watched.solids
        met = [int(pair) for pair in np.flatnonzero(durations)]
        touches.set_value(
            Touches(
                tuple(
                    Touch(
                        self._watched.bodies[pair // len(solids)],
                        solids[pair % len(solids)],
                        float(durations[pair]),
                        float(forces[pair]),
                    )
                    for pair in met
                )
            )
        )
