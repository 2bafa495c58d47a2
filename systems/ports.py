"""Typed access to ports: the one place that knows pydrake's untyped edges."""

from typing import TypeVar

import numpy as np
from pydrake.systems.framework import (
    BasicVector,
    Context,
    DiscreteValues,
    InputPort,
    LeafSystem,
    OutputPort,
)

from footfall.models.values.vector import Vector

T = TypeVar("T")


def eval_vector(port: InputPort | OutputPort, context: Context) -> Vector:
    """Evaluates a vector port, shape (n,), as an array that may be kept and changed."""
    # Of a vector port pydrake gives a copy.
    value: Vector = port.Eval(context)  # type: ignore[assignment]
    return value


def set_vector(output: BasicVector, value: Vector) -> None:
    """Writes `value`, shape (n,), to an output port's vector."""
    output.SetFromVector(value)


def declare_state_output(system: LeafSystem, name: str, initial: Vector) -> int:
    """Declares a group of discrete state that is an output, too.

    Drake itself gives such an output; no callback of the System's is asked.

    Args:
        system: whose.
        name: of the port.
        initial: in the default context, (n,).

    Returns:
        Index of the group.
    """
    value: Vector = np.array(initial, dtype=np.float64)
    state = system.DeclareDiscreteState(value)
    system.DeclareStateOutputPort(name, state)
    return int(state)


def read_state(context: Context, index: int) -> Vector:
    """Reads a group of discrete state, shape (n,)."""
    value: Vector = context.get_discrete_state(int(index)).value()
    return value


def declare_state(system: LeafSystem, initial: Vector) -> int:
    """Declares a group of discrete state; gives its index.

    Args:
        system: whose.
        initial: in the default context, (n,).
    """
    value: Vector = np.array(initial, dtype=np.float64)
    return int(system.DeclareDiscreteState(value))


def set_state(discrete: DiscreteValues, index: int, value: Vector) -> None:
    """Writes a group of discrete state, shape (n,), in an update."""
    discrete.set_value(index, value)


def eval_abstract(port: InputPort | OutputPort, context: Context, kind: type[T]) -> T:
    """Evaluates an abstract port.

    Raises:
        TypeError: the port carries something else than a `kind`.
    """
    value = port.Eval(context)
    if not isinstance(value, kind):
        raise TypeError(
            f"port {port.get_name()} carries {type(value).__name__}, "
            f"expected {kind.__name__}"
        )
    return value
