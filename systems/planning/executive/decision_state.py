"""What executives have in common: a decision as state, and its fields at ports."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeVar

from pydrake.common.value import AbstractValue
from pydrake.systems.framework import Context, LeafSystem, State

from footfall.systems.callbacks import weakly_bound
from footfall.systems.timing import timed

D = TypeVar("D")


def declare_decisions(
    system: LeafSystem,
    first: D,
    fields: Sequence[str],
    period: float,
    decide: Callable[[Context, D], D],
) -> Callable[[Context], D]:
    """Declares a decision as abstract state, made anew every so often.

    Args:
        system: whose state it is.
        first: the decision of the default context, a frozen dataclass.
        fields: of the decision; each is shown at an abstract output port of its name.
        period: between decisions, s; the first one falls at time 0.
        decide: from the System's context and its last decision to the next.

    Returns:
        From the System's context to its decision.
    """
    index = system.DeclareAbstractState(AbstractValue.Make(first))
    decide = weakly_bound(decide)

    def decision(context: Context) -> D:
        state: Any = context.get_abstract_state(int(index))
        value = state.get_value()
        assert isinstance(value, type(first))
        return value

    def show(field: str) -> Callable[..., None]:
        def calc(context: Context, output: AbstractValue) -> None:
            output.set_value(getattr(decision(context), field))

        return calc

    def update(context: Context, state: State) -> None:
        after = decide(context, decision(context))
        state.get_mutable_abstract_state(int(index)).set_value(after)

    for field in fields:
        system.DeclareAbstractOutputPort(
            field,
            partial(AbstractValue.Make, getattr(first, field)),
            timed(system, show(field)),
            prerequisites_of_calc={system.abstract_state_ticket(index)},
        )
    system.DeclarePeriodicUnrestrictedUpdateEvent(period, 0.0, timed(system, update))
    return decision
