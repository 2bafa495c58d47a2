"""The headless runner: simulates a task, judges it and writes the run folder."""

import os
import shutil
import traceback
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter
from typing import TypeAlias

from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from diagrams.crossing_judge import eyes_summary
from diagrams.evidence import Evidence, Stop, gather
from diagrams.outcome import judge
from diagrams.room_summary import room_perception, stage_ms
from diagrams.scenario import Scenario, save_scenario
from diagrams.signals import SCENARIO_FILE, SIGNALS_FOLDER, SUMMARY_FILE
from diagrams.summary import (
    Summary,
    installed_versions,
    perception_summary,
    timing_us,
)
from diagrams.task_diagram import TaskDiagram
from diagrams.watch import (
    LIE_TIME,
    LOOK,
    WATCHED_REST,
    HoldClock,
    RobotWatch,
)
from systems.values import Json

REST_WATCH = 5.0
"""For how long a robot that has finished is given to come to rest, s."""
FALL_WATCH = 3.0
"""For how long a robot that falls is watched at the most, until it lies, s."""
SLICE = 0.05
"""How long the simulation runs between two looks at how it goes, s."""
TRACEBACK_FILE = "traceback.txt"
Progress: TypeAlias = Callable[[float, str], None]
"""Is told the simulated time, s, and what the executive is doing."""


@dataclass(frozen=True)
class Simulated:
    """A simulation that has stopped."""

    context: Context
    """The diagram's, with the logs in it."""
    stop: Stop
    reason: str
    wall_time: float
    """s."""
    error: BaseException | None = None
    """What was raised, where something was."""


def run_task(
    task: TaskDiagram,
    scenario: Scenario,
    folder: Path,
    progress: Progress | None = None,
    realtime_rate: float = 0.0,
) -> Summary:
    """Simulates a task and writes its run folder, however the simulation stops.

    The folder appears in one piece: it is written beside its place and then renamed.

    Args:
        task: the closed loop.
        scenario: what it was built from.
        folder: where the run goes; must not exist, or be empty.
        progress: is called every `SLICE` of simulated time.
        realtime_rate: upper bound of simulated over wall time; 0 runs as fast as it
            can.

    Raises:
        FileExistsError: the folder exists and is not empty.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise FileExistsError(f"{folder}: exists and is not empty")
    folder.parent.mkdir(parents=True, exist_ok=True)
    partial = folder.with_name(f".{folder.name}.partial-{os.getpid()}")
    partial.mkdir()
    try:
        save_scenario(scenario, partial / SCENARIO_FILE)
        simulated = simulate(
            task, scenario.simulation.max_time, progress, realtime_rate
        )
        task.signals.write(simulated.context, partial / SIGNALS_FOLDER)
        summary = summarize(task, scenario, simulated)
        summary.write(partial / SUMMARY_FILE)
        if simulated.error is not None:
            text = "".join(traceback.format_exception(simulated.error))
            (partial / TRACEBACK_FILE).write_text(text, encoding="utf-8")
        partial.replace(folder)
    finally:
        shutil.rmtree(partial, ignore_errors=True)
    return summary


def simulate(
    task: TaskDiagram,
    max_time: float,
    progress: Progress | None = None,
    realtime_rate: float = 0.0,
) -> Simulated:
    """Simulates until the task is over, the robot fell, time is up or Ctrl-C.

    A task that is finished is watched until the robot has been at rest for
    `REST_TIME`, for `REST_WATCH` at the most; a fall until the robot lies, for
    `FALL_WATCH` at the most.

    An exception, of the contact solver or of a System, ends the simulation like a
    fall does; what was logged until then is kept.
    """
    simulator = Simulator(task.diagram)
    simulator.set_target_realtime_rate(realtime_rate)
    context = simulator.get_mutable_context()
    watch = RobotWatch(task, context)
    end, finished, fell = max_time, False, False
    resting, lying = HoldClock(WATCHED_REST), HoldClock(LIE_TIME)
    stop: Stop = "time limit"
    reason = f"not done after {max_time:g} s"
    error: BaseException | None = None
    start = perf_counter()
    try:
        simulator.Initialize()
        while context.get_time() < end - 1e-9:
            until = min(context.get_time() + SLICE, end)
            if finished and not fell:
                _advance_to_rest(simulator, until, watch, resting)
            else:
                simulator.AdvanceTo(until)
            now, status = context.get_time(), task.task_status(context)
            if progress is not None:
                progress(now, status.activity)
            if fell:
                lying.look(now, watch.lies())
                if lying.done():
                    break
            elif (how := watch.fall()) is not None:
                fell, end = True, now + FALL_WATCH
                stop, reason = "fell", f"the robot fell at {now:.2f} s: {how}"
            elif finished:
                if resting.done():
                    break
            elif status.state == "infeasible":
                stop, reason = "infeasible", status.reason
                break
            elif status.state == "finished":
                finished, end = True, now + REST_WATCH
                stop, reason = "finished", status.reason
    except KeyboardInterrupt as interrupt:
        stop, reason = "interrupted", f"interrupted at {context.get_time():.2f} s"
        error = interrupt
    except Exception as exception:
        stop, error = "error", exception
        message = (str(exception).splitlines() or [""])[0]
        what = f"{type(exception).__name__}: {message}"
        reason = f"the simulation broke off at {context.get_time():.2f} s: {what}"
    return Simulated(context, stop, reason, perf_counter() - start, error)


def _advance_to_rest(
    simulator: Simulator, until: float, watch: RobotWatch, resting: HoldClock
) -> None:
    """Simulates in steps of `LOOK`, as long as the robot has not rested enough."""
    context = simulator.get_context()
    while context.get_time() < until - 1e-9 and not resting.done():
        simulator.AdvanceTo(min(context.get_time() + LOOK, until))
        resting.look(context.get_time(), watch.rests())


def summarize(task: TaskDiagram, scenario: Scenario, simulated: Simulated) -> Summary:
    """Judges a simulation that has stopped and gathers what its summary says."""
    evidence = gather(task, simulated.context, simulated.stop, simulated.reason)
    simulated_time = simulated.context.get_time()
    return Summary(
        **asdict(judge(evidence)),
        scenario=scenario.name,
        seed=scenario.simulation.seed,
        simulated_time_s=simulated_time,
        wall_time_s=simulated.wall_time,
        real_time_factor=simulated_time / simulated.wall_time or None,
        perception=_perception(task, evidence),
        timing_us=timing_us(task.diagram),
        versions=installed_versions(),
    )


def _perception(task: TaskDiagram, evidence: Evidence) -> Mapping[str, Json] | None:
    """How the stairs, the room or the obstacles were seen; None where none was."""
    if evidence.crossing is not None:
        return eyes_summary(evidence.crossing)
    ms_per_frame = stage_ms(task.diagram, len(evidence.environments))
    if ms_per_frame:
        return room_perception(evidence.environments, task.scene, ms_per_frame)
    return perception_summary(
        evidence.segmentations, evidence.staircases, evidence.treads
    )
