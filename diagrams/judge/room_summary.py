"""How well and how fast a room was seen: the summary's `perception` of a crossing."""

from collections.abc import Mapping, Sequence

import numpy as np
from pydrake.systems.framework import Diagram

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.models.scenes.mover import MoverParams
from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.scene import SceneParams
from footfall.models.values.room import Environment, ObstacleBox
from footfall.models.values.value import Json
from footfall.models.values.vector import Vector
from footfall.systems.timing import stopwatch

STAGES = {
    "cloud": "depth_cloud",
    "floor": "floor_extractor",
    "boxes": "obstacle_clusterer",
    "xml": "environment_exchange",
}
"""The system behind each stage of perception."""
CENTER_TOLERANCE, SIZE_TOLERANCE = 0.03, 0.05
"""A box whose centre or a side is off by more counts as off, m. It may be that the
robot hides a part of it."""
MOVED_AT_MOST = 0.2
"""For so long after a box has come to rest a look may still show it moving, s."""


def room_perception(
    environments: Sequence[tuple[float, Environment]],
    scene: SceneParams,
    ms_per_frame: Mapping[str, float],
) -> dict[str, Json] | None:
    """Compares what was seen of a room with the true one; None where nothing was seen.

    Args:
        environments: when, s, what was seen was known, and what was seen.
        scene: what truly stood there.
        ms_per_frame: see `stage_ms`.

    Returns:
        `frames`; `ms_per_frame`; `floor_inlier_share`, the mean; `errors`, None where
        no box stood in the room: over all boxes of all frames how many were to be seen,
        how many were not and how many were off, and the mean and largest error of the
        centre (distance) and of the size (the worst side), m. A box while it moves does
        not count.
    """
    if not environments:
        return None
    errors, unseen = [], 0
    for time, environment in environments:
        sensed_at = environment.sensed_at
        for box in standing_boxes(scene, time if sensed_at is None else sensed_at):
            error = box_error(box, environment.boxes)
            if error is None:
                unseen += 1
            else:
                errors.append(error)
    shares = [
        environment.floor.inlier_share if environment.floor else 0.0
        for _, environment in environments
    ]
    return {
        "frames": len(environments),
        "ms_per_frame": {name: round(ms, 2) for name, ms in ms_per_frame.items()},
        "floor_inlier_share": round(float(np.mean(shares)), 4),
        "errors": _error_summary(errors, unseen) if errors or unseen else None,
    }


def stage_ms(diagram: Diagram, frames: int) -> dict[str, float]:
    """Mean time of each stage of perception and of all, ms a frame.

    Args:
        diagram: of the crossing, after its run.
        frames: how many were worked on.

    Returns:
        By stage, and "total"; empty where there is no camera or no frame.
    """
    systems = {system.get_name(): system for _, system in leaf_systems(diagram)}
    times = {}
    for stage, name in STAGES.items():
        if not frames or name not in systems:
            return {}
        watch = stopwatch(systems[name])
        times[stage] = 1e3 * watch.total / frames if watch else 0.0
    times["total"] = sum(times.values())
    return times


def standing_boxes(scene: SceneParams, time: float) -> list[ObstacleBox]:
    """Finds the true boxes that stand still at a time, where they stand then."""
    boxes = [true_box(box, box.x, box.y) for box in scene.boxes]
    for mover in scene.movers:
        place = _rest(mover, time)
        if place is not None:
            boxes.append(true_box(mover, *place))
    return boxes


def _rest(mover: MoverParams, time: float) -> tuple[float, float] | None:
    if time < mover.time:
        return mover.x, mover.y
    if time > mover.time + mover.duration + MOVED_AT_MOST:
        return mover.to_x, mover.to_y
    return None


def true_box(box: BoxParams, x: float, y: float) -> ObstacleBox:
    """Finds the true box with its centre at x, y."""
    size: Vector = np.array(box.size)
    center: Vector = np.array([x, y, box.z + size[2] / 2.0])
    return ObstacleBox(box.name, center, box.yaw, size)


def box_error(
    true: ObstacleBox, seen: Sequence[ObstacleBox]
) -> tuple[float, float] | None:
    """Distance of the centres and the worst side's error, m; None where it was missed.

    It is seen where the nearest centre, from above, is within half its diagonal.
    """
    if not seen:
        return None
    near = min(seen, key=lambda box: _apart(true, box))
    if _apart(true, near) > np.linalg.norm(true.size[:2]) / 2.0:
        return None
    # Which of a rectangle's sides is its x is for each to choose.
    turn = near.yaw - true.yaw
    swapped = abs(np.sin(turn)) > np.sqrt(0.5)
    size = near.size[[1, 0, 2]] if swapped else near.size
    return (
        float(np.linalg.norm(near.center - true.center)),
        float(np.abs(size - true.size).max()),
    )


def _apart(one: ObstacleBox, other: ObstacleBox) -> float:
    return float(np.linalg.norm(one.center[:2] - other.center[:2]))


def _error_summary(
    errors: Sequence[tuple[float, float]], unseen: int
) -> dict[str, Json]:
    summary: dict[str, Json] = {"boxes": len(errors) + unseen, "unseen": unseen}
    if errors:
        columns = np.array(errors).T
        off = (columns[0] > CENTER_TOLERANCE) | (columns[1] > SIZE_TOLERANCE)
        summary["off"] = int(off.sum())
        for name, column in zip(("center_m", "size_m"), columns, strict=True):
            summary[f"mean_{name}"] = round(float(column.mean()), 5)
            summary[f"max_{name}"] = round(float(column.max()), 5)
    return summary
