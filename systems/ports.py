"""Typed access to ports: the one place that knows pydrake's untyped edges."""

from typing import TypeVar

import numpy as np
from pydrake.systems.framework import BasicVector, Context, InputPort, OutputPort

from footfall.models.values.vector import Vector

T = TypeVar("T")


def eval_vector(port: InputPort | OutputPort, context: Context) -> Vector:
    """Evaluates a vector port, shape (n,), as an array that may be kept."""
    return np.array(port.Eval(context), dtype=float)


def set_vector(output: BasicVector, value: Vector) -> None:
    """Writes `value`, shape (n,), to an output port's vector."""
    output.get_mutable_value()[:] = value


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
