"""How long a room crossing's perception and planning take."""

from typing import Any

import numpy as np
import pytest

from footfall.diagrams.scenario import load_scenario
from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.robots.robot import Sole
from footfall.models.scenes.room import RoomParams
from footfall.models.scenes.room_obstacles import ClutterParams, place_boxes
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.planned import FootstepPlan, MotionPlan
from footfall.models.values.room import DepthImage, Environment
from footfall.systems.perception.depth_cloud import depth_to_points, downsample
from footfall.systems.perception.obstacles.boxes import (
    ObstacleClustererParams,
    find_boxes,
)
from footfall.systems.perception.room.environment_xml import (
    read_environment,
    write_environment,
)
from footfall.systems.perception.room.floor import FloorParams, extract_floor
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.motion.motion import plan_motion
from footfall.systems.planning.motion.motion_task import MotionTask, Walker
from footfall.systems.planning.path.path_footsteps import plan_path_footsteps
from footfall.systems.planning.path.path_params import PathPlannerParams
from footfall.systems.planning.path.path_search import plan_path
from footfall.systems.sensing.depth_camera import DepthCameraParams, measure_depth
from footfall.systems.sensing.pinhole import pixel_rays
from footfall.systems.sensing.ray_caster import RayCaster
from tests.systems.planning.path.room_cases import stand

SOLE = Sole(heel=0.075, toe=0.150, half_width=0.042, ankle_height=0.1077)
CAMERA = DepthCameraParams(position=[0.0, -0.6, 3.9])
START, GOAL = np.array([-2.5, 0.0]), np.array([2.5, 0.0, 0.0])


def depth_image(seed: int, count: int = 8) -> DepthImage:
    """A VGA image of a room with eight boxes."""
    clutter = ClutterParams(seed=seed, min_count=count, max_count=count)
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
        walker = Walker(params.motion_planner, params.zmp_preview, JVRC1)
        return plan_motion(MotionTask(feet, com, plan(environment).footsteps), walker)

    assert benchmark(whole).duration > 15.0
