"""From depth images of random rooms to environments: the issue's accuracy, measured."""

import numpy as np
import pytest
from pydrake.common.value import AbstractValue
from pydrake.math import RigidTransform
from pydrake.systems.framework import Diagram, DiagramBuilder

from footfall.models.scenes.obstacle import BoxParams
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.room_obstacles import ClutterParams, place_boxes
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.room import DepthImage, Environment
from footfall.systems.perception.depth_cloud import DepthCloud, DepthCloudParams
from footfall.systems.perception.obstacles.obstacle_clusterer import ObstacleClusterer
from footfall.systems.perception.room.environment_exchange import EnvironmentExchange
from footfall.systems.perception.room.floor_extractor import FloorExtractor
from footfall.systems.sensing.depth_camera import DepthCameraParams, measure_depth
from footfall.systems.sensing.pinhole import pixel_rays
from footfall.systems.sensing.ray_caster import RayCaster

CAMERA = DepthCameraParams(position=[0.0, -0.6, 3.9])
CLEAR = np.array([[-2.5, 0.0], [2.5, 0.0]])


def take_image(boxes: list[BoxParams], params: DepthCameraParams) -> DepthImage:
    """What the camera sees of a room 4 m high with the boxes in it."""
    solids = [*RoomParams(height=4.0).solids(), *(box.solid() for box in boxes)]
    caster = RayCaster(triangle_mesh(solids), ())
    rays = pixel_rays(params.rows, params.columns, params.focal_length)
    depth = caster.cast_beams(params.X_WC(), rays, (), lambda p, r: (), threads=1)
    measured = measure_depth(depth, 0, params)
    shape = (params.rows, params.columns)
    return DepthImage(0.0, params.X_WC(), params.focal_length, measured.reshape(shape))


def perception() -> Diagram:
    """Cloud, floor, boxes and the step through XML, in the order of the data."""
    builder = DiagramBuilder()
    cloud = builder.AddNamedSystem(
        "cloud",
        DepthCloud(DepthCloudParams(lower=[-9, -3.4, -1], upper=[9, 3.4, 4])),
    )
    floor = builder.AddNamedSystem("floor", FloorExtractor())
    boxes = builder.AddNamedSystem("boxes", ObstacleClusterer())
    xml = builder.AddNamedSystem("xml", EnvironmentExchange())
    builder.ExportInput(cloud.GetInputPort("depth_image"), "depth_image")
    for system in (floor, boxes):
        builder.Connect(
            cloud.GetOutputPort("viewpoint"), system.GetInputPort("viewpoint")
        )
    builder.Connect(cloud.GetOutputPort("cloud"), floor.GetInputPort("cloud"))
    for name in ("floor", "obstacles"):
        builder.Connect(floor.GetOutputPort(name), boxes.GetInputPort(name))
    builder.Connect(boxes.GetOutputPort("environment"), xml.GetInputPort("environment"))
    builder.ExportOutput(xml.GetOutputPort("environment"), "environment")
    return builder.Build()


def perceive(image: DepthImage) -> Environment:
    """What the diagram makes of one image."""
    diagram = perception()
    context = diagram.CreateDefaultContext()
    port = diagram.GetInputPort("depth_image")
    port.FixValue(context, AbstractValue.Make(image))
    environment = diagram.GetOutputPort("environment").Eval(context)
    assert isinstance(environment, Environment)
    return environment


