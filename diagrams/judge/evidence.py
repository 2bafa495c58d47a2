"""What the judge is shown of a run: the truth of the plant, and what was logged."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
import pandas as pd
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex
from pydrake.systems.framework import Context

from footfall.diagrams.closed_loop.task_diagram import TaskDiagram
from footfall.diagrams.judge.box_clearance import box_clearances
from footfall.diagrams.judge.crossing_judge import CrossingEvidence
from footfall.diagrams.judge.self_distance import NearestApproach, nearest_approach
from footfall.diagrams.judge.true_motion import TrueMotion, true_motion
from footfall.diagrams.signal_names import STATE_SIGNAL
from footfall.models.robots.self_distance import SelfDistanceMeter
from footfall.models.scenes.solids import GROUND, Box
from footfall.models.scenes.tread import Tread
from footfall.models.values.contact import Touch, Touches
from footfall.models.values.obstacle import ObstacleMap
from footfall.models.values.perceived import PlaneSegmentation, Staircase
from footfall.models.values.planned import TaskStatus
from footfall.models.values.room import Environment
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.report import CrossingMotion

Stop: TypeAlias = Literal[
    "finished", "infeasible", "fell", "time limit", "stopped", "interrupted", "error"
]
"""Why a simulation stopped; the executive said "finished" or "infeasible", the user
"stopped", by a condition of his own, or "interrupted", by Ctrl-C."""


@dataclass(frozen=True)
class Limits:
    """What the robot may not exceed."""

    torque: Mapping[str, float]
    """By joint, in the order of the actuators, Nm."""
    speed: Mapping[str, float]
    """By joint, rad/s."""
    weight: float
    """Of the robot, N."""


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """What the judge is shown."""

    stop: Stop
    stop_reason: str
    """In one line."""
    kind: str
    """What the task was, one of `task_params.TASKS`; any other is to stand."""
    motion: TrueMotion
    joint_velocities: Mapping[str, Vector]
    """By joint, (n,) at `motion.time`, rad/s."""
    frames: Mapping[str, pd.DataFrame]
    """The logged signals; those that are missing leave their measures null."""
    treads: tuple[Tread, ...]
    """The true treads, lowest first; empty without a staircase."""
    limits: Limits
    friction: float
    """Least coefficient between the soles and what they may stand on."""
    goal: tuple[float, float, float] | None = None
    """Where the midpoint of the feet was to come to, x, y, yaw, m and rad."""
    touches: tuple[Touch, ...] | None = None
    """What the robot met that it must not, of the scene and of itself; None where
    unknown."""
    self_distance: NearestApproach | None = None
    """The nearest that two of its bodies came; None where far apart or unknown."""
    activities: tuple[tuple[float, str], ...] | None = None
    """When, s, the executive turned to what; None where that was not logged."""
    segmentations: tuple[PlaneSegmentation, ...] = ()
    """What perception saw, one entry a frame; empty where that was not logged."""
    staircases: tuple[Staircase, ...] = ()
    """What was made of it, one entry a change."""
    environments: tuple[tuple[float, Environment], ...] = ()
    """When, s, the room was looked at, and what was seen, one entry a look."""
    crossing: CrossingEvidence | None = None
    """What there is of an obstacle crossing; None where that was not the task."""


def gather(
    task: TaskDiagram, context: Context, stop: Stop, stop_reason: str
) -> Evidence:
    """Gathers what there is to know about a simulation that has stopped.

    Abstract signals are found by the type of what they carry (`Touches`, `TaskStatus`,
    `PlaneSegmentation`, `Staircase`, `Environment`).

    Args:
        task: the closed loop.
        context: the diagram's, after the simulation.
        stop: why the simulation stopped.
        stop_reason: the same in one line.

    Raises:
        ValueError: the task does not log `STATE_SIGNAL`.
    """
    frames = task.signals.frames(context)
    if STATE_SIGNAL not in frames:
        raise ValueError(f"the task does not log {STATE_SIGNAL}")
    samples = frames[STATE_SIGNAL].to_numpy(dtype=np.float64)
    time, state = samples[:, 0], samples[:, 1:]
    logs = task.signals.logged_values(context).values()
    entries = [entry for log in logs for entry in log]
    touches = [entry.value for entry in entries if isinstance(entry.value, Touches)]
    activities = [
        (entry.time, entry.value.activity)
        for entry in entries
        if isinstance(entry.value, TaskStatus)
    ]
    return Evidence(
        stop=stop,
        stop_reason=stop_reason,
        kind=task.kind,
        motion=true_motion(task.plant, task.robot_instance, task.robot, time, state),
        joint_velocities=joint_velocities(task.plant, task.robot_instance, state),
        frames=frames,
        treads=task.scene.treads(),
        limits=robot_limits(task.plant, task.robot_instance),
        friction=min(
            solid.friction for solid in task.scene.solids() if solid.role in GROUND
        ),
        goal=task.goal,
        touches=touches[-1].touches if touches else None,
        self_distance=nearest_approach(
            SelfDistanceMeter(task.robot),
            time,
            state[:, : task.plant.num_positions(task.robot_instance)],
        ),
        activities=tuple(activities) or None,
        segmentations=tuple(
            entry.value
            for entry in entries
            if isinstance(entry.value, PlaneSegmentation) and entry.value.times_ms
        ),
        staircases=tuple(
            entry.value for entry in entries if isinstance(entry.value, Staircase)
        ),
        environments=tuple(
            (entry.time, entry.value)
            for entry in entries
            if isinstance(entry.value, Environment) and entry.value != Environment()
        ),
        crossing=_crossing(task, time, state, [entry.value for entry in entries]),
    )


def _crossing(
    task: TaskDiagram, time: Vector, state: Vector, values: Sequence[object]
) -> CrossingEvidence | None:
    """Gathers the evidence of an obstacle crossing, known by the maps that it logs."""
    maps = [value for value in values if isinstance(value, ObstacleMap)]
    if not maps:
        return None
    boxes = tuple(
        solid
        for solid in task.scene.solids()
        if isinstance(solid, Box) and solid.role == "box"
    )
    return CrossingEvidence(
        boxes,
        box_clearances(task.plant, task.robot_instance, task.robot, time, state, boxes),
        tuple(seen for seen in maps if seen.status != "none"),
        tuple(value.report for value in values if isinstance(value, CrossingMotion)),
    )


def robot_limits(plant: MultibodyPlant, instance: ModelInstanceIndex) -> Limits:
    """Reads the robot's limits from its description, and its weight."""
    actuators = [
        plant.get_joint_actuator(index)
        for index in plant.GetJointActuatorIndices(instance)
    ]
    context = plant.CreateDefaultContext()
    gravity = float(np.linalg.norm(plant.gravity_field().gravity_vector()))
    return Limits(
        torque={item.joint().name(): item.effort_limit() for item in actuators},
        speed={
            item.joint().name(): float(item.joint().velocity_upper_limits()[0])
            for item in actuators
        },
        weight=plant.CalcTotalMass(context, [instance]) * gravity,
    )


def joint_velocities(
    plant: MultibodyPlant, instance: ModelInstanceIndex, state: Vector
) -> dict[str, Vector]:
    """Computes the velocity of every actuated joint, (n,) each, rad/s.

    Args:
        plant: the finalised plant.
        instance: the robot in it.
        state: positions, then velocities of the robot, (n, nq + nv).
    """
    names = plant.GetVelocityNames(instance, False, False)
    joints = {
        plant.get_joint_actuator(index).joint().name()
        for index in plant.GetJointActuatorIndices(instance)
    }
    velocities = state[:, plant.num_positions(instance) :]
    return {
        name: velocities[:, column]
        for column, name in enumerate(names)
        if name in joints
    }
