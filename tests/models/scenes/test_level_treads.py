"""Treads of any scene: level, wide enough, and nothing on them."""

import numpy as np
import shapely

from footfall.models.scenes.level_treads import level_treads, open_facets
from footfall.models.scenes.prisms import Facet, Prism, cut_prisms, level_facets
from tests.models.scenes.scene_meshes import block_steps, box, joined

AHEAD = np.array([1.0, 0.0])


def test_treads_of_blocks_are_those_of_the_staircase() -> None:
    """Lowest first, x up the stairs."""
    mesh = block_steps(3, 0.2, 0.27)
    facets = open_facets(level_facets(mesh), cut_prisms(mesh))
    treads = level_treads(facets, 0.15, AHEAD, "stairs/")
    assert [tread.name for tread in treads] == [f"stairs/tread_{n}" for n in (1, 2, 3)]
    for n, tread in enumerate(treads):
        place = tread.X_WR.translation()
        np.testing.assert_allclose(
            place, [0.27 * (n + 0.5), 0, 0.2 * (n + 1)], atol=1e-6
        )
        np.testing.assert_allclose(tread.size, [0.27, 0.5], atol=1e-6)
        np.testing.assert_allclose(tread.X_WR.rotation().col(0), [1, 0, 0], atol=1e-9)
        assert tread.outline is None


def test_what_lies_under_another_solid_is_no_tread() -> None:
    """Stacked boxes, each set back: of the lower one the front is open."""
    stack = joined(box([0, 0, 0], [0.6, 1, 0.2]), box([0.3, 0, 0.2], [0.6, 1, 0.4]))
    treads = level_treads(
        open_facets(level_facets(stack), cut_prisms(stack)), 0.15, AHEAD, ""
    )
    np.testing.assert_allclose([t.size for t in treads], [[0.3, 1.0]] * 2, atol=1e-6)


def test_a_flight_that_turns_is_followed() -> None:
    """Each tread's x goes from the one below to the one above."""
    areas = [
        Facet(height, shapely.box(*bounds))
        for height, bounds in (
            (0.2, (0.0, 0.0, 0.3, 0.8)),
            (0.4, (0.3, 0.0, 1.1, 0.8)),
            (0.6, (0.3, 0.8, 1.1, 1.1)),
        )
    ]
    treads = level_treads(areas, 0.15, AHEAD, "")
    ways = [tread.X_WR.rotation().col(0)[:2] for tread in treads]
    np.testing.assert_allclose(ways[0], [1, 0], atol=1e-9)
    np.testing.assert_allclose(ways[2], [0, 1], atol=1e-9)
    np.testing.assert_allclose(treads[2].size, [0.3, 0.8])


def test_a_lone_tread_faces_as_it_is_told_and_a_narrow_one_is_none() -> None:
    """And what is not higher than the floor is floor."""
    facets = [
        Facet(0.0, shapely.box(0, 0, 1, 1)),
        Facet(0.3, shapely.box(0, 0, 0.5, 1)),
        Facet(0.9, shapely.box(0, 0, 1, 0.05)),
    ]
    (tread,) = level_treads(facets, 0.15, np.array([0.1, 1.0]), "a/")
    np.testing.assert_allclose(tread.X_WR.rotation().col(0), [0, 1, 0], atol=1e-9)
    np.testing.assert_allclose(tread.size, [1.0, 0.5])


def test_an_area_that_is_no_rectangle_keeps_its_outline() -> None:
    """An L-shaped landing."""
    corner = shapely.Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    (tread,) = level_treads([Facet(0.5, corner)], 0.15, AHEAD, "")
    assert tread.outline is not None
    assert shapely.Polygon(tread.outline).equals(corner)
    assert open_facets([Facet(0.5, corner)], [Prism(np.zeros((3, 2)), 1.0, 2.0)])
