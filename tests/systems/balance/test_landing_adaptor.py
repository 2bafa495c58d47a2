"""Touch-down is felt: early, late, never; and what the references do meanwhile."""

import dataclasses

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.values.vector import Vector
from footfall.systems.balance.landing_adaptor import (
    LANDING_SPEED,
    FootState,
    LandingAdaptor,
    LandingParams,
    adapt,
    standing,
)
from footfall.systems.ports import eval_vector

PARAMS = LandingParams()
T = PARAMS.period
STILL = np.zeros(6)
GROUND = np.array([0.3, 0.1, 0.2, 0.0, 0.0, 0.1])
DOWN = np.array([0.0, 0.0, -0.2, 0.0, 0.0, 0.0])


def tick(
    state: FootState,
    planned: Vector = GROUND,
    rate: Vector = STILL,
    contact: bool = True,
    felt: bool = True,
    measured: Vector | None = None,
    params: LandingParams = PARAMS,
) -> tuple[FootState, Vector, Vector]:
    """One tick; a foot is by default where it is planned, on the ground."""
    measured = planned if measured is None else measured
    return adapt(state, planned, rate, contact, felt, measured, params)


def in_the_air(state: FootState, time: float, **inputs: object) -> FootState:
    """The state after that long in the air without feeling anything."""
    for _ in range(round(time / T)):
        state, _, _ = tick(state, contact=False, **({"felt": False} | inputs))
    return state


def test_standing_feet_follow_the_plan() -> None:
    """The pose as it is planned; sag that is measured is no reason to move."""
    state, pose, rate = tick(standing(), measured=GROUND + 0.003)
    np.testing.assert_array_equal(pose, GROUND)
    np.testing.assert_array_equal(rate, STILL)
    assert state.landed
    assert state.lifted_for == 0.0


def test_touch_down_on_time() -> None:
    """The reference goes from where it was to where the foot met the ground, flat."""
    state = in_the_air(standing(), 0.5, rate=DOWN)
    assert not state.landed
    measured = GROUND + np.array([0.004, -0.002, 0.001, 0.02, -0.03, 0.01])
    flat = np.array([*measured[:3], 0.0, 0.0, measured[5]])
    state, before, _ = tick(state, contact=False, felt=False)
    state, pose, _ = tick(state, measured=measured)
    assert state.landed
    np.testing.assert_allclose(pose, before, atol=1e-12)
    for _ in range(round(PARAMS.settle_time / T)):
        state, after, rate = tick(state, measured=measured - 0.002)
        np.testing.assert_allclose(after - pose, rate * T, atol=1e-4)
        pose = after
    share = 2.0 * np.exp(-1.0)
    np.testing.assert_allclose(pose, flat + share * (before - flat), atol=1e-3)
    for _ in range(200):
        state, pose, rate = tick(state, measured=measured - 0.002)
    np.testing.assert_allclose(pose, flat, atol=1e-5)
    np.testing.assert_allclose(rate, STILL, atol=1e-4)


def test_early_touch_down_holds_the_foot() -> None:
    """From the first tick that feels it, through the rest of the planned swing."""
    state = in_the_air(standing(), 0.5, rate=DOWN)
    higher = GROUND + np.array([0, 0, 0.03, 0.01, -0.02, 0])
    flat = np.array([*higher[:3], 0.0, 0.0, higher[5]])
    first = higher + np.array([0, 0, 0.005, 0, 0, 0])
    state, _, _ = tick(state, first, DOWN, False, True, higher)
    assert state.landed
    for planned in np.linspace(higher, GROUND, 150):
        state, pose, rate = tick(state, planned, DOWN, False, True, higher)
    np.testing.assert_allclose(pose, flat, atol=1e-4)
    np.testing.assert_allclose(rate, STILL, atol=1e-3)
    state, pose, _ = tick(state, GROUND, STILL, True, True, higher)
    np.testing.assert_allclose(pose, flat, atol=1e-4)


def test_a_foot_lifted_before_it_has_settled_does_not_jump() -> None:
    """What was left of the way goes with what the foot forgets in the air."""
    state = in_the_air(standing(), 0.5)
    state, _, _ = tick(state, measured=GROUND + np.array([0.01, 0, 0, 0, 0, 0]))
    state, before, _ = tick(state)
    state, pose, _ = tick(state, contact=False, felt=False)
    np.testing.assert_allclose(pose, before, atol=1.1e-2 * T / PARAMS.release_time)


@pytest.mark.parametrize(
    ("time", "rate", "felt"),
    [(0.2, DOWN, True), (0.5, -DOWN, True), (0.5, DOWN, False)],
    ids=["just lifted", "going up", "nothing felt"],
)
def test_what_is_no_touch_down(time: float, rate: Vector, felt: bool) -> None:
    """A foot that still leaves the ground, that rises, or that feels nothing."""
    state = in_the_air(standing(), time, rate=rate)
    state, _, after = tick(state, GROUND, rate, False, felt)
    assert not state.landed
    np.testing.assert_array_equal(after, rate)


