"""The log of abstract ports."""

import pytest
from pydrake.common.value import AbstractValue, Value
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context, Diagram, DiagramBuilder, LeafSystem

from footfall.models.values.planned import TaskStatus
from footfall.systems.value_log_sink import ValueLogSink


class Alternating(LeafSystem):
    """Says "move" in every odd second; each time a new, equal object."""

    def __init__(self) -> None:
        super().__init__()
        self.DeclareAbstractOutputPort(
            "status", lambda: Value[object](TaskStatus()), self._calc
        )

    def _calc(self, context: Context, output: AbstractValue) -> None:
        odd = int(context.get_time() + 1e-9) % 2 == 1
        output.set_value(TaskStatus(activity="move" if odd else "stand"))


def logged_diagram(period: float) -> tuple[Diagram, ValueLogSink]:
    """The source and its log."""
    builder = DiagramBuilder()
    source = builder.AddNamedSystem("source", Alternating())
    port = source.GetOutputPort("status")
    sink = builder.AddNamedSystem("log", ValueLogSink(port.Allocate(), period))
    builder.Connect(port, sink.GetInputPort("value"))
    return builder.Build(), sink


def test_only_changes_are_kept() -> None:
    """Equal values in a row are one entry, with the time it was first seen."""
    diagram, sink = logged_diagram(0.25)
    simulator = Simulator(diagram)
    simulator.AdvanceTo(3.6)
    log = sink.find_log(simulator.get_context())
    assert [(entry.time, entry.value.activity) for entry in log] == [
        (0.0, "stand"),
        (1.0, "move"),
        (2.0, "stand"),
        (3.0, "move"),
    ]


def test_each_context_has_its_own_log() -> None:
    """The log is no attribute of the system."""
    diagram, sink = logged_diagram(0.25)
    first, second = Simulator(diagram), Simulator(diagram)
    first.AdvanceTo(1.5)
    second.AdvanceTo(0.5)
    assert len(sink.find_log(first.get_context())) == 2
    assert len(sink.find_log(second.get_context())) == 1
    assert sink.find_log(diagram.CreateDefaultContext()) == ()


def test_forced_publish_looks_too() -> None:
    """As with Drake's own sinks."""
    diagram, sink = logged_diagram(10.0)
    context = diagram.CreateDefaultContext()
    context.SetTime(1.5)
    diagram.ForcedPublish(context)
    assert [entry.time for entry in sink.find_log(context)] == [1.5]


def test_period_must_be_positive() -> None:
    """A zero would log at every step of the integrator."""
    with pytest.raises(ValueError, match=r"period: must be positive, got 0\.0 s"):
        ValueLogSink(Value(""), 0.0)
