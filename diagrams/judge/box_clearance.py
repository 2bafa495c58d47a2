"""How near every part of the robot truly came to the boxes it stepped over."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex

from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import body_meshes
from footfall.models.scenes.solids import Box
from footfall.models.values.vector import Vector

SPACING = 0.008
"""Of the points that stand for the robot's surface, m: between them it comes nearer
to an edge 3 cm away by a quarter of a millimetre at most."""
TICK = 0.02
"""Between the postures that are looked at, s."""
NEAR = 0.9
"""A box farther from the robot's base than this is not looked at, m."""


@dataclass(frozen=True)
class BoxClearance:
    """The nearest that the robot came to one box."""

    box: str
    distance: float
    """m; not positive where it touched."""
    body: str
    """Which part of the robot."""
    time: float
    """s."""


def surface_points(
    vertices: Vector, triangles: np.ndarray[Any, Any], spacing: float
) -> Vector:
    """Points on a mesh, no farther from each other than `spacing`, (n, 3).

    Args:
        vertices: (v, 3), m.
        triangles: indices, (t, 3).
        spacing: m.
    """
    found = []
    for a, b, c in vertices[triangles.astype(np.int64)]:
        longest = max(
            np.linalg.norm(b - a), np.linalg.norm(c - b), np.linalg.norm(a - c)
        )
        n = int(np.ceil(longest / spacing))
        i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1))
        inside = i + j <= n
        s, t = i[inside] / max(n, 1), j[inside] / max(n, 1)
        found.append(a + s[:, None] * (b - a) + t[:, None] * (c - a))
    points = np.vstack(found)
    cells = np.round(points / (0.5 * spacing)).astype(np.int64)
    cells -= cells.min(axis=0)
    size = cells.max(axis=0) + 1
    keys = (cells[:, 0] * size[1] + cells[:, 1]) * size[2] + cells[:, 2]
    _, first = np.unique(keys, return_index=True)
    return np.asarray(points[np.sort(first)])


def box_distance(p_W: Vector, box: Box) -> Vector:
    """Distance of points (n, 3) to a box, (n,), m; negative inside."""
    p_B = np.array(box.X_WB.inverse().multiply(p_W.T)).T
    beyond = np.abs(p_B) - box.size / 2.0
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    return np.asarray(outside + np.minimum(beyond.max(axis=1), 0.0))


def box_clearances(
    plant: MultibodyPlant,
    instance: ModelInstanceIndex,
    robot: RobotModel,
    time: Vector,
    state: Vector,
    boxes: Sequence[Box],
) -> tuple[BoxClearance, ...]:
    """Computes the least distance of the robot's surface to each box.

    Args:
        plant: the finalised plant.
        instance: the robot in it.
        robot: its names.
        time: (n,), s.
        state: positions, then velocities of the robot, (n, nq + nv).
        boxes: which.
    """
    surfaces: Mapping[str, Vector] = {
        mesh.body: surface_points(mesh.vertices, mesh.triangles, SPACING)
        for mesh in body_meshes(robot)
    }
    radii = {
        body: float(np.linalg.norm(points, axis=1).max())
        for body, points in surfaces.items()
    }
    bodies = {name: plant.GetBodyByName(name, instance) for name in surfaces}
    base = plant.GetBodyByName(robot.base_body, instance)
    context = plant.CreateDefaultContext()
    step = max(1, round(TICK / float(np.median(np.diff(time))))) if len(time) > 1 else 1
    best = {box.name: BoxClearance(box.name, np.inf, "", 0.0) for box in boxes}
    for row in range(0, len(time), step):
        plant.SetPositionsAndVelocities(context, instance, state[row])
        p_WBase: Vector = np.array(
            plant.EvalBodyPoseInWorld(context, base).translation()
        )
        for box in boxes:
            reach = p_WBase.copy()
            reach[2] = box.X_WB.translation()[2]
            if box_distance(reach[None], box)[0] > NEAR:
                continue
            for name, body in bodies.items():
                X_WB: RigidTransform = plant.EvalBodyPoseInWorld(context, body)
                origin: Vector = np.array(X_WB.translation())
                least = best[box.name].distance
                if box_distance(origin[None], box)[0] - radii[name] > least:
                    continue
                p_W = np.array(X_WB.multiply(surfaces[name].T)).T
                distance = float(box_distance(p_W, box).min())
                if distance < least:
                    best[box.name] = BoxClearance(
                        box.name, distance, name, float(time[row])
                    )
    return tuple(clearance for clearance in best.values() if clearance.body)


def crossed(path: Vector, box: Box) -> bool:
    """Tells whether the midpoint of the feet went over a box and ended beyond it.

    Args:
        path: midpoints of the feet over time, (n, 2), m.
        box: which.
    """
    p_W = np.column_stack([path, np.full(len(path), box.X_WB.translation()[2])])
    p_B = np.array(box.X_WB.inverse().multiply(p_W.T)).T
    half = box.size[:2] / 2.0
    over = bool((np.abs(p_B[:, :2]) <= half).all(axis=1).any())
    ends = np.abs(p_B[[0, -1], :2]) > half
    return over and bool(ends.any(axis=1).all())
