"""Adding systems to a builder."""

from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import Gain

from footfall.diagrams.closed_loop.wiring import add_system


def test_the_system_comes_back_under_its_name() -> None:
    """The same object, with its own type."""
    builder, gain = DiagramBuilder(), Gain(k=2.0, size=1)
    assert add_system(builder, "twice", gain) is gain
    assert builder.GetSubsystemByName("twice") is gain
