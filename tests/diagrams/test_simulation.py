"""The runner: however a run stops, its folder is whole and says why."""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from footfall.diagrams.figures.run_figures import plot_run
from footfall.diagrams.judge.evidence import gather, joint_velocities
from footfall.diagrams.judge.evidence_signals import fall
from footfall.diagrams.judge.watch import RobotWatch
from footfall.diagrams.run_folder import RecordingError
from footfall.diagrams.signals import load_run
from footfall.diagrams.simulation import run_task, simulate
from footfall.models.scenes.scene import SceneParams
from footfall.models.scenes.staircase import StaircaseParams
from footfall.models.values.planned import TaskStatus
from tests.diagrams.test_signal_files import room_for


def test_a_task_without_stairs_is_completed_by_standing(tmp_path, standing) -> None:
    """Everything that was logged is there, and measured."""
    scenario = standing.scenario(seed=7)
    summary = run_task(standing.task(), scenario, tmp_path / "a" / "run")
    assert summary.outcome == "completed"
    # Done after 0.2 s it is given five seconds to come to rest, which takes one.
    assert 1.2 < summary.simulated_time_s < 5.2
    assert summary.max_impact_body_weights == pytest.approx(0.5, abs=0.1)
    assert 0.0 < summary.min_zmp_margin_m < 0.1
    run = load_run(tmp_path / "a" / "run")
    assert run.scenario == scenario
    assert run.summary["seed"] == 7
    assert run.summary["real_time_factor"] > 0.0
    state = run.signals["plant.state"]
    last = summary.simulated_time_s - 0.005
    assert state["time"].iloc[-1] == pytest.approx(last)
    assert state.shape == (round(last / 0.005) + 1, 1 + 39 + 38)
    activities = [value["activity"] for _, value in run.values("executive.status")]
    assert activities == ["stand", "stand"]
    assert set(run.summary["timing_us"]) >= {"executive", "contact_monitor", "station"}
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["run"]


def test_same_seed_same_result(tmp_path, standing) -> None:
    """Bit for bit."""
    states = []
    for name in "ab":
        run_task(standing.task(), standing.scenario(), tmp_path / name)
        states.append(load_run(tmp_path / name).signals["plant.state"].to_numpy())
    np.testing.assert_array_equal(*states)


def test_a_fall_ends_the_run(tmp_path, standing) -> None:
    """It is seen in the true state: the clock goes on saying that all is well."""
    task = standing.task(end=60.0, pitch=0.4)
    summary = run_task(task, standing.scenario(max_time=20.0), tmp_path / "run")
    assert summary.outcome == "fell"
    assert summary.simulated_time_s < 6.0
    assert summary.reason.startswith("the robot fell at ")


def test_a_fall_is_watched_to_the_ground(standing) -> None:
    """Until the robot lies: that it fell was plain a good while before."""
    task = standing.task(end=60.0, pitch=0.4)
    simulated = simulate(task, 20.0)
    assert simulated.stop == "fell"
    evidence = gather(task, simulated.context, simulated.stop, simulated.reason)
    fallen = fall(evidence)
    assert fallen is not None
    assert simulated.context.get_time() > fallen.time + 0.2
    assert evidence.motion.base[-1, 2] < 0.3
    support = evidence.frames["contact_monitor.other_support"]["fz"].iloc[-50:]
    assert (support > 0.4 * evidence.limits.weight).all()


