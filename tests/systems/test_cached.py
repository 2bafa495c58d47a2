"""Intermediate results: once for the same inputs, for each context its own."""

import gc
import weakref

from pydrake.systems.framework import BasicVector, Context, LeafSystem

from footfall.systems.cached import declare_cached


class Squares(LeafSystem):
    """Two ports that want the same square.

    .. pydrake_system::

        name: Squares
        input_ports:
        - side
        output_ports:
        - area
        - twice
    """

    def __init__(self) -> None:
        super().__init__()
        self.calls = 0
        self._side = self.DeclareVectorInputPort("side", 1)
        self._square = declare_cached(
            self, "square", self._calc_square, {self._side.ticket()}
        )
        for name, factor in (("area", 1.0), ("twice", 2.0)):

            def calc(
                context: Context, output: BasicVector, factor: float = factor
            ) -> None:
                output[0] = factor * self._square(context)

            self.DeclareVectorOutputPort(name, 1, calc, {self._side.ticket()})

    def _calc_square(self, context: Context) -> float:
        self.calls += 1
        return float(self._side.Eval(context)[0]) ** 2


def test_it_is_computed_once_for_the_same_inputs() -> None:
    """And anew for others."""
    system = Squares()
    context = system.CreateDefaultContext()
    for side, calls in ((2.0, 1), (3.0, 2)):
        system.GetInputPort("side").FixValue(context, [side])
        area = system.GetOutputPort("area").Eval(context)[0]
        twice = system.GetOutputPort("twice").Eval(context)[0]
        assert (area, twice, system.calls) == (side**2, 2.0 * side**2, calls)


def test_every_context_has_its_own() -> None:
    """A clone's does not change the first."""
    system = Squares()
    context = system.CreateDefaultContext()
    system.GetInputPort("side").FixValue(context, [2.0])
    assert system.GetOutputPort("area").Eval(context)[0] == 4.0
    clone = context.Clone()
    system.GetInputPort("side").FixValue(clone, [5.0])
    assert system.GetOutputPort("area").Eval(clone)[0] == 25.0
    assert system.GetOutputPort("area").Eval(context)[0] == 4.0


def test_it_does_not_keep_what_computes_it() -> None:
    """Drake holds its callbacks weakly."""

    class Owner:
        """Computes nothing."""

        def calc(self, context: Context) -> int:
            return 0

    system, owner = LeafSystem(), Owner()
    declare_cached(system, "nothing", owner.calc, {system.nothing_ticket()})
    gone = weakref.ref(owner)
    del owner
    gc.collect()
    assert gone() is None
