"""Values on the ports of a room crossing: depth images, environments, paths.

As all of `footfall.models.values`: frozen, comparable, each with a JSON form. W: z up.
"""

from dataclasses import dataclass, field
from math import cos, sin
from typing import Literal

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.values.value import Value
from footfall.models.values.vector import Vector


def _no_rows(*shape: int) -> Vector:
    return np.zeros((0, *shape))


@dataclass(frozen=True, eq=False)
class DepthImage(Value):
    """Frame of a depth camera.

    Camera frame C: origin at the pinhole, x to the right of the picture, y down, z
    into the picture.
    """

    time: float
    """Time at which it was taken, s; -inf for the empty image before the first."""
    X_WC: RigidTransform
    """Pose of the camera."""
    focal_length: float
    """Focal length, pixels; the same along x and y, the axis through the middle."""
    depth: Vector
    """Distance along z_C, (rows, columns), m; inf where nothing was met within range,
    nan where something was too near."""


@dataclass(frozen=True, eq=False)
class FloorPlane(Value):
    """The supporting plane that was found, as far as it was seen."""

    coefficients: Vector
    """(A, B, C, D) of A x + B y + C z + D = 0 in W (room paper, Sec. 2.2.2), (4,);
    (A, B, C) is the unit normal and points up."""
    polygon: Vector
    """Convex outline on the plane, (n, 3), m, counter-clockwise from above."""
    inlier_share: float = 1.0
    """Share of the points in view that lie on the plane, 0 to 1."""

    def height(self, p: Vector) -> float:
        """Computes the plane's height in W, m, over the horizontal point p, (2,), m."""
        a, b, c, d = self.coefficients
        return float(-(a * p[0] + b * p[1] + d) / c)


@dataclass(frozen=True, eq=False)
class FloorEstimate(Value):
    """The floor of one cloud, or why there is none."""

    floor: FloorPlane | None = None
    reason: str = ""
    """Why there is no floor, in one line; empty otherwise."""


@dataclass(frozen=True, eq=False)
class ObstacleBox(Value):
    """An upright box around an obstacle."""

    name: str
    center: Vector
    """Centre in W, (3,), m."""
    yaw: float
    """Direction of its x axis about z of W, rad."""
    size: Vector
    """Side lengths along its own x, y and z, (3,), m."""
    support_count: int = 0
    """Number of points that it was fitted to; 0 where it was not seen."""

    @property
    def X_WB(self) -> RigidTransform:
        """Pose of its centre."""
        return RigidTransform(RollPitchYaw(0.0, 0.0, self.yaw), self.center)

    def footprint(self) -> Vector:
        """Computes its corners on the floor, (4, 2), m, counter-clockwise."""
        c, s = cos(self.yaw), sin(self.yaw)
        signs = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
        corners: Vector = signs * self.size[:2] @ np.array([[c, s], [-s, c]])
        return corners + self.center[:2]

    def aligned(self) -> tuple[Vector, Vector]:
        """Computes the axis-aligned box around it: both corners in W, (3,), m."""
        corners, half = self.footprint(), self.size[2] / 2.0
        low = np.append(corners.min(axis=0), self.center[2] - half)
        high = np.append(corners.max(axis=0), self.center[2] + half)
        return low, high


@dataclass(frozen=True, eq=False)
class Environment(Value):
    """The 3D model of the room: the floor and what stands on it (paper, Sec. 4)."""

    floor: FloorPlane | None = None
    boxes: tuple[ObstacleBox, ...] = ()
    reason: str = ""
    """Why there is no floor, in one line; empty otherwise."""
    sensed_at: float | None = None
    """Time of the frame, s, earlier than that of the result; None before the first."""


@dataclass(frozen=True, eq=False)
class PathPlan(Value):
    """A collision-free path of the robot's middle over the floor, or why there is none.

    The trees are what RRT-Connect grew, to be drawn: one segment an edge.
    """

    points: Vector = field(default_factory=lambda: _no_rows(2))
    """Corners of the path in W, (n, 2), m, from the start to the goal."""
    goal_yaw: float = 0.0
    """Heading at the goal, rad."""
    status: Literal["planned", "refused"] = "refused"
    reason: str = ""
    """Reason why there is no path, in one line; empty otherwise."""
    found: Vector = field(default_factory=lambda: _no_rows(2))
    """Corners of the path before it was shortened, (m, 2), m."""
    start_tree: Vector = field(default_factory=lambda: _no_rows(2, 2))
    """Edges of the tree that grew from the start, (k, 2, 2), m."""
    goal_tree: Vector = field(default_factory=lambda: _no_rows(2, 2))
    """Edges of the tree that grew from the goal, (k, 2, 2), m."""

    @property
    def length(self) -> float:
        """Length of the path, m."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())
