"""The estimator alone: from the sensors that a run logged to what they tell."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import typer
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from footfall.diagrams.closed_loop.estimation import build_estimation
from footfall.diagrams.closed_loop.estimation_signals import (
    ANKLES_SIGNAL,
    FOOTHOLDS_SIGNAL,
    IMU_SIGNAL,
    JOINTS_SIGNAL,
    estimation_signals,
)
from footfall.diagrams.closed_loop.parts import Parts
from footfall.diagrams.closed_loop.setup import set_up
from footfall.diagrams.judge.estimate_errors import estimate_summary
from footfall.diagrams.judge.summary_table import summary_rows
from footfall.diagrams.run_data import read_run_data
from footfall.diagrams.scenario import ESTIMATED, Scenario, ScenarioError, load_scenario
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signals import SCENARIO_FILE, RunError, SignalRecorder, load_run
from footfall.models.values.value import Json
from footfall.systems.signal_playback import SignalPlayback

SENSORS = {
    "imu": IMU_SIGNAL,
    "joints": JOINTS_SIGNAL,
    "ankle_wrenches": ANKLES_SIGNAL,
    "footholds": FOOTHOLDS_SIGNAL,
}
"""By input of the station `estimation` the signal that a run logs of it."""


def estimate_from_sensors(
    scenario: Scenario, sensors: Mapping[str, pd.DataFrame]
) -> Mapping[str, pd.DataFrame]:
    """Runs contact detection and estimator over logged sensor data.

    No plant is simulated and no scene known; of the scenario robot, start, and the
    parameters of the two count. The same data gives the same estimate, bit for bit, as
    in the run.

    Args:
        scenario: whose robot stood where at the first sample.
        sensors: by name the signals of `SENSORS`, a data frame each: `time` [s], then a
            column an element, with a row every tick.

    Returns:
        The signals of the estimate, by name.

    Raises:
        RunError: a signal is missing or empty.
        ScenarioError: the scenario's robot is to know its true state.
    """
    if scenario.robot.state != ESTIMATED:
        raise ScenarioError(
            f"{scenario.name}: robot.state: must be {ESTIMATED} for an estimate, "
            f"got {scenario.robot.state!r}"
        )
    period = scenario.parameters.control_period
    setup = set_up(scenario, Parts({}))
    station = build_estimation(setup).system
    builder = DiagramBuilder()
    builder.AddNamedSystem("estimation", station)
    end = np.inf
    for name, signal in SENSORS.items():
        if signal not in sensors or not len(sensors[signal]):
            raise RunError(f"{signal}: was not logged; the estimator needs it")
        rows = sensors[signal].to_numpy(dtype=np.float64)
        end = min(end, rows[-1, 0])
        playback = SignalPlayback(rows[:, 0], rows[:, 1:])
        builder.AddNamedSystem(name, playback)
        builder.Connect(playback.get_output_port(0), station.GetInputPort(name))
    recorder = SignalRecorder(builder)
    for name, port, columns, units in estimation_signals(setup.model):
        if station.HasOutputPort(port):
            output = station.GetOutputPort(port)
            recorder.add_vector(name, output, columns, units, period)
    simulator = Simulator(builder.Build())
    simulator.Initialize()
    # The updates of the last tick come after it.
    simulator.AdvanceTo(end + 0.5 * period)
    return recorder.frames(simulator.get_context())


def estimate_run(
    folder: Path, overrides: Sequence[str] = ()
) -> tuple[Mapping[str, pd.DataFrame], dict[str, Json] | None]:
    """Estimates again what a run's sensors tell, with other parameters if wanted.

    Args:
        folder: of the run.
        overrides: "KEY=VALUE" each, of the scenario.

    Returns:
        The signals of the estimate by name, and its errors against the logged truth
        (`estimate_summary`).

    Raises:
        RunError: the folder holds no run, or one without its sensors.
        ScenarioError: its scenario, or what is set, cannot be used.
    """
    run = load_run(folder)
    scenario = load_scenario(run.folder / SCENARIO_FILE, overrides)
    estimate = estimate_from_sensors(scenario, run.signals)
    data = read_run_data(folder)
    frames = {**run.signals, **estimate}
    return estimate, estimate_summary(frames, data.motion)


def print_estimate(
    frames: Mapping[str, pd.DataFrame], errors: dict[str, Json] | None, out: Path | None
) -> None:
    """Prints the errors of an estimate, and writes its signals where asked.

    Args:
        frames: the signals.
        errors: against the truth; None where that was not logged.
        out: a folder for them, a Parquet file each.
    """
    rows = [
        row
        for name, value in (errors or {}).items()
        for row in summary_rows(name, value)
    ]
    width = max((len(name) for name, _ in rows), default=0)
    for name, value in rows:
        typer.echo(f"{name:<{width}}  {value}")
    if out is None:
        return
    out.mkdir(parents=True, exist_ok=True)
    for name, frame in frames.items():
        with whole_file(out / f"{name}.parquet") as path:
            frame.to_parquet(path, index=False)
    typer.echo(f"written to {out}")