def test_late_touch_down_searches_for_the_ground() -> None:
    """Straight down, from its start faster up to the search speed, until it is felt."""
    state = in_the_air(standing(), 0.5)
    heights, rates = [], []
    for _ in range(60):
        state, pose, rate = tick(state, felt=False)
        heights.append(pose[2])
        rates.append(rate[2])
    gain = PARAMS.search_acceleration * T
    begun = LANDING_SPEED + gain * np.arange(1, 4)
    np.testing.assert_allclose(rates[:3], -begun)
    assert rates[-1] == -PARAMS.search_speed
    np.testing.assert_allclose(np.diff(heights), np.array(rates[1:]) * T, atol=1e-12)
    np.testing.assert_allclose(pose[[0, 1, 3, 4, 5]], GROUND[[0, 1, 3, 4, 5]])
    assert not state.landed
    lower = np.array([*GROUND[:2], heights[-1] - 0.001, *GROUND[3:]])
    state, pose, rate = tick(state, felt=True, measured=lower)
    assert state.landed
    for _ in range(200):
        state, pose, rate = tick(state, felt=True, measured=lower)
    np.testing.assert_allclose(pose, lower, atol=1e-5)
    np.testing.assert_allclose(rate, STILL, atol=1e-4)


def test_a_search_begins_as_fast_as_it_is_set() -> None:
    """Where a plan waits for the foot it starts from rest."""
    params = dataclasses.replace(PARAMS, search_start=0.0)
    state = in_the_air(standing(), 0.5, params=params)
    _, _, rate = tick(state, felt=False, params=params)
    assert rate[2] == pytest.approx(-PARAMS.search_acceleration * T)


def test_a_foot_that_goes_down_as_it_misses_the_ground_goes_on() -> None:
    """No faster for that, and no slower."""
    state = in_the_air(standing(), 0.5, rate=0.2 * DOWN)
    _, _, rate = tick(state, felt=False)
    gain = PARAMS.search_acceleration * T
    assert rate[2] == pytest.approx(0.2 * DOWN[2] - gain)


def test_search_ends_at_its_depth() -> None:
    """A foot over a hole is taken for landed there, not sunk for ever."""
    state = in_the_air(standing(), 0.5)
    for _ in range(200):
        sunk = GROUND + np.array([0, 0, state.offset[2], 0, 0, 0])
        state, pose, _ = tick(state, felt=False, measured=sunk)
    assert state.landed
    depth = GROUND[2] - pose[2]
    assert PARAMS.search_depth <= depth <= PARAMS.search_depth + 0.1 * T + 1e-9


def test_a_lifted_foot_returns_to_its_plan() -> None:
    """From where it stood; neither the reference nor its speed jumps at lift-off."""
    state = in_the_air(standing(), 0.5)
    measured = GROUND + np.array([0.01, 0, -0.02, 0, 0, 0])
    for _ in range(200):
        state, before, _ = tick(state, measured=measured)
    speed = 0.0
    for _ in range(round(PARAMS.release_time / T)):
        state, pose, rate = tick(state, contact=False, felt=False, measured=before)
        assert abs(rate[2] - speed) <= 0.02 * T / PARAMS.release_time**2
        np.testing.assert_allclose(pose - before, T * rate, atol=3e-4)
        before, speed = pose, rate[2]
    left = state.offset[2] / -0.02
    assert left == pytest.approx(2.0 * np.exp(-1.0), rel=0.01)
    for _ in range(round(0.9 / T)):
        state, pose, _ = tick(state, contact=False, felt=False, measured=before)
        before = pose
    np.testing.assert_allclose(pose, GROUND, atol=1e-4)


def test_the_reference_is_of_the_tick_when_it_is_tracked() -> None:
    """Given out at a tick, read at the next: a moving plan is a tick ahead."""
    _, pose, rate = tick(in_the_air(standing(), 0.1), rate=-DOWN, contact=False)
    np.testing.assert_allclose(pose, GROUND - T * DOWN, atol=1e-4)
    np.testing.assert_allclose(rate, -DOWN, atol=1e-9)


def test_a_foot_that_is_late_as_drives_are_has_no_sag() -> None:
    """It follows its reference by `swing_delay`: nothing is to be made up for."""
    late = GROUND - PARAMS.swing_delay * DOWN
    state = in_the_air(standing(), 0.5, rate=DOWN, measured=late)
    np.testing.assert_allclose(state.sag, 0.0, atol=1e-12)


def test_sag_in_the_air_is_made_up_for() -> None:
    """A foot that hangs below its reference by a spring comes to its plan."""
    state, sag = standing(), np.array([0.0, 0.0, -0.01, 0.0, 0.02, 0.0])
    pose = GROUND
    for _ in range(round(0.6 / T)):
        state, pose, _ = tick(state, contact=False, felt=False, measured=pose + sag)
    np.testing.assert_allclose(pose + sag, GROUND, atol=1e-4)


