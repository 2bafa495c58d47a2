"""Crossings read back from a run's log."""

from dataclasses import replace

import numpy as np
import pytest

from footfall.diagrams.figures.crossing_data import read_crossings, without_adaptation
from footfall.diagrams.run_data import read_run_data


@pytest.fixture(scope="module")
def crossing(crossed_folder):
    """The crossing of the run over 15 cm."""
    return read_crossings(read_run_data(crossed_folder))


def test_the_plan_is_what_the_planner_reported(crossing) -> None:
    """Obstacle, key configuration, and errors of the ZMP that its curves show."""
    (plan,) = crossing.plans
    (obstacle,), (key,) = plan.obstacles, plan.keys
    assert obstacle.height == pytest.approx(0.15, abs=0.005)
    said = crossing.data.run.summary["crossing"]
    assert key.X_ads == pytest.approx(said["keys"][0]["X_ads"])
    assert plan.repairs.lowered == pytest.approx(said["repairs"][0]["lowered"])
    (phases,) = plan.phases
    during = (plan.curves.time > phases.begin) & (plan.curves.time < phases.end)
    wanted = np.interp(plan.curves.time[during], plan.time, plan.zmp[:, 0])
    error = np.abs(plan.curves.zmp_cwtg1[during, 0] - wanted).max()
    assert error == pytest.approx(said["zmp_error_after_cwtg1_m"][0], rel=0.1)


def test_the_phases_are_those_of_the_true_feet(crossing) -> None:
    """Phase 1 is the flight of the first foot, phase 3 of the second."""
    (phases,) = crossing.plans[0].phases
    motion = crossing.data.motion
    for foot, begin, end in (
        (phases.first, phases.begin, phases.touch),
        (phases.second, phases.lift, phases.end),
    ):
        high = motion.time[motion.X_WF[foot][:, 2, 3] > 0.06]
        assert begin < high[0] < high[-1] < end
    assert phases.first != phases.second
    said = crossing.data.run.summary["crossing_time_s"]
    assert phases.end - phases.begin == pytest.approx(said, abs=0.06)


def test_the_windows_hold_steps_before_and_after(crossing) -> None:
    """One for the film strip, two for the figures."""
    (plan,) = crossing.plans
    (phases,) = plan.phases
    (begin, end), (first, last) = plan.window(), plan.stretch()
    swings = plan.swings
    assert ((swings[:, 0] >= begin - 1e-9) & (swings[:, 1] <= end + 1e-9)).sum() == 6
    assert ((swings[:, 0] >= first - 1e-9) & (swings[:, 1] <= last + 1e-9)).sum() == 4
    assert first < phases.begin < phases.end < last


def test_obstacle_and_box_are_matched(crossing) -> None:
    """The axes follow the true box where it is near, else what was seen."""
    (obstacle,) = crossing.plans[0].obstacles
    box = crossing.true_box(obstacle)
    assert box.name == "box/obstacle"
    np.testing.assert_allclose(crossing.axes, np.eye(2), atol=1e-12)
    np.testing.assert_allclose(crossing.across_box(box, obstacle), [1.0, 0.0])
    far = obstacle.__class__(obstacle.center + 1.0, np.pi, 0.05, 0.15, 1.0)
    assert crossing.true_box(far) is None
    assert crossing.across_box(box, far)[0] == pytest.approx(-1.0)


def test_without_adaptation_nothing_is_repaired(crossing) -> None:
    """The same feet; the waist is 2 cm higher where the adaptor has lowered it."""
    (plan,) = crossing.plans
    bare = without_adaptation(crossing, plan)
    assert bare.report.repairs.lowered == 0.0
    assert bare.start_time == plan.time[0]
    lowered = bare.report.curves.waist[:, 2] - plan.curves.waist[:, 2]
    assert lowered.max() == pytest.approx(plan.repairs.lowered, abs=1e-6)


def test_the_parameters_are_those_of_the_way_that_was_taken(crossing) -> None:
    """Over 15 cm the first; a plan of another way is read with that way's."""
    (plan,) = crossing.plans
    assert plan.way == 0
    params = crossing.data.run.scenario.parameters.crossing
    assert crossing.params(plan) == params
    high = crossing.params(replace(plan, way=2))
    assert high.feasibility.s_w == params.high.margins[1]
    assert high.single_support == params.high.single_support


def test_runs_without_crossings_have_none(tmp_path, standing, crossed_folder) -> None:
    """Nor those that did not log their plans."""
    data = read_run_data(crossed_folder)
    plans = crossed_folder / "signals" / "executive.motion_plan.jsonl"
    hidden = plans.rename(tmp_path / "plans")
    try:
        assert read_crossings(data) is None
    finally:
        hidden.rename(plans)
