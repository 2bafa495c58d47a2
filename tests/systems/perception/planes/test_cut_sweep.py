"""A sweep that is cut line by line is the sweep that is cut as a whole."""

import numpy as np
import pytest

from footfall.models.robots.robot_description import default_sole
from footfall.systems.perception.planes.cut_sweep import (
    BLOCK,
    CutCloud,
    CutSweep,
    add_line,
    cut_cloud,
    empty_cut,
    finish_sweep,
    join_cuts,
    merge_surfaces,
)
from footfall.systems.perception.planes.plane_segmentation import (
    is_cut_for,
    segment_planes,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.surfaces import GAP, cut_columns
from tests.systems.perception.stair_scans import StairScene, scan_scene

CELL = 0.02
DOWN = np.array([0.0, 0.0, -1.0])
EYE = np.array([-0.6, 0.0, 1.5])


def _swept(cloud: np.ndarray, lines: int, eye_height: float = np.inf) -> CutCloud:
    """Cuts a cloud by parts of about one size, in their order."""
    sweep = CutSweep(empty_cut(CELL))
    for line in np.array_split(cloud, lines):
        sweep = add_line(sweep, cut_cloud(line, eye_height, CELL))
    return finish_sweep(sweep)


def _assert_same(part_by_part: CutCloud, whole: CutCloud) -> None:
    """Checks points, pieces and which points are whose."""
    np.testing.assert_array_equal(part_by_part.points, whole.points)
    assert part_by_part.seen == whole.seen
    ours, theirs = part_by_part.surfaces, whole.surfaces
    assert (ours.corner, ours.width) == (theirs.corner, theirs.width)
    for name in ("first", "column", "low", "high"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
    np.testing.assert_allclose(ours.mean, theirs.mean, rtol=0.0, atol=1e-12)
    for begin, end in zip(ours.first[:-1], ours.first[1:], strict=True):
        np.testing.assert_array_equal(
            np.sort(ours.order[begin:end]), np.sort(theirs.order[begin:end])
        )


@pytest.mark.parametrize("lines", [1, 2, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK + 5])
def test_line_by_line_is_as_the_whole(lines: int) -> None:
    """However many lines; points that are not finite or too high do not count."""
    rng = np.random.default_rng(lines)
    cloud = rng.uniform([-0.3, -0.4, -0.2], [0.4, 0.3, 0.6], (6000, 3))
    cloud[::7] = np.round(cloud[::7], 2)
    cloud[5], cloud[-3] = np.nan, np.inf
    _assert_same(_swept(cloud, lines, 0.5), cut_cloud(cloud, 0.5, CELL))


def test_a_point_between_joins_two_pieces() -> None:
    """Of three clouds only the last one closes the gap between the first two."""
    at = np.array([0.01, 0.01, 0.0])
    up = np.array([0.0, 0.0, 0.9 * GAP])
    clouds = [np.array([at]), np.array([at + 2.0 * up]), np.array([at + up])]
    apart = merge_surfaces([cut_columns(cloud, CELL) for cloud in clouds[:2]])
    assert len(apart.column) == 2
    joined = merge_surfaces([cut_columns(cloud, CELL) for cloud in clouds])
    assert len(joined.column) == 1
    np.testing.assert_allclose(joined.mean[0], at + up)
    assert joined.high[0] - joined.low[0] == pytest.approx(1.8 * GAP)


def test_a_piece_within_a_long_one_does_not_end_it() -> None:
    """A wall of one cloud spans a shelf of another and goes on above it."""
    z = np.arange(0.0, 1.0, 0.01)
    wall = np.column_stack([np.full_like(z, 0.01), np.full_like(z, 0.01), z])
    shelf = np.array([[0.01, 0.01, 0.301]])
    top = np.array([[0.01, 0.01, 1.01]])
    parts = [cut_columns(cloud, CELL) for cloud in (wall, shelf, top)]
    merged = merge_surfaces(parts)
    assert len(merged.column) == 1
    assert merged.count[0] == len(z) + 2


def test_a_sweep_without_points_is_empty() -> None:
    """Neither lines that saw nothing nor no lines at all are a fault."""
    nothing = np.zeros((0, 3))
    assert not len(_swept(nothing, 40).points)
    assert not len(finish_sweep(CutSweep(empty_cut(CELL))).points)
    one = cut_cloud(np.array([[0.1, 0.2, 0.3]]), 1.0, CELL)
    assert len(join_cuts([empty_cut(CELL), one]).points) == 1


@pytest.mark.parametrize("noise", [0.0, 0.005, 0.02])
def test_the_staircase_is_the_same(noise: float) -> None:
    """As the cloud at once, also where much noise has its levels drawn together."""
    scene = StairScene(steps=3, rise=0.20, run=0.27, width=0.50)
    cloud = scan_scene(scene, EYE, noise=noise)
    params, sole = PlaneSegmenterParams(), default_sole()
    whole, _ = segment_planes(cloud, DOWN, params, sole, EYE)
    cut = _swept(cloud, 241, float(EYE[2]))
    found, stages = segment_planes(cut.points, DOWN, params, sole, EYE, cut)
    assert (stages.surfaces is cut.surfaces) == (noise < 0.02)
    assert len(found.planes) == len(whole.planes)
    assert len(found.staircase.treads) == len(whole.staircase.treads) >= 3
    for ours, theirs in zip(found.planes, whole.planes, strict=True):
        np.testing.assert_allclose(ours.corners(), theirs.corners(), atol=1e-9)
        np.testing.assert_allclose(ours.polygon, theirs.polygon, atol=1e-9)
        assert ours.support_count == theirs.support_count


def test_a_cut_that_does_not_fit_is_passed_over() -> None:
    """Of another size, along another direction, for another method, or of nothing."""
    rng = np.random.default_rng(0)
    cut = cut_cloud(rng.uniform(-1.0, 1.0, (100, 3)), 2.0, CELL)
    params = PlaneSegmenterParams()
    assert is_cut_for(cut, 9.81 * DOWN, params)
    assert not is_cut_for(cut, np.array([0.1, 0.0, -1.0]), params)
    assert not is_cut_for(cut, DOWN, PlaneSegmenterParams(voxel_size=0.03))
    assert not is_cut_for(cut, DOWN, PlaneSegmenterParams(method="supervoxels"))
    assert not is_cut_for(empty_cut(CELL), DOWN, params)
