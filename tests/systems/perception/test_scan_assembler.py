"""Clouds from sweeps: nothing is lost, nothing is the robot's own."""

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantValueSource, TrajectorySource
from pydrake.trajectories import PiecewisePolynomial

from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solids import Box, triangle_mesh, upright_pose
from footfall.systems.perception.planes.cut_sweep import CutCloud, cut_cloud
from footfall.systems.perception.scan_assembler import (
    ScanAssembler,
    ScanAssemblerParams,
    SelfFilterBox,
    box_around,
    remove_own_points,
)
from footfall.systems.sensing.ray_caster import BodyMesh
from footfall.systems.sensing.tilting_lidar import TiltingLidar, TiltingLidarParams

HEAD, CHEST = 1, 2
POSES = [RigidTransform(), upright_pose(z=1.5), upright_pose(x=0.3, z=1.0, yaw=0.5)]
CHEST_MESH = triangle_mesh(
    [Box("chest", RigidTransform(), np.array([0.2, 0.4, 0.3]), 0.5, (1, 1, 1, 1))]
)


def _outputs(
    params: TiltingLidarParams,
    *,
    own: bool,
    at: float,
    filtered: bool = True,
    cell: float | None = None,
) -> tuple[np.ndarray, int, CutCloud]:
    """Cloud, count of sweeps and cut cloud in an empty room; two sweeps are asked for.

    Args:
        params: the scanner.
        own: whether a chest hangs in front of the scanner.
        at: time, s.
        filtered: whether the assembler knows of the chest.
        cell: side of columns, m; None for none.
    """
    builder = DiagramBuilder()
    poses = builder.AddSystem(ConstantValueSource(AbstractValue.Make(POSES)))
    enable = builder.AddSystem(
        TrajectorySource(
            PiecewisePolynomial.ZeroOrderHold([0, 1, 2, 99], [[1.0, 0.0, 1.0, 0.0]])
        )
    )
    X_BM = upright_pose(z=0.15)
    chest = BodyMesh(CHEST, CHEST_MESH.vertices, CHEST_MESH.triangles)
    lidar = builder.AddSystem(
        TiltingLidar(
            params,
            mount_body=HEAD,
            X_BM=X_BM,
            scene=triangle_mesh(RoomParams().solids()),
            body_meshes=[chest] if own else [],
        )
    )
    assembler = builder.AddSystem(
        ScanAssembler(
            ScanAssemblerParams(),
            beam_angles=params.angles(),
            mount_body=HEAD,
            X_BM=X_BM,
            own_boxes=[box_around(CHEST, CHEST_MESH.vertices)] if filtered else [],
            cell=cell,
        )
    )
    for system in (lidar, assembler):
        builder.Connect(poses.get_output_port(), system.GetInputPort("body_poses"))
    builder.Connect(enable.get_output_port(), lidar.GetInputPort("enable"))
    for port in ("scan", "sweep"):
        builder.Connect(lidar.GetOutputPort(port), assembler.GetInputPort(port))
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(at)
    context = assembler.GetMyContextFromRoot(simulator.get_context())
    cloud = assembler.GetOutputPort("cloud").Eval(context)
    sweep = assembler.GetOutputPort("sweep").Eval(context)
    cut = assembler.GetOutputPort("cut_cloud").Eval(context)
    return cloud.xyzs().T.copy(), int(sweep[0]), cut


def _cloud(
    params: TiltingLidarParams, *, own: bool, at: float, filtered: bool = True
) -> tuple[np.ndarray, int]:
    """Cloud and count of sweeps, as of `_outputs`."""
    return _outputs(params, own=own, at=at, filtered=filtered)[:2]


COARSE = TiltingLidarParams(tilt_step_deg=4.0, noise=0.0)


def test_points_in_a_turned_box_are_removed_and_only_those() -> None:
    """The core agrees with a test of each point against each box."""
    generator = np.random.default_rng(2)
    points = generator.uniform(-1.0, 1.0, (2000, 3))
    body_poses = [
        RigidTransform(
            RollPitchYaw(generator.uniform(-3.0, 3.0, 3)),
            generator.uniform(-0.5, 0.5, 3),
        )
        for _ in range(3)
    ]
    X_BG = RigidTransform(RollPitchYaw(0.3, 0.2, 0.1), np.array([0.1, 0.0, -0.2]))
    size = np.array([0.3, 0.5, 0.7])
    boxes = [SelfFilterBox(index, X_BG, size) for index in (0, 2)]
    expected = []
    for p_W in points:
        inside = False
        for index in (0, 2):
            p_G = body_poses[index].multiply(X_BG).inverse().multiply(p_W)
            inside |= bool(np.all(np.abs(p_G) <= size / 2.0 + 0.05))
        if not inside:
            expected.append(p_W)
    kept = remove_own_points(points, boxes, body_poses, 0.05)
    assert 50 < len(points) - len(kept) < 1000
    np.testing.assert_array_equal(kept, expected)


def test_without_boxes_every_point_stays() -> None:
    """A robot of which nothing is known loses nothing."""
    points = np.ones((4, 3))
    assert remove_own_points(points, (), [], 0.1) is points
    assert len(remove_own_points(np.zeros((0, 3)), (), [], 0.1)) == 0


