"""The map as a system: it merges once a sweep, and asks only then."""

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context, DiagramBuilder, LeafSystem

from footfall.models.values.perceived import PlaneSegment, PlaneSegmentation, Staircase
from footfall.systems.perception.staircases.staircase_map import StaircaseMap
from footfall.systems.ports import eval_abstract, eval_vector


def tread(index: int) -> PlaneSegment:
    """A tread of a flight along x."""
    p = np.array([0.14 + 0.28 * index, 0.0, 0.2 * (index + 1)])
    made = PlaneSegment(
        polygon=np.zeros((0, 3)),
        X_WR=RigidTransform(p),
        size=np.array([0.28, 0.8]),
        normal=np.array([0.0, 0.0, 1.0]),
        area=0.224,
        support_count=100,
    )
    return PlaneSegment(
        made.corners(), made.X_WR, made.size, made.normal, made.area, 100
    )


class Climb(LeafSystem):
    """Sees one more tread every 0.1 s, a sweep, and counts how often it is asked."""

    def __init__(self) -> None:
        super().__init__()
        self.asked: list[float] = []
        self.DeclareAbstractOutputPort(
            "segmentation",
            lambda: AbstractValue.Make(PlaneSegmentation()),
            self._calc,
            prerequisites_of_calc={self.time_ticket()},
        )
        self.DeclareVectorOutputPort(
            "sweep",
            1,
            lambda context, out: out.SetAtIndex(0, self._count(context)),
            prerequisites_of_calc={self.time_ticket()},
        )

    def _count(self, context: Context) -> int:
        return int(context.get_time() / 0.1 + 1e-9)

    def _calc(self, context: Context, value: AbstractValue) -> None:
        self.asked.append(context.get_time())
        newest = tread(self._count(context) - 1)
        value.set_value(PlaneSegmentation((newest,), Staircase((newest,))))


def test_map_merges_each_sweep_once() -> None:
    """After three sweeps three treads are known, from three evaluations."""
    builder = DiagramBuilder()
    climb = builder.AddNamedSystem("climb", Climb())
    known = builder.AddNamedSystem("map", StaircaseMap())
    for port in ("segmentation", "sweep"):
        builder.Connect(climb.GetOutputPort(port), known.GetInputPort(port))
    simulator = Simulator(builder.Build())
    context = known.GetMyContextFromRoot(simulator.get_context())

    def state() -> tuple[Staircase, float]:
        staircase = known.GetOutputPort("staircase")
        sweep = eval_vector(known.GetOutputPort("sweep"), context)
        return eval_abstract(staircase, context, Staircase), float(sweep[0])

    simulator.AdvanceTo(0.09)
    assert state() == (Staircase(), 0.0)
    assert climb.asked == []
    simulator.AdvanceTo(0.19)
    assert state() == (Staircase((tread(0),)), 1.0)
    simulator.AdvanceTo(0.39)
    assert state() == (Staircase((tread(0), tread(1), tread(2))), 3.0)
    np.testing.assert_allclose(climb.asked, [0.1, 0.2, 0.3], atol=0.026)


def test_what_a_sweep_says_is_there_after_the_time_it_takes() -> None:
    """Sweeps that end meanwhile wait; the one that is worked on next is the latest."""
    builder = DiagramBuilder()
    climb = builder.AddNamedSystem("climb", Climb())
    known = builder.AddNamedSystem("map", StaircaseMap(latency=0.26))
    for port in ("segmentation", "sweep"):
        builder.Connect(climb.GetOutputPort(port), known.GetInputPort(port))
    simulator = Simulator(builder.Build())
    context = known.GetMyContextFromRoot(simulator.get_context())
    seen: list[tuple[float, int, float | None]] = []
    for step in range(1, 32):
        simulator.AdvanceTo(0.025 * step + 0.001)
        sweep = round(float(eval_vector(known.GetOutputPort("sweep"), context)[0]))
        port = known.GetOutputPort("segmentation")
        found = eval_abstract(port, context, PlaneSegmentation)
        if found.planes and (not seen or seen[-1][1] != sweep):
            seen.append((round(0.025 * step, 3), sweep, found.sensed_at))
    # Each time eleven updates of 25 ms later.
    assert [(time, sweep) for time, sweep, _ in seen] == [(0.375, 1), (0.65, 3)]
    sensed = [moment for _, _, moment in seen]
    np.testing.assert_allclose(sensed, [0.1, 0.375], atol=1e-9)
    np.testing.assert_allclose(climb.asked, [0.1, 0.375, 0.65], atol=1e-9)


def test_a_time_that_makes_no_sense_is_refused() -> None:
    """When the System is made."""
    with pytest.raises(ValueError, match=r"^latency: must be at least 0 s, got "):
        StaircaseMap(latency=-0.1)
