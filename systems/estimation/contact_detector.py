"""Which feet stand: from noisy forces, over what a foot in the air feels."""

import math
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
    touch_force: float = number(25.0, "N", above=0.0)
    """Least force along the sole's normal, over what a foot in the air feels, that
    counts as ground, N."""
    touch_sigmas: float = number(5.0, least=0.0)
    """The same as a multiple of the noise that a foot in the air feels: the larger of
    the two counts, at the first sample, as a stiff leg that goes on down for a few
    ticks strikes with body weights."""
    release_share: float = number(0.5, above=0.0, below=1.0)
    """Below this share of that force the ground is lost."""
    release_count: int = number(2, least=1, most=100)
    """Samples in a row that it takes to lose it."""
    noise: float = number(3.0, "N", above=0.0)
    """Noise of the force that is reckoned with before a foot was in the air, N."""
    largest_noise: float = number(12.0, "N", above=0.0)
    """Most that is taken for noise, N."""
    tare_time: float = number(0.1, "s", above=0.0)
    """Time constant with which the mean of the force in the air, from offsets and the
    foot's inertia, is followed, s."""
    noise_time: float = number(0.3, "s", above=0.0)
    """The same of its noise, s: of the differences from sample to sample, since what
    inertia pulls comes and goes slowly."""
    largest_tare: float = number(10.0, "N", least=0.0)
    """Most that is taken for such a mean, N: what is more is ground."""
    bearing_force: float = number(150.0, "N", above=0.0)
    """Force with which a foot that touches bears: it does not move, and the base can be
    told by it."""
    edge: float = number(0.02, "m", least=0.0)
    """A foot whose centre of pressure is nearer to the sole's edge than this, m, may
    roll over it, and bears nothing for sure."""


class SoleSize(NamedTuple):
    """Edges of a sole in F, m."""

    heel: float
    toe: float
    half_width: float


_OUTLIER = 9.0
"""A sample counts for no more than so many variances."""


class FootContact(NamedTuple):
    """What is remembered of one foot."""

    touching: bool
    """Whether it is on the ground."""
    against: int
    """Samples in a row that say otherwise, of one that is."""
    mean: float
    """What it felt in the air, N."""
    variance: float
    """How that scattered, N^2."""
    last: float
    """The sample before, N."""


def standing_contact(params: ContactParams) -> FootContact:
    """Makes the memory of a foot that stands and was never in the air."""
    return FootContact(True, 0, 0.0, params.noise**2, 0.0)


def detect_contact(
    contact: FootContact, force: float, params: ContactParams
) -> FootContact:
    """Takes in one sample.

    Args:
        contact: after the sample before.
        force: along the sole's normal, N.
        params: thresholds and time constant.
    """
    touching, against, mean, variance, last = contact
    threshold = max(params.touch_force, params.touch_sigmas * math.sqrt(variance))
    excess = force - mean
    if touching:
        against = against + 1 if excess < params.release_share * threshold else 0
        if against >= params.release_count:
            touching, against = False, 0
        return FootContact(touching, against, mean, variance, force)
    if excess > threshold:
        return FootContact(True, 0, mean, variance, force)
    share = min(1.0, params.period / params.tare_time)
    mean = max(-params.largest_tare, min(params.largest_tare, mean + share * excess))
    # Of two samples that scatter alike the difference scatters twice as much.
    scatter = min(0.5 * (force - last) ** 2, _OUTLIER * variance)
    variance += min(1.0, params.period / params.noise_time) * (scatter - variance)
    variance = max(params.noise**2, min(params.largest_noise**2, variance))
    return FootContact(False, 0, mean, variance, force)


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
        stands = standing_contact(params)
        first: Vector = np.array([*stands, *stands], dtype=np.float64)
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
            detect_contact(_contact(before[:5]), left, self._params),
            detect_contact(_contact(before[5:]), right, self._params),
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
    touching, against, mean, variance, last = values.tolist()
    return FootContact(touching > 0.5, int(against), mean, variance, last)
