"""What a room crossing knows of its room: from the ceiling camera, or from a file."""

import dataclasses
from pathlib import Path

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.primitives import ConstantValueSource, ConstantVectorSource

from footfall.diagrams.closed_loop.lidar_scanning import own_boxes, robot_meshes
from footfall.diagrams.closed_loop.robot_station import RobotStation
from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import Station, StationBuilder
from footfall.diagrams.scenario import Scenario
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.vector import Vector
from footfall.systems.perception.depth_cloud import DepthCloud
from footfall.systems.perception.obstacles.obstacle_clusterer import ObstacleClusterer
from footfall.systems.perception.room.environment_exchange import EnvironmentExchange
from footfall.systems.perception.room.environment_xml import load_environment
from footfall.systems.perception.room.floor_extractor import FloorExtractor
from footfall.systems.sensing.depth_camera import DepthCamera
from footfall.systems.sensing.ray_caster import BodyMesh


def build_room_perception(setup: Setup, true: RobotStation) -> Station:
    """Builds camera and perception, or what the task's file says in their place.

    Takes `true_body_poses` and `body_poses`, unless there is a file; gives
    `environment` and `frame`, how many frames there were. Parts: `depth_camera`,
    `depth_cloud`, `floor_extractor`, `obstacle_clusterer`, `environment_exchange`, or
    `frame` and `environment_file`.

    Raises:
        EnvironmentFileError: the scenario's environment cannot be read.
    """
    station = StationBuilder("perception", setup.parts)
    if setup.scenario.task.environment is not None:
        _add_file(station, Path(setup.scenario.task.environment))
        return station.build()
    params = setup.params
    meshes = robot_meshes(setup.robot, true)
    station.add("depth_camera", lambda: _camera(setup.scenario, true.plant, meshes))
    boxes = own_boxes(setup)
    station.add("depth_cloud", lambda: DepthCloud(params.depth_cloud, boxes))
    station.add("floor_extractor", lambda: FloorExtractor(params.floor))
    station.add("obstacle_clusterer", lambda: ObstacleClusterer(params.obstacles))
    station.add("environment_exchange", EnvironmentExchange)
    for source, *targets in (
        ("depth_camera.depth_image", "depth_cloud.depth_image"),
        ("depth_camera.frame_body_poses", "depth_cloud.body_poses"),
        ("depth_cloud.cloud", "floor_extractor.cloud"),
        (
            "depth_cloud.viewpoint",
            "floor_extractor.viewpoint",
            "obstacle_clusterer.viewpoint",
        ),
        ("floor_extractor.floor", "obstacle_clusterer.floor"),
        ("floor_extractor.obstacles", "obstacle_clusterer.obstacles"),
        ("obstacle_clusterer.environment", "environment_exchange.environment"),
    ):
        station.connect(source, *targets)
    station.take("true_body_poses", "depth_camera.body_poses")
    station.take("body_poses", "depth_camera.believed_poses")
    station.give("frame", "depth_camera.frame")
    station.give("environment", "environment_exchange.environment")
    return station.build()


def _add_file(station: StationBuilder, path: Path) -> None:
    environment = AbstractValue.Make(load_environment(path))
    once: Vector = np.ones(1)
    station.add("frame", lambda: ConstantVectorSource(once))
    station.add("environment_file", lambda: ConstantValueSource(environment))
    station.give("frame", "frame.y0")
    station.give("environment", "environment_file.y0")


def _camera(
    scenario: Scenario, plant: MultibodyPlant, robot: list[BodyMesh]
) -> DepthCamera:
    lens = scenario.sensors.camera
    return DepthCamera(
        dataclasses.replace(lens, seed=lens.seed + scenario.simulation.seed),
        scene=triangle_mesh(scenario.scene.solids()),
        body_meshes=[*robot, *_mover_meshes(scenario, plant)],
    )


def _mover_meshes(scenario: Scenario, plant: MultibodyPlant) -> list[BodyMesh]:
    """Gives what a camera sees of the boxes that move."""
    meshes = []
    for box in scenario.scene.movers:
        still = dataclasses.replace(box, x=0.0, y=0.0)
        mesh = triangle_mesh([still.solid()])
        body = plant.GetBodyByName(f"mover_{box.name}")
        meshes.append(BodyMesh(int(body.index()), mesh.vertices, mesh.triangles))
    return meshes
