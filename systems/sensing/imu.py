"""An inertial measurement unit: what turns and pulls at the pelvis, as MEMS feel it."""

import math
from dataclasses import dataclass

import numpy as np
from pydrake.systems.framework import Context, DiscreteValues, LeafSystem

from footfall.models.values.validation import MAX_SEED, Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.ports import (
    declare_state,
    declare_state_output,
    eval_vector,
    read_state,
    set_state,
)
from footfall.systems.sensing.sampling import NoiseSource, latency_steps, shifted
from footfall.systems.timing import timed

STANDARD_GRAVITY = 9.80665
"""m/s^2, by which data sheets give accelerations."""


@dataclass(kw_only=True)
class ImuParams(Parameters):
    """Noise of the unit; by default that of an Analog Devices ADIS16470.

    Its data sheet gives the rate noise density as 0.008 deg/s per root Hz, the in-run
    bias stability as 8 deg/h and 13 micro-g; noise density of the accelerometer and
    the bias that is left after switching on are of its class.
    """

    gyroscope_noise: float = number(1.4e-4, "rad/s", least=0.0, most=1.0)
    """White noise of the angular rate, rad/s per root Hz."""
    accelerometer_noise: float = number(1e-3, "m/s^2", least=0.0, most=10.0)
    """White noise of the specific force, m/s^2 per root Hz."""
    gyroscope_bias: float = number(2e-3, "rad/s", least=0.0, most=1.0)
    """Deviation of the bias that a start draws, rad/s."""
    accelerometer_bias: float = number(1.5e-2, "m/s^2", least=0.0, most=10.0)
    """Deviation of the bias that a start draws, m/s^2."""
    gyroscope_walk: float = number(4e-6, "rad/s", least=0.0, most=1.0)
    """How the bias wanders, rad/s per root second: 8 deg/h in 100 s."""
    accelerometer_walk: float = number(1.3e-5, "m/s^2", least=0.0, most=1.0)
    """How the bias wanders, m/s^2 per root second: 13 micro-g in 100 s."""
    latency: float = number(0.0025, "s", least=0.0, most=0.1)
    """How late a sample arrives, s; at least a step of the plant."""
    fails_at: float | None = number(None, "s", least=0.0)
    """When the unit falls silent, s; null for never."""
    seed: int = number(0, least=0, most=MAX_SEED)
    """Of noise and biases; `simulation.seed` is added."""


class Imu(LeafSystem):
    """Integrates what an accelerometer and a gyroscope feel at every step of the plant.

    It gives integrals, as units do that sum inside faster than they are read: whoever
    reads takes the difference to what he read last, at any rate, and loses nothing.

    .. pydrake_system::

        name: Imu
        input_ports:
        - angular_rate
        - specific_force
        output_ports:
        - integrals

    - `angular_rate`: true, of the unit in itself, (3,), rad/s.
    - `specific_force`: true, acceleration less gravity, in the unit, (3,), m/s^2.
    - `integrals`: time of the latest sample that has arrived, s, then the integrals of
      the angular rate, rad, and of the specific force, m/s, since the start, (7,).
    """

    def __init__(self, params: ImuParams, period: float) -> None:
        """Declares ports, state and the update.

        Args:
            params: noise.
            period: the plant's time step, s.

        Raises:
            ValueError: a parameter is wrong.
        """
        super().__init__()
        params.validate()
        self._params, self._period = params, period
        start = NoiseSource(params.seed, "imu bias", 6).at(0)
        sizes = np.repeat([params.gyroscope_bias, params.accelerometer_bias], 3)
        noise = np.repeat([params.gyroscope_noise, params.accelerometer_noise], 3)
        walk = np.repeat([params.gyroscope_walk, params.accelerometer_walk], 3)
        self._noise: Vector = noise * math.sqrt(period)
        self._walk: Vector = walk * math.sqrt(period)
        self._white = NoiseSource(params.seed, "imu", 12)
        self._steps = latency_steps(params.latency, period)
        self._inner = declare_state(self, np.concatenate([[0.0], sizes * start]))
        waiting: Vector = np.zeros(7 * self._steps)
        self._waiting = declare_state(self, waiting)
        self._output = declare_state_output(self, "integrals", np.zeros(7))
        self._rate = self.DeclareVectorInputPort("angular_rate", 3)
        self._force = self.DeclareVectorInputPort("specific_force", 3)
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))

    def _update(self, context: Context, state: DiscreteValues) -> None:
        inner = read_state(context, self._inner)
        waiting = read_state(context, self._waiting).reshape(-1, 7)
        step, bias = int(inner[0]), inner[1:]
        failed = self._params.fails_at
        if failed is not None and step * self._period >= failed:
            return
        white = self._white.at(step)
        felt = np.concatenate(
            [eval_vector(self._rate, context), eval_vector(self._force, context)]
        )
        newest = np.empty(7)
        newest[0] = (step + 1) * self._period
        newest[1:] = waiting[-1, 1:] + (felt + bias) * self._period
        newest[1:] += self._noise * white[:6]
        waiting = shifted(waiting, newest)
        bias = bias + self._walk * white[6:]
        set_state(state, self._inner, np.concatenate([[step + 1.0], bias]))
        set_state(state, self._waiting, waiting.ravel())
        set_state(state, self._output, waiting[0])
