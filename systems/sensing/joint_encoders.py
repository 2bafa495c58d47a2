"""Encoders in the joints: positions in steps, velocities as a drive derives them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from pydrake.systems.framework import Context, DiscreteValues, LeafSystem

from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.ports import (
    declare_state,
    declare_state_output,
    read_state,
    set_state,
)
from footfall.systems.sensing.sampling import latency_steps, shifted
from footfall.systems.timing import timed


@dataclass(kw_only=True)
class JointEncoderParams(Parameters):
    """What the encoders resolve, and when they are heard."""

    resolution: float = number(1.2e-5, "rad", least=0.0, most=0.1)
    """Step of a position, rad: 19 bits a turn at the joint; 0 for none."""
    bandwidth: float = number(100.0, "Hz", above=0.0)
    """Of the low pass of first order behind the difference of two positions, Hz."""
    latency: float = number(0.0025, "s", least=0.0, most=0.1)
    """How late a sample arrives, s; at least a step of the plant."""
    stuck_joints: list[str] = field(default_factory=list)
    """Joints whose encoders stick from `sticks_at` on."""
    sticks_at: float = number(0.0, "s", least=0.0)
    """When they do, s."""


class JointEncoders(LeafSystem):
    """Samples the joints at every step of the plant.

    .. pydrake_system::

        name: JointEncoders
        input_ports:
        - state
        output_ports:
        - joints

    - `state`: true positions and velocities of the robot, (nq + nv,); of them only the
      joints' positions are read.
    - `joints`: measured positions, then velocities of the joints in the order of the
      state, (2 n,), rad, rad/s.
    """

    def __init__(
        self,
        params: JointEncoderParams,
        period: float,
        joints: Sequence[str],
        positions: Vector,
        width: int,
    ) -> None:
        """Declares ports, state and the update.

        Args:
            params: resolution, filter and latency.
            period: the plant's time step, s.
            joints: the last n names of the robot's positions, those of its joints.
            positions: of the joints in the default context, (n,), rad.
            width: nq + nv of the robot.

        Raises:
            ValueError: a parameter is wrong, or a joint has other than one freedom.
        """
        super().__init__()
        params.validate()
        self._params, self._period = params, period
        count = len(joints)
        if width != 13 + 2 * count:
            raise ValueError(
                f"width: must be {13 + 2 * count} for a floating base and {count} "
                f"joints of one freedom, got {width}"
            )
        self._columns = slice(7, 7 + count)
        self._count = count
        self._keep = math.exp(-2.0 * math.pi * params.bandwidth * period)
        self._stuck: Vector = np.array([name in params.stuck_joints for name in joints])
        self._steps = latency_steps(params.latency, period)
        first = np.concatenate([self._read(positions), np.zeros(count)])
        self._clock = declare_state(self, np.zeros(1))
        self._waiting = declare_state(self, np.tile(first, self._steps))
        self._output = declare_state_output(self, "joints", first)
        self._state = self.DeclareVectorInputPort("state", width)
        self.DeclarePeriodicDiscreteUpdateEvent(period, 0.0, timed(self, self._update))

    def _read(self, positions: Vector) -> Vector:
        step = self._params.resolution
        return np.round(positions / step) * step if step > 0.0 else positions

    def _update(self, context: Context, state: DiscreteValues) -> None:
        step = read_state(context, self._clock)[0]
        waiting = read_state(context, self._waiting)
        waiting = waiting.reshape(self._steps, -1)
        q_before, v_before = waiting[-1, : self._count], waiting[-1, self._count :]
        true: Vector = self._state.Eval(context)  # type: ignore[assignment]
        q = self._read(true[self._columns])
        if self._stuck.any() and step * self._period >= self._params.sticks_at:
            q = np.where(self._stuck, q_before, q)
        v = (q - q_before) / self._period
        v += self._keep * (v_before - v)
        waiting = shifted(waiting, np.concatenate([q, v]))
        set_state(state, self._clock, np.array([step + 1.0]))
        set_state(state, self._waiting, waiting.ravel())
        set_state(state, self._output, waiting[0])
