"""How far the filter trusts its sensors, and how its equations take that."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.balance.zmp_preview import GRAVITY

SIZE = 27
"""Elements of the error."""


class Rows:
    """Where each part of the error is."""

    R = slice(0, 3)
    """Of the base's orientation, rad."""
    v = slice(3, 6)
    """Of its velocity, m/s."""
    p = slice(6, 9)
    """Of its position, m."""
    d = (slice(9, 12), slice(15, 18))
    """Of the feet's positions, m."""
    C = (slice(12, 15), slice(18, 21))
    """Of their orientations, rad."""
    b_g = slice(21, 24)
    """Of the gyroscope's bias, rad/s."""
    b_a = slice(24, 27)
    """Of the accelerometer's, m/s^2."""


@dataclass(kw_only=True)
class FilterParams(Parameters):
    """How much the filter trusts its sensors, as standard deviations."""

    gyroscope: float = number(3e-4, "rad/s", least=1e-9)
    """White noise of the angular rate, rad/s per root Hz: twice the sensor's own, for
    what vibration adds."""
    accelerometer: float = number(2e-2, "m/s^2", least=1e-9)
    """White noise of the specific force, m/s^2 per root Hz: over the sensor's own, for
    a base that bends and for what is averaged over a tick."""
    gyroscope_walk: float = number(2e-5, "rad/s", least=0.0)
    """How its bias wanders, rad/s per root second."""
    accelerometer_walk: float = number(1e-4, "m/s^2", least=0.0)
    """The same of the accelerometer, m/s^2 per root second."""
    contact: float = number(2e-3, "m/s", least=0.0)
    """How a bearing sole creeps while the robot moves, m/s per root Hz."""
    contact_turn: float = number(3e-2, "rad/s", least=0.0)
    """How a bearing sole turns meanwhile, rad/s per root Hz: rubber yields and twists;
    the gyroscope knows better."""
    rest_contact: float = number(5e-4, "m/s", least=0.0)
    """How a bearing sole creeps while all joints are at rest, m/s per root Hz."""
    rest_contact_turn: float = number(2e-4, "rad/s", least=0.0)
    """How it turns meanwhile, rad/s per root Hz: hardly, which tells the gyroscope's
    bias."""
    rest_speed: float = number(0.03, "rad/s", least=0.0)
    """Joints that are slower than this, all of them, rad/s, are at rest."""
    foot_position: float = number(1e-3, "m", above=0.0)
    """Of a sole seen from the base by the encoders, m."""
    foot_turn: float = number(2e-3, "rad", above=0.0)
    """The same of its orientation, rad."""
    rest_foot_turn: float = number(3e-4, "rad", above=0.0)
    """The same while all joints are at rest and no leg bends, rad: it tells the
    gyroscope's bias in a second."""
    slip_gate: float = number(50.0, above=0.0)
    """Squared Mahalanobis distance of a foot's innovation (6 numbers) beyond which it
    is not where it stood: it slipped or rolled, and stands anew where it is."""
    gain_time: float = number(0.04, "s", least=0.0, most=0.1)
    """So long a gain is kept while the same feet bear, s; 0 computes it every tick."""
    foothold: float = number(2e-3, "m", above=0.0)
    """Of a sole from the ground that it lies on, as its place is known, m."""
    foothold_time: float = number(0.1, "s", least=0.0)
    """So long a sole has borne load until it lies, s."""
    foothold_gate: float = number(9.0, above=0.0)
    """Squared distance from that ground, in deviations, beyond which a sole stands on
    something else."""
    lead: float = number(0.0025, "s", least=0.0, most=0.1)
    """How far the state is told ahead of the latest sample, s, base and joints going on
    as they go: by default the latency of the sensors."""
    start_tilt: float = number(0.01, "rad", least=0.0)
    """Of the tilt that it begins with, rad."""
    start_gyroscope_bias: float = number(5e-3, "rad/s", least=0.0)
    """What the gyroscope's bias may be at the start, rad/s."""
    start_accelerometer_bias: float = number(2e-2, "m/s^2", least=0.0)
    """What the accelerometer's bias may be at the start, m/s^2."""


class FilterModel(NamedTuple):
    """The filter's parameters as its equations take them, and gravity."""

    inertial: Vector
    """Deviations of gyroscope and accelerometer, per root Hz, (6,)."""
    wander: Vector
    """Variances that feet and biases gain in a second, (27,)."""
    foot: Vector
    """Variances of a sole seen from the base, position then turn, (6,)."""
    slip_gate: float
    gain_time: float
    """s; a tick's rounding below the parameter."""
    gravity: float
    """m/s^2."""
    at_rest: bool
    """Whether it is of a robot of which no joint moves."""


def filter_model(
    params: FilterParams, gravity: float = GRAVITY, at_rest: bool = False
) -> FilterModel:
    """Lays the parameters out for the filter.

    Args:
        params: of the filter.
        gravity: m/s^2.
        at_rest: of a robot of which no joint moves.
    """
    creep, turn, foot_turn = params.contact, params.contact_turn, params.foot_turn
    if at_rest:
        creep, turn = params.rest_contact, params.rest_contact_turn
        foot_turn = params.rest_foot_turn
    wander = np.zeros(SIZE)
    wander[Rows.b_g] = params.gyroscope_walk**2
    wander[Rows.b_a] = params.accelerometer_walk**2
    for i in range(2):
        wander[Rows.d[i]] = creep**2
        wander[Rows.C[i]] = turn**2
    return FilterModel(
        np.repeat([params.gyroscope, params.accelerometer], 3),
        wander,
        np.repeat([params.foot_position**2, foot_turn**2], 3),
        params.slip_gate,
        params.gain_time - 1e-6,
        gravity,
        at_rest,
    )