def test_a_robot_that_does_not_rest_is_watched_for_five_seconds(standing) -> None:
    """And no longer; here the watch never sees it rest."""
    task = standing.task(end=0.1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(RobotWatch, "rests", lambda self: False)
        simulated = simulate(task, 1.0)
    assert simulated.stop == "finished"
    assert simulated.context.get_time() == pytest.approx(5.1, abs=0.06)


def test_infeasible_ends_the_run_with_its_reason(tmp_path, standing) -> None:
    """As the executive gives it."""
    status = TaskStatus("infeasible", "plan", "the step is 40 cm high")
    task = standing.task(0.1, status)
    summary = run_task(task, standing.scenario(), tmp_path / "run")
    assert (summary.outcome, summary.reason) == ("infeasible", status.reason)
    assert summary.simulated_time_s == pytest.approx(0.1)


def test_time_limit_ends_the_run(tmp_path, standing) -> None:
    """Exactly then."""
    task = standing.task(end=60.0)
    summary = run_task(task, standing.scenario(max_time=0.33), tmp_path / "run")
    assert (summary.outcome, summary.reason) == ("timed_out", "not done after 0.33 s")
    assert summary.simulated_time_s == pytest.approx(0.33)


def test_ctrl_c_ends_a_run_that_is_kept(tmp_path, standing) -> None:
    """Judged as interrupted, its log up to then; nothing went wrong."""
    task = standing.task(0.2, KeyboardInterrupt())
    summary = run_task(task, standing.scenario(), tmp_path / "run")
    assert summary.outcome == "interrupted"
    assert summary.reason.startswith("interrupted at 0.2")
    assert len(load_run(tmp_path / "run").signals["plant.state"]) >= 40
    assert not (tmp_path / "run" / "traceback.txt").exists()


def test_what_breaks_a_run_off_keeps_the_log(tmp_path, standing) -> None:
    """The log up to then is written, and where it broke."""
    task = standing.task(0.2, RuntimeError("the solver failed\nat length"))
    summary = run_task(task, standing.scenario(), tmp_path / "run")
    assert summary.outcome == "cut"
    assert "RuntimeError: the solver fail" in summary.reason
    assert "\n" not in summary.reason
    assert len(load_run(tmp_path / "run").signals["plant.state"]) >= 40
    assert "_calc_status" in (tmp_path / "run" / "traceback.txt").read_text()


@pytest.mark.parametrize(
    ("error", "outcome"),
    [(KeyboardInterrupt(), "interrupted"), (RuntimeError("no"), "cut")],
)
def test_a_run_that_ends_before_it_logs_says_so(
    tmp_path, standing, monkeypatch, error, outcome
) -> None:
    """There is nothing to judge."""

    def broken(*_: object) -> None:
        raise error

    monkeypatch.setattr("pydrake.systems.analysis.Simulator.Initialize", broken)
    summary = run_task(standing.task(), standing.scenario(), tmp_path / "run")
    assert summary.outcome == outcome
    assert summary.simulated_time_s == 0.0
    assert summary.footsteps is None
    assert load_run(tmp_path / "run").summary["outcome"] == outcome


def test_a_folder_in_use_is_refused_and_left_alone(tmp_path, standing) -> None:
    """An empty one is taken."""
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "thesis.txt").write_text("years of work")
    with pytest.raises(FileExistsError, match="run: exists and is not empty"):
        run_task(standing.task(), standing.scenario(), tmp_path / "run")
    assert [path.name for path in tmp_path.rglob("*")] == ["run", "thesis.txt"]
    (tmp_path / "empty").mkdir()
    run_task(standing.task(), standing.scenario(), tmp_path / "empty")
    assert load_run(tmp_path / "empty").summary["outcome"] == "completed"


KILLED = """
import sys
from pathlib import Path
from footfall.diagrams.simulation import run_task
from tests.diagrams.conftest import standing_scenario, standing_task

run_task(
    standing_task(end=60.0),
    standing_scenario(max_time=60.0),
    Path(sys.argv[1]),
    progress=lambda time, activity: print(time, flush=True),
)
"""


