"""The eyes' shell: one look a sweep, what it remembers and what it hands on."""

from dataclasses import replace

import numpy as np
import pytest
from pydrake.perception import PointCloud
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import Context

from footfall.models.values.obstacle import ObstacleMap
from footfall.models.values.vector import Vector
from footfall.systems.perception.obstacles.obstacle_finder import ObstacleFinder
from footfall.systems.perception.obstacles.obstacles import (
    ObstacleFinderParams,
    find_obstacles,
)
from footfall.systems.ports import eval_abstract, eval_vector

EYES: Vector = np.array([0.0, 0.0, 1.5])


def _scene(height: float) -> Vector:
    """Floor, front and top of a box 1.2 m ahead, (n, 3), as a port carries it."""
    rng = np.random.default_rng(2)
    floor = np.column_stack(
        [rng.uniform([0.4, -1.5], [2.4, 1.5], (12000, 2)), np.zeros(12000)]
    )
    front = rng.uniform([1.175, -0.5, 0.0], [1.175, 0.5, height], (3000, 3))
    top = rng.uniform([1.175, -0.5, height], [1.225, 0.5, height], (1500, 3))
    return np.vstack([floor, front, top]).astype(np.float32).astype(np.float64)


def _give(system: ObstacleFinder, context: Context, points: Vector, sweep: int) -> None:
    """A cloud and how many sweeps are finished."""
    cloud = PointCloud(len(points))
    cloud.mutable_xyzs()[:] = points.T
    system.GetInputPort("cloud").FixValue(context, cloud)
    system.GetInputPort("viewpoint").FixValue(context, EYES)
    system.GetInputPort("sweep").FixValue(context, [float(sweep)])


def _seen(system: ObstacleFinder, context: Context) -> tuple[ObstacleMap, int]:
    """Both outputs."""
    found = eval_abstract(system.GetOutputPort("obstacle_map"), context, ObstacleMap)
    return found, int(eval_vector(system.GetOutputPort("sweep"), context)[0])


def test_before_the_first_sweep_it_has_not_looked() -> None:
    """Whatever the cloud holds."""
    system = ObstacleFinder()
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    _give(system, context, _scene(0.15), 0)
    simulator.AdvanceTo(0.3)
    found, sweep = _seen(system, context)
    assert (found.status, found.obstacles, sweep) == ("none", (), 0)


def test_it_hands_on_what_the_core_finds() -> None:
    """With its parameters and from where the robot looked."""
    params = replace(ObstacleFinderParams(), period=0.05)
    system = ObstacleFinder(params)
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    points = _scene(0.15)
    _give(system, context, points, 1)
    simulator.AdvanceTo(0.06)
    found, sweep = _seen(system, context)
    assert sweep == 1
    assert found == replace(find_obstacles(points, EYES, params), sensed_at=0.0)
    (obstacle,) = found.obstacles
    assert obstacle.height == pytest.approx(0.15, abs=0.01)


def test_it_looks_once_a_sweep() -> None:
    """A cloud that changes within a sweep is not looked at; the next sweep's is."""
    system = ObstacleFinder()
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    _give(system, context, _scene(0.15), 1)
    simulator.AdvanceTo(0.2)
    first, _ = _seen(system, context)
    _give(system, context, _scene(0.25), 1)
    simulator.AdvanceTo(0.4)
    assert _seen(system, context) == (first, 1)
    _give(system, context, _scene(0.25), 2)
    simulator.AdvanceTo(0.6)
    second, sweep = _seen(system, context)
    assert sweep == 2
    assert second.obstacles[0].height > first.obstacles[0].height + 0.05


def test_what_a_sweep_shows_is_there_after_the_time_it_takes() -> None:
    """Of the cloud and the viewpoint of when it began; the next sweep waits."""
    system = ObstacleFinder(replace(ObstacleFinderParams(), period=0.05), latency=0.3)
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    low, high = _scene(0.15), _scene(0.25)
    _give(system, context, low, 0)
    simulator.AdvanceTo(0.12)
    _give(system, context, low, 1)
    simulator.AdvanceTo(0.17)
    _give(system, context, high, 2)
    system.GetInputPort("viewpoint").FixValue(context, EYES + 0.2)
    simulator.AdvanceTo(0.44)
    nothing, count = _seen(system, context)
    assert (nothing.status, count) == ("none", 0)
    expected = []
    for points, eyes, sweep, time in (
        (low, EYES, 1, 0.15),
        (high, EYES + 0.2, 2, 0.45),
    ):
        simulator.AdvanceTo(time + 0.31)
        found, count = _seen(system, context)
        assert count == sweep
        assert found.sensed_at == pytest.approx(time)
        plain = find_obstacles(points, eyes, ObstacleFinderParams())
        assert replace(found, sensed_at=None) == plain
        expected.append(plain)
    assert expected[0] != expected[1]


def test_an_empty_cloud_has_no_floor() -> None:
    """That is data, no error."""
    system = ObstacleFinder()
    simulator = Simulator(system)
    context = simulator.get_mutable_context()
    _give(system, context, np.zeros((0, 3)), 1)
    simulator.AdvanceTo(0.2)
    assert _seen(system, context)[0].status == "no floor"


def test_a_wrong_parameter_is_refused() -> None:
    """When the System is made."""
    with pytest.raises(ValueError, match="period"):
        ObstacleFinder(replace(ObstacleFinderParams(), period=0.0))
    with pytest.raises(ValueError, match="latency"):
        ObstacleFinder(latency=-1.0)
