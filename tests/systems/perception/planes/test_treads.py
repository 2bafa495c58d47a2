"""Edges of treads from the points of the cloud."""

import numpy as np
import pytest

from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.planes import FittedPlane, Patch, bound_patch
from footfall.systems.perception.planes.treads import refine_treads, stair_rotation

UP = np.array([0.0, 0.0, 1.0])
HEIGHT = 0.2


def grid(*axes: Vector) -> Vector:
    """All combinations of the coordinates, (n, 3)."""
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


Y = np.arange(-0.4, 0.4001, 0.01)


def top(rows: Vector) -> Vector:
    """A tread of which the scanner saw these rows."""
    return grid(rows, Y, np.array([HEIGHT]))


def face(x: float, low: float, high: float) -> Vector:
    """An upright face."""
    return grid(np.array([x]), Y, np.arange(low, high, 0.01))


def patch(points: Vector) -> Patch:
    """What the voxels said: these points, and their plane."""
    made = bound_patch(FittedPlane(points.mean(axis=0), UP, np.arange(1)), points, 0.2)
    assert made is not None
    return made


@pytest.mark.parametrize("yaw", [0.0, 0.15, -0.15])
def test_faces_tell_where_sparse_rows_end(yaw: float) -> None:
    """Rows 2.5 cm apart end short of the edges at 0 and 0.27; the faces stand there."""
    turn = stair_rotation(yaw)
    rows = top(np.arange(0.012, 0.265, 0.025)) @ turn.T
    # Not so near to the tread that their points would count as the tread's.
    faces = np.concatenate(
        [face(0.0, 0.0, HEIGHT - 0.02), face(0.27, HEIGHT + 0.02, 0.4)]
    )
    cloud = np.concatenate([rows, faces @ turn.T])
    found, (tread,) = refine_treads([patch(rows)], cloud, None)
    assert found == pytest.approx(yaw, abs=0.002)
    np.testing.assert_allclose(tread.low, [0.0, -0.4], atol=0.004)
    np.testing.assert_allclose(tread.high, [0.27, 0.4], atol=0.004)
    assert tread.drops
    assert tread.ends
    np.testing.assert_allclose(tread.normal, UP, atol=1e-6)


def test_nosing_reaches_before_its_riser() -> None:
    """A tread that overhangs the face below by 3 cm begins at its own end."""
    rows = top(np.arange(-0.03, 0.2701, 0.01))
    # Of the face it hides the part down to 0.16 m.
    cloud = np.concatenate([rows, grid(np.zeros(1), Y, np.arange(0.0, 0.16, 0.002))])
    _, (tread,) = refine_treads([patch(rows)], cloud, np.array([-1.0, 0.0, 1.5]))
    assert tread.low[0] == pytest.approx(-0.03, abs=0.002)


def test_unseen_ends_are_told() -> None:
    """Nothing lower before it, nothing behind it: neither edge is known."""
    rows = top(np.arange(0.0, 0.27, 0.01))
    eye = np.array([-1.0, 0.0, 1.5])
    _, (tread,) = refine_treads([patch(rows)], rows, eye)
    assert not tread.drops
    assert not tread.ends
    floor = grid(np.arange(-0.3, 0.0, 0.02), Y, np.array([0.0]))
    behind = grid(np.arange(0.6, 0.9, 0.02), Y, np.array([0.0]))
    _, (tread,) = refine_treads(
        [patch(rows)], np.concatenate([rows, floor, behind]), eye
    )
    assert tread.drops
    assert tread.ends


def test_what_is_seen_under_an_open_tread_is_not_behind_it() -> None:
    """A ray that passes below the tread says nothing of its back edge."""
    rows = top(np.arange(0.0, 0.27, 0.01))
    under = grid(np.arange(0.3, 0.5, 0.02), Y, np.array([-1.0]))
    eye = np.array([-0.6, 0.0, 1.0])
    _, (tread,) = refine_treads([patch(rows)], np.concatenate([rows, under]), eye)
    assert not tread.ends


def test_lone_tread_without_viewpoint_rises_from_its_face() -> None:
    """Its front is where the face below it was seen."""
    rows = top(np.arange(0.0, 0.27, 0.01))
    for x, sign in ((0.0, 1.0), (0.26, -1.0)):
        cloud = np.concatenate([rows, face(x, 0.0, HEIGHT - 0.02)])
        yaw, _ = refine_treads([patch(rows)], cloud, None)
        assert np.cos(yaw) == pytest.approx(sign, abs=1e-3)
