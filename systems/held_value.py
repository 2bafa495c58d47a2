"""Abstract state of one type: the one place that knows Drake's untyped access to it."""

from typing import Any, Generic, TypeVar

from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem, State

T = TypeVar("T")


class HeldValue(Generic[T]):
    """A frozen value that a System holds as abstract state.

    It knows the System by the index and the ticket of the state alone, so that neither
    keeps the other alive.
    """

    def __init__(self, system: LeafSystem, first: T) -> None:
        """Declares the state.

        Args:
            system: whose state it is.
            first: the value in the default context; all that follow are of its type.
        """
        self._kind = type(first)
        index = system.DeclareAbstractState(AbstractValue.Make(first))
        self._index = int(index)
        self.ticket = system.abstract_state_ticket(index)
        """What a cache entry depends on that reads the value."""

    def get(self, context: Context) -> T:
        """Reads the value in the System's context.

        Raises:
            TypeError: another type was written there.
        """
        state: Any = context.get_abstract_state(self._index)
        value = state.get_value()
        if not isinstance(value, self._kind):
            got, wanted = type(value).__name__, self._kind.__name__
            raise TypeError(f"the state holds {got}, expected {wanted}")
        return value

    def set(self, state: State, value: T) -> None:
        """Writes the value, in an unrestricted update."""
        state.get_mutable_abstract_state(self._index).set_value(value)
