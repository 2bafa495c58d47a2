"""The contact wrench cone: its two forms against each other and against the pyramid."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw
from scipy.optimize import linprog, nnls

from footfall.systems.balance.contact_wrench_cone import (
    Contact,
    contact_wrench_cone,
    contact_wrench_cone_world,
    contact_wrench_generators,
    contact_wrench_generators_world,
    point_contact,
    sole_contact,
    stance_generators,
    wrench_transform,
)

SHAPES = [(0.12, 0.07, 0.7), (0.1, 0.02, 0.2), (0.07, 0.07, 1.3)]
X_WC = RigidTransform(RollPitchYaw(0.3, -0.5, 1.1), [0.4, -0.7, 0.25])


def _in_span(generators: np.ndarray, wrench: np.ndarray) -> bool:
    scale = np.linalg.norm(wrench)
    return nnls(generators, wrench / scale)[1] < 1e-9


@pytest.mark.parametrize(("X", "Y", "mu"), SHAPES)
def test_generators_satisfy_the_inequalities_and_every_row_is_tight(
    X: float, Y: float, mu: float
) -> None:
    """No generator leaves the cone; each row is a facet of it."""
    A, G = contact_wrench_cone(X, Y, mu), contact_wrench_generators(X, Y, mu)
    assert A.shape == (16, 6)
    assert G.shape == (6, 16)
    products = A @ G
    assert products.max() < 1e-12
    for row in products:
        tight = G[:, np.abs(row) < 1e-12]
        assert np.linalg.matrix_rank(tight) == 5  # each row is a facet


@pytest.mark.parametrize(("X", "Y", "mu"), SHAPES)
def test_both_forms_accept_the_same_wrenches(X: float, Y: float, mu: float) -> None:
    """A wrench in the span obeys the rows and no other does."""
    rng = np.random.default_rng(0)
    A, G = contact_wrench_cone(X, Y, mu), contact_wrench_generators(X, Y, mu)
    inside = 0
    for _ in range(1000):
        wrench = G @ rng.exponential(size=16) ** 3 / 40.0
        wrench += rng.normal(size=6) * [mu, mu, 1.0, Y, X, mu * (X + Y)]
        violation = (A @ wrench).max()
        if abs(violation) < 1e-7:
            continue
        inside += violation < 0
        assert _in_span(G, wrench) == (violation < 0.0)
    assert 200 < inside < 900


@pytest.mark.parametrize(("X", "Y", "mu"), SHAPES)
def test_largest_yaw_torque_is_the_linear_programme_s(
    X: float, Y: float, mu: float
) -> None:
    """The yaw bound is the part of the closed form that is not plain to see."""
    A, G = contact_wrench_cone(X, Y, mu), contact_wrench_generators(X, Y, mu)
    rng = np.random.default_rng(1)
    for _ in range(20):
        wrench = G @ rng.exponential(size=16)
        by_inequalities = linprog(
            [0, 0, 0, 0, 0, -1.0],
            A_ub=A,
            b_ub=np.zeros(16),
            A_eq=np.eye(5, 6),
            b_eq=wrench[:5],
            bounds=(None, None),
        )
        by_generators = linprog(-G[5], A_eq=G[:5], b_eq=wrench[:5])
        assert by_inequalities.fun == pytest.approx(by_generators.fun, abs=1e-9)


def test_corner_forces_in_the_world_obey_the_world_s_cone() -> None:
    """What forces at the corners add up to lies in the cone, about any point."""
    contact = Contact(X_WC, 0.12, 0.07, 0.7)
    rng = np.random.default_rng(2)
    p_WQ = np.array([0.3, 2.0, -1.0])
    A = contact_wrench_cone_world(contact, p_WQ)
    R = X_WC.rotation().matrix()
    for _ in range(100):
        wrench = np.zeros(6)
        for corner in contact.corners():
            f_z = rng.exponential()
            f_C = [rng.uniform(-0.7, 0.7) * f_z, rng.uniform(-0.7, 0.7) * f_z, f_z]
            f_W = R @ f_C
            wrench += [*f_W, *np.cross(corner - p_WQ, f_W)]
        assert (A @ wrench).max() < 1e-12
    assert (A @ -wrench).max() > 0.1


def test_world_forms_agree() -> None:
    """Also as one carries the other over."""
    contact = Contact(X_WC, 0.12, 0.07, 0.7)
    A, G = contact_wrench_cone_world(contact), contact_wrench_generators_world(contact)
    products = A @ G
    assert products.max() < 1e-12
    assert ((np.abs(products) < 1e-12).sum(axis=1) >= 5).all()
    np.testing.assert_allclose(
        G, wrench_transform(X_WC) @ contact_wrench_generators(0.12, 0.07, 0.7)
    )


def test_a_point_contact_exerts_no_torque_at_its_point() -> None:
    """Its rows forbid every torque about it, in the world too."""
    contact = point_contact(X_WC, 0.5)
    assert contact_wrench_generators_world(contact).shape == (6, 4)
    G = contact_wrench_generators_world(contact, X_WC.translation())
    np.testing.assert_allclose(G[3:], 0.0, atol=1e-15)
    A = contact_wrench_cone_world(contact, X_WC.translation())
    push = X_WC.rotation().matrix() @ [0.4, 0.4, 1.0]
    assert (A @ [*push, 0, 0, 0]).max() < 0.0 + 1e-15
    for torque in np.vstack([np.eye(3), -np.eye(3)]):
        assert (A @ [*push, *torque]).max() > 0.1


def test_without_friction_only_normal_pushes_remain() -> None:
    """Ice: no tangential force, no yaw torque."""
    G = contact_wrench_generators(0.12, 0.07, 0.0)
    np.testing.assert_array_equal(G[[0, 1, 5]], 0.0)
    A = contact_wrench_cone(0.12, 0.07, 0.0)
    assert (A @ [0, 0, 1, 0.06, 0.1, 0]).max() <= 0.0
    assert (A @ [0.01, 0, 1, 0, 0, 0]).max() > 0.0
    assert (A @ [0, 0, 1, 0, 0, 0.01]).max() > 0.0


def test_sole_contact_is_centred_on_the_sole() -> None:
    """Heel and toe differ, the rectangle is theirs."""
    contact = sole_contact(X_WC, heel=0.1, toe=0.14, half_width=0.07, friction=0.7)
    corners = X_WC.inverse().multiply(contact.corners().T)
    assert corners[0].max() == pytest.approx(0.14)
    assert corners[0].min() == pytest.approx(-0.1)
    assert np.abs(corners[1]).max() == pytest.approx(0.07)
    np.testing.assert_allclose(corners[2], 0.0, atol=1e-12)


def test_stance_generators_stand_side_by_side() -> None:
    """Sixteen of a foot, four of a point."""
    contacts = [Contact(X_WC, 0.1, 0.05, 0.6), point_contact(X_WC, 0.4)]
    assert stance_generators(contacts).shape == (6, 20)
    assert stance_generators([]).shape == (6, 0)


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ((-0.1, 0.05, 0.5), "half_length"),
        ((0.1, float("nan"), 0.5), "half_width"),
        ((0.1, 0.05, -0.5), "friction"),
    ],
)
def test_what_is_no_contact_is_refused(
    values: tuple[float, float, float], field: str
) -> None:
    """By each function, with the field and the value."""
    with pytest.raises(ValueError, match=f"{field}: .* got"):
        contact_wrench_cone(*values)
    with pytest.raises(ValueError, match=field):
        Contact(X_WC, *values)
