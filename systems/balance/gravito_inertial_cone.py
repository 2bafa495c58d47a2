"""The gravito-inertial wrench cone of a stance, by double description.

All contacts together can exert exactly the wrenches G l, l >= 0 (the stair paper's
Eqs. 4 and 5). Double description (pycddlib) turns that into inequalities. In floats
it is silently wrong on tilted contacts unless the numbers are near one: torque about
the middle of the contacts, generators of unit length, forces in weights. Even so its
rows are taken only where the generators prove them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cdd
import numpy as np
from pydrake.math import VectorToSkewSymmetric

from footfall.models.values.vector import Vector
from footfall.systems.balance.contact_wrench_cone import Contact, stance_generators

_RANK = 1e-9
"""Directions in which the unit generators reach less than this do not count."""
_VALID = 1e-10
"""Largest violation by a unit generator of a unit row that it is meant to obey."""


@dataclass(frozen=True, eq=False)
class GravitoInertialCone:
    """Cone of the wrenches that a stance can exert, about Q, in W."""

    generators: Vector
    """G, (6, m), unit columns: w = G l, l >= 0."""
    rows: Vector
    """H, (k, 6), unit rows: H w <= 0. Proven: every generator obeys every row. Whether
    some are missing is for the question to check that is put to them."""
    normals: Vector
    """Equalities of a cone without interior: (j, 6), orthonormal, normals w = 0."""
    p_WQ: Vector
    """The middle of the contacts, (3,), m."""
    unproven: int
    """Number of rows of double description that a generator disproves."""

    def about(self, p_WP: Vector) -> Vector:
        """Computes the rows for the wrench about another point, (k, 6): H_stab.

        With P the world's origin they are H_stab, and hold for the force per mass
        p_Gdd - g with the torque per mass p_G x (p_Gdd - g) + L_Gd / m.
        """
        lever = VectorToSkewSymmetric(p_WP - self.p_WQ)
        T = np.eye(6)
        T[3:, :3] = lever
        return np.asarray(self.rows @ T)


def centred_generators(contacts: Sequence[Contact]) -> tuple[Vector, Vector]:
    """Computes the stance's generators about the middle of its contacts.

    Args:
        contacts: the stance, at least one.

    Returns:
        G, (6, m), unit columns, and p_WQ, (3,), m.
    """
    p_WQ = np.mean([contact.X_WC.translation() for contact in contacts], axis=0)
    G = stance_generators(contacts, p_WQ)
    return G / np.sqrt((G * G).sum(axis=0)), p_WQ


def gravito_inertial_cone(contacts: Sequence[Contact]) -> GravitoInertialCone:
    """Computes the cone of a stance.

    Args:
        contacts: the stance, at least one.

    Returns:
        The cone; without rows where double description gave up.

    Raises:
        ValueError: there is no contact.
    """
    if len(contacts) == 0:
        raise ValueError("contacts: must hold at least one, got none")
    G, p_WQ = centred_generators(contacts)
    return cone_of_generators(G, p_WQ)


def cone_of_generators(G: Vector, p_WQ: Vector) -> GravitoInertialCone:
    """Computes the cone of unit generators G, (6, m), about p_WQ, (3,)."""
    basis, normals = span(G)
    flat = len(normals) > 0
    reduced = basis.T @ G if flat else G
    # Steeply pushing generators first, in the order given: two thirds of the time of
    # cdd's own order, and no less exact. Where cdd meets an inconsistency in one order
    # (one stance of yawed feet in twenty) it mostly does not in another.
    array = np.zeros((reduced.shape[1], reduced.shape[0] + 1))
    array[:, 1:] = reduced.T
    rows = _double_description(array[np.argsort(G[2], kind="stable")])
    if len(rows) == 0:
        rows = _double_description(array[::-1])
    if flat:
        rows = rows @ basis.T
    proven = proven_rows(rows, G)
    return GravitoInertialCone(G, proven, normals, p_WQ, len(rows) - len(proven))


def span(G: Vector) -> tuple[Vector, Vector]:
    """Computes bases of the span of unit generators G, (6, m), and of its complement.

    Returns:
        Orthonormal directions, (6, r) as columns and (6 - r, 6) as rows.
    """
    U, singular, _ = np.linalg.svd(G)
    rank = int((singular > _RANK).sum())
    return U[:, :rank], U[:, rank:].T


def proven_rows(rows: Vector, G: Vector) -> Vector:
    """Selects those of the unit rows, (k, 6), that all generators, (6, m), obey."""
    return np.asarray(rows[(rows @ G).max(axis=1, initial=-np.inf) <= _VALID])


def _double_description(rays: Vector) -> Vector:
    """Computes unit rows a, (k, d), with a r <= 0 for the rays, (m, 1 + d), 0 first."""
    try:
        matrix = cdd.matrix_from_array(rays.tolist(), rep_type=cdd.RepType.GENERATOR)
        polyhedron = cdd.polyhedron_from_matrix(
            matrix, row_order=cdd.RowOrderType.MIN_INDEX
        )
        inequalities = cdd.copy_inequalities(polyhedron)
    except RuntimeError:
        # A numerical inconsistency; an answer without rows cannot pass its check.
        return np.zeros((0, rays.shape[1] - 1))
    rows = -np.array(inequalities.array).reshape(-1, rays.shape[1])[:, 1:]
    equalities = sorted(inequalities.lin_set)
    rows = np.vstack([rows, -rows[equalities]])
    length = np.sqrt((rows * rows).sum(axis=1))
    return np.asarray(rows[length > 0.0] / length[length > 0.0, None])
