"""A hand joins the stance: where the CoM may be with it and without it."""

import numpy as np
import pytest
from pydrake.math import RigidTransform
from scipy.optimize import linprog

from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import (
    Contact,
    sole_contact,
    stance_generators,
)
from footfall.systems.balance.convex_polygon import area, signed_margin
from footfall.systems.balance.handrail import hand_contact
from footfall.systems.balance.stability_polygon import static_polygon


def on_a_step() -> list[Contact]:
    """Both soles of JVRC-1, the right one on a tread of 24 cm."""
    return [
        sole_contact(RigidTransform(p), 0.075, 0.15, 0.042, 0.6)
        for p in ([0.0, 0.095, 0.0], [0.33, -0.095, 0.24])
    ]


def stands(contacts: list[Contact], com: Vector) -> bool:
    """Whether forces exist that hold unit weight at the CoM, by linear programme."""
    G = stance_generators(contacts, np.zeros(3))
    p = np.array([*com, 0.9])
    weight = np.array([0.0, 0.0, 1.0])
    wrench = np.concatenate([weight, np.cross(p, weight)])
    return linprog(np.zeros(G.shape[1]), A_eq=G, b_eq=wrench).status == 0


@pytest.mark.parametrize(
    ("place", "normal"),
    [
        ([0.35, -0.45, 1.0], [0.0, 0.0, 1.0]),
        ([0.35, -0.45, 1.0], [-0.58, 0.0, 0.81]),
        ([0.35, -0.45, 1.1], [0.0, 1.0, 0.0]),
    ],
)
@pytest.mark.parametrize("palm", [0.0, 0.04])
def test_a_hand_widens_the_polygon(
    place: list[float], normal: list[float], palm: float
) -> None:
    """On a level rail, on one that rises with the stairs, against a wall."""
    feet = on_a_step()
    hand = hand_contact(np.array(place), np.array(normal), 0.5, palm, palm)
    without, held = static_polygon(feet), static_polygon([*feet, hand])
    assert held.status == "ok"
    assert area(held.vertices) > 1.05 * area(without.vertices)
    for vertex in without.vertices:
        assert signed_margin(held.vertices, vertex) > -1e-9
    middle = held.vertices.mean(axis=0)
    for vertex in held.vertices:
        assert stands([*feet, hand], middle + 0.999 * (vertex - middle))
        assert not stands([*feet, hand], middle + 1.001 * (vertex - middle))


def test_a_rail_carries_from_above() -> None:
    """A point on a level rail is one more corner of the hull when friction is none."""
    feet = [
        Contact(c.X_WC, c.half_length, c.half_width, 0.0)
        for c in (on_a_step()[0], on_a_step()[0])
    ]
    hand = hand_contact(np.array([0.1, -0.5, 0.9]), np.array([0.0, 0.0, 2.0]), 0.0)
    held = static_polygon([feet[0], hand]).vertices
    assert np.linalg.norm(held - [0.1, -0.5], axis=1).min() < 1e-9


def test_frame_of_the_hand() -> None:
    """Z along the normal, y level."""
    normal = np.array([-0.3, 0.5, 0.8])
    X_WC = hand_contact(np.array([1.0, 2.0, 3.0]), normal, 0.5).X_WC
    R = X_WC.rotation().matrix()
    np.testing.assert_allclose(R[:, 2], normal / np.linalg.norm(normal))
    assert R[2, 1] == pytest.approx(0.0)
    np.testing.assert_array_equal(X_WC.translation(), [1.0, 2.0, 3.0])


def test_a_normal_without_length_is_refused() -> None:
    """It says nothing about the surface."""
    with pytest.raises(ValueError, match="normal: must have a length"):
        hand_contact(np.zeros(3), np.zeros(3), 0.5)
