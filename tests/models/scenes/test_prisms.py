"""Closed surfaces are cut into prisms, exactly."""

import numpy as np
import pytest
import shapely
import trimesh

from footfall.models.scenes.prisms import (
    convex_parts,
    cut_prisms,
    level_facets,
    open_edges,
)
from tests.models.scenes.scene_meshes import block_steps, box, joined, profile_steps

RISES, RUNS = [0.14, 0.18, 0.20], [0.27, 0.90, 0.30]


def test_a_profile_is_cut_below_its_treads() -> None:
    """A prism a tread, down to the floor; together they are the whole of it."""
    mesh = profile_steps(RISES, RUNS)
    assert open_edges(mesh) == 0
    prisms = sorted(cut_prisms(mesh), key=lambda prism: prism.high)
    np.testing.assert_allclose([p.high for p in prisms], np.cumsum(RISES), atol=1e-9)
    np.testing.assert_allclose([p.low for p in prisms], 0.0, atol=1e-9)
    assert sum(p.volume for p in prisms) == pytest.approx(mesh.volume)
    low, high = prisms[1].vertices().min(axis=0), prisms[1].vertices().max(axis=0)
    np.testing.assert_allclose(low, [0.27, -0.25, 0.0], atol=1e-9)
    np.testing.assert_allclose(high, [1.17, 0.25, 0.32], atol=1e-9)


def test_plates_have_air_beneath() -> None:
    """Each its own thickness."""
    plates = joined(
        box([0.0, -0.4, 0.16], [0.3, 0.4, 0.2]),
        box([0.28, -0.4, 0.36], [0.6, 0.4, 0.4]),
    )
    prisms = sorted(cut_prisms(plates), key=lambda prism: prism.high)
    np.testing.assert_allclose(
        [(p.low, p.high) for p in prisms], [(0.16, 0.2), (0.36, 0.4)]
    )


def test_blocks_that_share_edges_are_closed() -> None:
    """Four triangles meet at an edge; of a missing face three edges tell."""
    blocks = block_steps()
    assert not blocks.is_watertight
    assert open_edges(blocks) == 0
    assert sum(p.volume for p in cut_prisms(blocks)) == pytest.approx(blocks.volume)
    open_box = box([0, 0, 0], [1, 1, 1])
    open_box.update_faces(np.arange(len(open_box.faces)) > 0)
    assert open_edges(open_box) == 3


def test_facets_are_joined_where_coplanar() -> None:
    """Two boxes side by side have one top; steep faces are none."""
    pair = joined(box([0, 0, 0], [1, 1, 0.3]), box([1, 0, 0], [2, 1, 0.3]))
    (top,) = level_facets(pair)
    assert (top.height, top.outline.area) == pytest.approx((0.3, 2.0))
    assert len(shapely.get_parts(top.outline)) == 1
    tilt = trimesh.transformations.rotation_matrix(np.deg2rad(1.0), [1, 0, 0])
    pair.apply_transform(tilt)
    assert level_facets(pair) == []


def test_an_area_that_is_not_convex_is_cut_further() -> None:
    """An L into convex parts that fill it."""
    corner = shapely.Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    parts = [shapely.Polygon(part) for part in convex_parts(corner)]
    assert sum(part.area for part in parts) == pytest.approx(corner.area)
    assert all(part.equals(part.convex_hull) for part in parts)
    assert shapely.union_all(parts).area == pytest.approx(corner.area)
