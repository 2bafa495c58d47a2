"""A log of vector signals that shares the evaluation of the controllers."""

import numpy as np
from pydrake.common.value import Value
from pydrake.systems.framework import (
    Context,
    EventStatus,
    InputPort,
    LeafSystem,
    ValueProducer,
)

from footfall.models.values.vector import Vector
from footfall.systems.timing import timed


class SignalLog(LeafSystem):
    """Samples vector signals once a tick, as the controllers see them.

    A tick is sampled in a discrete update, not in a publish event as Drake's
    `VectorLogSink` does. A plant with sampled output ports steps in an unrestricted
    update, which comes after the publish events and before the discrete updates of
    the same time. A sink that publishes therefore has the whole control chain
    evaluated for a state that no controller acts on; this one logs, at no further
    evaluation, the values that the controllers use.

    So a row with time t holds what the controllers use at t. Of a plant of time step
    h that is the state after the step which begins at t, its state at t + h by its
    own count. The first row, t = 0, is sampled at initialization and holds the
    initial state; the later ones follow at multiples of the period. A simulation that
    ends at a tick ends before that tick's updates, hence before its sample.

    Like that of `VectorLogSink` the log lies in the context, in memory, until it is
    cleared.

    .. pydrake_system::

        name: SignalLog
        input_ports: []
        output_ports: []

    It begins without ports; `declare_signal` adds one for each signal.
    """

    def __init__(self, period: float) -> None:
        """Declares when the signals are sampled.

        Args:
            period: time between samples, s; that of the controllers.

        Raises:
            ValueError: the period is not positive.
        """
        super().__init__()
        if not period > 0.0:
            raise ValueError(f"period: must be positive, got {period} s")
        self._signals: list[InputPort] = []
        log = self.DeclareCacheEntry(
            "log",
            ValueProducer(
                allocate=lambda: Value[object]([]),
                calc=ValueProducer.NoopCalc,  # type: ignore[arg-type]
            ),
            {self.nothing_ticket()},
        )
        # The entry itself would keep this System alive.
        self._log = log.cache_index()
        sample = timed(self, self._sample)
        self.DeclareInitializationPublishEvent(sample)
        # With an offset the times of the ticks would differ from the controllers' in
        # their last bits, and an event of its own be made of most of them.
        self.DeclarePeriodicDiscreteUpdateEvent(
            period, 0.0, lambda context, _: sample(context)
        )

    def declare_signal(self, name: str, size: int) -> InputPort:
        """Declares the input port of one more signal, before the diagram is built.

        Args:
            name: of the port.
            size: number of elements.
        """
        port = self.DeclareVectorInputPort(name, size)
        self._signals.append(port)
        return port

    def find_log(self, root_context: Context) -> Vector:
        """Finds the log in a diagram's context: time and all signals, (n, 1 + k)."""
        rows = self._rows(self.GetMyContextFromRoot(root_context))
        width = 1 + sum(port.size() for port in self._signals)
        log: Vector = np.array(rows, dtype=np.float64).reshape(len(rows), width)
        return log

    def clear_log(self, root_context: Context) -> None:
        """Forgets what a diagram's context holds."""
        self._rows(self.GetMyContextFromRoot(root_context)).clear()

    def _rows(self, context: Context) -> list[Vector]:
        entry = self.get_cache_entry(self._log)
        held = entry.get_mutable_cache_entry_value(context)
        rows = held.GetMutableValueOrThrow()
        if not isinstance(rows, list):
            raise TypeError(f"the log holds {type(rows).__name__}, expected a list")
        return rows

    def _sample(self, context: Context) -> EventStatus:
        rows = self._rows(context)
        if rows and rows[-1][0] == context.get_time():
            return EventStatus.DidNothing()
        values = [port.Eval(context) for port in self._signals]
        row: Vector = np.concatenate([[context.get_time()], *values])
        rows.append(row)
        return EventStatus.Succeeded()
