"""Random rooms for path planning, and an independent judge of whether a way exists."""

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw
from scipy import ndimage

from footfall.models.scenes.room_obstacles import ClutterParams, place_boxes
from footfall.models.values.feet import FEET
from footfall.models.values.room import Environment, FloorPlane, ObstacleBox
from footfall.systems.planning.footsteps.foothold import SIDE

LEVEL = np.array([0.0, 0.0, 1.0, 0.0])


def floor(x: float = 3.5, y: float = 2.6) -> FloorPlane:
    """A level rectangle about the origin, with half its sides in m."""
    corners = np.array([[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]])
    return FloorPlane(LEVEL, corners)


def box(
    name: str,
    x: float,
    y: float,
    yaw: float = 0.0,
    sides: tuple[float, ...] = (0.4, 0.4),
) -> ObstacleBox:
    """An upright box, 0.5 m high."""
    return ObstacleBox(name, np.array([x, y, 0.25]), yaw, np.array([*sides, 0.5]))


def room(seed: int, y: float = 2.6, area_y: float = 1.9) -> Environment:
    """A floor with six to ten random boxes between (-2.5, 0) and (2.5, 0)."""
    params = ClutterParams(seed=seed, area=[-1.7, 1.7, -area_y, area_y], gap=0.0)
    placed = place_boxes(params, np.array([[-2.5, 0.0], [2.5, 0.0]]))
    boxes = tuple(
        ObstacleBox(
            b.name, np.array([b.x, b.y, b.size[2] / 2]), b.yaw, np.array(b.size)
        )
        for b in placed
    )
    return Environment(floor(y=y), boxes)


def stand(x: float, y: float, yaw: float, width: float = 0.19) -> list[RigidTransform]:
    """Left and right sole side by side about a pose."""
    X_WM = RigidTransform(RollPitchYaw(0.0, 0.0, yaw), [x, y, 0.0])
    return [X_WM @ RigidTransform([0.0, SIDE[f] * width / 2.0, 0.0]) for f in FEET]


def distance_to_boxes(points: np.ndarray, environment: Environment) -> np.ndarray:
    """Distance of horizontal points, (..., 2), to the nearest box, by its own axes."""
    nearest = np.full(points.shape[:-1], np.inf)
    for b in environment.boxes:
        c, s = np.cos(b.yaw), np.sin(b.yaw)
        p_B = np.abs((points - b.center[:2]) @ np.array([[c, -s], [s, c]]))
        beyond = np.maximum(p_B - b.size[:2] / 2.0, 0.0)
        nearest = np.minimum(nearest, np.hypot(beyond[..., 0], beyond[..., 1]))
    return nearest


def distance_to_edge(points: np.ndarray, environment: Environment) -> np.ndarray:
    """Distance of points inside a rectangular floor about the origin to its edge."""
    half = environment.floor.polygon[:, :2].max(axis=0)
    return np.min(half - np.abs(points), axis=-1)


def grid_finds_a_way(
    environment: Environment,
    start: np.ndarray,
    goal: np.ndarray,
    clearance: float,
    cell: float = 0.02,
) -> bool:
    """Whether start and goal are linked on a grid of points that keep a clearance."""
    half = environment.floor.polygon[:, :2].max(axis=0)
    x, y = (np.arange(-h, h + cell, cell) for h in half)
    points = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    free = (distance_to_boxes(points, environment) >= clearance) & (
        distance_to_edge(points, environment) >= clearance
    )
    # Four neighbours only: what lies between two of them is at most half a cell off.
    part, _ = ndimage.label(free)
    near = [np.linalg.norm(points - p, axis=-1) <= 1.5 * cell for p in (start, goal)]
    first, second = (set(part[n]) - {0} for n in near)
    return bool(first & second)
