"""Parts of one's own in the closed loop: what fits, and what is told otherwise."""

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import BasicVector, Context, LeafSystem, System
from pydrake.systems.primitives import ConstantVectorSource, Gain, ZeroOrderHold

from footfall.diagrams.closed_loop.loop_builder import LoopBuilder
from footfall.diagrams.closed_loop.parts import PartError
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.simulation import simulate, summarize
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.perceived import PlaneSegmentation, Staircase
from footfall.systems.perception.planes.plane_segmenter import PlaneSegmenter

STAND = load_scenario("stand", ["task.stand_time=0.1"])
STAIRS = load_scenario("stairs-exp1")


class Sees(LeafSystem):
    """A segmenter that gives `value` on a port called `port`.

    .. pydrake_system::

        name: Sees
        input_ports: []
        output_ports:
        - segmentation
    """

    def __init__(self, value: object, port: str = "segmentation") -> None:
        super().__init__()
        self.DeclareAbstractOutputPort(
            port,
            lambda: AbstractValue.Make(value),
            lambda context, output: None,
            prerequisites_of_calc={self.nothing_ticket()},
        )


class Tilted(LeafSystem):
    """A segmenter that asks for an inclination.

    .. pydrake_system::

        name: Tilted
        input_ports:
        - inclination
        output_ports:
        - segmentation
    """

    def __init__(self) -> None:
        super().__init__()
        self.DeclareVectorInputPort("inclination", 2)
        self.DeclareAbstractOutputPort(
            "segmentation",
            lambda: AbstractValue.Make(PlaneSegmentation()),
            lambda context, output: None,
        )


class Ahead(LeafSystem):
    """How far the CoM is ahead of the left foot.

    .. pydrake_system::

        name: Ahead
        input_ports:
        - com
        - feet
        output_ports:
        - distance
    """

    def __init__(self) -> None:
        super().__init__()
        self.DeclareVectorInputPort("com", 3)
        self.DeclareVectorInputPort("feet", 12)
        self.DeclareVectorOutputPort("distance", 1, self._calc)

    def _calc(self, context: Context, output: BasicVector) -> None:
        com, feet = (self.get_input_port(i).Eval(context) for i in (0, 1))
        output[0] = com[0] - feet[0]


def test_a_part_takes_the_place_of_ours_and_is_named() -> None:
    """A stronger hold of the torque, in the station of the robot."""
    hold = ZeroOrderHold(0.01, 32)
    task = build_task(STAND, replace={"torque_hold": hold})
    assert task.system("torque_hold") is hold
    summary = summarize(task, STAND, simulate(task, 10.0))
    assert summary.outcome == "completed"
    name = "pydrake.systems.primitives.ZeroOrderHold"
    assert summary.to_json()["replaced"] == {"torque_hold": name}


def test_a_station_takes_the_place_of_ours() -> None:
    """Ours of the same signals, made by hand: nothing that it exports is missing."""
    ours = build_task(STAIRS).system("perception")
    assert {"staircase", "sweep", "staircase_map.staircase"} <= {
        ours.get_output_port(i).get_name() for i in range(ours.num_output_ports())
    }
    with pytest.raises(PartError, match=r"perception: Sees has no output port 'sweep'"):
        build_task(STAIRS, replace={"perception": Sees(Staircase(), "staircase")})


@pytest.mark.parametrize(
    ("replace", "message"),
    [
        (
            {"plane_segmentr": Sees(PlaneSegmentation())},
            r"plane_segmentr: this task has no such part, did you mean "
            r"'plane_segmenter'\?; its parts: .*walking_control",
        ),
        (
            {"plane_segmenter": Sees(PlaneSegmentation(), "planes")},
            r"plane_segmenter: Sees has no output port 'segmentation' \(abstract "
            r"PlaneSegmentation\), .*its outputs: planes \(abstract PlaneSegmentation",
        ),
        (
            {"plane_segmenter": Sees(Staircase())},
            r"its output port 'segmentation' must be abstract PlaneSegmentation, is "
            r"abstract Staircase",
        ),
        (
            {"torque_hold": ZeroOrderHold(0.005, 30)},
            r"torque_hold: ZeroOrderHold.*'y' must be vector of 32, is vector of 30",
        ),
        (
            {"plane_segmenter": Tilted()},
            r"connected to nothing: plane_segmenter\.inclination \(vector of 2\); ",
        ),
        (
            {"plane_segmenter": PlaneSegmenter},
            r"plane_segmenter: must be a Drake System, got .*the class and not one of",
        ),
        ({"contact_monitor": Gain(1.0, 1)}, r"contact_monitor: cannot be replaced: "),
        ({"robot_station": Gain(1.0, 1)}, r"robot_station: cannot be replaced: "),
    ],
)
def test_what_does_not_fit_is_told_by_name_and_type(
    replace: dict[str, System], message: str
) -> None:
    """When the loop is built, in one line."""
    with pytest.raises(PartError, match=message) as told:
        build_task(STAIRS, replace=replace)
    assert "\n" not in str(told.value)


