"""The segmenter as a system."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from pydrake.perception import PointCloud
from pydrake.systems.framework import Context

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.perceived import PlaneSegmentation
from footfall.models.values.vector import Vector
from footfall.systems.perception.planes.cut_sweep import cut_cloud
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.plane_segmenter import PlaneSegmenter
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.ports import eval_abstract
from footfall.systems.timing import stopwatch

GRAVITY = np.array([0.0, 0.0, -9.81])


def evaluate(segmenter: PlaneSegmenter, context: Context) -> PlaneSegmentation:
    """The output port's value."""
    port = segmenter.GetOutputPort("segmentation")
    return eval_abstract(port, context, PlaneSegmentation)


def fix_cloud(segmenter: PlaneSegmenter, context: Context, points: Vector) -> None:
    """Gives the input port a cloud."""
    cloud = PointCloud(len(points))
    cloud.mutable_xyzs()[:] = points.T
    segmenter.GetInputPort("cloud").FixValue(context, cloud)


def test_system_publishes_the_core(
    scan: Callable[..., Vector], stair_scene: Any
) -> None:
    """The shell hands cloud, gravity and viewpoint on, and computes once."""
    scene = stair_scene(yaw=0.1)
    eye = scene.sensor()
    cloud = scan(scene, eye)
    segmenter = PlaneSegmenter(JVRC1.sole)
    context = segmenter.CreateDefaultContext()
    fix_cloud(segmenter, context, cloud)
    segmenter.GetInputPort("gravity").FixValue(context, GRAVITY)
    unseen = evaluate(segmenter, context)
    segmenter.GetInputPort("viewpoint").FixValue(context, eye)
    found = evaluate(segmenter, context)
    assert evaluate(segmenter, context) is found
    watch = stopwatch(segmenter)
    assert watch is not None
    assert watch.count == 2
    assert len(found.staircase.treads) == len(unseen.staircase.treads) == 3
    # The port carries floats of 32 bits.
    single: Vector = cloud.astype(np.float32).astype(np.float64)
    wanted, _ = segment_planes(single, GRAVITY, PlaneSegmenterParams(), JVRC1.sole, eye)
    assert found.planes == wanted.planes
    assert found.staircase == wanted.staircase


def test_empty_cloud_has_an_empty_segmentation() -> None:
    """Before the first sweep there is nothing, and that is no error."""
    segmenter = PlaneSegmenter(JVRC1.sole)
    context = segmenter.CreateDefaultContext()
    fix_cloud(segmenter, context, np.zeros((0, 3)))
    segmenter.GetInputPort("gravity").FixValue(context, GRAVITY)
    found = evaluate(segmenter, context)
    assert found.planes == ()
    assert found.staircase.treads == ()
    assert found.staircase.floor is None


def test_bad_parameters_are_refused_at_once() -> None:
    """Where the system is made, not at its first cloud."""
    with pytest.raises(ValueError, match="voxel_size: must be at least"):
        PlaneSegmenter(JVRC1.sole, PlaneSegmenterParams(voxel_size=-1.0))


def test_a_cut_cloud_stands_for_the_cloud_where_it_fits(
    scan: Callable[..., Vector], stair_scene: Any
) -> None:
    """Only those that it does not fit look at the other cloud, which is empty."""

    class OwnWay(PlaneSegmenter):
        def segment(
            self, points: Vector, gravity: Vector, viewpoint: Vector | None
        ) -> PlaneSegmentation:
            """As ours, but said to be another."""
            return super().segment(points, gravity, viewpoint)

    scene = stair_scene(yaw=0.1)
    eye = scene.sensor()
    cloud = scan(scene, eye)
    wanted, _ = segment_planes(cloud, GRAVITY, PlaneSegmenterParams(), JVRC1.sole, eye)
    cut = cut_cloud(cloud, float(eye[2]), PlaneSegmenterParams().voxel_size)
    coarse = PlaneSegmenterParams(voxel_size=0.03)
    for segmenter, count in (
        (PlaneSegmenter(JVRC1.sole), 3),
        (PlaneSegmenter(JVRC1.sole, coarse), 0),
        (OwnWay(JVRC1.sole), 0),
    ):
        context = segmenter.CreateDefaultContext()
        fix_cloud(segmenter, context, np.zeros((0, 3)))
        segmenter.GetInputPort("gravity").FixValue(context, GRAVITY)
        segmenter.GetInputPort("viewpoint").FixValue(context, eye)
        segmenter.GetInputPort("cut_cloud").FixValue(context, cut)
        found = evaluate(segmenter, context)
        assert len(found.staircase.treads) == count
        if count:
            assert found.staircase == wanted.staircase
