"""A log of an abstract port, which Drake's own log sinks do not take."""

from dataclasses import dataclass

from pydrake.common.value import AbstractValue, Value
from pydrake.systems.framework import (
    Context,
    EventStatus,
    LeafSystem,
    ValueProducer,
)

from footfall.systems.timing import timed


@dataclass(frozen=True)
class LoggedValue:
    """What a port carried from one moment on."""

    time: float
    """When the port was first seen to carry it, s."""
    value: object
    """The value itself."""


class ValueLogSink(LeafSystem):
    """Keeps the values of an abstract port, one entry each time the value changes.

    A value that is the last one (the same object, or equal to it) is not kept again.
    Like Drake's `VectorLogSink`, the log lies in the context, in memory. The values
    are kept, not copied, so they must be immutable, as those of
    `footfall.models.values` are.

    .. pydrake_system::

        name: ValueLogSink
        input_ports:
        - value
        output_ports: []

    - `value`: what is logged, abstract.
    """

    def __init__(self, model_value: AbstractValue, period: float) -> None:
        """Declares the port and when it is looked at.

        Args:
            model_value: a value of the type that the port will carry.
            period: time between two looks, s.

        Raises:
            ValueError: the period is not positive.
        """
        super().__init__()
        if not period > 0.0:
            raise ValueError(f"period: must be positive, got {period} s")
        self._value = self.DeclareAbstractInputPort("value", model_value)
        entry = self.DeclareCacheEntry(
            "log",
            ValueProducer(
                allocate=lambda: Value[object]([]),
                calc=ValueProducer.NoopCalc,  # type: ignore[arg-type]
            ),
            {self.nothing_ticket()},
        )
        # An entry that the System held would keep it alive for ever.
        self._log = entry.cache_index()
        append = timed(self, self._append)
        self.DeclarePeriodicPublishEvent(period, 0.0, append)
        self.DeclareForcedPublishEvent(append)

    def find_log(self, root_context: Context) -> tuple[LoggedValue, ...]:
        """Everything that was logged in a diagram's context, in order of time."""
        return tuple(self._entries(self.GetMyContextFromRoot(root_context)))

    def forget_log(self, root_context: Context) -> None:
        """Forgets all but the last entry, by which the next change is seen."""
        del self._entries(self.GetMyContextFromRoot(root_context))[:-1]

    def _entries(self, context: Context) -> list[LoggedValue]:
        entry = self.get_cache_entry(self._log)
        held = entry.get_mutable_cache_entry_value(context)
        entries = held.GetMutableValueOrThrow()
        if not isinstance(entries, list):
            raise TypeError(f"the log holds {type(entries).__name__}, expected a list")
        return entries

    def _append(self, context: Context) -> EventStatus:
        value = self._value.Eval(context)
        entries = self._entries(context)
        if not entries or (
            entries[-1].value is not value and entries[-1].value != value
        ):
            entries.append(LoggedValue(context.get_time(), value))
        return EventStatus.Succeeded()
