"""What a ball of two parts touches, and with what mean force."""

from dataclasses import dataclass

import numpy as np
import pytest
from pydrake.multibody.plant import ContactResults
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.models.values.contact import Touches
from footfall.models.values.vector import Vector
from footfall.systems.ports import eval_vector
from footfall.systems.sensing.contact_monitor import ContactMonitor
from footfall.systems.sensing.robot_contacts import WatchedGeometry, watched_geometry
from tests.systems.sensing.ball_scene import FEET, GROUND, WEIGHT, ball_scene, is_sole


@dataclass(frozen=True)
class Seen:
    """What the monitor says at the end."""

    touches: Touches
    touching: float
    foot_forces: Vector
    other_support: float
    impact: Vector
    friction_ratio: float


def simulate(
    ball: str = "shin",
    solid: str = "staircase/step_1",
    height: float = 0.1,
    duration: float = 1.0,
    step: float = 0.002,
    slope: float = 0.0,
    solver: str = "lagged",
) -> Seen:
    """Lets a ball go at a height of its centre above a slab."""
    scene = ball_scene({solid: 0.0}, {ball: (0.0, height)}, step, slope, solver)
    watched = watched_geometry(
        scene.plant,
        scene.scene_graph.model_inspector(),
        scene.robot,
        FEET,
        is_sole,
        GROUND,
    )
    builder: DiagramBuilder = scene.builder
    monitor = builder.AddNamedSystem("monitor", ContactMonitor(watched, step, WEIGHT))
    builder.Connect(
        scene.plant.get_contact_results_output_port(),
        monitor.GetInputPort("contact_results"),
    )
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(duration)
    context = monitor.GetMyContextFromRoot(simulator.get_context())

    def vector(port: str) -> Vector:
        return eval_vector(monitor.GetOutputPort(port), context)

    return Seen(
        monitor.GetOutputPort("touches").Eval(context),
        float(vector("touching")[0]),
        vector("foot_forces"),
        float(vector("other_support")[0]),
        vector("impact"),
        float(vector("friction_ratio")[0]),
    )


@pytest.mark.parametrize("solid", ["staircase/step_1", "box/trunk", "room/floor"])
def test_resting_part_is_named_with_duration_and_force(solid: str) -> None:
    """A shin that rests weighs what it weighs, whatever it rests on."""
    seen = simulate("shin", solid, height=0.0995)
    (touch,) = seen.touches.touches
    assert (touch.body, touch.solid) == ("SHIN", solid)
    assert seen.touching == 1.0
    assert touch.duration == pytest.approx(1.0, abs=0.02)
    assert touch.peak_force >= WEIGHT * 0.99
    assert seen.other_support == pytest.approx(WEIGHT, rel=0.01)
    np.testing.assert_allclose(seen.foot_forces, 0.0)


@pytest.mark.parametrize("solid", ["staircase/step_1", "room/floor"])
def test_a_sole_may_touch_the_ground(solid: str) -> None:
    """It bears the weight; nothing else does."""
    seen = simulate("sole", solid, height=0.0995)
    assert (seen.touches, seen.touching) == (Touches(), 0.0)
    assert seen.foot_forces[2] == pytest.approx(WEIGHT, rel=0.01)
    assert seen.other_support == 0.0


@pytest.mark.parametrize("solid", ["box/trunk", "room/wall_left", "room/ceiling"])
def test_a_sole_must_not_touch_anything_else(solid: str) -> None:
    """Boxes and walls least of all."""
    (touch,) = simulate("sole", solid, height=0.0995).touches.touches
    assert (touch.body, touch.solid) == ("LEFT", solid)


def test_the_peak_of_a_touch_is_kept() -> None:
    """A ball that has fallen 20 cm strikes harder than it weighs, and then rests."""
    seen = simulate(height=0.3, duration=1.0)
    (touch,) = seen.touches.touches
    assert touch.duration == pytest.approx(0.8, abs=0.05)
    assert touch.peak_force > 20.0 * WEIGHT


