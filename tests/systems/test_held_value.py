"""A value as abstract state: it is read as it was written, by its type."""

from dataclasses import dataclass

import pytest
from pydrake.systems.framework import LeafSystem, State

from footfall.systems.held_value import HeldValue


@dataclass(frozen=True)
class Count:
    """How often something happened."""

    n: int = 0


class Counter(LeafSystem):
    """Counts its own updates."""

    def __init__(self) -> None:
        """One update a second."""
        super().__init__()
        self.held = HeldValue(self, Count())
        self.DeclarePeriodicUnrestrictedUpdateEvent(1.0, 0.0, self._count)

    def _count(self, context, state: State) -> None:
        self.held.set(state, Count(self.held.get(context).n + 1))


def test_it_holds_what_was_written() -> None:
    """Two updates after the first value."""
    system = Counter()
    context = system.CreateDefaultContext()
    assert system.held.get(context) == Count(0)
    for n in (1, 2):
        state = context.Clone().get_mutable_state()
        system.CalcForcedUnrestrictedUpdate(context, state)
        system.held.set(context.get_mutable_state(), Count(n))
        assert system.held.get(context) == Count(n)


def test_another_type_is_told() -> None:
    """Whoever writes past it learns of it at the next look."""
    system = Counter()
    context = system.CreateDefaultContext()
    context.get_mutable_state().get_mutable_abstract_state(0).set_value("seven")
    with pytest.raises(TypeError, match="holds str, expected Count"):
        system.held.get(context)


def test_it_does_not_hold_the_system() -> None:
    """Drake keeps callbacks for ever; what they hold would stay with them."""
    system = Counter()
    assert not any(part is system for part in vars(system.held).values())
