"""The measured ZMP against what defines it."""

import numpy as np
import pytest
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.values.vector import Vector
from footfall.systems.sensing.measured_zmp import measured_zmp, zmp_now


def matrices(poses: list[RigidTransform]) -> Vector:
    """As arrays, (feet, 4, 4)."""
    return np.array([X.GetAsMatrix4() for X in poses])


def test_zmp_on_feet_of_different_heights_lies_between_them() -> None:
    """At the heights' mean, weighted by load, where only yaw moment is left."""
    X_WF = [
        RigidTransform(RollPitchYaw(0.1, -0.2, 0.3), [0.2, 0.1, 0.4]),
        RigidTransform(RollPitchYaw(0.0, 0.3, -0.1), [-0.1, -0.1, 0.2]),
    ]
    wrenches = np.array(
        [[5.0, -8.0, 300.0, 3.0, 6.0, 1.0], [-3.0, 2.0, 100.0, -1.0, 2.0, 0.5]]
    )
    zmp = measured_zmp(matrices(X_WF), wrenches)
    force, moment, loads = np.zeros(3), np.zeros(3), []
    for wrench, X in zip(wrenches, X_WF, strict=True):
        f_W = X.rotation().multiply(wrench[:3])
        loads.append(f_W[2])
        force += f_W
        arm = X.translation() - zmp
        moment += X.rotation().multiply(wrench[3:]) + np.cross(arm, f_W)
    np.testing.assert_allclose(moment[:2], 0.0, atol=1e-9)
    assert zmp[2] == pytest.approx(np.average([0.4, 0.2], weights=loads))


def test_nothing_felt_is_no_zmp() -> None:
    """Neither in flight nor where the feet only graze."""
    X_WF = matrices([RigidTransform(), RigidTransform()])
    assert np.isnan(measured_zmp(X_WF, np.zeros((2, 6)))).all()
    graze = np.zeros((2, 6))
    graze[:, 2] = 0.4
    assert np.isnan(measured_zmp(X_WF, graze)).all()


def test_it_is_weighted_by_load() -> None:
    """Three quarters of the load on the left foot put it there by as much."""
    X_WF = matrices([RigidTransform([0.0, y, 0.0]) for y in (0.1, -0.1)])
    wrenches = np.array([[0, 0, share, 0, 0, 0] for share in (450.0, 150.0)])
    np.testing.assert_allclose(measured_zmp(X_WF, wrenches), [0.0, 0.05, 0.0])
    assert np.isnan(measured_zmp(X_WF, wrenches, min_force=601.0)).all()


def random_pose(rng: np.random.Generator) -> RigidTransform:
    """Somewhere, tilted a little."""
    return RigidTransform(RollPitchYaw(*rng.normal(0.0, 0.1, 3)), rng.normal(size=3))


def test_many_samples_are_measured_at_once() -> None:
    """Each as if it were alone."""
    rng = np.random.default_rng(0)
    X_WF = np.stack([matrices([random_pose(rng), random_pose(rng)]) for _ in range(5)])
    wrenches = rng.normal(0.0, 10.0, (5, 2, 6))
    wrenches[..., 2] += 300.0
    together = measured_zmp(X_WF, wrenches)
    alone = [measured_zmp(X, w) for X, w in zip(X_WF, wrenches, strict=True)]
    np.testing.assert_allclose(together, alone, atol=1e-12)


def test_one_moment_in_plain_numbers_is_the_same() -> None:
    """Of two feet anywhere, of one in the air, and of nothing felt."""
    rng = np.random.default_rng(3)
    for _ in range(20):
        frames = [
            (RollPitchYaw(rng.uniform(-1, 1, 3)).ToRotationMatrix().matrix(), p)
            for p in rng.uniform(-1.0, 1.0, (2, 3))
        ]
        wrenches = rng.uniform(-1.0, 1.0, (2, 6)) * 300.0
        wrenches[:, 2] = rng.uniform(0.0, 500.0, 2) * rng.integers(0, 2, 2)
        poses = np.tile(np.eye(4), (2, 1, 1))
        for pose, (R_WF, p_WF) in zip(poses, frames, strict=True):
            pose[:3, :3], pose[:3, 3] = R_WF, p_WF
        want = measured_zmp(poses, wrenches)
        np.testing.assert_allclose(zmp_now(frames, wrenches), want, rtol=1e-9)
