"""Which fields of a scenario act, by its task: the others change nothing in its run.

A System knows nothing of tasks, so that this cannot stand beside its parameters;
`tests/diagrams/fields/test_acting.py` builds every task without what does not act.
"""

from collections.abc import Mapping
from typing import Any, TypeAlias

Condition: TypeAlias = Mapping[str, tuple[Any, ...]]
"""By path of a field of the scenario, the values of it with which something acts."""

STAIRS: Condition = {"task.kind": ("stair_climbing",)}
OBSTACLES: Condition = {"task.kind": ("obstacle_crossing",)}
ROOM: Condition = {"task.kind": ("room_crossing",)}
STAND: Condition = {"task.kind": ("stand",)}
SCANS: Condition = {"task.kind": ("stair_climbing", "obstacle_crossing")}
GOAL: Condition = {"task.kind": ("room_crossing", "obstacle_crossing")}
CAMERA: Condition = {**ROOM, "task.environment": (None,)}
SLOW: Condition = {"task.mode": ("quasi_static",)}
FAST: Condition = {"task.mode": ("dynamic",)}

BELIEF: Condition = {"robot.state": ("estimated",)}

ACTS: Mapping[str, Condition] = {
    "sensors.imu": BELIEF,
    "sensors.encoders": BELIEF,
    "sensors.ankles": BELIEF,
    "parameters.base_estimator": BELIEF,
    "parameters.com_observer": BELIEF,
    "robot.com_error_ahead": BELIEF,
    "robot.com_error_left": BELIEF,
    "sensors.camera": CAMERA,
    "sensors.lidar": SCANS,
    "task.steps_between_scans": STAIRS,
    "task.stand_time": STAND,
    "task.goal": GOAL,
    "task.environment": ROOM,
    "parameters.scan_assembler": SCANS,
    "parameters.segmenter": STAIRS,
    "parameters.staircase_map": STAIRS,
    "parameters.motion_planner.quasi_static": {**STAIRS, **SLOW},
    "parameters.depth_cloud": CAMERA,
    "parameters.floor": CAMERA,
    "parameters.obstacles": CAMERA,
    "parameters.path_planner": ROOM,
    "parameters.path_executive": ROOM,
    "parameters.executive": SCANS,
    "parameters.obstacle_finder": OBSTACLES,
    "parameters.crossing": OBSTACLES,
    "parameters.crossing.high": {**OBSTACLES, **FAST},
    "parameters.crossing.quasi_static": {**OBSTACLES, **SLOW},
    "parameters.thinking.segmentation": STAIRS,
    "parameters.thinking.obstacle_finding": OBSTACLES,
    "parameters.thinking.room_perception": CAMERA,
    "parameters.thinking.climb_planning": {**STAIRS, **FAST},
    "parameters.thinking.quasi_static_climb_planning": {**STAIRS, **SLOW},
    "parameters.thinking.crossing_planning": {**OBSTACLES, **FAST},
    "parameters.thinking.quasi_static_crossing_planning": {**OBSTACLES, **SLOW},
    "parameters.thinking.room_planning": ROOM,
    "parameters.thinking.stopping": ROOM,
}
"""When a field or a group acts, by path; what is not listed acts always."""


def unmet(path: str, scenario: object) -> str:
    """Why a field does not act in a scenario, e.g. "task.kind is not room_crossing".

    Args:
        path: of a field or a group, as a key of `ACTS`.
        scenario: whose `task` is asked.

    Returns:
        Empty where it acts.
    """
    for key, values in ACTS.get(path, {}).items():
        value = scenario
        for name in key.split("."):
            value = getattr(value, name)
        if value not in values:
            return f"{key} is not {_listed(values)}"
    return ""


def acts_in_task(path: str, kind: str) -> bool:
    """Whether a field, or a group around it, can act in a kind of task."""
    parts = path.split(".")
    around = (".".join(parts[: depth + 1]) for depth in range(len(parts)))
    return all(kind in ACTS.get(one, {}).get("task.kind", (kind,)) for one in around)


def told(path: str) -> str:
    """When a field acts, e.g. "task.kind is room_crossing"; empty for always."""
    return " and ".join(
        f"{key} is {_listed(values)}" for key, values in ACTS.get(path, {}).items()
    )


def _listed(values: tuple[Any, ...]) -> str:
    return " or ".join("null" if value is None else str(value) for value in values)
