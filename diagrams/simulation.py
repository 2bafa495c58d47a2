"""The headless runner: simulates a task, judges it and writes the run folder."""

import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter
from typing import TypeAlias

from pydrake.systems.analysis import Simulator, SimulatorStatus
from pydrake.systems.framework import Context, Diagram, EventStatus

from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.judge.crossing_judge import obstacle_map_errors
from footfall.diagrams.judge.estimate_errors import estimate_summary
from footfall.diagrams.judge.evidence import Evidence, Stop, gather
from footfall.diagrams.judge.outcome import Judgement, Outcome, judge
from footfall.diagrams.judge.room_summary import room_perception, stage_ms
from footfall.diagrams.judge.summary import (
    Summary,
    installed_versions,
    perception_summary,
    timing_us,
)
from footfall.diagrams.judge.watch import (
    LIE_TIME,
    LOOK,
    WATCHED_REST,
    HoldClock,
    RobotWatch,
)
from footfall.diagrams.run_folder import RecordingError, begin_run
from footfall.diagrams.scenario import Scenario
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signal_recorder import SignalStream
from footfall.diagrams.signals import SIGNALS_FOLDER, SUMMARY_FILE
from footfall.models.values.value import Json

REST_WATCH = 5.0
"""For how long a robot that has finished is given to come to rest, s."""
FALL_WATCH = 3.0
"""For how long a robot that falls is watched at the most, until it lies, s."""
SLICE = 0.05
"""How long the simulation runs between two looks at how it goes, s."""
FLUSH_PERIOD = 0.5
"""How often the signals go to disk, s of simulated time; the most that a run which is
killed loses, but for a `SLICE`."""
TRACEBACK_FILE = "traceback.txt"
Progress: TypeAlias = Callable[[float, str], None]
"""Is told the simulated time, s, and what the executive is doing."""
Until: TypeAlias = Callable[[Context], str | None]
"""Is asked after every step of the plant, with the diagram's context, whether to stop,
and says why in a few words."""


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
    stream: SignalStream | None = None
    """Where the signals went, but for what was logged since the last flush; None where
    they are in memory."""


def run_task(
    task: TaskDiagram,
    scenario: Scenario,
    folder: Path,
    progress: Progress | None = None,
    realtime_rate: float = 0.0,
    while_judging: Callable[[], AbstractContextManager[object]] = nullcontext,
    until: Until | None = None,
) -> Summary:
    """Simulates a task and writes its run folder, however the simulation stops.

    The signals go to disk while it runs: of a run that is killed `load_run` opens what
    was written until then.

    Args:
        task: the closed loop.
        scenario: what it was built from.
        folder: where the run goes; must not exist, or be empty.
        progress: is called every `SLICE` of simulated time.
        realtime_rate: upper bound of simulated over wall time; 0 runs as fast as it
            can.
        while_judging: held from the end of the simulation until the folder is whole;
            where Ctrl-C must not break that off it can put it off.
        until: ends the run when it gives a reason; the outcome is "interrupted".

    Raises:
        FileExistsError: the folder exists and is not empty.
        OSError: the folder cannot be made.
        RecordingError: it cannot be written to any more.
    """
    begin_run(folder, scenario)
    simulated = simulate(
        task,
        scenario.simulation.max_time,
        progress,
        realtime_rate,
        folder / SIGNALS_FOLDER,
        until,
    )
    assert simulated.stream is not None
    with while_judging():
        end = simulated.context.get_time()
        with _recorded(folder, end):
            simulated.stream.flush()
        summary = summarize(task, scenario, simulated)
        with _recorded(folder, end):
            with whole_file(folder / SUMMARY_FILE) as path:
                summary.write(path)
            if isinstance(simulated.error, Exception):
                text = "".join(traceback.format_exception(simulated.error))
                with whole_file(folder / TRACEBACK_FILE) as path:
                    path.write_text(text, encoding="utf-8")
            simulated.stream.finish()
    return summary


