"""One whole crossing in physics, and a refusal."""

from pathlib import Path

import pytest

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.simulation import run_task

QUICK_SCAN = "sensors.lidar.tilt_step_deg=0.5"


def _run(folder: Path, *overrides: str) -> Run:
    scenario = load_scenario("obstacle-15cm", [QUICK_SCAN, *overrides])
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


@pytest.fixture(scope="module")
def crossing(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The shipped scenario with half as many scan lines."""
    return _run(tmp_path_factory.mktemp("crossing") / "run")


def test_it_crosses_and_walks_on(crossing: Run) -> None:
    """Judged from the plant's true state."""
    summary = crossing.summary
    assert summary["outcome"] == "completed", summary["reason"]
    assert summary["obstacles_crossed"] == 1
    assert summary["goal_error_m"] < 0.05
    assert crossing.signals["feet.true"]["left_x"].iloc[-1] > 1.2 + 0.5


def test_phases_margin_and_impact_are_the_papers(crossing: Run) -> None:
    """4 s, 3 cm, 1.3 body weights; torque and speed within their limits."""
    summary = crossing.summary
    assert summary["crossing_time_s"] <= 4.0
    assert summary["min_clearance_m"] >= 0.03
    assert summary["max_impact_body_weights"] <= 1.3
    assert summary["max_torque_fraction"] <= 1.0 + 1e-6
    assert summary["max_speed_fraction"] <= 1.0 + 1e-6


def test_the_zmp_is_five_times_nearer_after_the_filter(crossing: Run) -> None:
    """Planned; the measured one stays inside the support polygon."""
    figures = crossing.summary["crossing"]
    for before, after in zip(
        figures["zmp_error_after_cwtg1_m"],
        figures["zmp_error_after_cwtg2_m"],
        strict=True,
    ):
        assert after < before / 5.0
    assert crossing.summary["min_zmp_margin_m"] > 0.0


def test_the_eyes_are_right(crossing: Run) -> None:
    """Against the true box."""
    errors = crossing.summary["perception"]["errors"]
    assert errors["max_front_m"] < 0.005
    assert errors["max_height_m"] < 0.01
    assert errors["max_yaw_deg"] < 1.0


def test_thinking_takes_its_time(crossing: Run) -> None:
    """What a sweep shows, and each plan, which begins when it is there."""
    thinking = crossing.scenario.parameters.thinking
    maps = crossing.values("obstacle_finder.obstacle_map")[1:]
    for time, seen in maps:
        late = time - seen["sensed_at"] - thinking.obstacle_finding
        assert -1e-6 < late < 2 * 0.025 + 1e-6
    (known, _), (start, _) = maps[0], crossing.values("executive.motion_plan")[1]
    plan = crossing.values("executive.motion_plan")[1][1]
    assert plan["start_time"] == pytest.approx(start, abs=0.026)
    late = start - known - thinking.crossing_planning
    assert -1e-6 < late < 3 * 0.025 + 1e-6


def test_too_high_an_obstacle_is_refused_before_it_is_reached(tmp_path: Path) -> None:
    """With the reason, the feet where they were."""
    run = _run(tmp_path / "run", "scene.boxes[0].size=[0.05, 1.2, 0.45]", "robot.x=0.1")
    summary = run.summary
    assert summary["outcome"] == "infeasible"
    assert "cannot be crossed" in summary["reason"]
    assert summary["obstacles_crossed"] == 0
    assert run.signals["feet.true"]["left_x"].iloc[-1] == pytest.approx(0.1, abs=0.01)


def test_quasi_statically_the_com_is_always_over_what_stands(tmp_path: Path) -> None:
    """The true CoM, at a third of the dynamic pace; begun near by to save time."""
    run = _run(
        tmp_path / "run",
        "task.mode=quasi_static",
        "robot.x=0.5",
        "task.goal=[1.75, 0.0, 0.0]",
    )
    summary = run.summary
    assert summary["outcome"] == "completed", summary["reason"]
    assert summary["obstacles_crossed"] == 1
    assert summary["min_static_margin_m"] > 0.015
    assert summary["min_clearance_m"] >= 0.03
    assert 8.0 < summary["crossing_time_s"] < 12.0
    assert summary["max_torque_fraction"] < 0.95
    planned = summary["crossing"]
    assert summary["min_static_margin_m"] == pytest.approx(
        planned["static_margin_m"], abs=3e-3
    )
    share = planned["static_torque_fraction"]
    assert summary["max_torque_fraction"] == pytest.approx(share, abs=0.06)


def test_quasi_statically_a_higher_obstacle_is_refused_by_its_equation(
    tmp_path: Path,
) -> None:
    """20 cm, which the robot crosses dynamically."""
    run = _run(
        tmp_path / "run",
        "task.mode=quasi_static",
        "scene.boxes[0].size=[0.05, 1.2, 0.20]",
    )
    assert run.summary["outcome"] == "infeasible"
    assert "Eq. 6, the CoM over the rear foot" in run.summary["reason"]
