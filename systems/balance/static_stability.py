"""Static stability as a System: soles and CoM in, polygon and margin out."""

from dataclasses import dataclass, field

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.framework import BasicVector, Context, LeafSystem, State

from footfall.models.robots.robot import Sole
from footfall.models.values.contact import StancePolygon
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import Contact, sole_contact
from footfall.systems.balance.convex_polygon import signed_margin
from footfall.systems.balance.sole_contacts import carrying_contact, moved_by
from footfall.systems.balance.stability_polygon import StabilityPolygon, static_polygon
from footfall.systems.held_value import HeldValue
from footfall.systems.ports import eval_abstract, eval_vector, set_vector
from footfall.systems.timing import timed


@dataclass(frozen=True, eq=False)
class _Stance(Value):
    """The stance that the polygon belongs to."""

    looked: bool = False
    soles: tuple[Contact, ...] = ()
    others: tuple[Contact, ...] = ()
    polygon: StabilityPolygon = field(
        default_factory=lambda: StabilityPolygon(status="no_contact")
    )
    caught: int = 0
    seen: Vector = field(default_factory=lambda: np.full(16, np.inf))
    """Poses and contacts that it was made of, (16,)."""


class StaticStability(LeafSystem):
    """Says where the CoM may be to stand still on the present contacts, and how far in.

    .. pydrake_system::

        name: StaticStability
        input_ports:
        - sole_poses
        - contacts
        - com
        - other_contacts
        output_ports:
        - polygon
        - margin
        - caught

    - `sole_poses`: of the left and the right sole frame F in W, each x, y, z, m, then
      roll, pitch, yaw, rad, (12,).
    - `contacts`: whether the left and the right sole stand, above 0.5, then the length
      of each that carries, from the toe edge back, (4,), -, -, m, m. A sole of which
      only a part carries has its heel lifted; the ground under its toes is level.
    - `com`: p_WCom, (3,), m.
    - `other_contacts`: hands and the like, a tuple of `Contact`; none where it is not
      connected.
    - `polygon`: `StancePolygon` in W with status and margin, as of the last look.
    - `margin`: signed distance of the CoM to the polygon's edge, (1,), m; positive
      inside, minus infinity where there is no polygon.
    - `caught`: how many results of double description the check has refused and linear
      programmes replaced, (1,).

    The stance is looked at every `period`; the polygon is computed anew only where a
    contact came, went or moved by more than `tolerance`.
    """

    def __init__(
        self,
        heel: float,
        toe: float,
        half_width: float,
        friction: float,
        period: float = 0.025,
        tolerance: float = 1e-3,
    ) -> None:
        """Declares the ports and the state.

        Args:
            heel: from the sole frame's origin back to the heel, m.
            toe: from the sole frame's origin forward to the toes, m.
            half_width: half the sole's width, m.
            friction: mu of the four-sided pyramid.
            period: how often the stance is looked at, s.
            tolerance: how far a corner of a contact may move unheeded, m.

        Raises:
            ValueError: a length or the friction is negative, period not positive.
        """
        super().__init__()
        if not period > 0.0:
            raise ValueError(f"period: must be positive, got {period} s")
        if not tolerance >= 0.0:
            raise ValueError(f"tolerance: must not be negative, got {tolerance}")
        self._sole = Sole(heel, toe, half_width, ankle_height=0.0)
        self._friction, self._tolerance = friction, tolerance
        sole_contact(RigidTransform(), heel, toe, half_width, friction)  # refuses now

        self._sole_poses = self.DeclareVectorInputPort("sole_poses", 12)
        self._contacts = self.DeclareVectorInputPort("contacts", 4)
        self._com = self.DeclareVectorInputPort("com", 3)
        self._other_contacts = self.DeclareAbstractInputPort(
            "other_contacts", AbstractValue.Make(())
        )
        self._stance = HeldValue(self, _Stance())
        state = self._stance.ticket
        with_com = {state, self._com.ticket()}
        self.DeclareAbstractOutputPort(
            "polygon",
            lambda: AbstractValue.Make(StancePolygon()),
            timed(self, self._calc_polygon),  # type: ignore[arg-type]
            prerequisites_of_calc=with_com,
        )
        self.DeclareVectorOutputPort(
            "margin",
            1,
            timed(self, self._calc_margin),
            prerequisites_of_calc=with_com,
        )
        self.DeclareVectorOutputPort(
            "caught",
            1,
            timed(self, self._calc_caught),
            prerequisites_of_calc={state},
        )
        update = timed(self, self._update)
        self.DeclareInitializationUnrestrictedUpdateEvent(update)
        self.DeclarePeriodicUnrestrictedUpdateEvent(period, 0.0, update)

    def _margin(self, context: Context) -> float:
        com = eval_vector(self._com, context)
        return signed_margin(self._stance.get(context).polygon.vertices, com[:2])

    def _calc_polygon(self, context: Context, output: AbstractValue) -> None:
        polygon = self._stance.get(context).polygon
        output.set_value(
            StancePolygon(polygon.vertices, polygon.status, self._margin(context))
        )

    def _calc_margin(self, context: Context, output: BasicVector) -> None:
        set_vector(output, np.array([self._margin(context)]))

    def _calc_caught(self, context: Context, output: BasicVector) -> None:
        set_vector(output, np.array([float(self._stance.get(context).caught)]))

    def _update(self, context: Context, state: State) -> None:
        held = self._stance.get(context)
        poses = eval_vector(self._sole_poses, context)
        contacts = eval_vector(self._contacts, context)
        others: tuple[Contact, ...] = ()
        if self._other_contacts.HasValue(context):
            others = eval_abstract(self._other_contacts, context, tuple)
        seen: Vector = np.concatenate([poses, contacts])
        if others == held.others and self._surely_same(seen, held.seen):
            return
        soles = tuple(
            carrying_contact(pose, length, self._sole, self._friction)
            for pose, stands, length in zip(
                poses.reshape(2, 6), contacts[:2] > 0.5, contacts[2:], strict=True
            )
            if stands
        )
        if held.looked and others == held.others and self._same(soles, held.soles):
            return
        polygon = static_polygon([*soles, *others])
        self._stance.set(
            state,
            _Stance(True, soles, others, polygon, held.caught + polygon.caught, seen),
        )

    def _surely_same(self, seen: Vector, before: Vector) -> bool:
        """Tells from numbers alone that no corner of a sole that stands has moved.

        A corner moves by less than the largest change of its pose's six numbers times
        one and three arms, which are less than 1 m.
        """
        stands = np.repeat(seen[12:14] > 0.5, 6)
        if (seen[12:] != before[12:]).any():
            return False
        change = np.abs(seen[:12] - before[:12])[stands]
        return bool(not change.size or 5.0 * change.max() <= self._tolerance)

    def _same(self, soles: tuple[Contact, ...], before: tuple[Contact, ...]) -> bool:
        """Tells whether no sole came, went or moved; lifted toes stay."""
        return len(soles) == len(before) and all(
            moved_by(a, b) <= self._tolerance
            for a, b in zip(soles, before, strict=True)
        )
