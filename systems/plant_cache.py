"""Contexts of a plant that live in a System's cache: scratch space for kinematics."""

from collections.abc import Callable
from typing import Any

from pydrake.common.value import Value
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import (
    CacheEntry,
    CacheIndex,
    Context,
    InputPort,
    LeafSystem,
    ValueProducer,
)

from footfall.systems.callbacks import weakly_bound
from footfall.systems.ports import eval_vector


class _Scratch:
    """A plant's context; a clone of the System's context gets a clone of it.

    A clone at the default state would not do: the System's cache entries are copied
    together with the mark that they are up to date.
    """

    def __init__(self, context: Context) -> None:
        self.context = context

    def __deepcopy__(self, memo: dict[int, object]) -> "_Scratch":
        return _Scratch(self.context.Clone())


class _PlantContexts:
    """A plant's context in the cache of every context of a System.

    The System holds this, and Drake's callbacks hold it weakly: the plant may be part
    of the same diagram, which they would keep alive for ever.
    """

    def __init__(
        self, system: LeafSystem, plant: MultibodyPlant, state: InputPort | None = None
    ) -> None:
        self._system = system
        self._plant = plant
        self._state = state
        self.index: CacheIndex | None = None

    def allocate(self) -> Value[object]:
        return Value[object](_Scratch(self._plant.CreateDefaultContext()))

    def follow(self, context: Context, value: Any) -> None:
        assert self._state is not None
        state = eval_vector(self._state, context)
        self._plant.SetPositionsAndVelocities(value.get_mutable_value().context, state)

    def scratch(self, context: Context) -> Context:
        entry = self._entry()
        value = entry.get_mutable_cache_entry_value(context)
        holder = value.GetMutableValueOrThrow()
        assert isinstance(holder, _Scratch)
        return holder.context

    def at_state(self, context: Context) -> Context:
        holder = self._entry().Eval(context)
        assert isinstance(holder, _Scratch)
        return holder.context

    def _entry(self) -> CacheEntry:
        assert self.index is not None
        return self._system.get_cache_entry(self.index)


def declare_scratch_context(
    system: LeafSystem, plant: MultibodyPlant
) -> Callable[[Context], Context]:
    """Declares a plant context that callbacks may set as they like.

    Args:
        system: whose cache holds it.
        plant: finalised.

    Returns:
        From the System's context to the plant's; the System has to hold it.
    """
    contexts = _PlantContexts(system, plant)
    entry = system.DeclareCacheEntry(
        "scratch plant context",
        ValueProducer(
            allocate=weakly_bound(contexts.allocate),
            calc=ValueProducer.NoopCalc,  # type: ignore[arg-type]
        ),
        {system.nothing_ticket()},
    )
    contexts.index = entry.cache_index()
    return contexts.scratch


def declare_state_context(
    system: LeafSystem, plant: MultibodyPlant, state: InputPort
) -> Callable[[Context], Context]:
    """Declares a plant context that follows a state input: its kinematics, cached.

    Args:
        system: whose cache holds it.
        plant: finalised.
        state: input port of the System with the plant's positions and velocities.

    Returns:
        From the System's context to the plant's, set to the present state; the System
        has to hold it.
    """
    contexts = _PlantContexts(system, plant, state)
    entry = system.DeclareCacheEntry(
        "plant context at the input's state",
        ValueProducer(
            allocate=weakly_bound(contexts.allocate),
            calc=weakly_bound(contexts.follow),  # type: ignore[arg-type]
        ),
        {state.ticket()},
    )
    contexts.index = entry.cache_index()
    return contexts.at_state
