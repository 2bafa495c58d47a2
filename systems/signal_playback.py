"""Plays a logged signal back: what a System gave then, for others to take again."""

import numpy as np
from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.models.values.vector import Vector
from footfall.systems.ports import set_vector
from footfall.systems.timing import timed

_ROUNDING = 1e-9
"""Between the time of a tick and that of its sample, s."""


class SignalPlayback(LeafSystem):
    """Gives the sample that was logged last before now.

    .. pydrake_system::

        name: SignalPlayback
        input_ports: []
        output_ports:
        - signal

    - `signal`: the sample, (n,); before the first one the first.
    """

    def __init__(self, time: Vector, samples: Vector) -> None:
        """Declares the port.

        Args:
            time: when they were logged, rising, (m,), s.
            samples: (m, n).

        Raises:
            ValueError: there are none, or not one a time.
        """
        super().__init__()
        if not len(time) or len(time) != len(samples):
            raise ValueError(
                f"samples: must be one a time, got {len(samples)} at {len(time)} times"
            )
        self._time, self._samples = time, samples
        self.DeclareVectorOutputPort(
            "signal",
            samples.shape[1],
            timed(self, self._calc),
            prerequisites_of_calc={self.time_ticket()},
        )

    def _calc(self, context: Context, signal: BasicVector) -> None:
        now = context.get_time() + _ROUNDING
        row = max(0, int(np.searchsorted(self._time, now, side="right")) - 1)
        set_vector(signal, self._samples[row])
