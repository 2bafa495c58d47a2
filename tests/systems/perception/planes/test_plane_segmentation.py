"""The chain from cloud to treads, on synthetic sweeps and on real data."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydrake.common.yaml import yaml_dump_typed, yaml_load_typed
from pydrake.math import RollPitchYaw

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot import Sole
from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_files import read_cloud
from footfall.systems.perception.planes.flights import find_flights
from footfall.systems.perception.planes.levels import Sampling
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.segments import tread_segment
from footfall.systems.perception.planes.supervoxel_planes import (
    LevelVoxels,
    bound_planes,
    cluster_level,
    fit_planes,
)
from footfall.systems.perception.planes.tread_candidates import StairLimits
from footfall.systems.perception.planes.voxels import adjacent_voxels, voxelize
from footfall.systems.perception.staircases.staircase_merging import (
    StaircaseMapParams,
    leave_partial,
)
from tests.systems.perception.planes.tread_checks import Scan, check_treads

GRAVITY = np.array([0.0, 0.0, -9.81])
PARAMS = PlaneSegmenterParams(threads=1)
SOLE = JVRC1.sole


SCENES = {
    "exp1": {},
    "exp1 yawed": {"yaw": 0.17},
    "low and wide": {"rise": 0.10, "run": 0.32, "width": 1.3, "yaw": -0.17},
    "two steps": {"steps": 2, "rise": 0.15, "run": 0.30, "yaw": -0.09},
    "open": {"rise": 0.18, "run": 0.29, "width": 0.8, "open_risers": True},
    "open, yawed": {"rise": 0.12, "width": 0.9, "open_risers": True, "yaw": 0.12},
    "between walls": {"rise": 0.15, "width": 1.1, "walls": True, "yaw": 0.05},
    "24 cm": {"steps": 1, "rise": 0.24, "run": 0.30, "width": 0.6, "yaw": 0.1},
}


@pytest.mark.parametrize("name", SCENES)
def test_staircase_from_the_floor(name: str, scan: Scan, stair_scene: Any) -> None:
    """The treads, and nothing else, to a few millimetres; the floor is the floor."""
    scene = stair_scene(**SCENES[name])
    eye = scene.sensor()
    found, _ = segment_planes(scan(scene, eye), GRAVITY, PARAMS, SOLE, eye)
    check_treads(found, scene, list(range(scene.steps)))
    floor = found.staircase.floor
    assert floor is not None
    assert abs(floor.X_WR.translation()[2]) < 0.003
    assert floor == found.planes[0]
    assert not [p for p in found.planes if p.X_WR.translation()[2] > 2.0]


@pytest.mark.parametrize("stands_on", [0, 1, 2])
@pytest.mark.parametrize("open_risers", [False, True])
def test_staircase_from_a_tread(
    stands_on: int, open_risers: bool, scan: Scan, stair_scene: Any
) -> None:
    """On a tread the ones ahead are found; what is below is no new tread."""
    scene = stair_scene(
        steps=4, rise=0.16, run=0.28, width=0.9, yaw=0.08, open_risers=open_risers
    )
    eye = scene.sensor(stands_on)
    found, _ = segment_planes(scan(scene, eye), GRAVITY, PARAMS, SOLE, eye)
    check_treads(found, scene, list(range(stands_on + 1, 4)))


def test_strip_of_floor_is_no_tread(scan: Scan, stair_scene: Any) -> None:
    """A corridor's floor of which only a tread's depth is seen is the floor."""
    scene = stair_scene(rise=0.17, run=0.30, width=1.0, walls=True)
    eye = scene.sensor()
    cloud = scan(scene, eye)
    found, _ = segment_planes(cloud[cloud[:, 0] > -0.31], GRAVITY, PARAMS, SOLE, eye)
    check_treads(found, scene, [0, 1, 2])
    assert found.staircase.floor is not None
    assert abs(found.staircase.floor.X_WR.translation()[2]) < 0.003


@pytest.mark.parametrize("with_viewpoint", [False, True])
@pytest.mark.parametrize("open_risers", [False, True])
def test_tread_that_the_view_cuts_off_has_no_back(
    open_risers: bool, with_viewpoint: bool, scan: Scan, stair_scene: Any
) -> None:
    """Of the fourth tread two thirds are seen: who steps on it waits for the rest."""
    scene = stair_scene(
        steps=4, rise=0.13, run=0.30, width=0.7, open_risers=open_risers
    )
    eye = scene.sensor()
    found, _ = segment_planes(
        scan(scene, eye), GRAVITY, PARAMS, SOLE, eye if with_viewpoint else None
    )
    cut = found.staircase.treads[3]
    assert cut.edges is not None
    assert cut.edges.front
    assert not cut.edges.back
    assert 0.15 < cut.size[0] < 0.28
    whole = leave_partial(found.staircase, StaircaseMapParams())
    check_treads(replace(found, staircase=whole), scene, [0, 1, 2])


def test_hidden_parts_do_not_move_the_edges(scan: Scan, stair_scene: Any) -> None:
    """Knees between sensor and stairs hide parts of the treads, not their edges."""
    scene = stair_scene(rise=0.18, run=0.28, width=0.8)
    eye = scene.sensor(0)
    cloud = scan(scene, eye)
    fall = np.maximum(eye[2] - cloud[:, 2:], 0.01)
    way = (cloud - eye) / fall
    hidden = (np.abs(np.abs(way[:, 1]) - 0.09) < 0.04) & (way[:, 0] < 0.45)
    hidden &= fall[:, 0] > 0.1
    found, _ = segment_planes(cloud[~hidden], GRAVITY, PARAMS, SOLE, eye)
    check_treads(found, scene, [1, 2])


def test_room_without_stairs_has_no_staircase(scan: Scan, stair_scene: Any) -> None:
    """Floor, and with the viewpoint known no ceiling."""
    scene = stair_scene(steps=0)
    eye = np.array([-0.6, 0.0, 1.5])
    cloud = scan(scene, eye)
    found, _ = segment_planes(cloud, GRAVITY, PARAMS, SOLE, eye)
    assert found.staircase.treads == ()
    heights = [float(p.X_WR.translation()[2]) for p in found.planes]
    assert abs(heights[0]) < 0.003
    assert max(heights) < 1.0


def test_any_frame_gives_the_same_treads(scan: Scan, stair_scene: Any) -> None:
    """A cloud in a turned frame, gravity turned with it, gives turned treads."""
    scene = stair_scene(rise=0.15, width=0.7, yaw=0.1)
    eye = scene.sensor()
    cloud = scan(scene, eye)
    R_VW: Vector = RollPitchYaw(0.5, -0.8, 1.9).ToRotationMatrix().matrix()
    turned, _ = segment_planes(
        cloud @ R_VW.T, 0.1 * R_VW @ GRAVITY, PARAMS, SOLE, R_VW @ eye
    )
    plain, _ = segment_planes(cloud, GRAVITY, PARAMS, SOLE, eye)
    assert len(turned.staircase.treads) == len(plain.staircase.treads) == 3
    for a, b in zip(turned.staircase.treads, plain.staircase.treads, strict=True):
        np.testing.assert_allclose(a.corners() @ R_VW, b.corners(), atol=0.006)
        np.testing.assert_allclose(a.normal @ R_VW, b.normal, atol=0.01)


def test_result_does_not_depend_on_threads_or_chance(
    scan: Scan, stair_scene: Any
) -> None:
    """Same cloud, same planes, bit for bit; points that are none change nothing."""
    scene = stair_scene()
    cloud = scan(scene, scene.sensor())
    first, _ = segment_planes(cloud, GRAVITY, PARAMS, SOLE)
    second, _ = segment_planes(cloud, GRAVITY, PlaneSegmenterParams(threads=2), SOLE)
    holes = np.insert(cloud, [0, 100, len(cloud)], [np.nan, 0.0, np.inf], axis=0)
    third, _ = segment_planes(holes, GRAVITY, PARAMS, SOLE)
    assert first.planes == second.planes == third.planes
    assert first.staircase == second.staircase == third.staircase
    assert first.staircase.treads


def test_order_of_the_paper(scan: Scan, stair_scene: Any) -> None:
    """Normals before voxels, RANSAC over all, the largest size cluster: Algorithm 1.

    On a small room, where the steps are the largest cluster, as in the paper.
    """
    scene = stair_scene(width=0.8)
    eye = scene.sensor()
    cloud = scan(scene, eye, noise=0.002)
    # With what is seen past the last tread, which tells where it ends.
    near = np.all((cloud > [-0.5, -0.5, -0.1]) & (cloud < [2.0, 0.5, 1.0]), axis=1)
    params = PlaneSegmenterParams(
        order="normals_first",
        planes_from="all",
        staircase_from="size_cluster",
        threads=1,
    )
    found, stages = segment_planes(cloud[near], GRAVITY, params, SOLE, eye)
    check_treads(found, scene, [0, 1, 2])
    assert stages.clusters.max() >= 3


CLOUDS: dict[str, Vector] = {
    "empty": np.zeros((0, 3)),
    "one point": np.ones((1, 3)),
    "one voxel": np.random.default_rng(0).uniform(0.001, 0.019, (100, 3)),
    "same point": np.ones((1000, 3)),
    "all nan": np.full((50, 3), np.nan),
    "a line": np.column_stack([np.linspace(0, 1, 999), np.zeros(999), np.zeros(999)]),
    "a strip": np.random.default_rng(1).uniform(0, 1, (9999, 3)) * [1.0, 0.03, 0.0],
    "noise": np.random.default_rng(2).uniform(-1, 1, (20000, 3)),
    "a wall": np.random.default_rng(3).uniform(-1, 1, (20000, 3)) * [0, 1, 1],
}


@pytest.mark.parametrize("staircase_from", ["chain", "size_cluster"])
@pytest.mark.parametrize("order", ["voxels_first", "normals_first"])
@pytest.mark.parametrize("name", CLOUDS)
def test_poor_clouds_have_no_staircase(
    name: str, order: str, staircase_from: str
) -> None:
    """Whatever the cloud, a defined result and no error."""
    params = PlaneSegmenterParams(order=order, staircase_from=staircase_from, threads=1)
    found, _ = segment_planes(CLOUDS[name], GRAVITY, params, SOLE)
    assert staircase_from == "size_cluster" or found.staircase.treads == ()
    if name in ("empty", "all nan"):
        assert found.planes == ()
        assert found.staircase.floor is None
        assert found.times_ms[0][0] == "cloud"


def test_wrong_shape_is_refused() -> None:
    """The error shows what came."""
    with pytest.raises(ValueError, match=r"points: must be \(n, 3\), got \(3, 5\)"):
        segment_planes(np.zeros((3, 5)), GRAVITY, PARAMS, SOLE)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("voxel_size", 0),
        ("seed_resolution", 0.03),
        ("influence", 1),
        ("min_neighbors", 26),
        ("slope_tolerance", 2),
        ("neighbors", 3),
        ("order", "sideways"),
        ("planes_from", "nothing"),
        ("staircase_from", ""),
        ("threads", 0),
    ],
)
def test_bad_parameters_are_named(field: str, value: float | str) -> None:
    """Each names its field and shows the value."""
    params = PlaneSegmenterParams()
    setattr(params, field, value)
    with pytest.raises(ValueError, match=f"^{field}: must .*got '?{value}"):
        params.validate()


def test_what_is_smaller_than_the_sole_is_no_plane() -> None:
    """Whatever robot it is: a board that JVRC-1 can stand on is none for a giant."""
    board = np.random.default_rng(4).uniform(0, 1, (9999, 3)) * [0.4, 0.3, 0.0]
    giant = Sole(heel=0.3, toe=0.6, half_width=0.15, ankle_height=0.3)
    for sole, count in ((SOLE, 1), (giant, 0)):
        assert len(segment_planes(board, GRAVITY, PARAMS, sole)[0].planes) == count


def test_parameters_are_table_1_and_go_through_yaml() -> None:
    """The paper's values, and a round trip through Drake's YAML."""
    params = PlaneSegmenterParams()
    params.validate()
    assert (params.seed_resolution, params.voxel_size) == (0.1, 0.02)
    assert (params.influence, params.min_neighbors) == (0.2, 5)
    assert params.slope_tolerance == pytest.approx(np.radians(15.0))
    text = yaml_dump_typed(params)
    assert yaml_load_typed(schema=PlaneSegmenterParams, data=text) == params


def test_published_rectangles_from_published_voxels(data: Path) -> None:
    """From the first experiment's voxels after Filter 2 to its three rectangles."""
    voxels = np.loadtxt(data / "exp1" / "voxels.txt", delimiter=",")
    rectangles = np.loadtxt(data / "exp1" / "rectangles.txt", delimiter=",")
    rectangles = rectangles.reshape(3, 4, 3)
    rectangles = rectangles[np.argsort(rectangles[:, :, 2].mean(axis=1))]
    # The file gives every voxel the y of its supervoxel's centre.
    spread = (-0.035, -0.0175, 0.0, 0.0175, 0.035)
    cloud = np.concatenate([voxels + np.array([0.0, dy, 0.0]) for dy in spread])
    # Risers and rays are not in it, so that a cut-off tread cannot be told.
    params = PlaneSegmenterParams(
        voxel_size=0.03, stairs=StairLimits(depth_tolerance=1.0)
    )
    grid = voxelize(cloud, params.voxel_size)
    pairs = adjacent_voxels(grid)
    points = cloud[grid.representative]
    level = LevelVoxels(
        points=points,
        normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)),
        pairs=pairs,
        grid=grid,
        member=np.arange(len(points)),
        grid_pairs=pairs,
    )
    _, clusters = cluster_level(level, params, SOLE)
    patches = bound_planes(
        fit_planes(level, clusters, params, SOLE), level, cloud, params
    )
    (flight,) = find_flights(patches, cloud, params, None, Sampling())
    yaw, treads = flight.yaw, flight.treads
    assert len(treads) == 3
    for tread, rectangle in zip(treads, rectangles, strict=True):
        corners = tread_segment(tread, yaw, params.voxel_size, np.eye(3)).corners()
        # Front right, back right, back left, front left.
        wanted = rectangle[[0, 3, 2, 1]]
        error = corners - wanted
        assert abs(error[:, 2].mean()) < 0.01
        for side in ([0, 3], [1, 2]):
            assert abs(error[side, 0].mean()) < 0.03
        for side in ([0, 1], [2, 3]):
            assert abs(error[side, 1].mean()) < 0.03