@pytest.mark.parametrize("seed", range(8))
def test_boxes_of_random_rooms(seed: int) -> None:
    """As many boxes, centres within 3 cm, sides within 5 cm, yaw within 5 deg."""
    boxes = place_boxes(ClutterParams(seed=seed), CLEAR)
    environment = perceive(take_image(boxes, CAMERA))
    assert environment.floor is not None
    np.testing.assert_allclose(environment.floor.coefficients, [0, 0, 1, 0], atol=0.003)
    assert 0.9 < environment.floor.inlier_share < 1.0
    assert len(environment.boxes) == len(boxes)
    for true in boxes:
        center = np.array([true.x, true.y, true.size[2] / 2.0])
        found = min(
            environment.boxes, key=lambda b: float(np.linalg.norm(b.center - center))
        )
        assert np.linalg.norm(found.center - center) < 0.03
        quarters = round((found.yaw - true.yaw) / (np.pi / 2.0))
        assert abs(found.yaw - true.yaw - quarters * np.pi / 2.0) < np.radians(5.0)
        size = np.array(true.size)[[1, 0, 2] if quarters % 2 else [0, 1, 2]]
        np.testing.assert_allclose(found.size, size, atol=0.05)


def test_empty_room_has_no_boxes() -> None:
    """Noise of the floor and the edge of the picture make no obstacles."""
    environment = perceive(take_image([], CAMERA))
    assert environment.floor is not None
    assert environment.boxes == ()


def test_a_camera_that_sees_no_floor_says_so() -> None:
    """Turned to the ceiling or to a wall it makes no environment up."""
    for target in ([0.0, -0.5, 9.0], [0.0, -9.0, 3.9]):
        params = DepthCameraParams(
            position=[0.0, -0.6, 2.0], target=target, field_of_view_deg=40.0
        )
        environment = perceive(take_image([], params))
        assert environment.floor is None
        assert environment.boxes == ()
        assert environment.reason.startswith("no floor in view")


def test_nothing_seen_yet() -> None:
    """Before the first frame there is no floor."""
    empty = DepthImage(-np.inf, RigidTransform(), 320.0, np.zeros((0, 0)))
    assert perceive(empty).reason == "no floor in view: the cloud has 0 points"


def box(x: float, y: float, *size: float) -> BoxParams:
    """A box along the axes."""
    return BoxParams(x=x, y=y, size=list(size))


CLOSE = {
    "lower one touches": [box(0.3, 0.2, 0.4, 0.4, 0.4), box(0.7, 0.2, 0.4, 0.4, 0.7)],
    "lower one 8 cm away": [
        box(0.3, 0.2, 0.4, 0.4, 0.3),
        box(0.78, 0.2, 0.4, 0.4, 0.7),
    ],
    "as high, 8 cm away": [
        box(0.3, 0.2, 0.4, 0.4, 0.5),
        box(0.78, 0.2, 0.4, 0.4, 0.5),
    ],
    "sofa": [box(1.0, 0.8, 1.6, 0.6, 0.45), box(1.0, 1.2, 1.6, 0.2, 0.85)],
    "low": [box(0.5, 0.5, 0.4, 0.3, 0.06), box(-1.0, 0.5, 0.4, 0.4, 0.10)],
}


@pytest.mark.parametrize("name", CLOSE)
def test_each_thing_is_a_box_of_its_own(name: str) -> None:
    """Heights within 1 cm, centres within 3 cm, sides within 5 cm."""
    environment = perceive(take_image(CLOSE[name], CAMERA))
    assert len(environment.boxes) == len(CLOSE[name])
    for true in CLOSE[name]:
        found = min(
            environment.boxes,
            key=lambda b: float(np.hypot(b.center[0] - true.x, b.center[1] - true.y)),
        )
        assert abs(found.size[2] - true.size[2]) < 0.01
        assert np.hypot(found.center[0] - true.x, found.center[1] - true.y) < 0.03
        np.testing.assert_allclose(found.size[:2], true.size[:2], atol=0.05)


def test_a_chair_is_as_high_as_its_back() -> None:
    """The seat of 45 cm, and a back of 90 cm that is 4 cm thick."""
    chair = [box(-1.0, 0.5, 0.45, 0.45, 0.45), box(-1.0, 0.705, 0.45, 0.04, 0.9)]
    boxes = perceive(take_image(chair, CAMERA)).boxes
    heights = sorted(b.size[2] for b in boxes)
    np.testing.assert_allclose(heights, [0.45, 0.9], atol=0.02)
