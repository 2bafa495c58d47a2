"""The log of vector signals: what a sample holds, and what it costs."""

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import (
    BasicVector,
    Context,
    Diagram,
    DiagramBuilder,
    LeafSystem,
    State,
)
from pydrake.systems.primitives import ZeroOrderHold

from footfall.systems.signal_log import SignalLog

STEP, TICK = 0.0025, 0.005
"""Of the plant and of the controllers, s."""


class Plant(LeafSystem):
    """Counts its steps, which it takes as Drake's sampled plant does."""

    def __init__(self) -> None:
        super().__init__()
        steps = self.DeclareDiscreteState(1)
        self.DeclarePeriodicUnrestrictedUpdateEvent(STEP, 0.0, self._step)
        self.DeclareStateOutputPort("steps", steps)

    def _step(self, context: Context, state: State) -> None:
        state.get_mutable_discrete_state().get_mutable_vector(0)[0] += 1.0


class Controller(LeafSystem):
    """Ten times what it measures, and by the way how often it was asked."""

    def __init__(self) -> None:
        super().__init__()
        self.calls = 0
        measured = self.DeclareVectorInputPort("measured", 1)

        def calc(context: Context, output: BasicVector) -> None:
            self.calls += 1
            output.SetFromVector(10.0 * measured.Eval(context))

        self.DeclareVectorOutputPort(
            "command", 1, calc, prerequisites_of_calc={measured.ticket()}
        )


def closed_loop() -> tuple[Diagram, Controller, ZeroOrderHold, SignalLog]:
    """Plant, controller and a hold that uses its command; both signals logged."""
    builder = DiagramBuilder()
    log = builder.AddSystem(SignalLog(TICK))
    plant, controller = builder.AddSystem(Plant()), builder.AddSystem(Controller())
    hold = builder.AddSystem(ZeroOrderHold(TICK, 1))
    builder.Connect(plant.GetOutputPort("steps"), controller.GetInputPort("measured"))
    command = controller.GetOutputPort("command")
    builder.Connect(command, hold.get_input_port())
    builder.Connect(plant.GetOutputPort("steps"), log.declare_signal("steps", 1))
    builder.Connect(command, log.declare_signal("command", 1))
    return builder.Build(), controller, hold, log


def test_a_sample_is_what_the_controllers_use() -> None:
    """After the initial state, the plant's state one of its steps ahead."""
    diagram, _, hold, log = closed_loop()
    simulator = Simulator(diagram)
    simulator.AdvanceTo(0.018)
    rows = log.find_log(simulator.get_context())
    np.testing.assert_array_equal(
        rows, [[0, 0, 0], [0.005, 3, 30], [0.010, 5, 50], [0.015, 7, 70]]
    )
    held = hold.GetMyContextFromRoot(simulator.get_context())
    assert hold.get_output_port().Eval(held) == rows[-1, 2]


def test_a_sample_costs_no_evaluation_of_its_own() -> None:
    """The controller is asked once a tick, and once at initialization."""
    diagram, controller, _, _ = closed_loop()
    simulator = Simulator(diagram)
    simulator.AdvanceTo(0.999)
    assert controller.calls == 200 + 1


def test_each_context_has_its_own_log() -> None:
    """The log is no attribute of the system."""
    diagram, _, _, log = closed_loop()
    first, second = Simulator(diagram), Simulator(diagram)
    first.AdvanceTo(0.019)
    second.AdvanceTo(0.009)
    assert len(log.find_log(first.get_context())) == 4
    assert len(log.find_log(second.get_context())) == 2
    assert log.find_log(diagram.CreateDefaultContext()).shape == (0, 3)


def test_what_is_cleared_is_forgotten_and_logging_goes_on() -> None:
    """From the next tick."""
    diagram, _, _, log = closed_loop()
    simulator = Simulator(diagram)
    simulator.AdvanceTo(0.019)
    log.clear_log(simulator.get_context())
    assert log.find_log(simulator.get_context()).shape == (0, 3)
    simulator.AdvanceTo(0.021)
    times = log.find_log(simulator.get_context())[:, 0]
    np.testing.assert_array_equal(times, [0.020])


def test_period_must_be_positive() -> None:
    """A zero would log at every step."""
    with pytest.raises(ValueError, match=r"period: must be positive, got 0\.0 s"):
        SignalLog(0.0)