def test_box_around_vertices_is_tight() -> None:
    """Its faces touch the outermost vertices."""
    box = box_around(4, np.array([[0.0, -1.0, 2.0], [2.0, 1.0, 2.5], [1.0, 0.0, 2.2]]))
    assert box.body_index == 4
    np.testing.assert_allclose(box.X_BG.translation(), [1.0, 0.0, 2.25])
    np.testing.assert_allclose(box.size, [2.0, 2.0, 0.5])


def test_cloud_appears_when_the_sweep_is_finished_with_every_line_in_it() -> None:
    """16 lines of 1081 beams, all of them on a surface of the room."""
    before, count = _cloud(COARSE, own=False, at=0.375)
    assert (len(before), count) == (0, 0)
    points, count = _cloud(COARSE, own=False, at=0.38)
    assert (len(points), count) == (16 * 1081, 1)
    room = np.array([[-5.5, -3.5, 0.0], [5.5, 3.5, 3.0]])
    to_surface = np.min(np.abs(points[:, np.newaxis, :] - room), axis=(1, 2))
    assert np.max(to_surface) < 1e-4
    assert np.sum(np.abs(points[:, 2]) < 1e-4) > 1000


def test_each_sweep_makes_a_cloud_of_its_own() -> None:
    """The second sweep replaces the first: same size, other noise."""
    noisy = TiltingLidarParams(tilt_step_deg=4.0)
    first, count = _cloud(noisy, own=False, at=2.1)
    assert count == 1
    second, count = _cloud(noisy, own=False, at=3.0)
    assert count == 2
    assert first.shape == second.shape
    assert not np.any(np.all(first == second, axis=1))
    np.testing.assert_allclose(first, second, atol=0.08)


def test_own_points_are_removed() -> None:
    """A chest in front of the scanner hides the room but is not in the cloud."""
    noisy = TiltingLidarParams(tilt_step_deg=4.0)
    bare, _ = _cloud(noisy, own=False, at=1.0)
    raw, _ = _cloud(noisy, own=True, at=1.0, filtered=False)
    clean, _ = _cloud(noisy, own=True, at=1.0)
    half = np.array([0.1, 0.2, 0.15]) + 0.029
    X_CW = POSES[CHEST].inverse()

    def own(points: np.ndarray) -> int:
        return int(np.sum(np.all(np.abs(X_CW.multiply(points.T).T) < half, axis=1)))

    assert own(bare) == 0
    assert own(raw) > 500
    assert own(clean) == 0
    assert len(clean) == len(raw) - own(raw)


def test_same_seed_gives_the_same_cloud_bit_for_bit() -> None:
    """Two runs cannot be told apart; another seed can."""
    params = TiltingLidarParams(tilt_step_deg=4.0, seed=5)
    one, _ = _cloud(params, own=True, at=1.0)
    again, _ = _cloud(params, own=True, at=1.0)
    assert np.array_equal(one, again)
    other, _ = _cloud(TiltingLidarParams(tilt_step_deg=4.0, seed=6), own=True, at=1.0)
    assert one.shape != other.shape or not np.array_equal(one, other)


@pytest.mark.parametrize(
    ("params", "message"),
    [
        (ScanAssemblerParams(margin=-0.1), "margin: must be at least 0 m, got -0.1 m"),
        (ScanAssemblerParams(offset=0.025), "offset: must be less than the period"),
        (ScanAssemblerParams(offset=0.0), "offset: must be positive, got 0 s"),
    ],
)
def test_wrong_parameter_is_named(params: ScanAssemblerParams, message: str) -> None:
    """Every field that can be wrong is refused under its name."""
    with pytest.raises(ValueError, match=message):
        params.validate()


def test_the_cut_cloud_is_the_cloud_below_the_scanner() -> None:
    """Line by line as a whole, of the last finished sweep, without the robot."""
    height = 1.65
    before = _outputs(COARSE, own=True, at=0.375, cell=0.02)[2]
    assert not len(before.points)
    cloud, _, cut = _outputs(COARSE, own=True, at=0.5, cell=0.02)
    assert np.all(cut.points[:, 2] < height + 1e-9)
    # Beams along the servo's axis are at the scanner's height but for rounding, and
    # the port carries floats of 32 bits.
    low = cloud[cloud[:, 2] < height - 1e-5]
    assert 1000 < len(low) < len(cloud) == cut.seen
    lower = cut.points[cut.points[:, 2] < height - 1e-5]
    np.testing.assert_allclose(lower, low, atol=1e-6)
    whole = cut_cloud(cut.points, np.inf, 0.02).surfaces
    np.testing.assert_array_equal(cut.surfaces.column, whole.column)
    np.testing.assert_array_equal(cut.surfaces.first, whole.first)
    later = _outputs(COARSE, own=True, at=0.9, cell=0.02)[2]
    assert later.seen == cut.seen


def test_nothing_is_cut_where_nobody_asks() -> None:
    """Without a side of columns the port is empty."""
    assert not len(_outputs(COARSE, own=False, at=0.5)[2].points)
