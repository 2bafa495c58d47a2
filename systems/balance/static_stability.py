"""Static stability as a System: soles and CoM in, polygon and margin out."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
from pydrake.systems.framework import BasicVector, Context, LeafSystem, State

from systems.balance.contact_wrench_cone import Contact, sole_contact
from systems.balance.convex_polygon import signed_margin
from systems.balance.stability_polygon import StabilityPolygon, static_polygon
from systems.ports import Vector, eval_abstract, eval_vector, set_vector
from systems.timing import timed
from systems.values import StancePolygon, Value

LIFTED = 1e-6
"""A sole that carries on this much less than its length has its heel lifted, m."""


@dataclass(frozen=True, eq=False)
class _Stance(Value):
    """The stance that the polygon belongs to."""

    sole_poses: Vector = field(default_factory=lambda: np.zeros(12))
    contacts: Vector = field(default_factory=lambda: np.full(4, np.nan))
    others: tuple[Contact, ...] = ()
    polygon: StabilityPolygon = field(
        default_factory=lambda: StabilityPolygon(status="no_contact")
    )
    caught: int = 0


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
            tolerance: how far a sole may move, m, or turn, rad, unheeded.

        Raises:
            ValueError: a length or the friction is negative, period not positive.
        """
        super().__init__()
        if not period > 0.0:
            raise ValueError(f"period: must be positive, got {period} s")
        if not tolerance >= 0.0:
            raise ValueError(f"tolerance: must not be negative, got {tolerance}")
        self._sole = (heel, toe, half_width, friction)
        self._tolerance = tolerance
        sole_contact(RigidTransform(), *self._sole)  # refuses a bad sole now

        self._sole_poses = self.DeclareVectorInputPort("sole_poses", 12)
        self._contacts = self.DeclareVectorInputPort("contacts", 4)
        self._com = self.DeclareVectorInputPort("com", 3)
        self._other_contacts = self.DeclareAbstractInputPort(
            "other_contacts", AbstractValue.Make(())
        )
        self._stance = self.DeclareAbstractState(AbstractValue.Make(_Stance()))
        state = self.abstract_state_ticket(self._stance)
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

    def _held(self, context: Context) -> _Stance:
        state: Any = context.get_abstract_state(int(self._stance))
        held = state.get_value()
        assert isinstance(held, _Stance)
        return held

    def _margin(self, context: Context) -> float:
        com = eval_vector(self._com, context)
        return signed_margin(self._held(context).polygon.vertices, com[:2])

    def _calc_polygon(self, context: Context, output: AbstractValue) -> None:
        polygon = self._held(context).polygon
        output.set_value(
            StancePolygon(polygon.vertices, polygon.status, self._margin(context))
        )

    def _calc_margin(self, context: Context, output: BasicVector) -> None:
        set_vector(output, np.array([self._margin(context)]))

    def _calc_caught(self, context: Context, output: BasicVector) -> None:
        set_vector(output, np.array([float(self._held(context).caught)]))

    def _update(self, context: Context, state: State) -> None:
        held = self._held(context)
        poses = eval_vector(self._sole_poses, context)
        contacts = eval_vector(self._contacts, context)
        contacts[:2] = contacts[:2] > 0.5
        others: tuple[Contact, ...] = ()
        if self._other_contacts.HasValue(context):
            others = eval_abstract(self._other_contacts, context, tuple)
        standing = np.repeat(contacts[:2] > 0.5, 6)
        if (
            np.array_equal(contacts, held.contacts)
            and others == held.others
            and np.abs(_moved(poses, held.sole_poses)[standing]).max(initial=0.0)
            <= self._tolerance
        ):
            return
        soles = [
            self._contact(pose, length)
            for pose, stands, length in zip(
                poses.reshape(2, 6), contacts[:2], contacts[2:], strict=True
            )
            if stands
        ]
        polygon = static_polygon([*soles, *others])
        state.get_mutable_abstract_state(int(self._stance)).set_value(
            _Stance(poses, contacts, others, polygon, held.caught + polygon.caught)
        )

    def _contact(self, pose: Vector, length: float) -> Contact:
        """The part of a sole that carries."""
        heel, toe, half_width, friction = self._sole
        X_WF = _pose(pose)
        if length >= heel + toe - LIFTED:
            return sole_contact(X_WF, heel, toe, half_width, friction)
        p_FE: Vector = np.array([toe, 0.0, 0.0])
        p_WE: Vector = np.asarray(X_WF.multiply(p_FE))
        X_WE = RigidTransform(RotationMatrix.MakeZRotation(pose[5]), p_WE)
        return sole_contact(X_WE, length, 0.0, half_width, friction)


def _pose(pose: Vector) -> RigidTransform:
    """The pose with x, y, z, roll, pitch, yaw, (6,)."""
    position: Vector = pose[:3]
    angles: Vector = pose[3:]
    return RigidTransform(RollPitchYaw(angles), position)


def _moved(poses: Vector, before: Vector) -> Vector:
    """Change of both soles' poses, (12,), m and rad; angles the short way round."""
    change = (poses - before).reshape(2, 6)
    change[:, 3:] = np.remainder(change[:, 3:] + np.pi, 2.0 * np.pi) - np.pi
    return change.ravel()
