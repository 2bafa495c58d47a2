"""Synthetic sweeps of a tilting laser scanner before staircases in a room."""

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from footfall.systems.open3d_loader import open3d as o3d

Array: TypeAlias = np.ndarray[Any, np.dtype[np.float64]]

ROOM = (11.0, 7.0, 3.0)
BEAMS = np.radians(np.arange(1081) * 0.25 - 135.0)
LINES = 241


@dataclass(frozen=True, kw_only=True)
class StairScene:
    """A staircase in the room; the first riser crosses the origin, yawed about it."""

    steps: int = 3
    rise: float = 0.2
    run: float = 0.27
    width: float = 0.5
    yaw: float = 0.0
    open_risers: bool = False
    board: float = 0.04
    """Thickness of the treads of an open staircase, m."""
    landing: float = 0.0
    """Depth of a landing one rise above the last tread, m; 0 for none."""
    walls: bool = False
    """Whether walls flank the staircase."""
    room: tuple[float, float, float] = ROOM

    def rotation(self) -> Array:
        """R_WS, (3, 3)."""
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def tread_corners(self, index: int) -> Array:
        """Corners of a tread in W, (4, 3), m."""
        x = np.array([index, index + 1, index + 1, index]) * self.run
        y = np.array([-1.0, -1.0, 1.0, 1.0]) * self.width / 2.0
        z = np.full(4, (index + 1) * self.rise)
        return np.column_stack([x, y, z]) @ self.rotation().T

    def sensor(self, stands_on: int = -1, distance: float = 0.6) -> Array:
        """Where the head is, (3,): `distance` before the first riser, or on a tread."""
        if stands_on < 0:
            return np.array([-distance, 0.0, 1.5]) @ self.rotation().T
        x = (stands_on + 0.5) * self.run + 0.05
        z = (stands_on + 1) * self.rise + 1.5
        return np.array([x, 0.0, z]) @ self.rotation().T


def _box(scene: StairScene, low: tuple[float, ...], high: tuple[float, ...]) -> Any:
    size = np.array(high) - np.array(low)
    box = o3d.geometry.TriangleMesh.create_box(*size)
    box.translate(low)
    box.rotate(scene.rotation(), center=(0.0, 0.0, 0.0))
    return box


def _meshes(scene: StairScene) -> list[Any]:
    half = scene.width / 2.0
    meshes = []
    for i in range(scene.steps):
        top = (i + 1) * scene.rise
        bottom = top - scene.board if scene.open_risers else 0.0
        low, high = (i * scene.run, -half, bottom), ((i + 1) * scene.run, half, top)
        meshes.append(_box(scene, low, high))
    if scene.landing > 0.0:
        start, top = scene.steps * scene.run, (scene.steps + 1) * scene.rise
        meshes.append(
            _box(scene, (start, -half, 0.0), (start + scene.landing, half, top))
        )
    if scene.walls:
        for side in (-half - 0.1, half):
            meshes.append(_box(scene, (-2.0, side, 0.0), (6.0, side + 0.1, 2.9)))
    length, breadth, height = scene.room
    room = o3d.geometry.TriangleMesh.create_box(length, breadth, height)
    room.translate((-3.0, -breadth / 2.0, 0.0))
    meshes.append(room)
    return meshes


def scan_scene(
    scene: StairScene,
    sensor: Array,
    *,
    noise: float = 0.005,
    seed: int = 0,
    tilt: tuple[float, float] = (30.0, 90.0),
    lines: int = LINES,
) -> Array:
    """The cloud of one sweep, (n, 3), m, in W; tilt in degrees, positive down."""
    caster = o3d.t.geometry.RaycastingScene()
    for mesh in _meshes(scene):
        caster.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(mesh))
    down = np.radians(np.linspace(*tilt, lines))[:, None]
    # The scanner looks along W's x, however the staircase is yawed.
    azimuth = BEAMS[None, :]
    directions = np.stack(
        [
            np.cos(azimuth) * np.cos(down),
            np.sin(azimuth) * np.ones_like(down),
            -np.cos(azimuth) * np.sin(down),
        ],
        axis=-1,
    ).reshape(-1, 3)
    rays = np.hstack([np.broadcast_to(sensor, directions.shape), directions])
    ranges = caster.cast_rays(o3d.core.Tensor(rays.astype(np.float32)))
    t = ranges["t_hit"].numpy().astype(np.float64)
    t = t + np.random.default_rng(seed).normal(0.0, noise, len(t))
    seen = np.isfinite(t)
    return np.asarray(sensor + t[seen, None] * directions[seen], dtype=np.float64)


def crop(cloud: Array, scene: StairScene) -> Array:
    """The part of the cloud near the staircase."""
    local = cloud @ scene.rotation()
    low, high = np.array([-1.0, -1.5, -0.1]), np.array([2.5, 1.5, 2.0])
    return cloud[np.all((local > low) & (local < high), axis=1)]
