"""How long a room crossing's perception and planning take."""

from typing import Any

import numpy as np
import pytest

from diagrams.scenario import load_scenario
from models.jvrc1 import JVRC1
from models.robot import Sole
from models.room import RoomParams
from models.room_obstacles import ClutterParams, place_boxes
from models.solids import triangle_mesh
from systems.perception.boxes import ObstacleClustererParams, find_boxes
from systems.perception.depth_cloud import depth_to_points, downsample
from systems.perception.environment_xml import read_environment, write_environment
from systems.perception.floor import FloorParams, extract_floor
from systems.planning.footstep_params import FootstepPlannerParams
from systems.planning.motion import plan_motion
from systems.planning.path_footsteps import plan_path_footsteps
from systems.planning.path_params import PathPlannerParams
from systems.planning.path_search import plan_path
from systems.room_values import DepthImage, Environment
from systems.sensing.depth_camera import DepthCameraParams, measure_depth
from systems.sensing.pinhole import pixel_rays
from systems.sensing.ray_caster import RayCaster
from systems.values import FootstepPlan, MotionPlan
from tests.systems.planning.room_cases import stand

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)
CAMERA = DepthCameraParams(position=[0.0, -0.6, 3.9])
START, GOAL = np.array([-2.5, 0.0]), np.array([2.5, 0.0, 0.0])


def depth_image(seed: int, count: int = 8) -> DepthImage:
    """A VGA image of a room with eight boxes."""
    clutter = ClutterParams(seed=seed, least_count=count, most_count=count)
    boxes = place_boxes(clutter, np.array([START, GOAL[:2]]))
    solids = [*RoomParams(height=4.0).solids(), *(box.solid() for box in boxes)]
    caster = RayCaster(triangle_mesh(solids), ())
    rays = pixel_rays(CAMERA.rows, CAMERA.columns, CAMERA.focal_length)
    depth = caster.cast_beams(CAMERA.X_WC(), rays, (), lambda p, r: (), threads=0)
    picture = measure_depth(depth, 0, CAMERA).reshape(CAMERA.rows, CAMERA.columns)
    return DepthImage(0.0, CAMERA.X_WC(), CAMERA.focal_length, picture)


def perceive(image: DepthImage, leaf: float = 0.02) -> Environment:
    """The whole of perception, the XML included."""
    viewpoint = image.X_WC.translation()
    cloud = downsample(depth_to_points(image), leaf)
    estimate, above = extract_floor(cloud, viewpoint, FloorParams())
    assert estimate.floor is not None
    params = ObstacleClustererParams(cell=leaf)
    boxes = find_boxes(above, estimate.floor, viewpoint, params)
    return read_environment(write_environment(Environment(estimate.floor, boxes)))


def plan(environment: Environment) -> FootstepPlan:
    """Path and footsteps."""
    path = plan_path(environment, START, GOAL, PathPlannerParams())
    left, right = stand(*START, 0.0)
    params = FootstepPlannerParams()
    return plan_path_footsteps(path, environment, left, right, params, SOLE)


def test_depth_image(benchmark: Any) -> None:
    """Casting a frame, its noise included."""
    assert benchmark(depth_image, 0).depth.shape == (480, 640)


@pytest.mark.parametrize("leaf", [0.01, 0.02, 0.05])
def test_perception(benchmark: Any, leaf: float) -> None:
    """A frame of a room with eight boxes."""
    environment = benchmark(perceive, depth_image(0), leaf)
    assert len(environment.boxes) == 8


@pytest.mark.parametrize("seed", range(10))
def test_planning(benchmark: Any, seed: int) -> None:
    """Path and footsteps past eight boxes as they were perceived."""
    footsteps = benchmark(plan, perceive(depth_image(seed)))
    assert footsteps.status == "planned"


@pytest.mark.parametrize("seed", range(10))
def test_whole_planning(benchmark: Any, seed: int) -> None:
    """The same with the motion along the footsteps, its ZMP pattern included."""
    environment = perceive(depth_image(seed))
    params = load_scenario("room").controllers()
    feet = np.array([[*START, 0.0, 0.0, 0.0, 0.0]] * 2)
    feet[:, 1] += [0.095, -0.095]
    com = np.array([*START, params.motion_planner.com_height])

    def whole() -> MotionPlan:
        return plan_motion(
            feet,
            com,
            plan(environment).footsteps,
            np.zeros((0, 3)),
            params.motion_planner,
            params.zmp_preview,
            JVRC1,
        )

    assert benchmark(whole).duration > 15.0