def test_a_killed_run_has_all_but_its_last_second(tmp_path) -> None:
    """It opens, says that it was cut, and is drawn."""
    folder = tmp_path / "run"
    with subprocess.Popen(
        [sys.executable, "-c", KILLED, str(folder)],
        cwd=Path(__file__).parents[2],
        env=os.environ | {"PYTHONPATH": "."},
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        times = (float(line) for line in process.stdout)
        time = next(time for time in times if time > 1.2)
        process.send_signal(signal.SIGKILL)
    run = load_run(folder)
    for name in ("plant.state", "station.foot_wrenches"):
        assert run.signals[name]["time"].iloc[-1] >= time - 1.0
    assert run.values("executive.status")[0][1]["activity"] == "stand"
    assert run.summary["outcome"] == "cut"
    assert run.summary["simulated_time_s"] >= time - 1.0
    assert len(plot_run(folder)) == 5


@pytest.mark.parametrize("room", [100_000, 30_000])
def test_a_disk_that_fills_up_ends_the_run_in_one_line(
    tmp_path, standing, room
) -> None:
    """What was written until then can be read; nothing is empty or half there."""
    task, folder = standing.task(end=60.0), tmp_path / "run"
    scenario = standing.scenario(max_time=20.0)
    with room_for(room), pytest.raises(RecordingError) as caught:
        run_task(task, scenario, folder)
    (line,) = str(caught.value).splitlines()
    assert line.startswith(f"{folder}: cannot be written to at ")
    assert "File too large" in line
    run = load_run(folder)
    assert run.summary["outcome"] == "cut"
    ends = [run.signals[name]["time"].iloc[-1] for name in run.signals]
    assert all(time > 0.4 for time in ends)
    assert ("plant.state" in run.signals) == (room > 60_000)
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert all(path.stat().st_size > 0 for path in files)
    assert not [path for path in files if path.suffix == ".partial"]


def test_a_folder_that_vanishes_ends_the_run_in_one_line(tmp_path, standing) -> None:
    """It is not made again."""
    folder = tmp_path / "run"

    def remove(time: float, _: str) -> None:
        if time > 0.7 and folder.exists():
            shutil.rmtree(folder)

    with pytest.raises(RecordingError, match=r"run: cannot.*No such file") as caught:
        run_task(
            standing.task(end=60.0),
            standing.scenario(max_time=20.0),
            folder,
            progress=remove,
        )
    assert "at 1.00 s of the run" in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_summary_that_does_not_fit_leaves_the_signals(
    tmp_path, standing, monkeypatch
) -> None:
    """As a run that was cut."""

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("footfall.diagrams.judge.summary.Summary.write", full)
    with pytest.raises(RecordingError, match="No space left on device"):
        run_task(standing.task(), standing.scenario(), tmp_path / "run")
    run = load_run(tmp_path / "run")
    assert run.summary["outcome"] == "cut"
    assert len(run.signals["plant.state"]) >= 140


def test_what_is_streamed_is_what_memory_would_hold(tmp_path, standing) -> None:
    """The folder of a run changes nothing of it."""
    run_task(standing.task(), standing.scenario(), tmp_path / "run")
    task = standing.task()
    simulated = simulate(task, 1.0)
    run = load_run(tmp_path / "run")
    for name, frame in task.signals.frames(simulated.context).items():
        np.testing.assert_array_equal(run.signals[name], frame, name)


def test_judging_is_not_broken_off(tmp_path, standing) -> None:
    """What holds Ctrl-C off is held from the simulation's end to the folder's."""
    had = []

    @contextmanager
    def holding() -> Iterator[None]:
        had.append({path.name for path in (tmp_path / "run").iterdir()})
        yield
        had.append({path.name for path in (tmp_path / "run").iterdir()})

    scenario = standing.scenario()
    run_task(standing.task(), scenario, tmp_path / "run", while_judging=holding)
    assert had == [
        {"scenario.yaml", "signals"},
        {"scenario.yaml", "signals", "summary.json"},
    ]


def test_progress_is_told(standing) -> None:
    """Every slice, with the time and what is done."""
    told: list[tuple[float, str]] = []
    simulate(standing.task(), 1.0, lambda time, activity: told.append((time, activity)))
    times = [time for time, _ in told]
    np.testing.assert_allclose(times[:-1], np.arange(1, len(times)) * 0.05)
    assert {activity for _, activity in told} == {"stand"}


def test_evidence_is_the_truth_of_the_plant(standing) -> None:
    """Soles on the floor, limits of the URDF, touches of a step it stands in."""
    scene = SceneParams(staircase=StaircaseParams(x=0.12, rise=0.05))
    task = standing.task(scene=scene, end=0.05)
    simulated = simulate(task, 0.1)
    evidence = gather(task, simulated.context, simulated.stop, simulated.reason)
    heights = evidence.motion.sole_corners["left"][0, :, 2]
    np.testing.assert_allclose(heights, 0.0, atol=1e-9)
    assert len(evidence.limits.torque) == 32
    assert set(evidence.limits.torque.values()) == {100.0}
    assert evidence.limits.speed["R_KNEE"] == pytest.approx(14.66, abs=0.01)
    assert evidence.limits.weight == pytest.approx(62.4 * 9.81, rel=0.01)
    assert {"staircase/step_1"} <= {touch.solid for touch in evidence.touches}
    assert evidence.kind == "standing"
    assert evidence.friction == 0.8
    assert set(evidence.joint_velocities) == set(evidence.limits.speed)
    assert evidence.activities[0] == (0.0, "stand")


def test_joint_velocities_go_by_name(standing) -> None:
    """Those of the state's second half, without the floating base."""
    task = standing.task()
    context = task.plant.CreateDefaultContext()
    for joint, speed in (("R_KNEE", 1.5), ("L_WRIST_Y", -0.25)):
        task.plant.GetJointByName(joint).set_angular_rate(context, speed)
    state = task.plant.GetPositionsAndVelocities(context, task.robot_instance)
    speeds = joint_velocities(task.plant, task.robot_instance, state[None])
    assert len(speeds) == 32
    assert {name: v[0] for name, v in speeds.items() if v[0] != 0.0} == {
        "R_KNEE": 1.5,
        "L_WRIST_Y": -0.25,
    }
