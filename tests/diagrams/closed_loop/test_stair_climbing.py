"""The main job: one whole climb, what it leaves behind, and how it may fail."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from footfall.diagrams.cli.app import app
from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.simulation import run_task, simulate
from footfall.models.values.feet import FEET

QUICK_SCAN = "sensors.lidar.tilt_step_deg=0.5"


@pytest.fixture(scope="module")
def climb(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The stair paper's first experiment, from the first scan to the top."""
    folder = tmp_path_factory.mktemp("climb") / "run"
    scenario = load_scenario("stairs-exp1")
    run_task(build_task(scenario), scenario, folder)
    return load_run(folder)


def test_it_climbs_to_the_top(climb: Run) -> None:
    """Both feet on the third tread, judged from the plant's true state."""
    summary = climb.summary
    assert summary["outcome"] == "completed", summary["reason"]
    assert summary["reason"] == "both feet rest on the top tread, number 3"
    assert summary["steps_climbed"] == 3
    assert summary["footsteps"] >= 6
    feet = climb.signals["feet.true"]
    for foot in FEET:
        assert feet[f"{foot}_z"].iloc[-1] == pytest.approx(0.60, abs=3e-3)
        assert 0.6 + 2 * 0.27 < feet[f"{foot}_x"].iloc[-1] < 0.6 + 3 * 0.27


def test_nothing_but_soles_touches_the_staircase(climb: Run) -> None:
    """At no step of the plant."""
    assert [touches for _, touches in climb.values("contact_monitor.touches")] == [
        {"touches": []}
    ]


def test_it_is_within_its_limits(climb: Run) -> None:
    """Torque and speed of the URDF; counted again from the signals."""
    summary = climb.summary
    assert summary["max_torque_fraction"] <= 1.0 + 1e-6
    assert summary["max_speed_fraction"] <= 1.0 + 1e-6
    torque = climb.signals["plant.net_actuation"].drop(columns="time").abs().to_numpy()
    assert torque.max() / 100.0 == pytest.approx(summary["max_torque_fraction"])
    command = climb.signals["station.torque_command"].drop(columns="time").abs()
    assert command.to_numpy().max() <= 100.0 + 1e-6


def test_it_is_quick_and_does_not_slip(climb: Run) -> None:
    """From the first motion to the top, scans not counted."""
    summary = climb.summary
    assert summary["climb_time_s"] <= 20.0
    assert summary["climb_time_s"] >= 6 * 0.8
    assert summary["max_foot_slip_m"] < 0.01
    assert summary["min_clearance_m"] > 0.01
    assert summary["max_dcm_error_m"] < 0.05
    assert summary["com_rms_error_m"] < 0.01


def test_it_saw_the_staircase_well(climb: Run) -> None:
    """Every frame against the true scene, and its own map at the end."""
    perception = climb.summary["perception"]
    assert perception["frames"] >= 2
    errors = perception["errors"]
    assert errors["treads"] >= 3
    assert errors["max_height_m"] < 0.005
    assert errors["max_front_edge_m"] < 0.01
    assert errors["max_normal_deg"] < 1.0
    treads = climb.values("staircase_map.staircase")[-1][1]["treads"]
    heights = [tread["X_WR"]["translation"][2] for tread in treads]
    np.testing.assert_allclose(heights, [0.2, 0.4, 0.6], atol=0.005)


def test_it_scans_between_climbs(climb: Run) -> None:
    """Only what was seen is planned: two treads at most from scan to scan."""
    activities = [value["activity"] for _, value in climb.values("executive.status")]
    assert activities.count("scan") >= 3
    for before, after in pairwise(activities):
        if after == "move":
            assert before == "plan"
        if after == "plan":
            assert before == "scan"
    assert activities[-1] == "stand"
    for _, plan in climb.values("executive.footstep_plan"):
        planes = {step["plane"] for step in plan["footsteps"]} - {-1}
        assert len(planes) <= 2


def test_thinking_takes_its_time(climb: Run) -> None:
    """What a sweep says, and each plan; what is logged may be an update late."""
    thinking = climb.scenario.parameters.thinking
    for time, seen in climb.values("staircase_map.segmentation")[1:]:
        late = time - seen["sensed_at"] - thinking.segmentation
        assert -1e-6 < late < 2 * 0.025 + 1e-6
    status = climb.values("executive.status")
    plans = 0
    for (begun, value), (there, _) in pairwise(status):
        if value["activity"] == "plan":
            plans += 1
            assert -1e-6 < there - begun - thinking.climb_planning < 0.025 + 1e-6
    assert plans >= 3


def test_a_plan_still_fits_when_it_is_there(climb: Run) -> None:
    """Nothing that it begins with has moved since it was begun."""
    status = climb.values("executive.status")
    plans = 0
    for (begun, value), (there, after) in pairwise(status):
        if (value["activity"], after["activity"]) != ("plan", "move"):
            continue
        plans += 1
        for name in ("feet.wanted", "reference.com"):
            signal = climb.signals[name]
            time = signal["time"]
            thinking = signal[(time > begun) & (time < there - 0.03)].to_numpy()[:, 1:4]
            assert len(thinking) > 10
            assert np.ptp(thinking, axis=0).max() < 1e-6
    assert plans >= 2


