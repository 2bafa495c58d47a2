"""Decisions as state: when they are made, from what, and where they show."""

import dataclasses

import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context, LeafSystem

from footfall.models.values.planned import TaskStatus
from footfall.models.values.value import Value
from footfall.systems.planning.executive.decision_state import declare_decisions


@dataclasses.dataclass(frozen=True, eq=False)
class Count(Value):
    """How often it was decided."""

    number: int = 0
    status: TaskStatus = dataclasses.field(default_factory=TaskStatus)


class Counter(LeafSystem):
    """Counts its decisions and says when it made the last."""

    def __init__(self, *fields: str) -> None:
        """Shows these fields."""
        super().__init__()
        self.count = declare_decisions(self, Count(), fields, 0.1, self._decide)

    def _decide(self, context: Context, before: Count) -> Count:
        status = TaskStatus("running", f"{context.get_time():.1f} s")
        return Count(before.number + 1, status)


def test_it_is_decided_every_period_from_the_last_decision() -> None:
    """Beginning at time 0; the default context holds the first."""
    system = Counter("status")
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    status = system.GetOutputPort("status")
    assert status.Eval(context) == TaskStatus()
    for time, number, activity in ((0.05, 1, "0.0 s"), (0.15, 2, "0.1 s")):
        simulator.AdvanceTo(time)
        assert system.count(context).number == number
        assert status.Eval(context) == TaskStatus("running", activity)


def test_only_fields_that_are_asked_for_show() -> None:
    """Each at a port of its name; a field that does not exist is an error."""
    system = Counter("status")
    assert system.num_output_ports() == 1
    assert system.HasOutputPort("status")
    with pytest.raises(AttributeError, match="nothing"):
        Counter("nothing")
