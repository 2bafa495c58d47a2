"""Intermediate results in a System's cache: computed once however many ports ask."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

from pydrake.common.value import Value
from pydrake.systems.framework import CacheIndex, Context, LeafSystem, ValueProducer

from footfall.systems.callbacks import weakly_bound

T = TypeVar("T")


class _Entry:
    """A cache entry, found again by its index: itself it would keep the System."""

    def __init__(self, system: LeafSystem, calc: Callable[[Context], object]) -> None:
        self._system, self._calc = system, weakly_bound(calc)
        self.index: CacheIndex | None = None

    def fill(self, context: Context, value: Any) -> None:
        value.set_value(self._calc(context))

    def get(self, context: Context) -> object:
        assert self.index is not None
        return self._system.get_cache_entry(self.index).Eval(context)


def declare_cached(
    system: LeafSystem, name: str, calc: Callable[[Context], T], tickets: set[Any]
) -> Callable[[Context], T]:
    """Declares a result that a System computes at most once for the same inputs.

    Args:
        system: whose cache holds it.
        name: of the entry.
        calc: computes it; what it gives must not be changed.
        tickets: all that it depends on.

    Returns:
        From the System's context to the result; the System has to hold it.
    """
    kept = _Entry(system, calc)
    entry = system.DeclareCacheEntry(
        name,
        ValueProducer(
            allocate=lambda: Value[object](None),
            calc=weakly_bound(kept.fill),  # type: ignore[arg-type]
        ),
        tickets,
    )
    kept.index = entry.cache_index()
    return cast(Callable[[Context], T], kept.get)
