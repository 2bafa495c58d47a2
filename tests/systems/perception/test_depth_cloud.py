"""From depth images to clouds: back-projection, voxels, bounds, the robot's points."""

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.scenes.solids import upright_pose
from footfall.models.values.room import DepthImage
from footfall.systems.perception.depth_cloud import (
    DepthCloud,
    DepthCloudParams,
    crop,
    depth_to_points,
    downsample,
    remove_robot,
)
from footfall.systems.perception.scan_assembler import SelfFilterBox, remove_own_points

X_WC = RigidTransform(RollPitchYaw(2.7, 0.1, -0.4), np.array([0.3, -0.2, 2.8]))


def _image(depth: np.ndarray) -> DepthImage:
    return DepthImage(0.0, X_WC, 30.0, depth)


def test_points_project_back_to_their_pixels() -> None:
    """Each point has its pixel's depth and place, and blind pixels give none."""
    depth = np.random.default_rng(0).uniform(0.5, 4.0, (24, 32))
    depth[3, 5], depth[7, 9] = np.nan, np.inf
    points = depth_to_points(_image(depth))
    p_C = np.array(X_WC.inverse().multiply(points.T)).T
    rows, columns = np.nonzero(np.isfinite(depth))
    np.testing.assert_allclose(p_C[:, 2], depth[rows, columns])
    np.testing.assert_allclose(p_C[:, 0] / p_C[:, 2] * 30.0, columns - 15.5, atol=1e-9)
    np.testing.assert_allclose(p_C[:, 1] / p_C[:, 2] * 30.0, rows - 11.5, atol=1e-9)


def test_voxels_hold_the_centroid_of_their_points() -> None:
    """One point a voxel, the mean of those in it."""
    rng = np.random.default_rng(1)
    points = rng.uniform(-1.0, 1.0, (4000, 3))
    cells = np.floor(points / 0.25).astype(int)
    found = downsample(points, 0.25)
    wanted = np.array(
        [
            points[(cells == cell).all(axis=1)].mean(axis=0)
            for cell in {*map(tuple, cells)}
        ]
    )
    np.testing.assert_allclose(
        found[np.lexsort(found.T)], wanted[np.lexsort(wanted.T)], atol=1e-9
    )
    assert np.array_equal(found, downsample(points, 0.25))


def test_cropping_keeps_what_is_within() -> None:
    """Both corners count."""
    points = np.array([[0.0, 0, 0], [1, 1, 1], [0.5, 0.5, 2], [-1, 0.5, 0.5]])
    np.testing.assert_array_equal(crop(points, [0, 0, 0], [1, 1, 1]), points[:2])


@pytest.mark.parametrize("seed", range(10))
def test_fast_self_filter_agrees_with_the_plain_one(seed: int) -> None:
    """Looking only near the robot changes nothing but the order."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-3.0, 3.0, (5000, 3))
    boxes = [
        SelfFilterBox(
            i, RigidTransform(rng.uniform(-0.2, 0.2, 3)), rng.uniform(0, 1, 3)
        )
        for i in range(5)
    ]
    poses = [
        RigidTransform(RollPitchYaw(rng.uniform(-3, 3, 3)), rng.uniform(-1, 1, 3))
        for _ in range(5)
    ]
    fast = remove_robot(points, boxes, poses, 0.1)
    plain = remove_own_points(points, boxes, poses, 0.1)
    assert 0 < len(plain) < len(points)
    np.testing.assert_array_equal(fast[np.lexsort(fast.T)], plain[np.lexsort(plain.T)])


def test_system_takes_out_the_robot_and_what_is_out_of_bounds() -> None:
    """The cloud's points are in W, in the bounds and not in the robot's box."""
    depth = np.random.default_rng(0).uniform(1.0, 2.6, (24, 32))
    params = DepthCloudParams(lower=[-9.0, -9.0, 0.4], upper=[9.0, 9.0, 9.0])
    box = SelfFilterBox(0, RigidTransform(), np.array([0.5, 0.5, 4.0]))
    system = DepthCloud(params, [box])
    context = system.CreateDefaultContext()
    system.GetInputPort("depth_image").FixValue(
        context, AbstractValue.Make(_image(depth))
    )
    system.GetInputPort("body_poses").FixValue(
        context, AbstractValue.Make([upright_pose(x=0.2, y=-0.1)])
    )
    cloud = system.GetOutputPort("cloud").Eval(context)
    points = cloud.xyzs().T
    whole = downsample(depth_to_points(_image(depth)), params.leaf)
    own = np.all(np.abs(whole[:, :2] - [0.2, -0.1]) <= 0.25 + params.margin, axis=1)
    own &= np.abs(whole[:, 2]) <= 2.0 + params.margin
    wanted = whole[~own & (whole[:, 2] >= 0.4)]
    assert 0 < own.sum() < len(whole)
    np.testing.assert_allclose(
        points[np.lexsort(points.T)],
        wanted.astype(np.float32)[np.lexsort(wanted.astype(np.float32).T)],
        atol=1e-6,
    )
    viewpoint = system.GetOutputPort("viewpoint").Eval(context)
    np.testing.assert_array_equal(viewpoint, X_WC.translation())


def test_an_empty_image_is_an_empty_cloud() -> None:
    """Before the first frame there is nothing, and no body is asked for."""
    system = DepthCloud(
        DepthCloudParams(), [SelfFilterBox(0, RigidTransform(), np.ones(3))]
    )
    context = system.CreateDefaultContext()
    system.GetInputPort("depth_image").FixValue(
        context, AbstractValue.Make(_image(np.zeros((0, 0))))
    )
    assert system.GetOutputPort("cloud").Eval(context).size() == 0


@pytest.mark.parametrize(
    ("field", "value"), [("leaf", 0.0), ("margin", -0.1), ("lower", [0.0])]
)
def test_wrong_parameters_are_named(field: str, value: object) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        DepthCloud(DepthCloudParams(**{field: value}))
