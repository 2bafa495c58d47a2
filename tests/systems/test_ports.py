"""Typed access to ports."""

import numpy as np
import pytest
from pydrake.common.value import Value
from pydrake.systems.framework import BasicVector
from pydrake.systems.primitives import ConstantValueSource, ConstantVectorSource

from footfall.models.values.perceived import Staircase
from footfall.models.values.planned import TaskStatus
from footfall.systems.ports import eval_abstract, eval_vector, set_vector


def test_vector_is_a_copy_that_may_be_kept() -> None:
    """Writing to it does not write to Drake's cache."""
    source = ConstantVectorSource([1.0, 2.0])
    context = source.CreateDefaultContext()
    value = eval_vector(source.get_output_port(), context)
    value[0] = 7.0
    np.testing.assert_array_equal(
        eval_vector(source.get_output_port(), context), [1.0, 2.0]
    )
    assert value.dtype == np.float64


def test_set_vector_writes_every_element() -> None:
    """And refuses another size."""
    output = BasicVector(3)
    set_vector(output, np.array([1.0, 2.0, 3.0]))
    np.testing.assert_array_equal(output.value(), [1.0, 2.0, 3.0])
    with pytest.raises(IndexError, match="does not match"):
        set_vector(output, np.zeros(2))


def test_abstract_value_of_the_wrong_type_is_named() -> None:
    """The error says which port carries what."""
    source = ConstantValueSource(Value[object](TaskStatus("finished")))
    context = source.CreateDefaultContext()
    port = source.get_output_port()
    assert eval_abstract(port, context, TaskStatus).state == "finished"
    with pytest.raises(TypeError, match="y0 carries TaskStatus, expected Staircase"):
        eval_abstract(port, context, Staircase)