def test_signals_open_in_pandas(climb: Run) -> None:
    """Directly from the folder: a time column, no holes, the whole run."""
    files = sorted((climb.folder / "signals").glob("*.parquet"))
    assert len(files) >= 16
    for path in files:
        frame = pd.read_parquet(path)
        assert frame.columns[0] == "time"
        assert frame["time"].is_monotonic_increasing
        end = climb.summary["simulated_time_s"]
        assert frame["time"].iloc[-1] == pytest.approx(end, abs=0.02)
        if path.stem != "balance_state.zmp":
            assert np.isfinite(frame.to_numpy()).all(), path.stem


def test_summary_times_every_system(climb: Run) -> None:
    """Median and 99th percentile of the callbacks of perception and control."""
    timing = climb.summary["timing_us"]
    assert set(timing) >= {
        *("tilting_lidar", "scan_assembler", "plane_segmenter", "staircase_map"),
        *("footstep_planner", "motion_planner", "executive", "motion_player"),
        *("zmp_preview", "landing_adaptor", "ik_tracker", "stabilizer"),
        *("feedforward", "kinematic_state", "foot_wrench_sensor", "contact_monitor"),
    }
    for system in timing.values():
        assert 0.0 < system["median"] <= system["p99"]


def test_its_scenario_runs_again_bit_for_bit(climb: Run) -> None:
    """The resolved file of the run folder, for the first half second."""
    scenario = load_scenario(climb.folder / "scenario.yaml")
    assert scenario == load_scenario("stairs-exp1")
    task = build_task(scenario)
    simulated = simulate(task, 0.5)
    for name, again in task.signals.frames(simulated.context).items():
        first = climb.signals[name].iloc[: len(again)]
        np.testing.assert_array_equal(again.to_numpy(), first.to_numpy(), name)


def run(tmp_path: Path, *overrides: str) -> tuple[int, str, Run]:
    """Exit status, output and run folder of `footfall run stairs-exp1`."""
    settings = [word for item in overrides for word in ("--set", item)]
    arguments = ["run", "stairs-exp1", "--out", str(tmp_path / "run"), *settings]
    result = CliRunner().invoke(app, arguments)
    return result.exit_code, result.stdout, load_run(tmp_path / "run")


def test_a_robot_that_is_pushed_over_has_fallen(tmp_path: Path) -> None:
    """With the time, in summary and output; exit status 1; what was logged is kept."""
    push = "task.pushes=[{time: 1.0, duration: 0.2, force: [400.0, 0.0, 0.0]}]"
    status, output, run_folder = run(tmp_path, push, "simulation.max_time=8.0")
    summary = run_folder.summary
    assert status == 1
    assert summary["outcome"] == "fell"
    end = summary["simulated_time_s"]
    assert 1.2 < end < 7.0
    assert summary["reason"].startswith("the robot fell at ")
    assert output.startswith("fell: the robot fell at ")
    time = run_folder.signals["plant.state"]["time"]
    assert time.iloc[-1] == pytest.approx(end, abs=0.01)
    assert run_folder.scenario.task.pushes[0].force == [400.0, 0.0, 0.0]


def test_a_robot_that_is_nudged_stands_on() -> None:
    """The same push, a tenth as strong."""
    push = "task.pushes=[{time: 0.5, duration: 0.2, force: [40.0, 0.0, 0.0]}]"
    simulated = simulate(build_task(load_scenario("stairs-exp1", [push])), 2.5)
    assert simulated.stop == "time limit"


@pytest.mark.parametrize(
    ("overrides", "reason"),
    [
        (
            ("scene.staircase.rise=0.4", "scene.staircase.steps=1"),
            "tread 1 rises 0.40 m above the floor, more than the 0.25 m",
        ),
        (
            ("scene.staircase.run=0.15",),
            "tread 1 is 0.150 m deep, too shallow for the 0.225 m sole",
        ),
    ],
    ids=["too high", "narrower than a foot"],
)
def test_a_staircase_that_cannot_be_climbed(
    tmp_path: Path, overrides: tuple[str, ...], reason: str
) -> None:
    """Is refused before a step is taken, with the reason; exit status 1."""
    status, output, run_folder = run(tmp_path, QUICK_SCAN, *overrides)
    summary = run_folder.summary
    assert status == 1
    assert summary["outcome"] == "infeasible"
    assert summary["reason"].startswith(reason)
    assert "\n" not in summary["reason"]
    # The terminal may break the line.
    assert " ".join(output.split()).startswith(f"infeasible: {reason}")
    assert summary["footsteps"] == 0
    assert summary["climb_time_s"] is None


def test_seeds_differ_in_what_is_seen() -> None:
    """The scanner's noise is another one; the robot stands alike until it knows."""
    lines = []
    for seed in (0, 1):
        task = build_task(load_scenario("stairs-exp1", [f"simulation.seed={seed}"]))
        simulated = simulate(task, 0.5)
        lidar = task.system("tilting_lidar")
        context = lidar.GetMyContextFromRoot(simulated.context)
        lines.append(lidar.GetOutputPort("scan").Eval(context))
    assert lines[0].tilt == lines[1].tilt
    assert lines[0] != lines[1]