def simulate(
    task: TaskDiagram,
    max_time: float,
    progress: Progress | None = None,
    realtime_rate: float = 0.0,
    signals_folder: Path | None = None,
    until: Until | None = None,
) -> Simulated:
    """Simulates until the task is over, the robot fell, time is up or Ctrl-C.

    A task that is finished is watched until the robot has been at rest for
    `REST_TIME`, for `REST_WATCH` at the most; a fall until the robot lies, for
    `FALL_WATCH` at the most.

    An exception, of the contact solver or of a System, ends the simulation like a
    fall does; what was logged until then is kept.

    Args:
        task: the closed loop.
        max_time: when it is given up, s of simulated time.
        progress: is called every `SLICE` of simulated time.
        realtime_rate: upper bound of simulated over wall time; 0 runs as fast as it
            can.
        signals_folder: where the signals go every `FLUSH_PERIOD`; None keeps them in
            memory.
        until: ends the simulation when it gives a reason.

    Raises:
        RecordingError: that folder cannot be written to any more.
    """
    simulator = Simulator(task.diagram)
    user = _Monitor(task.diagram, until)
    if until is not None:
        simulator.set_monitor(user)
    simulator.set_target_realtime_rate(realtime_rate)
    context = simulator.get_mutable_context()
    stream = task.signals.stream(context, signals_folder) if signals_folder else None
    watch = RobotWatch(task, context)
    end, finished, fell = max_time, False, False
    resting, lying = HoldClock(WATCHED_REST), HoldClock(LIE_TIME)
    stop: Stop = "time limit"
    reason = f"not done after {max_time:g} s"
    error: BaseException | None = None
    start, slices, flushed = perf_counter(), 0, 0.0
    try:
        simulator.Initialize()
        while context.get_time() < end - 1e-9:
            slices += 1
            boundary = min(slices * SLICE, end)
            if finished and not fell:
                _advance_to_rest(simulator, boundary, watch, resting)
            else:
                simulator.AdvanceTo(boundary)
            now, status = context.get_time(), task.task_status(context)
            if stream and now > flushed + FLUSH_PERIOD - 1e-9:
                flushed = now
                with _recorded(stream.folder.parent, flushed):
                    stream.flush()
            if progress is not None:
                progress(now, status.activity)
            if user.reason is not None:
                stop, reason = "stopped", f"stopped at {now:.3f} s: {user.reason}"
                break
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
    except RecordingError:
        raise
    except KeyboardInterrupt as interrupt:
        stop, reason = "interrupted", f"interrupted at {context.get_time():.2f} s"
        error = interrupt
    except Exception as exception:
        stop, error = "error", exception
        message = (str(exception).splitlines() or [""])[0]
        what = f"{type(exception).__name__}: {message}"
        reason = f"the simulation broke off at {context.get_time():.2f} s: {what}"
    return Simulated(context, stop, reason, perf_counter() - start, error, stream)


class _Monitor:
    """Asks the user after every step, and keeps what he says."""

    def __init__(self, diagram: Diagram, until: Until | None) -> None:
        self.reason: str | None = None
        self._diagram, self._until = diagram, until

    def __call__(self, root_context: Context) -> EventStatus:
        if self._until is not None and self.reason is None:
            self.reason = self._until(root_context)
        if self.reason is None:
            return EventStatus.DidNothing()
        return EventStatus.ReachedTermination(self._diagram, self.reason)


@contextmanager
def _recorded(folder: Path, time: float) -> Iterator[None]:
    """Says of a folder that cannot be written to which it is, and what became of it."""
    try:
        yield
    except OSError as error:
        raise RecordingError(
            f"{folder}: cannot be written to at {time:.2f} s of the run: "
            f"{error.strerror or error}; what was written until then is kept"
        ) from error


def _advance_to_rest(
    simulator: Simulator, until: float, watch: RobotWatch, resting: HoldClock
) -> None:
    """Simulates in steps of `LOOK`, as long as the robot has not rested enough."""
    context = simulator.get_context()
    while context.get_time() < until - 1e-9 and not resting.done():
        status = simulator.AdvanceTo(min(context.get_time() + LOOK, until))
        if status.reason() == SimulatorStatus.ReturnReason.kReachedTerminationCondition:
            return
        resting.look(context.get_time(), watch.rests())


def summarize(task: TaskDiagram, scenario: Scenario, simulated: Simulated) -> Summary:
    """Judges a simulation that has stopped and gathers what its summary says.

    One that stopped before anything was logged cannot be judged; its figures are null.
    """
    frames = task.signals.frames(simulated.context)
    if any(len(frame) for frame in frames.values()):
        evidence = gather(task, simulated.context, simulated.stop, simulated.reason)
        judgement, perception = judge(evidence), _perception(task, evidence)
        estimate = estimate_summary(evidence.frames, evidence.motion)
    else:
        interrupted = simulated.stop in ("interrupted", "stopped")
        outcome: Outcome = "interrupted" if interrupted else "cut"
        judgement = Judgement(outcome=outcome, reason=simulated.reason)
        perception = estimate = None
    simulated_time = simulated.context.get_time()
    return Summary(
        **asdict(judgement),
        scenario=scenario.name,
        seed=scenario.simulation.seed,
        simulated_time_s=simulated_time,
        wall_time_s=simulated.wall_time,
        real_time_factor=simulated_time / simulated.wall_time or None,
        perception=perception,
        estimate=estimate,
        timing_us=timing_us(task.diagram),
        replaced=task.replaced,
        versions=installed_versions(),
    )


def _perception(task: TaskDiagram, evidence: Evidence) -> Mapping[str, Json] | None:
    """Compares what was seen with the true scene; None where nothing was seen."""
    if evidence.crossing is not None:
        return obstacle_map_errors(evidence.crossing)
    ms_per_frame = stage_ms(task.diagram, len(evidence.environments))
    if ms_per_frame:
        return room_perception(evidence.environments, task.scene, ms_per_frame)
    return perception_summary(
        evidence.segmentations, evidence.staircases, evidence.treads
    )
