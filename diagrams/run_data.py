"""A run read back with what truly happened: what its figures draw."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder

from footfall.diagrams.judge.evidence import Limits, joint_velocities, robot_limits
from footfall.diagrams.judge.true_motion import TrueMotion, true_motion
from footfall.diagrams.signal_names import MOVERS_SIGNAL, STATE_SIGNAL
from footfall.diagrams.signals import Run, RunError, load_run
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.tread import Tread
from footfall.models.values.feet import Foot
from footfall.models.values.vector import Vector


@dataclass(frozen=True)
class RunData:
    """A run, the robot's true motion in it, and its limits."""

    run: Run
    motion: TrueMotion
    state: Vector
    """Positions, then velocities of the robot at `motion.time`, (n, nq + nv)."""
    limits: Limits
    velocities: Mapping[str, Vector]
    treads: tuple[Tread, ...]
    wrenches: Mapping[Foot, Vector] | None
    """Each foot's contact wrench at `motion.time`, (n, 6)."""

    def signal(self, name: str) -> pd.DataFrame | None:
        """Finds a vector signal, where it was logged."""
        return self.run.signals.get(name)

    def first_signal(self, *names: str) -> pd.DataFrame | None:
        """Finds the first of these signals that was logged."""
        return next((self.run.signals[n] for n in names if n in self.run.signals), None)


def read_run_data(folder: Path) -> RunData:
    """Reads a run and replays its state on the robot's plant.

    Raises:
        RunError: the folder holds no run, or one without the plant's state.
        ScenarioError: its scenario cannot be read.
    """
    run = load_run(folder)
    if STATE_SIGNAL not in run.signals:
        raise RunError(f"{run.folder}: the run did not log {STATE_SIGNAL}")
    samples = run.signals[STATE_SIGNAL].to_numpy(dtype=np.float64)
    time, state = samples[:, 0], samples[:, 1:]
    robot = run.scenario.robot.model()
    plant, scene_graph = AddMultibodyPlantSceneGraph(DiagramBuilder(), time_step=0.0)
    instance = add_robot(plant, scene_graph, robot)
    plant.Finalize()
    wrenches: dict[Foot, Vector] | None = None
    if "station.foot_wrenches" in run.signals:
        logged = run.signals["station.foot_wrenches"].to_numpy(dtype=np.float64)
        both = np.stack(
            [np.interp(time, logged[:, 0], column) for column in logged[:, 1:13].T], 1
        )
        wrenches = {"left": both[:, :6], "right": both[:, 6:]}
    return RunData(
        run=run,
        motion=true_motion(plant, instance, robot, time, state),
        state=state,
        limits=robot_limits(plant, instance),
        velocities=joint_velocities(plant, instance, state),
        treads=run.scenario.scene.treads(),
        wrenches=wrenches,
    )


def mover_positions(run: Run, time: Vector) -> Vector | None:
    """Reads x, y of each box that moves in turn, (n, 2 k), m; None if not logged.

    Args:
        run: the run.
        time: when, (n,), s.
    """
    if MOVERS_SIGNAL not in run.signals:
        return None
    logged = run.signals[MOVERS_SIGNAL].to_numpy(dtype=np.float64)
    columns = logged[:, 1 : 1 + 2 * len(run.scenario.scene.movers)].T
    return np.stack([np.interp(time, logged[:, 0], part) for part in columns], axis=1)
