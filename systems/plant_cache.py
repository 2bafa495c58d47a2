"""Contexts of a plant that live in a System's cache: scratch space for kinematics."""

from collections.abc import Callable

from pydrake.common.value import Value
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Context, InputPort, LeafSystem, ValueProducer

from systems.ports import eval_vector


class _Scratch:
    """A plant's context; a clone of the System's context gets a clone of it.

    A clone at the default state would not do: the System's cache entries are copied
    together with the mark that they are up to date.
    """

    def __init__(self, context: Context) -> None:
        self.context = context

    def __deepcopy__(self, memo: dict[int, object]) -> "_Scratch":
        return _Scratch(self.context.Clone())


def declare_scratch_context(
    system: LeafSystem, plant: MultibodyPlant
) -> Callable[[Context], Context]:
    """Declares a plant context that callbacks may set as they like.

    Args:
        system: whose cache holds it.
        plant: finalised.

    Returns:
        From the System's context to the plant's.
    """
    entry = system.DeclareCacheEntry(
        "scratch plant context",
        ValueProducer(
            allocate=lambda: Value[object](_Scratch(plant.CreateDefaultContext())),
            calc=ValueProducer.NoopCalc,  # type: ignore[arg-type]
        ),
        {system.nothing_ticket()},
    )

    def scratch(context: Context) -> Context:
        value = entry.get_mutable_cache_entry_value(context)
        holder = value.GetMutableValueOrThrow()
        assert isinstance(holder, _Scratch)
        return holder.context

    return scratch


def declare_state_context(
    system: LeafSystem, plant: MultibodyPlant, state: InputPort
) -> Callable[[Context], Context]:
    """Declares a plant context that follows a state input: its kinematics, cached.

    Args:
        system: whose cache holds it.
        plant: finalised.
        state: input port of the System with the plant's positions and velocities.

    Returns:
        From the System's context to the plant's, set to the present state.
    """

    def calc(context: object, value: object) -> None:
        holder = value.get_mutable_value()  # type: ignore[attr-defined]
        plant.SetPositionsAndVelocities(
            holder.context,
            eval_vector(state, context),  # type: ignore[arg-type]
        )

    entry = system.DeclareCacheEntry(
        "plant context at the input's state",
        ValueProducer(
            allocate=lambda: Value[object](_Scratch(plant.CreateDefaultContext())),
            calc=calc,
        ),
        {state.ticket()},
    )

    def at_state(context: Context) -> Context:
        holder = entry.Eval(context)
        assert isinstance(holder, _Scratch)
        return holder.context

    return at_state