def test_an_impact_is_the_same_at_every_step_and_solver() -> None:
    """Within a tenth, where a single step says anything between 13 and 130 weights.

    A sole that has fallen for 1.25 cm brings an impulse of m sqrt(2 g h) with it; over
    10 ms that is 5 weights, and its own weight.
    """
    expected = np.sqrt(2.0 * 9.81 * 0.0125) / 0.01 / 9.81 + 1.0
    for solver in ("lagged", "similar", "sap"):
        for step in (0.001, 0.0025, 0.005):
            seen = simulate(
                "sole", height=0.1125, duration=0.3, step=step, solver=solver
            )
            body_weights = seen.impact[0] / WEIGHT
            assert body_weights == pytest.approx(expected, rel=0.1), (solver, step)
            assert seen.impact[1] == 0.0


def test_the_friction_ratio_is_that_of_a_loaded_foot() -> None:
    """A ball that rolls down a slope t: 5/7 tan t over 1 + 2/7 tan^2 t; 0 on a level.

    The ground is taken for level, so the slope itself counts.
    """
    tan = np.tan(0.4)
    rolling = simulate("sole", height=0.1 / np.cos(0.4), slope=0.4, duration=0.3)
    expected = 5.0 / 7.0 * tan / (1.0 + 2.0 / 7.0 * tan**2)
    assert rolling.friction_ratio == pytest.approx(expected, rel=0.05)
    level = simulate("sole", height=0.0995, duration=0.3)
    assert level.friction_ratio == pytest.approx(0.0, abs=1e-3)


def test_own_bodies_that_meet_are_a_touch() -> None:
    """Named both, in one order; their forces are no load of a foot."""
    scene = ball_scene(
        {"room/floor": -5.0}, {"shin": (0.0, 0.0), "sole": (0.0, 0.19)}, 0.002
    )
    watched = watched_geometry(
        scene.plant,
        scene.scene_graph.model_inspector(),
        scene.robot,
        FEET,
        is_sole,
        GROUND,
    )
    monitor = scene.builder.AddNamedSystem(
        "monitor", ContactMonitor(watched, 0.002, WEIGHT)
    )
    scene.builder.Connect(
        scene.plant.get_contact_results_output_port(),
        monitor.GetInputPort("contact_results"),
    )
    simulator = Simulator(scene.builder.Build())
    simulator.AdvanceTo(0.02)
    context = monitor.GetMyContextFromRoot(simulator.get_context())
    touches = monitor.GetOutputPort("touches").Eval(context)
    (touch,) = touches.touches
    assert {touch.body, touch.solid} == {"SHIN", "LEFT"}
    assert touch.peak_force > 0.0
    impact = eval_vector(monitor.GetOutputPort("impact"), context)
    np.testing.assert_allclose(impact, 0.0)


@pytest.mark.parametrize(
    ("period", "weight", "message"),
    [
        (-1.0, 600.0, r"period: must be positive, got -1\.0 s"),
        (0.002, 0.0, r"weight: must be positive, got 0\.0 N"),
    ],
)
def test_period_and_weight_must_be_positive(period, weight, message) -> None:
    """The plant's step, the robot's weight."""
    watched = WatchedGeometry((), (), (), frozenset(), {}, {})
    with pytest.raises(ValueError, match=message):
        ContactMonitor(watched, period, weight)


def test_without_contacts_nothing_is_touched() -> None:
    """At the start."""
    watched = WatchedGeometry(("LEFT",), (0,), (), frozenset(), {}, {})
    monitor = ContactMonitor(watched, 0.002, WEIGHT)
    context = monitor.CreateDefaultContext()
    monitor.GetInputPort("contact_results").FixValue(context, ContactResults())
    assert monitor.GetOutputPort("touches").Eval(context) == Touches()
