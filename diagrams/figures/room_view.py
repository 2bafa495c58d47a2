"""A room from above: the room paper's Fig. 5, with both trees of its Fig. 3."""

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

from footfall.diagrams.figures.colors import (
    GOAL,
    PATH,
    SEEN_THING,
    TREES,
    TRUE_THING,
    WALL,
)
from footfall.diagrams.judge.room_summary import true_box
from footfall.diagrams.signal_names import OBSTACLE_SIGNAL
from footfall.diagrams.signals import Run
from footfall.models.scenes.scene import SceneParams
from footfall.models.values.room import ObstacleBox
from footfall.models.values.value import Json
from footfall.models.values.vector import Vector

HEADING = 0.2
"""Length of the arrow that shows the heading at the goal, m."""


def draw_room(ax: Axes, run: Run) -> None:
    """Draws true and seen boxes, both trees, paths and the goal, as far as there are.

    Obstacles to step over are drawn as every sweep saw them.

    Of a room that changed the last look is drawn, of a plan that was changed every
    path.

    Args:
        ax: what is drawn on, in W, m.
        run: a run of any task.
    """
    _draw_scene(ax, run.scenario.scene)
    if OBSTACLE_SIGNAL in run.value_names:
        obstacles = [
            b for v in _values(run, OBSTACLE_SIGNAL) for b in seen_obstacles(v)
        ]
        _draw_outlines(ax, obstacles, "obstacle seen")
    if "executive.path_plan" not in run.value_names:
        return
    room = run.scenario.scene.room
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) / 2.0
    walls = room.X_WR().multiply((signs * [room.length, room.width, 0.0]).T)
    ax.add_patch(Polygon(walls[:2].T, fill=False, ec=WALL, lw=2.0, label="wall"))
    seen = [seen_boxes(value) for value in _values(run, "executive.environment")]
    _draw_outlines(ax, seen[-1] if seen else [], "box seen")
    plans = [p for p in _values(run, "executive.path_plan") if p["points"]]
    for name, color in TREES.items():
        edges = [np.array(plan[name]) for plan in plans if plan[name]]
        if edges:
            lines = LineCollection(
                list(np.concatenate(edges)), colors=color, lw=0.8, alpha=0.8
            )
            lines.set_label(f"tree from the {name.removesuffix('_tree')}")
            ax.add_collection(lines)
    for index, plan in enumerate(plans):
        points = np.array(plan["points"])
        label = "_" if index else "path"
        ax.plot(*points.T, color=PATH, lw=1.6, ls=":", label=label, zorder=3)
    x, y, yaw = run.scenario.task.goal
    tip = HEADING * np.array([np.cos(yaw), np.sin(yaw)])
    ax.plot(x, y, "x", color=GOAL, ms=9, mew=2, label="goal", zorder=4)
    ax.annotate(
        "",
        (x + tip[0], y + tip[1]),
        (x, y),
        arrowprops={"arrowstyle": "->", "color": GOAL},
    )


def _values(run: Run, name: str) -> list[Mapping[str, Json]]:
    return [value for _, value in run.values(name)]


def _draw_scene(ax: Axes, scene: SceneParams) -> None:
    """Draws the true boxes; those that move where they come to, and where they were."""
    boxes = [true_box(box, box.x, box.y) for box in scene.boxes]
    boxes += [true_box(mover, mover.to_x, mover.to_y) for mover in scene.movers]
    for index, box in enumerate(boxes):
        label = "_" if index else "box"
        ax.add_patch(
            Polygon(box.footprint(), fc=TRUE_THING, ec="none", alpha=0.8, label=label)
        )
    for mover in scene.movers:
        before = true_box(mover, mover.x, mover.y).footprint()
        ax.add_patch(Polygon(before, fc=TRUE_THING, ec="none", alpha=0.3))
        ax.annotate(
            "",
            (mover.to_x, mover.to_y),
            (mover.x, mover.y),
            arrowprops={"arrowstyle": "->", "color": PATH, "ls": "--"},
        )


def seen_boxes(environment: Mapping[str, Json]) -> list[ObstacleBox]:
    """Reads the boxes that a look saw, of the logged value of an environment."""
    boxes = []
    for item in cast(Sequence[Mapping[str, Json]], environment["boxes"]):
        center: Vector = np.array(item["center"], dtype=np.float64)
        size: Vector = np.array(item["size"], dtype=np.float64)
        yaw = float(cast(float, item["yaw"]))
        boxes.append(ObstacleBox(str(item["name"]), center, yaw, size))
    return boxes


def seen_obstacles(seen: Mapping[str, Json]) -> list[ObstacleBox]:
    """Reads what a sweep saw to lie in the way, of the logged value of a map."""
    boxes = []
    for item in cast(Sequence[Mapping[str, Any]], seen["obstacles"]):
        middle = item["height"] / 2.0
        center: Vector = np.array([*item["center"], middle], dtype=np.float64)
        size: Vector = np.array([item["width"], item["length"], item["height"]])
        boxes.append(ObstacleBox("obstacle", center, float(item["yaw"]), size))
    return boxes


def _draw_outlines(ax: Axes, boxes: Sequence[ObstacleBox], label: str) -> None:
    for index, box in enumerate(boxes):
        ax.add_patch(
            Polygon(
                box.footprint(),
                fill=False,
                ec=SEEN_THING,
                lw=1.2,
                label="_" if index else label,
            )
        )