def test_cinder_blocks(data: Path) -> None:
    """Tilted blocks: with 25 deg of slope each is a plane of its own size."""
    cloud = read_cloud(data / "clouds" / "terrain_close_rect.pcd")
    params = PlaneSegmenterParams(slope_tolerance=np.radians(25.0))
    found, _ = segment_planes(cloud, GRAVITY, params, SOLE)
    blocks = [
        plane
        for plane in found.planes
        if 0.05 < plane.X_WR.translation()[2] < 0.6
        and plane.size[0] > 0.25
        and plane.size[1] < 0.55
    ]
    assert 27 <= len(blocks) <= 31
    slopes = np.degrees([np.arccos(plane.normal[2]) for plane in blocks])
    assert 10.0 < np.median(slopes) < 18.0
    assert found.staircase.treads == ()
    level, _ = segment_planes(cloud, GRAVITY, PlaneSegmenterParams(), SOLE)
    assert len(level.planes) < len(found.planes)


def test_narrow_treads_behind_legs(scan: Scan, stair_scene: Any) -> None:
    """Low open steps; the strips beyond the legs' shadows are too small for planes."""
    scene = stair_scene(
        steps=4, rise=0.106, run=0.27, width=0.51, yaw=-0.055, open_risers=True
    )
    for stands_on in (0, 2):
        eye = scene.sensor(stands_on)
        cloud = scan(scene, eye)
        fall = np.maximum(eye[2] - cloud[:, 2:], 0.01)
        way = (cloud - eye) / fall
        hidden = (np.abs(np.abs(way[:, 1]) - 0.10) < 0.035) & (way[:, 0] < 0.46)
        hidden &= fall[:, 0] > 0.1
        found, _ = segment_planes(cloud[~hidden], GRAVITY, PARAMS, SOLE, eye)
        check_treads(found, scene, list(range(stands_on + 1, 4)))
