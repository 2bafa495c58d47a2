"""The depth camera: true depths, the noise it adds, its frames, bodies that move."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.analysis import Simulator

from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solids import Box, triangle_mesh, upright_pose
from footfall.models.values.room import DepthImage
from footfall.systems.sensing.depth_camera import (
    DepthCamera,
    DepthCameraParams,
    depth_noise,
    measure_depth,
)
from footfall.systems.sensing.ray_caster import BodyMesh

QUIET = DepthCameraParams(
    columns=64, rows=48, noise_near=0.0, noise_far=0.0, target=[0.0, -0.8, 0.0]
)
"""Straight down from under the ceiling, without noise."""


def _crate() -> BodyMesh:
    size = np.array([0.4, 0.4, 0.4])
    mesh = triangle_mesh([Box("crate", RigidTransform(), size, 0.5, (1, 1, 1, 1))])
    return BodyMesh(1, mesh.vertices, mesh.triangles)


def _images(
    params: DepthCameraParams, poses: list[list[RigidTransform]], *, crate: bool = False
) -> list[DepthImage]:
    """A frame for every list of body poses."""
    camera = DepthCamera(
        params,
        scene=triangle_mesh(RoomParams(width=12.0).solids()),
        body_meshes=[_crate()] if crate else [],
    )
    simulator = Simulator(camera)
    context = simulator.get_mutable_context()
    port = camera.GetInputPort("body_poses")
    images = []
    for k, frame in enumerate(poses):
        port.FixValue(context, AbstractValue.Make(frame))
        simulator.AdvanceTo((k + 0.5) * params.period)
        images.append(camera.GetOutputPort("depth_image").Eval(context))
    return images


def test_noise_is_millimetres_near_and_centimetres_far() -> None:
    """The deviation is the paper's at both ends and quadratic between them."""
    params = DepthCameraParams()
    ends = depth_noise(np.array([0.5, 5.0]), params)
    np.testing.assert_allclose(ends, [0.002, 0.04])
    z = np.linspace(0.5, 5.0, 50)
    fit = np.polyfit(z**2, depth_noise(z, params), 1)
    np.testing.assert_allclose(np.polyval(fit, z**2), depth_noise(z, params))


@pytest.mark.parametrize("depth", [0.6, 2.0, 4.0])
def test_measured_depths_have_that_deviation(depth: float) -> None:
    """Over 300,000 pixels mean and deviation are those of the formula."""
    params = DepthCameraParams()
    errors = measure_depth(np.full(300_000, depth), 0, params) - depth
    sigma = float(depth_noise(np.array([depth]), params)[0])
    assert abs(np.mean(errors)) < 5.0 * sigma / np.sqrt(len(errors))
    assert np.std(errors) == pytest.approx(sigma, rel=0.01)


def test_noise_depends_on_seed_and_frame_alone() -> None:
    """The same frame of the same seed is the same bit for bit; others are not."""
    depth = np.linspace(1.0, 4.0, 1000)
    params = DepthCameraParams(seed=3)
    first = measure_depth(depth, 5, params)
    assert np.array_equal(first, measure_depth(depth, 5, params))
    assert not np.any(first == measure_depth(depth, 6, params))
    assert not np.any(first == measure_depth(depth, 5, replace(params, seed=4)))


def test_limits_of_range() -> None:
    """Too near is nan, too far and nothing are inf."""
    measured = measure_depth(np.array([0.3, 0.5, 5.0, 5.1, 99.0, np.inf]), 0, QUIET)
    np.testing.assert_array_equal(measured, [np.nan, 0.5, 5.0, np.inf, np.inf, np.inf])


def test_floor_from_above_is_at_the_camera_height() -> None:
    """Depth is along the optical axis: the floor is 2.9 m deep in every pixel."""
    (image,) = _images(QUIET, [[RigidTransform()]])
    assert image.depth.shape == (48, 64)
    assert image.time == 0.0
    np.testing.assert_allclose(image.depth, 2.9, atol=1e-6)


def test_a_body_is_seen_where_it_was_at_each_frame() -> None:
    """A crate of 0.4 m that moves hides the floor under it, and only there."""
    places = [(0.0, -0.8), (0.8, -0.8), (-9.0, 0.0)]
    poses = [[RigidTransform(), upright_pose(x, y, 0.2)] for x, y in places]
    images = _images(QUIET, poses, crate=True)
    for image, (x, y) in zip(images[:2], places[:2], strict=True):
        top = np.abs(image.depth - 2.5) < 1e-5
        rows, columns = np.nonzero(top)
        # A top of 0.4 m at 2.5 m depth is 5.12 pixels wide at a focal length of 32.
        assert 16 <= top.sum() <= 36
        p_C = np.array([columns.mean() - 31.5, rows.mean() - 23.5]) / 32.0 * 2.5
        # Straight down, the top of the picture points along x of W.
        np.testing.assert_allclose([-p_C[1], -p_C[0]], [x, y + 0.8], atol=0.06)
    np.testing.assert_allclose(images[2].depth, 2.9, atol=1e-6)


def test_body_poses_of_the_frame_are_kept() -> None:
    """What the port gives between frames is where the bodies were at the frame."""
    camera = DepthCamera(QUIET, scene=triangle_mesh(RoomParams(width=12.0).solids()))
    simulator = Simulator(camera)
    context = simulator.get_mutable_context()
    port = camera.GetInputPort("body_poses")
    before = camera.GetOutputPort("depth_image").Eval(context)
    assert (before.time, before.depth.size) == (-np.inf, 0)
    port.FixValue(context, AbstractValue.Make([upright_pose(x=1.0)]))
    simulator.AdvanceTo(0.01)
    port.FixValue(context, AbstractValue.Make([upright_pose(x=2.0)]))
    simulator.AdvanceTo(0.02)
    (pose,) = camera.GetOutputPort("frame_body_poses").Eval(context)
    assert pose.translation()[0] == 1.0
    assert camera.GetOutputPort("frame").Eval(context)[0] == 1.0
    simulator.AdvanceTo(0.05)
    (pose,) = camera.GetOutputPort("frame_body_poses").Eval(context)
    assert pose.translation()[0] == 2.0
    assert camera.GetOutputPort("frame").Eval(context)[0] == 2.0


def test_believed_poses_of_the_frame_are_kept_beside_the_true_ones() -> None:
    """The rays meet the true bodies; what is told is what the robot believes."""
    camera = DepthCamera(QUIET, scene=triangle_mesh(RoomParams(width=12.0).solids()))
    simulator = Simulator(camera)
    context = simulator.get_mutable_context()
    for name, x in (("body_poses", 1.0), ("believed_poses", 1.1)):
        poses = AbstractValue.Make([upright_pose(x=x)])
        camera.GetInputPort(name).FixValue(context, poses)
    simulator.AdvanceTo(0.01)
    (pose,) = camera.GetOutputPort("frame_body_poses").Eval(context)
    assert pose.translation()[0] == 1.1


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("columns", 0),
        ("field_of_view_deg", 175.0),
        ("max_range", 0.4),
        ("noise_far", 0.001),
        ("position", [0.0, 1.0]),
        ("target", [0.0, -0.8, 2.9]),
        ("period", -1.0),
    ],
)
def test_wrong_parameters_are_named(field: str, value: object) -> None:
    """The message begins with the field."""
    with pytest.raises(ValueError, match=f"^{field}"):
        replace(DepthCameraParams(), **{field: value}).validate()
