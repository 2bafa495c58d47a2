"""The headless runner: simulates a task, judges it and writes the run folder."""

import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter
from typing import TypeAlias

from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from diagrams.crossing_judge import eyes_summary
from diagrams.evidence import Evidence, Stop, gather
from diagrams.outcome import Judgement, Outcome, has_fallen, judge
from diagrams.room_summary import room_perception, stage_ms
from diagrams.run_folder import RecordingError, begin_run
from diagrams.scenario import Scenario
from diagrams.signal_files import whole_file
from diagrams.signal_recorder import SignalStream
from diagrams.signals import SIGNALS_FOLDER, SUMMARY_FILE
from diagrams.summary import (
    Summary,
    installed_versions,
    perception_summary,
    timing_us,
)
from diagrams.task_diagram import TaskDiagram
from systems.values import FEET, Json

SETTLE_TIME = 0.5
"""For how long a finished task is watched on, s."""
SLICE = 0.05
"""How long the simulation runs between two looks at how it goes, s."""
FLUSH_PERIOD = 0.5
"""How often the signals go to disk, s of simulated time; the most that a run which is
killed loses, but for a `SLICE`."""
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
) -> Simulated:
    """Simulates until the task is over, the robot fell, time is up or Ctrl-C.

    A task that is finished is watched for `SETTLE_TIME` more.

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

    Raises:
        RecordingError: that folder cannot be written to any more.
    """
    simulator = Simulator(task.diagram)
    simulator.set_target_realtime_rate(realtime_rate)
    context = simulator.get_mutable_context()
    stream = task.signals.stream(context, signals_folder) if signals_folder else None
    watch = _FallWatch(task, context)
    end, finished = max_time, False
    stop: Stop = "time limit"
    reason = f"not done after {max_time:g} s"
    error: BaseException | None = None
    start, slices, flushed = perf_counter(), 0, 0.0
    try:
        simulator.Initialize()
        while context.get_time() < end - 1e-9:
            slices += 1
            simulator.AdvanceTo(min(slices * SLICE, end))
            if stream and context.get_time() > flushed + FLUSH_PERIOD - 1e-9:
                flushed = context.get_time()
                with _recorded(stream.folder.parent, flushed):
                    stream.flush()
            status = task.task_status(context)
            if progress is not None:
                progress(context.get_time(), status.activity)
            if watch.fallen():
                stop, reason = "fell", f"the robot fell at {context.get_time():.2f} s"
                break
            if status.state == "infeasible":
                stop, reason = "infeasible", status.reason
                break
            if status.state == "finished" and not finished:
                finished, end = True, context.get_time() + SETTLE_TIME
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


class _FallWatch:
    """Looks at the true robot while it moves."""

    def __init__(self, task: TaskDiagram, context: Context) -> None:
        self._plant = task.plant
        self._context = task.plant.GetMyContextFromRoot(context)
        robot, instance = task.robot, task.robot_instance
        self._base = self._plant.GetBodyByName(robot.base_body, instance)
        self._torso = self._plant.GetBodyByName(robot.torso_body, instance)
        self._feet = [
            self._plant.GetBodyByName(robot.foot_bodies[foot], instance)
            for foot in FEET
        ]
        self._ankle_height = robot.sole.ankle_height
        self._initial = self._height()

    def _height(self) -> float:
        def z(body: object) -> float:
            pose = self._plant.EvalBodyPoseInWorld(self._context, body)  # type: ignore[arg-type]
            return float(pose.translation()[2])

        lowest = min(z(foot) for foot in self._feet) - self._ankle_height
        return z(self._base) - lowest

    def fallen(self) -> bool:
        """Whether it lies or is about to."""
        pose = self._plant.EvalBodyPoseInWorld(self._context, self._torso)
        up = float(pose.rotation().matrix()[2, 2])
        return has_fallen(self._height(), self._initial, up)


def summarize(task: TaskDiagram, scenario: Scenario, simulated: Simulated) -> Summary:
    """Judges a simulation that has stopped and gathers what its summary says.

    One that stopped before anything was logged cannot be judged; its figures are null.
    """
    frames = task.signals.frames(simulated.context)
    if any(len(frame) for frame in frames.values()):
        evidence = gather(task, simulated.context, simulated.stop, simulated.reason)
        judgement, perception = judge(evidence), _perception(task, evidence)
    else:
        interrupted = simulated.stop == "interrupted"
        outcome: Outcome = "interrupted" if interrupted else "cut"
        judgement = Judgement(outcome=outcome, reason=simulated.reason)
        perception = None
    simulated_time = simulated.context.get_time()
    return Summary(
        **asdict(judgement),
        scenario=scenario.name,
        seed=scenario.simulation.seed,
        simulated_time_s=simulated_time,
        wall_time_s=simulated.wall_time,
        real_time_factor=simulated_time / simulated.wall_time or None,
        perception=perception,
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