def test_sag_is_bounded() -> None:
    """A leg that is stuck does not wind the reference up."""
    state = in_the_air(standing(), 2.0, measured=GROUND - 1.0)
    np.testing.assert_allclose(state.sag, PARAMS.swing_limit)
    state = in_the_air(standing(), 2.0, measured=GROUND + 1.0)
    np.testing.assert_allclose(state.sag, -PARAMS.swing_limit)


def make() -> tuple[LandingAdaptor, Context]:
    """The system, both feet standing on a plan that began at 0."""
    poses = np.concatenate([GROUND, GROUND - np.array([0, 0.2, 0, 0, 0, 0])])
    system = LandingAdaptor(PARAMS, poses)
    context = system.CreateDefaultContext()
    for name, value in (
        ("foot_references", np.concatenate([poses, np.zeros(12)])),
        ("contacts", [1.0, 1.0, 0.225, 0.1]),
        ("plan_start", [0.0]),
        ("touching", [1.0, 1.0]),
        ("foot_poses", poses),
    ):
        system.GetInputPort(name).FixValue(context, value)
    return system, context


def output(system: LandingAdaptor, context: Context, name: str) -> Vector:
    """A port's value."""
    return eval_vector(system.GetOutputPort(name), context)


def test_default_context_stands() -> None:
    """Before the first tick: the poses that were given, both feet on the ground."""
    system, context = make()
    references = output(system, context, "foot_references")
    np.testing.assert_array_equal(references[:6], GROUND)
    assert not references[12:].any()
    assert output(system, context, "contacts")[:2].tolist() == [1.0, 1.0]


def test_shell_adapts_each_foot_on_its_own() -> None:
    """The left one lands where it is; the right one stands on."""
    system, context = make()
    simulator = Simulator(system, context)
    system.GetInputPort("contacts").FixValue(context, [0.0, 1.0, 0.225, 0.1])
    system.GetInputPort("touching").FixValue(context, [0.0, 1.0])
    simulator.AdvanceTo(0.501)
    assert output(system, context, "contacts").tolist() == [0.0, 1.0, 0.225, 0.1]
    system.GetInputPort("contacts").FixValue(context, [1.0, 1.0, 0.225, 0.1])
    simulator.AdvanceTo(0.551)
    assert output(system, context, "contacts")[0] == 0.0
    references = output(system, context, "foot_references")
    assert references[2] < GROUND[2] - 0.0005
    assert references[14] < -0.02
    system.GetInputPort("touching").FixValue(context, [1.0, 1.0])
    simulator.AdvanceTo(0.561)
    assert output(system, context, "contacts").tolist() == [1.0, 1.0, 0.225, 0.1]
    right = GROUND - np.array([0, 0.2, 0, 0, 0, 0])
    np.testing.assert_array_equal(
        output(system, context, "foot_references")[6:12], right
    )


def test_each_foot_has_its_own_sensor() -> None:
    """What the left foot feels says nothing of the right one."""
    system, context = make()
    simulator = Simulator(system, context)
    system.GetInputPort("contacts").FixValue(context, [1.0, 0.0, 0.225, 0.225])
    system.GetInputPort("touching").FixValue(context, [1.0, 0.0])
    simulator.AdvanceTo(0.501)
    system.GetInputPort("contacts").FixValue(context, [1.0, 1.0, 0.225, 0.225])
    simulator.AdvanceTo(0.531)
    assert output(system, context, "contacts")[:2].tolist() == [1.0, 0.0]


def test_a_new_plan_begins_at_the_references() -> None:
    """What was remembered of the ground is in the new plan already."""
    system, context = make()
    simulator = Simulator(system, context)
    lifted = [0.0, 1.0, 0.225, 0.225]
    system.GetInputPort("contacts").FixValue(context, lifted)
    system.GetInputPort("touching").FixValue(context, [0.0, 0.0])
    simulator.AdvanceTo(0.501)
    poses = np.concatenate([GROUND, GROUND])
    poses[2] -= 0.01
    system.GetInputPort("contacts").FixValue(context, [1.0, 1.0, 0.225, 0.225])
    system.GetInputPort("touching").FixValue(context, [1.0, 0.0])
    system.GetInputPort("foot_poses").FixValue(context, poses)
    simulator.AdvanceTo(2.011)
    adapted = output(system, context, "foot_references")
    assert adapted[2] == pytest.approx(GROUND[2] - 0.01, abs=1e-6)
    system.GetInputPort("foot_references").FixValue(context, adapted)
    system.GetInputPort("plan_start").FixValue(context, [2.011])
    simulator.AdvanceTo(2.031)
    np.testing.assert_allclose(output(system, context, "foot_references"), adapted)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("period", 0.0),
        ("search_speed", np.inf),
        ("release_time", 0.0),
        ("blind_time", -0.1),
        ("search_depth", np.nan),
        ("swing_gain", -1.0),
        ("swing_limit", -1.0),
    ],
)
def test_parameters_out_of_range_are_refused(field: str, value: float) -> None:
    """By name."""
    with pytest.raises(ValueError, match=rf"^{field}: must"):
        LandingAdaptor(LandingParams(**{field: value}), np.zeros(12))
