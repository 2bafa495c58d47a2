"""Which feet stand: from noisy forces, with hysteresis and patience."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydrake.systems.framework import (
    BasicVector,
    Context,
    DiscreteStateIndex,
    DiscreteValues,
    LeafSystem,
)

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.cached import declare_cached
from footfall.systems.ports import (
    declare_state,
    eval_vector,
    read_state,
    set_state,
    set_vector,
)
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class ContactParams(Parameters):
    """When a foot counts as on the ground."""

    period: float = number(
        0.005, "s", least=1e-4, most=0.1, shared="parameters.control_period"
    )
    """Of the controllers, s."""
    touch_force: float = number(30.0, "N", above=0.0)
    """Force along the sole's normal that counts as ground, N: above the sensor's noise
    and offset and what the foot's own inertia pulls in the swing."""
    release_force: float = number(15.0, "N", above=0.0)
    """Below this force, N, the ground is lost."""
    sure_force: float = number(100.0, "N", above=0.0)
    """What is felt above this, N, is ground at the first sample: no noise is so strong,
    and a stiff leg that goes on down for a tick strikes with body weights."""
    touch_count: int = number(2, least=1, most=100)
    """Samples in a row that it takes to touch with less."""
    release_count: int = number(2, least=1, most=100)
    """Samples in a row that it takes to lose."""
    bearing_force: float = number(150.0, "N", above=0.0)
    """Force with which a foot that touches bears: it does not move, and the base can be
    told by it."""
    edge: float = number(0.02, "m", least=0.0)
    """A foot whose centre of pressure is nearer to the sole's edge than this, m, may
    roll over it, and bears nothing for sure."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.release_force < self.touch_force:
            raise ValueError(
                f"release_force: must be less than touch_force, "
                f"{self.touch_force:g} N, got {self.release_force:g} N"
            )
        if not self.touch_force <= self.sure_force:
            raise ValueError(
                f"sure_force: must be at least touch_force, {self.touch_force:g} N, "
                f"got {self.sure_force:g} N"
            )


class SoleSize(NamedTuple):
    """Edges of a sole in F, m."""

    heel: float
    toe: float
    half_width: float


class FootContact(NamedTuple):
    """What is remembered of one foot."""

    touching: bool
    """Whether it is on the ground."""
    against: int
    """Samples in a row that say otherwise."""


def detect_contact(
    contact: FootContact, force: float, params: ContactParams
) -> FootContact:
    """Takes in one sample.

    Args:
        contact: after the sample before.
        force: along the sole's normal, N.
        params: thresholds and counts.
    """
    if force > params.sure_force:
        return FootContact(True, 0)
    if contact.touching:
        contrary, patience = force < params.release_force, params.release_count
    else:
        contrary, patience = force > params.touch_force, params.touch_count
    against = contact.against + 1 if contrary else 0
    if against >= patience:
        return FootContact(not contact.touching, 0)
    return FootContact(contact.touching, against)


def bears(wrench: Vector, sole: SoleSize, params: ContactParams) -> bool:
    """Tells whether a foot bears load well inside its sole.

    Args:
        wrench: of the ground, force then moment about F, in F, (6,), N and Nm.
        sole: its edges.
        params: `bearing_force` and `edge`.
    """
    numbers: list[float] = wrench.tolist()
    _, _, f_z, m_x, m_y, _ = numbers
    if f_z < params.bearing_force:
        return False
    x, y = -m_y / f_z, m_x / f_z
    inside = -sole.heel + params.edge <= x <= sole.toe - params.edge
    return inside and abs(y) <= sole.half_width - params.edge


class ContactDetector(LeafSystem):
    """Tells from the measured wrenches which feet touch the ground, and which bear.

    .. pydrake_system::

        name: ContactDetector
        input_ports:
        - foot_wrenches
        output_ports:
        - touching
        - bearing

    - `foot_wrenches`: measured, of the ground on the left and the right foot, each
      force then moment about F, in F, (12,), N and Nm; a new sample every tick.
    - `touching`: left and right on the ground, 0 or 1, (2,), no unit.
    - `bearing`: left and right with load well inside the sole, 0 or 1, (2,), no unit.

    In the default context both feet touch.
    """

    def __init__(self, params: ContactParams, sole: SoleSize) -> None:
        """Declares ports, state and the update.

        Args:
            params: thresholds and counts.
            sole: edges of both soles.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._params, self._sole = params, sole
        first: Vector = np.array([1.0, 0.0, 1.0, 0.0])
        self._memory = declare_state(self, first)
        self._wrenches = self.DeclareVectorInputPort("foot_wrenches", 12)
        inputs = {
            self._wrenches.ticket(),
            self.discrete_state_ticket(DiscreteStateIndex(self._memory)),
        }
        self._after = declare_cached(self, "after this sample", self._calc, inputs)
        for name, calc in (
            ("touching", self._calc_touching),
            ("bearing", self._calc_bearing),
        ):
            self.DeclareVectorOutputPort(
                name, 2, timed(self, calc), prerequisites_of_calc=inputs
            )
        self.DeclarePeriodicDiscreteUpdateEvent(
            params.period, 0.0, timed(self, self._update)
        )

    def _calc(self, context: Context) -> tuple[FootContact, FootContact]:
        before = read_state(context, self._memory)
        left, right = eval_vector(self._wrenches, context).reshape(2, 6)[:, 2]
        return (
            detect_contact(_contact(before[:2]), left, self._params),
            detect_contact(_contact(before[2:4]), right, self._params),
        )

    def _calc_touching(self, context: Context, output: BasicVector) -> None:
        set_vector(output, np.array([foot.touching for foot in self._after(context)]))

    def _calc_bearing(self, context: Context, output: BasicVector) -> None:
        wrenches = eval_vector(self._wrenches, context).reshape(2, 6)
        bearing = [
            foot.touching and bears(wrench, self._sole, self._params)
            for foot, wrench in zip(self._after(context), wrenches, strict=True)
        ]
        set_vector(output, np.array(bearing))

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        left, right = self._after(context)
        memory = np.array([*left, *right], dtype=np.float64)
        set_state(discrete, self._memory, memory)


def _contact(values: Vector) -> FootContact:
    return FootContact(bool(values[0] > 0.5), int(values[1]))