def test_inputs_that_a_part_does_not_need_may_be_missing() -> None:
    """And those that it has beside ours are connected in `extend`."""
    build_task(STAIRS, replace={"plane_segmenter": Sees(PlaneSegmentation())})

    def extend(loop: LoopBuilder) -> None:
        loop.add("level", ConstantVectorSource(np.zeros(2)))
        loop.connect("level.y0", "plane_segmenter.inclination")

    build_task(STAIRS, replace={"plane_segmenter": Tilted()}, extend=extend)


def test_a_system_is_added_and_its_port_logged() -> None:
    """With what it is connected to by name."""

    def extend(loop: LoopBuilder) -> None:
        feet = "kinematic_state.foot_poses"
        loop.add("ahead", Ahead(), {"com": "kinematic_state.com", "feet": feet})
        loop.log("ahead.distance", ["x"], "m")
        loop.log("zmp_preview.com_velocity")

    task = build_task(STAND, extend=extend)
    simulator = Simulator(task.diagram)
    simulator.AdvanceTo(0.05)
    frames = task.signals.frames(simulator.get_context())
    assert frames["ahead.distance"]["x"].iloc[-1] == pytest.approx(0.0347, abs=2e-3)
    assert list(frames["zmp_preview.com_velocity"]) == ["time", "0", "1"]
    now = task.output("ahead.distance", simulator.get_context())
    np.testing.assert_allclose(now, frames["ahead.distance"]["x"].iloc[-1], atol=1e-4)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda loop: loop.log("ahead.x"), r"no output 'ahead.x': no part 'ahead'; "),
        (lambda loop: loop.log("zmp_preview.x"), r"zmp_preview has: zmp_preview\.com,"),
        (
            lambda loop: loop.add("a", Gain(1.0, 3), {"u0": "zmp_preview.com"}),
            r"com \(vector of 2\) cannot be connected to a\.u0 \(vector of 3\)",
        ),
        (
            lambda loop: loop.add("planning", Gain(1.0, 3)),
            "planning: the name is taken",
        ),
        (
            lambda loop: loop.connect("zmp_preview.com", "planning.x"),
            r"no input 'planning\.x'; open are: none",
        ),
        (
            lambda loop: loop.connect("zmp_preview.com", "walking_control.com"),
            r"'walking_control\.com' is connected already",
        ),
        (lambda loop: loop.log("plant.geometry_pose"), r"log: plant\.geometry_pose: "),
    ],
)
def test_what_cannot_be_added_is_told(call, message: str) -> None:
    """In one line, with what there is."""
    with pytest.raises(PartError, match=message) as told:
        build_task(STAND, extend=call)
    assert "\n" not in str(told.value)


def test_an_unknown_port_is_told_with_those_that_there_are() -> None:
    """By system, and by port."""
    task = build_task(STAND)
    context = task.diagram.CreateDefaultContext()
    with pytest.raises(LookupError, match=r"no system 'zmp'; .*zmp_preview"):
        task.output("zmp.com", context)
    with pytest.raises(LookupError, match=r"no output 'c'; it has: com, com_velocity"):
        task.output("zmp_preview.c", context)


def test_a_run_ends_when_the_user_says() -> None:
    """At the step of the plant at which he says so, and is judged until then."""
    task = build_task(STAND)

    def settled(context: Context) -> str | None:
        load = task.output("contact_monitor.foot_forces", context)
        return "it bears its weight" if load[2] + load[5] > 600.0 else None

    simulated = simulate(task, 1.0, until=settled)
    assert simulated.stop == "stopped"
    assert simulated.context.get_time() < 0.1
    summary = summarize(task, STAND, simulated)
    assert summary.outcome == "interrupted"
    assert "it bears its weight" in summary.reason


def test_a_segmenter_is_made_by_one_method() -> None:
    """The ports stay; what it finds is its own."""

    class Blind(PlaneSegmenter):
        """Sees nothing."""

        def segment(self, points, gravity, viewpoint):
            return PlaneSegmentation()

    task = build_task(STAIRS, replace={"plane_segmenter": Blind(JVRC1.sole)})
    assert type(task.system("plane_segmenter")) is Blind
