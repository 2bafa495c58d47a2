"""Stances that several tests of balance stand on."""

from collections.abc import Callable

import numpy as np
import pytest
from pydrake.common.eigen_geometry import AngleAxis
from pydrake.math import RigidTransform, RotationMatrix

from footfall.systems.balance.contact_wrench_cone import Contact


def _random_stance(rng: np.random.Generator) -> list[Contact]:
    """One to four feet, fists and points, tilted up to 40 deg any way."""
    stance = []
    for index in range(rng.integers(1, 5)):
        tilt, yaw = np.radians(rng.uniform(0.0, 40.0)), rng.uniform(-np.pi, np.pi)
        azimuth = rng.uniform(-np.pi, np.pi)
        axis = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        R = RotationMatrix(AngleAxis(tilt, axis)).multiply(
            RotationMatrix.MakeZRotation(yaw)
        )
        X = RigidTransform(R, rng.uniform([-0.5, -0.5, 0.0], [0.5, 0.5, 1.0]))
        shapes = ((0.12, 0.07), (0.1, 0.05), (0.05, 0.05), (0.0, 0.0))
        shape = shapes[rng.integers(4) if index else 0]
        stance.append(Contact(X, *shape, rng.uniform(0.2, 1.0)))
    return stance


@pytest.fixture(scope="session")
def random_stance() -> Callable[[np.random.Generator], list[Contact]]:
    """Draws a stance."""
    return _random_stance
