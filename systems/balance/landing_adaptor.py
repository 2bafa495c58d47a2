"""Touch-down is felt, not assumed: foot references that yield to the ground.

A foot that meets the ground before it was planned stops there; one that does not find
it where it was planned goes on down until it does. From then on its reference stays
where the foot was when it met the ground. In the air, where soft legs sag, the
reference is shifted until the foot itself follows the plan.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pydrake.systems.framework import Context, DiscreteValues, LeafSystem

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.ports import declare_state_output, eval_vector, set_state
from footfall.systems.timing import timed

_ROLL, _PITCH = 3, 4


LANDING_SPEED = 0.03
"""Gentle for a foot that strikes the ground, m/s."""


@dataclass(kw_only=True)
class LandingParams(Parameters):
    """When a foot counts as landed and how it looks for the ground."""

    period: float = number(
        0.005, "s", least=1e-4, most=0.1, shared="parameters.control_period"
    )
    """Of the controllers, s."""
    blind_time: float = number(0.3, "s", least=0.0)
    """After lift-off no touch counts for this long, s: the foot still leaves."""
    search_speed: float = number(0.10, "m/s", above=0.0)
    """Speed at which a foot that missed the ground goes on down, m/s."""
    search_start: float | None = number(None, "m/s", least=0.0, most=1.0)
    """Speed with which a foot that came to rest over the ground begins to look for it,
    m/s; null for that with which walking feet land, `LANDING_SPEED`, and for 0 where
    motions are quasi-static: they wait for the foot."""
    search_acceleration: float = number(0.5, "m/s^2", above=0.0)
    """How fast it takes that speed up, m/s^2: most ground is missed by less than a
    millimetre, and a leg that is heavy by its gears strikes it."""
    search_depth: float = number(0.03, "m", least=0.0)
    """How far it does so, m; then it is taken for landed, as deep ground is a plan's
    business."""
    release_time: float = number(0.08, "s", above=0.0)
    """Time constant with which a lifted foot forgets where it stood, s; twice over, so
    that it sets off at rest: if it set off at 0.1 m/s it would tip the other foot."""
    settle_time: float = number(0.05, "s", above=0.0)
    """Time constant with which the reference of a foot that has landed goes from where
    it was to where the foot is, s, twice over: a step would tear the foot off the
    ground again."""
    swing_gain: float = number(15.0, "1/s", least=0.0)
    """Rate at which a foot in the air is brought to its plan, 1/s."""
    swing_delay: float = number(0.003, "s", least=0.0, most=0.1)
    """How late a foot in the air follows its reference, s: what it is behind by that is
    no sag, and would be made up for when the foot is to stop, on the ground."""
    swing_limit: float = number(0.04, "m", least=0.0)
    """Most that its reference is shifted for that, m and rad."""


class FootState(NamedTuple):
    """What is remembered of one foot."""

    offset: Vector
    """Reference minus plan, as (x, y, z, roll, pitch, yaw), (6,), m and rad."""
    offset_rate: Vector
    """Of a lifted foot whose offset goes, (6,), m/s and rad/s."""
    sag: Vector
    """What is added in the air so that the foot follows the plan, (6,)."""
    held: Vector
    """The reference at which a foot that landed early is held, (6,)."""
    slack: Vector
    """How far the reference still is from where the foot met the ground, (6,)."""
    slack_rate: Vector
    """(6,), m/s and rad/s."""
    landed: bool
    """Whether it stands on ground that it has felt."""
    lifted_for: float
    """Time since the plan lifted it, s; 0 while it is to stand."""
    searching: float
    """Speed at which it goes down in the air, or looks for the ground below its plan,
    m/s: it goes on as it came."""


def adapt(
    state: FootState,
    planned: Vector,
    rate: Vector,
    contact: bool,
    felt: bool,
    measured: Vector,
    params: LandingParams,
) -> tuple[FootState, Vector, Vector]:
    """Adapts one foot for one tick.

    Args:
        state: after the tick before.
        planned: pose that the plan wants now, (6,).
        rate: its rate, (6,).
        contact: whether the plan wants the foot on the ground.
        felt: whether the ground is felt under it.
        measured: pose of the sole, (6,).
        params: see there.

    Returns:
        The state after this tick, the pose to track and its rate, (6,) each.
    """
    h = params.period
    offset, sag, held, landed = state.offset, state.sag, state.held, state.landed
    slack, slack_rate = _vanishing(state.slack, state.slack_rate, params.settle_time, h)
    offset_rate: Vector = np.zeros(6)
    lifted_for = searching = 0.0
    if not contact:
        lifted_for = state.lifted_for + h
        if state.lifted_for == 0.0:
            landed = False
        if not landed:
            # What is left of it goes with the rest of where the foot stood.
            offset, offset_rate = _vanishing(
                offset + slack, state.offset_rate + slack_rate, params.release_time, h
            )
            slack, slack_rate = np.zeros(6), np.zeros(6)
            start = params.search_start
            searching = max(LANDING_SPEED if start is None else start, -float(rate[2]))
            due = planned + offset - params.swing_delay * (rate + offset_rate)
            sag = state.sag + params.swing_gain * h * (due - measured)
            sag = np.clip(sag, -params.swing_limit, params.swing_limit)
            if felt and lifted_for > params.blind_time and rate[2] < 0.0:
                landed, searching = True, 0.0
                held = _level(measured)
                slack = planned + offset + sag - held
        if landed:
            offset, offset_rate = held - planned, np.zeros(6)
            rate = np.zeros(6)
            sag = np.zeros(6)
    # What is given out now is tracked from the next tick on.
    ahead = planned + h * rate
    if contact and not landed:
        landed = felt or offset[2] < -params.search_depth
        if landed:
            slack = offset + sag - (_level(measured) - planned)
            offset, sag = _level(measured) - planned, np.zeros(6)
        else:
            faster = state.searching + params.search_acceleration * h
            searching = min(params.search_speed, faster)
            offset = offset.copy()
            offset[2] -= searching * h
            rate = rate.copy()
            rate[2] -= searching
    after = FootState(
        offset, offset_rate, sag, held, slack, slack_rate, landed, lifted_for, searching
    )
    pose = ahead + offset + sag + slack
    return after, pose, rate + offset_rate + slack_rate


def _vanishing(
    value: Vector, rate: Vector, time: float, period: float
) -> tuple[Vector, Vector]:
    """Value and rate a tick later of what goes to zero, critically damped, (6,) each.

    Args:
        value: now.
        rate: now.
        time: constant, s; both of the same.
        period: of a tick, s.
    """
    # x'' = -2 x' / T - x / T^2: x(t) = (x + (x' + x / T) t) exp(-t / T).
    decay = np.exp(-period / time)
    slope = rate + value / time
    later = (value + slope * period) * decay
    return later, slope * decay - later / time


def _level(pose: Vector) -> Vector:
    """Levels the pose so that the sole is flat, (6,)."""
    flat = pose.copy()
    flat[[_ROLL, _PITCH]] = 0.0
    return flat


def standing() -> FootState:
    """Makes the state of a foot that stands where its plan says."""
    return _unpack(_STANDING)


_STANDING: Vector = np.array([0.0] * 36 + [1.0, 0.0, 0.0])
"""`standing` as numbers: 6 poses and rates, landed, lifted_for, searching."""
_SIZE = len(_STANDING)


def _pack(state: FootState) -> Vector:
    return np.concatenate([*state[:6], state[6:]])


def _unpack(values: Vector) -> FootState:
    landed, lifted_for, searching = values[36:].tolist()
    return FootState._make(
        [*values[:36].reshape(6, 6), landed > 0.5, lifted_for, searching]
    )


class LandingAdaptor(LeafSystem):
    """Lets foot references yield to the ground that the feet feel.

    .. pydrake_system::

        name: LandingAdaptor
        input_ports:
        - foot_references
        - contacts
        - plan_start
        - touching
        - foot_poses
        output_ports:
        - foot_references
        - contacts

    - `foot_references` (input): planned sole frames X_WF (x, y, z, roll, pitch, yaw),
      left then right, then the rates of both, (24,), m, rad, m/s, rad/s.
    - `contacts` (input): planned contact of left and right, 0 or 1, then the length of
      each sole that carries, (4,), -, -, m, m.
    - `plan_start`: start time of the plan, (1,), s; when it changes the new plan is
      taken to begin at the references of this system.
    - `touching`: whether the ground is felt under left and right, 0 or 1, (2,).
    - `foot_poses`: measured sole frames X_WF, left then right, (12,), m and rad.
    - `foot_references` (output): like the input, adapted; of the last tick.
    - `contacts` (output): like the input, but a foot counts when it has landed.

    The discrete state is, a foot, the fields of `FootState` in their order (39), then
    the plan's start; and both outputs.
    """

    def __init__(self, params: LandingParams, foot_poses: Vector) -> None:
        """Declares the ports.

        Args:
            params: see there.
            foot_poses: where the feet stand in the default context, (12,).

        Raises:
            ValueError: a parameter is out of range.
        """
        super().__init__()
        params.validate()
        self._params = params
        memory: Vector = np.concatenate([_STANDING, _STANDING, [0.0]])
        self._memory = int(self.DeclareDiscreteState(memory))
        still: Vector = np.concatenate([foot_poses, np.zeros(12)])
        self._tracked = declare_state_output(self, "foot_references", still)
        self._landed = declare_state_output(self, "contacts", np.ones(4))
        self._references = self.DeclareVectorInputPort("foot_references", 24)
        self._contacts = self.DeclareVectorInputPort("contacts", 4)
        self._plan_start = self.DeclareVectorInputPort("plan_start", 1)
        self._touching = self.DeclareVectorInputPort("touching", 2)
        self._poses = self.DeclareVectorInputPort("foot_poses", 12)
        self.DeclarePeriodicDiscreteUpdateEvent(
            period_sec=params.period, offset_sec=0.0, update=timed(self, self._update)
        )

    def _update(self, context: Context, discrete: DiscreteValues) -> None:
        before = context.get_discrete_state(self._memory).value()
        planned, rates = eval_vector(self._references, context).reshape(2, 2, 6)
        contacts = eval_vector(self._contacts, context)
        start = eval_vector(self._plan_start, context)
        touching = eval_vector(self._touching, context)
        measured = eval_vector(self._poses, context).reshape(2, 6)
        states, poses, speeds, landed = [], [], [], []
        for i in range(2):
            state = _unpack(before[i * _SIZE : (i + 1) * _SIZE])
            if start[0] != before[-1]:
                state = standing()
            state, pose, rate = adapt(
                state,
                planned[i],
                rates[i],
                contacts[i] > 0.5,
                touching[i] > 0.5,
                measured[i],
                self._params,
            )
            states.append(_pack(state))
            poses.append(pose)
            speeds.append(rate)
            landed.append(float(state.landed))
        set_state(discrete, self._memory, np.concatenate([*states, start]))
        set_state(discrete, self._tracked, np.concatenate([*poses, *speeds]))
        set_state(discrete, self._landed, np.array([*landed, *contacts[2:]]))
