"""The scanner: its noise and limits, the timing of its sweeps, what it sees."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import SpatialInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import (
    ConstantValueSource,
    ConstantVectorSource,
    TrajectorySource,
)
from pydrake.trajectories import PiecewisePolynomial

from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.solids import triangle_mesh, upright_pose
from footfall.models.values.perceived import LaserScan
from footfall.systems.sensing.tilting_lidar import (
    TiltingLidar,
    TiltingLidarParams,
    measure,
)

POSES = [RigidTransform(), upright_pose(z=1.5)]


def _simulator(
    params: TiltingLidarParams, switches: list[tuple[float, float]]
) -> tuple[TiltingLidar, Simulator]:
    """A scanner in an empty room; `enable` takes each value from its time on."""
    builder = DiagramBuilder()
    poses = builder.AddSystem(ConstantValueSource(AbstractValue.Make(POSES)))
    times, values = zip(*switches, (1e3, 0.0), strict=True)
    enable = builder.AddSystem(
        TrajectorySource(PiecewisePolynomial.ZeroOrderHold(times, [list(values)]))
    )
    lidar = builder.AddSystem(
        TiltingLidar(
            params,
            mount_body=1,
            X_BM=upright_pose(x=0.1, z=0.15),
            scene=triangle_mesh(RoomParams().solids()),
        )
    )
    builder.Connect(poses.get_output_port(), lidar.GetInputPort("body_poses"))
    builder.Connect(enable.get_output_port(), lidar.GetInputPort("enable"))
    return lidar, Simulator(builder.Build())


def _outputs(lidar: TiltingLidar, simulator: Simulator) -> tuple[Any, float, int]:
    context = lidar.GetMyContextFromRoot(simulator.get_context())
    scan, tilt, sweep = (
        lidar.GetOutputPort(name).Eval(context) for name in ("scan", "tilt", "sweep")
    )
    return scan, float(tilt[0]), int(sweep[0])


def test_noise_has_the_deviation_asked_for() -> None:
    """Over 200,000 ranges mean and deviation are those of the parameters."""
    params = TiltingLidarParams(noise=0.005)
    distances = np.full(1000, 4.0)
    errors = np.concatenate(
        [measure(distances, line, params) - 4.0 for line in range(200)]
    )
    assert abs(np.mean(errors)) < 5.0 * 0.005 / np.sqrt(len(errors))
    assert np.std(errors) == pytest.approx(0.005, rel=0.01)
    assert abs(np.corrcoef(errors[:-1000], errors[1000:])[0, 1]) < 0.02


def test_relative_noise_grows_with_range() -> None:
    """One part in a hundred of the range, beside the constant part."""
    params = TiltingLidarParams(noise=0.003, relative_noise=0.01)
    for distance in (0.5, 4.0):
        ranges = measure(np.full(20_000, distance), 0, params)
        expected = np.hypot(0.003, 0.01 * distance)
        assert np.std(ranges) == pytest.approx(expected, rel=0.03)
    assert np.isinf(measure(np.full(3, np.inf), 0, params)).all()


def test_noise_depends_on_seed_and_line_alone() -> None:
    """The same line of the same seed is the same bit for bit; others are not."""
    distances = np.linspace(1.0, 20.0, 1081)
    params = TiltingLidarParams(seed=3)
    first = measure(distances, 5, params)
    assert np.array_equal(first, measure(distances, 5, params))
    assert not np.any(first == measure(distances, 6, params))
    assert not np.any(first == measure(distances, 5, replace(params, seed=4)))


def test_limits_of_range() -> None:
    """Too near is nan, too far and nothing are inf."""
    params = TiltingLidarParams(noise=0.0, min_range=0.1, max_range=30.0)
    ranges = measure(np.array([0.05, 0.1, 30.0, 30.1, np.inf]), 0, params)
    np.testing.assert_array_equal(ranges, [np.nan, 0.1, 30.0, np.inf, np.inf])


def test_sweep_is_241_lines_in_six_seconds() -> None:
    """The first line at once, the last 6.0 s later; then the scanner waits."""
    lidar, simulator = _simulator(TiltingLidarParams(), [(0.0, 0.0), (0.0875, 1.0)])
    simulator.AdvanceTo(0.09)
    scan, tilt, sweep = _outputs(lidar, simulator)
    assert (scan.time, len(scan.ranges), sweep) == (-math.inf, 0, 0)
    lines: list[LaserScan] = []
    for tick in range(4, 260):
        simulator.AdvanceTo(0.025 * tick + 0.01)
        scan, tilt, sweep = _outputs(lidar, simulator)
        assert tilt == scan.tilt
        assert sweep == (1 if tick >= 244 else 0)
        if not lines or scan.time > lines[-1].time:
            lines.append(scan)
    assert len(lines) == 241
    assert lines[0].time == pytest.approx(0.1)
    assert lines[-1].time - lines[0].time == pytest.approx(6.0)
    assert np.degrees(lines[0].tilt) == pytest.approx(30.0)
    assert np.degrees(lines[-1].tilt) == pytest.approx(90.0)
    assert np.degrees(np.diff([line.tilt for line in lines])) == pytest.approx(0.25)
    assert sum(len(line.ranges) for line in lines) == 260_521


def test_each_sweep_takes_a_rising_edge_and_is_finished() -> None:
    """Staying on starts no second sweep; switching off stops none."""
    params = TiltingLidarParams(tilt_step_deg=15.0)
    switches = [(0.0, 1.0), (0.5, 0.0), (0.6, 1.0), (0.63, 0.0), (0.66, 1.0)]
    lidar, simulator = _simulator(params, switches)
    counts = {}
    for time in (0.09, 0.11, 0.59, 0.69, 0.71, 0.99):
        simulator.AdvanceTo(time)
        counts[time] = _outputs(lidar, simulator)[2]
    assert counts == {0.09: 0, 0.11: 1, 0.59: 1, 0.69: 1, 0.71: 2, 0.99: 2}


def test_line_sees_the_floor_from_the_mount() -> None:
    """Straight ahead and down, the range is the height over the sine of the tilt."""
    params = TiltingLidarParams(noise=0.0, tilt_step_deg=20.0)
    lidar, simulator = _simulator(params, [(0.0, 1.0)])
    for line, tilt in enumerate((30.0, 50.0, 70.0, 90.0)):
        simulator.AdvanceTo(0.025 * line + 0.01)
        scan, _, _ = _outputs(lidar, simulator)
        assert scan.ranges[540] == pytest.approx(
            1.65 / np.sin(np.radians(tilt)), rel=1e-5
        )


def test_two_runs_see_the_same_bit_for_bit() -> None:
    """Noise is part of the parameters, not of the moment."""
    scans = []
    for _ in range(2):
        lidar, simulator = _simulator(TiltingLidarParams(seed=9), [(0.0, 1.0)])
        simulator.AdvanceTo(0.2)
        scans.append(_outputs(lidar, simulator)[0])
    assert scans[0] == scans[1]
    assert np.std(scans[0].ranges - scans[1].ranges) == 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"line_period": 0.0}, "line_period: must be at least 0.001 s, got 0 s"),
        ({"resolution_deg": 0.7}, "resolution_deg: must divide 270 deg, got 0.7 deg"),
        ({"tilt_step_deg": 7.0}, "tilt_step_deg: must divide 60 deg, got 7 deg"),
        ({"tilt_end_deg": 30.0}, "tilt_end_deg: must exceed tilt_start_deg, got 30"),
        ({"max_range": 0.05}, "max_range: must exceed min_range, got 0.05 m"),
        (
            {"tilt_step_deg": 0.02, "resolution_deg": 0.02},
            "at most 1e.07 points",
        ),
        ({"noise": -0.1}, "noise: must be at least 0 m, got -0.1 m"),
        ({"field_of_view_deg": 360.0}, "field_of_view_deg: must be less than a turn"),
        ({"seed": -1}, "seed: must be at least 0, got -1"),
    ],
)
def test_wrong_parameter_is_named(change: dict[str, Any], message: str) -> None:
    """Every field that can be wrong is refused under its name."""
    with pytest.raises(ValueError, match=message):
        replace(TiltingLidarParams(), **change).validate()


def test_scanner_rides_on_a_body_of_a_plant() -> None:
    """The plant's own body_poses port fits; a falling scanner sees the floor near."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(time_step=0.001))
    body = plant.AddRigidBody("head", SpatialInertia.SolidSphereWithMass(1.0, 0.1))
    plant.Finalize()
    params = TiltingLidarParams(
        noise=0.0, tilt_start_deg=85.0, tilt_end_deg=90.0, tilt_step_deg=0.5
    )
    lidar = builder.AddSystem(
        TiltingLidar(
            params,
            mount_body=int(body.index()),
            X_BM=RigidTransform(),
            scene=triangle_mesh(RoomParams().solids()),
        )
    )
    enable = builder.AddSystem(ConstantVectorSource([1.0]))
    builder.Connect(
        plant.get_body_poses_output_port(), lidar.GetInputPort("body_poses")
    )
    builder.Connect(enable.get_output_port(), lidar.GetInputPort("enable"))
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, body, upright_pose(z=2.5))
    simulator.AdvanceTo(0.26)
    scan, tilt, sweep = _outputs(lidar, simulator)
    assert (np.degrees(tilt), sweep) == (pytest.approx(90.0), 1)
    # A step of the plant is taken after the line of the same instant.
    assert scan.ranges[540] == pytest.approx(2.5 - 9.81 / 2.0 * 0.25**2, abs=5e-3)
