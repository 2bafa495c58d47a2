"""What beams meet, against closed forms and against one tree of everything."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solids import Box, TriangleMesh, triangle_mesh, upright_pose
from footfall.systems.open3d_loader import open3d as o3d
from footfall.systems.sensing.ray_caster import BodyMesh, RayCaster
from footfall.systems.sensing.scan_geometry import (
    beam_angles,
    beam_directions,
    tilt_pose,
)

ANGLES = beam_angles(np.radians(270.0), np.radians(0.25))
DIRECTIONS = beam_directions(ANGLES)
NOTHING = TriangleMesh(
    np.array([[0, 0, -900.0], [1, 0, -900.0], [0, 1, -900.0]]),
    np.array([[0, 1, 2]], dtype=np.int64),
)


def _crate(size: float) -> TriangleMesh:
    sides = np.array([size, size, size])
    return triangle_mesh([Box("crate", RigidTransform(), sides, 0.5, (1, 1, 1, 1))])


def _room_distances(p_WL: np.ndarray, directions_W: np.ndarray) -> np.ndarray:
    """Distance to the inside of the 11 x 7 x 3 m room: the nearest of its planes."""
    low, high = np.array([-5.5, -3.5, 0.0]), np.array([5.5, 3.5, 3.0])
    ahead = np.where(directions_W > 0.0, high, low) - p_WL
    with np.errstate(divide="ignore"):
        to_planes = np.abs(ahead / directions_W)
    return np.min(to_planes, axis=1)


@pytest.mark.parametrize("tilt_deg", [-20.0, 0.0, 30.0, 61.75, 90.0])
def test_empty_room_has_known_ranges(tilt_deg: float) -> None:
    """Each beam ends on the nearest plane of the room."""
    caster = RayCaster(triangle_mesh(RoomParams().solids()), ())
    X_WL = RigidTransform(
        RollPitchYaw(0.05, 0.0, 0.4), np.array([0.3, -0.2, 1.65])
    ).multiply(tilt_pose(np.radians(tilt_deg)))
    expected = _room_distances(
        X_WL.translation(), DIRECTIONS @ X_WL.rotation().matrix().T
    )
    distances = caster.cast(X_WL, ANGLES, DIRECTIONS, [])
    np.testing.assert_allclose(distances, expected, rtol=1e-5)


def _ball(radius: float, body_index: int) -> BodyMesh:
    mesh = o3d.geometry.TriangleMesh.create_sphere(radius=radius, resolution=60)
    return BodyMesh(
        body_index,
        np.asarray(mesh.vertices),
        np.asarray(mesh.triangles).astype(np.int64),
    )


@pytest.mark.parametrize("y", [-0.05, 0.05])
def test_ball_behind_is_seen_on_both_sides(y: float) -> None:
    """A body across the seam at 180 deg meets the first beams and the last."""
    caster = RayCaster(NOTHING, [_ball(0.85, 0)])
    pose = upright_pose(x=-1.0, y=y)
    hit = np.isfinite(caster.cast(RigidTransform(), ANGLES, DIRECTIONS, [pose]))
    half = np.arcsin(0.85 / np.hypot(1.0, y))
    off = np.abs(np.angle(np.exp(1j * (ANGLES - np.arctan2(y, -1.0)))))
    assert np.any(hit[:100])
    assert np.any(hit[-100:])
    # The mesh lies just inside the ball it stands for.
    assert np.all(hit[off < half - 0.02])
    assert not np.any(hit[off > half])


def test_ball_is_seen_where_it_has_moved() -> None:
    """A body's pose, not its mesh, says where it is; its near side is met."""
    caster = RayCaster(NOTHING, [_ball(0.5, 1)])
    for distance in (2.0, 3.0):
        poses = [RigidTransform(), upright_pose(x=distance, y=0.0, z=1.0)]
        distances = caster.cast(upright_pose(z=1.0), ANGLES, DIRECTIONS, poses)
        assert distances[540] == pytest.approx(distance - 0.5, abs=2e-3)
        hit = np.isfinite(distances)
        half = np.arcsin(0.5 / distance)
        assert np.sum(hit) * np.radians(0.25) == pytest.approx(2.0 * half, abs=0.01)


def _together(parts: list[TriangleMesh]) -> TriangleMesh:
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return TriangleMesh(
        np.vstack([part.vertices for part in parts]),
        np.vstack([part.triangles + i for part, i in zip(parts, starts, strict=False)]),
    )


@pytest.mark.parametrize("tilt_deg", [-10.0, 20.0, 45.0, 85.0])
@pytest.mark.parametrize("enclosed", [False, True])
def test_culling_loses_nothing(tilt_deg: float, enclosed: bool) -> None:
    """Casting by body equals casting on one tree of everything where it now stands."""
    generator = np.random.default_rng(7)
    room, crate = triangle_mesh(RoomParams().solids()), _crate(0.3)
    bodies = [BodyMesh(i, crate.vertices, crate.triangles) for i in range(60)]
    poses = [
        RigidTransform(
            RollPitchYaw(generator.uniform(-3.0, 3.0, 3)),
            generator.uniform([-3.0, -3.0, 0.2], [3.0, 3.0, 2.8]),
        )
        for _ in bodies
    ]
    if enclosed:
        poses[0] = upright_pose(z=1.5)
    moved = [
        TriangleMesh(X.multiply(crate.vertices.T).T, crate.triangles) for X in poses
    ]
    X_WL = upright_pose(z=1.5, yaw=2.5).multiply(tilt_pose(np.radians(tilt_deg)))
    by_body = RayCaster(room, bodies).cast(X_WL, ANGLES, DIRECTIONS, poses)
    at_once = RayCaster(_together([room, *moved]), ()).cast(
        X_WL, ANGLES, DIRECTIONS, []
    )
    empty = RayCaster(room, ()).cast(X_WL, ANGLES, DIRECTIONS, [])
    assert np.mean(by_body < empty - 0.01) > 0.1
    # A beam that grazes an edge may fall to either side of it.
    assert np.mean(np.abs(by_body - at_once) > 1e-4) < 3e-3


def test_body_behind_the_field_of_view_is_not_seen() -> None:
    """The 90 deg behind the scanner hold no beam."""
    crate = _crate(0.3)
    caster = RayCaster(NOTHING, [BodyMesh(0, crate.vertices, crate.triangles)])
    behind = caster.cast(RigidTransform(), ANGLES, DIRECTIONS, [upright_pose(x=-2.0)])
    assert np.all(np.isinf(behind))
    ahead = caster.cast(RigidTransform(), ANGLES, DIRECTIONS, [upright_pose(x=2.0)])
    assert np.min(ahead) == pytest.approx(1.85, abs=1e-5)


def test_equal_meshes_share_their_tree() -> None:
    """However many sensors there are: about a thousand trees crash a process."""
    crate, other = _crate(0.5), _crate(0.6)
    casters = [
        RayCaster(crate, [BodyMesh(1, mesh.vertices.copy(), mesh.triangles.copy())])
        for mesh in (crate, crate, other)
    ]
    scenes = {id(caster._scene) for caster in casters}
    bodies = [caster._bodies[0].tree for caster in casters]
    assert len(scenes) == 1
    assert bodies[0] is bodies[1]
    assert bodies[2] is not bodies[0]
