"""The rows that bound a section: closed forms, the proven cone, and where none are."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.systems.balance.contact_wrench_cone import Contact, point_contact
from footfall.systems.balance.gravito_inertial_cone import (
    centred_generators,
    cone_of_generators,
)
from footfall.systems.balance.section_walk import section_rows
from footfall.systems.balance.stability_polygon import static_polygon
from footfall.systems.balance.wrench_slice import static_slice, zmp_slice


def foot(x: float, y: float, z: float, *rpy: float, mu: float = 0.7) -> Contact:
    """A sole of 24 x 14 cm."""
    angles = RollPitchYaw(*rpy) if rpy else RollPitchYaw(0.0, 0.0, 0.0)
    return Contact(RigidTransform(angles, [x, y, z]), 0.12, 0.07, mu)


TILTED = [foot(0.0, 0.1, 0.0, 0.1, -0.2, 0.3), foot(0.25, -0.1, 0.2, -0.2, 0.3, 0.0)]


def half_planes(rows: np.ndarray) -> np.ndarray:
    """Outward unit normals and offsets of the rows at rest, (k, 3)."""
    part = static_slice()
    lines = np.column_stack([rows @ part.W, -rows @ part.w_0])
    return lines / np.linalg.norm(lines[:, :2], axis=1)[:, None]


def test_a_level_sole_is_bounded_by_its_four_edges() -> None:
    """In order, counter-clockwise, whatever edge faces the first direction."""
    for yaw in (0.0, 0.4):
        G, _ = centred_generators([foot(0.3, -0.2, 0.1, 0.0, 0.0, yaw)])
        rows = section_rows(G, static_slice())
        assert rows is not None
        lines = half_planes(rows)
        angles = np.unwrap(np.arctan2(lines[:, 1], lines[:, 0]))
        assert (np.diff(angles) > 0.0).all()
        quarter = np.round((angles - yaw) / (0.5 * np.pi))
        np.testing.assert_allclose(angles - yaw, quarter * 0.5 * np.pi, atol=1e-9)
        assert set(quarter % 4) == {0.0, 1.0, 2.0, 3.0}
        extents = np.where(quarter % 2 == 0, 0.12, 0.07)
        np.testing.assert_allclose(lines[:, 2], extents, atol=1e-9)


def test_an_edge_that_faces_the_first_direction_is_not_missed() -> None:
    """There the walk begins and ends in a tie, decided by rounding."""
    for tilt in np.linspace(-0.6, 0.6, 25):
        for rpy in ((0.0, tilt, 0.0), (tilt, 0.0, 0.0)):
            G, _ = centred_generators([foot(0.0, 0.0, 0.0, *rpy)])
            rows = section_rows(G, static_slice())
            assert rows is not None
            facing = half_planes(rows)[:, :2] - [1.0, 0.0]
            assert np.abs(facing).sum(axis=1).min() < 1e-9


def test_ties_do_not_stop_it() -> None:
    """Level soles side by side, above one another, the same twice: no other method."""
    ties = [
        [foot(0.0, 0.1, 0.0), foot(0.1 * i, -0.1, 0.05 * j)]
        for i in range(5)
        for j in range(5)
    ]
    ties += [[foot(0.0, 0.1, 0.0), foot(0.0, 0.1, z)] for z in (0.0, 0.2, 0.4, 0.8)]
    ties += [
        [foot(0.1 * i, 0.1 * (-1) ** i, 0.1 * i) for i in range(n)] for n in (3, 6)
    ]
    for contacts in ties:
        polygon = static_polygon(contacts)
        assert polygon.method == "section"
        assert not polygon.caught


@pytest.mark.parametrize("part", [static_slice(), zmp_slice(np.array([0, 0, 0.8]), 0)])
def test_its_rows_are_rows_of_the_cone(part: object) -> None:
    """Every generator obeys them, five or more lie on each: facets or their ties."""
    G, p_WQ = centred_generators(TILTED)
    rows = section_rows(G, part)
    assert rows is not None
    np.testing.assert_allclose(np.linalg.norm(rows, axis=1), 1.0)
    values = rows @ G
    assert values.max() < 1e-12
    assert ((values > -1e-9).sum(axis=1) >= 5).all()
    cone = cone_of_generators(G, p_WQ)
    nearest = np.abs(rows[:, None] - cone.rows[None]).max(axis=2).min(axis=1)
    assert nearest.max() < 1e-7
    assert len(rows) < 0.2 * len(cone.rows)


@pytest.mark.parametrize(
    "contacts",
    [
        [foot(0.0, 0.0, 0.0, 0.0, 0.7, 0.0)],
        [foot(0.0, 0.0, 0.0, np.pi, 0.0, 0.0)],
        [foot(0.0, 0.0, 0.0), foot(0.0, 0.0, 1.5, np.pi, 0.0, 0.0)],
        [foot(0.0, 0.0, 0.0, mu=0.0)],
        [point_contact(RigidTransform([0.3, 0.1, 0.2]), 0.5)],
    ],
    ids=["too steep", "upside down", "braced", "ice", "point"],
)
def test_there_is_no_boundary_to_walk(contacts: list[Contact]) -> None:
    """No point, no end, or no forces to choose between."""
    G, _ = centred_generators(contacts)
    assert section_rows(G, static_slice()) is None
