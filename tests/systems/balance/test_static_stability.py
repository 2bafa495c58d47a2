"""StaticStability's shell: when it looks, when it computes, what it says."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.robots.robot import Sole
from footfall.systems.balance import static_stability
from footfall.systems.balance.contact_wrench_cone import point_contact, sole_contact
from footfall.systems.balance.convex_polygon import hausdorff_distance, signed_margin
from footfall.systems.balance.stability_polygon import StabilityPolygon, static_polygon
from footfall.systems.balance.static_stability import StaticStability
from footfall.systems.planning.motion.toe_off import lift_heel

SOLE = {"heel": 0.1, "toe": 0.14, "half_width": 0.07, "friction": 0.7}
POSES = np.array([0, 0.1, 0, 0, 0, 0.1, 0.25, -0.1, 0.2, 0, 0.2, 0.0])


def at_rest(in_contact: tuple[float, float]) -> tuple[StaticStability, Context]:
    """The system on fixed inputs."""
    system = StaticStability(**SOLE)
    context = system.CreateDefaultContext()
    system.GetInputPort("sole_poses").FixValue(context, POSES)
    system.GetInputPort("contacts").FixValue(context, [*in_contact, 0.24, 0.24])
    system.GetInputPort("com").FixValue(context, [0.05, 0.08, 0.8])
    return system, context


def expected(*feet: int) -> StabilityPolygon:
    """The core's polygon on those feet."""
    soles = [
        sole_contact(RigidTransform(RollPitchYaw(pose[3:]), pose[:3]), **SOLE)
        for pose in POSES.reshape(2, 6)[list(feet)]
    ]
    return static_polygon(soles)


def count_calls(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """A list that grows by one at every computation."""
    calls: list[int] = []

    def counted(contacts: list) -> StabilityPolygon:
        calls.append(len(contacts))
        return static_polygon(contacts)

    monkeypatch.setattr(static_stability, "static_polygon", counted)
    return calls


@pytest.mark.parametrize("feet", [(0, 1), (0,), (1,), ()])
def test_polygon_and_margin_are_the_core_s(feet: tuple[int, ...]) -> None:
    """From the first moment, for either foot, both and none."""
    mask = (float(0 in feet), float(1 in feet))
    system, context = at_rest(mask)
    Simulator(system, context).Initialize()
    polygon = system.GetOutputPort("polygon").Eval(context)
    want = expected(*feet)
    assert polygon.status == want.status
    assert hausdorff_distance(polygon.vertices, want.vertices) < 1e-12
    margin = system.GetOutputPort("margin").Eval(context)[0]
    assert margin == signed_margin(want.vertices, np.array([0.05, 0.08]))
    assert margin == polygon.margin
    assert (margin > 0.0) == (0 in feet)
    assert system.GetOutputPort("caught").Eval(context)[0] == 0.0


def test_it_computes_only_when_the_stance_changes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Not for a moving CoM, a drift below the tolerance or a swinging foot."""
    calls = count_calls(monkeypatch)
    system, context = at_rest((1.0, 1.0))
    simulator = Simulator(system, context)
    simulator.AdvanceTo(0.1)
    assert calls == [2]
    system.GetInputPort("com").FixValue(context, [0.3, 0.0, 0.8])
    poses = POSES + 0.0004
    poses[5] += 2.0 * np.pi
    system.GetInputPort("sole_poses").FixValue(context, poses)
    simulator.AdvanceTo(0.2)
    assert calls == [2]
    assert system.GetOutputPort("margin").Eval(context)[0] == signed_margin(
        expected(0, 1).vertices, np.array([0.3, 0.0])
    )
    system.GetInputPort("contacts").FixValue(context, [1.0, 0.0, 0.24, 0.24])
    simulator.AdvanceTo(0.3)
    assert calls == [2, 1]
    poses[6:] += 0.1
    system.GetInputPort("sole_poses").FixValue(context, poses)
    simulator.AdvanceTo(0.4)
    assert calls == [2, 1]
    poses[:3] += 0.1
    system.GetInputPort("sole_poses").FixValue(context, poses)
    simulator.AdvanceTo(0.5)
    assert calls == [2, 1, 1]


def test_a_hand_joins_the_stance(monkeypatch: pytest.MonkeyPatch) -> None:
    """Other contacts count, and are looked at once while they stay."""
    calls = count_calls(monkeypatch)
    system, context = at_rest((1.0, 1.0))
    hand = point_contact(RigidTransform([0.5, 0.3, 0.9]), 0.5)
    system.GetInputPort("other_contacts").FixValue(context, (hand,))
    simulator = Simulator(system, context)
    simulator.AdvanceTo(0.1)
    assert calls == [3]
    # The soles stay, the hand lets go.
    system.GetInputPort("other_contacts").FixValue(context, ())
    simulator.AdvanceTo(0.2)
    assert calls == [3, 2]


def test_refused_results_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """One a computation, over all stances so far."""
    monkeypatch.setattr(
        static_stability,
        "static_polygon",
        lambda contacts: StabilityPolygon(status="infeasible", caught=True),
    )
    system, context = at_rest((1.0, 1.0))
    simulator = Simulator(system, context)
    simulator.AdvanceTo(0.1)
    system.GetInputPort("contacts").FixValue(context, [1.0, 0.0, 0.24, 0.24])
    simulator.AdvanceTo(0.2)
    assert system.GetOutputPort("caught").Eval(context)[0] == 2.0


def test_bad_soles_are_refused_at_once() -> None:
    """Not first when a foot stands."""
    with pytest.raises(ValueError, match="friction"):
        StaticStability(heel=0.1, toe=0.1, half_width=0.05, friction=-1.0)
    with pytest.raises(ValueError, match="period"):
        StaticStability(**SOLE, period=0.0)
    with pytest.raises(ValueError, match="tolerance"):
        StaticStability(**SOLE, tolerance=-1.0)


def test_a_lifted_heel_leaves_the_toes() -> None:
    """A foot in toe-off carries on a strip at its toe edge, on level ground."""
    system, context = at_rest((1.0, 1.0))
    pitched = POSES.copy()
    pitched[4:6] = 0.3, 0.0
    system.GetInputPort("sole_poses").FixValue(context, pitched)
    system.GetInputPort("contacts").FixValue(context, [1.0, 0.0, 0.01, 0.24])
    Simulator(system, context).Initialize()
    polygon = system.GetOutputPort("polygon").Eval(context)
    edge = pitched[0] + SOLE["toe"] * np.cos(0.3)
    assert polygon.status == "ok"
    np.testing.assert_allclose(polygon.vertices[:, 0].max(), edge, atol=1e-9)
    np.testing.assert_allclose(polygon.vertices[:, 0].min(), edge - 0.01, atol=1e-9)


def test_a_heel_that_rises_over_resting_toes_changes_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The pose changes at every look, the strip that carries does not."""
    system, context = at_rest((1.0, 1.0))
    calls = count_calls(monkeypatch)
    sole = Sole(0.1, 0.14, 0.07, 0.1)
    simulator = Simulator(system, context)
    system.GetInputPort("contacts").FixValue(context, [1.0, 1.0, 0.01, 0.24])
    poses = POSES.copy()
    for pitch in (0.0, 0.1, 0.2, 0.4, 0.7):
        poses[:6] = lift_heel(POSES[:6], np.array([pitch]), sole)[0]
        system.GetInputPort("sole_poses").FixValue(context, poses)
        simulator.AdvanceTo(context.get_time() + 0.05)
    assert calls == [2]
