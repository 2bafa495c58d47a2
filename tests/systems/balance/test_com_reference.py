"""Horizontal and vertical CoM become one reference."""

import numpy as np

from footfall.systems.balance.com_reference import ComReference
from footfall.systems.ports import eval_vector


def test_joins_position_velocity_and_acceleration() -> None:
    """In that order, x and y from the one side, z from the other."""
    system = ComReference()
    context = system.CreateDefaultContext()
    for name, value in (
        ("com", [1.0, 2.0]),
        ("com_velocity", [4.0, 5.0]),
        ("com_acceleration", [7.0, 8.0]),
        ("com_height", [3.0, 6.0, 9.0]),
    ):
        system.GetInputPort(name).FixValue(context, value)
    port = system.GetOutputPort("com_reference")
    np.testing.assert_array_equal(eval_vector(port, context), np.arange(1.0, 10.0))
    system.GetInputPort("com_height").FixValue(context, [0.0, 6.0, 9.0])
    assert eval_vector(port, context)[2] == 0.0
