"""What a room crossing knows of its room: from the ceiling camera, or from a file."""

import dataclasses
from pathlib import Path

import numpy as np
from pydrake.common.value import AbstractValue
from pydrake.systems.framework import DiagramBuilder, OutputPort
from pydrake.systems.primitives import ConstantValueSource, ConstantVectorSource

from footfall.diagrams.closed_loop.station import Station, mover_meshes
from footfall.diagrams.closed_loop.wiring import add_system
from footfall.diagrams.scenario import Scenario
from footfall.models.robots.robot_loader import body_meshes
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.vector import Vector
from footfall.systems.perception.depth_cloud import DepthCloud
from footfall.systems.perception.obstacles.obstacle_clusterer import ObstacleClusterer
from footfall.systems.perception.room.environment_exchange import EnvironmentExchange
from footfall.systems.perception.room.environment_xml import load_environment
from footfall.systems.perception.room.floor_extractor import FloorExtractor
from footfall.systems.perception.scan_assembler import box_around
from footfall.systems.sensing.depth_camera import DepthCamera
from footfall.systems.sensing.ray_caster import BodyMesh


def add_perception(
    builder: DiagramBuilder, scenario: Scenario, station: Station
) -> tuple[OutputPort, OutputPort]:
    """Adds camera and perception, or what the task's file says in their place.

    Args:
        builder: of the diagram.
        scenario: what stands where, and the parameters.
        station: robot and scene.

    Returns:
        How many frames there are, (1,), and the environment.

    Raises:
        EnvironmentFileError: the scenario's environment cannot be read.
    """
    if scenario.task.environment is not None:
        return _add_file(builder, Path(scenario.task.environment))
    camera = _add_camera(builder, scenario, station)
    params = scenario.controllers()
    cloud = add_system(
        builder,
        "depth_cloud",
        DepthCloud(
            params.depth_cloud,
            [
                box_around(mesh.body_index, mesh.vertices)
                for mesh in _robot_meshes(station)
            ],
        ),
    )
    floor = add_system(builder, "floor_extractor", FloorExtractor(params.floor))
    clusters = add_system(
        builder, "obstacle_clusterer", ObstacleClusterer(params.obstacles)
    )
    exchange = add_system(builder, "environment_exchange", EnvironmentExchange())
    for source, port, system, target in (
        (camera, "depth_image", cloud, "depth_image"),
        (camera, "frame_body_poses", cloud, "body_poses"),
        (cloud, "cloud", floor, "cloud"),
        (cloud, "viewpoint", floor, "viewpoint"),
        (cloud, "viewpoint", clusters, "viewpoint"),
        (floor, "floor", clusters, "floor"),
        (floor, "obstacles", clusters, "obstacles"),
        (clusters, "environment", exchange, "environment"),
    ):
        builder.Connect(source.GetOutputPort(port), system.GetInputPort(target))
    return camera.GetOutputPort("frame"), exchange.GetOutputPort("environment")


def _add_file(builder: DiagramBuilder, path: Path) -> tuple[OutputPort, OutputPort]:
    environment = AbstractValue.Make(load_environment(path))
    once: Vector = np.ones(1)
    frame = add_system(builder, "frame", ConstantVectorSource(once))
    source = add_system(builder, "environment_file", ConstantValueSource(environment))
    return frame.get_output_port(), source.get_output_port()


def _add_camera(
    builder: DiagramBuilder, scenario: Scenario, station: Station
) -> DepthCamera:
    lens, plant = scenario.sensors.camera, station.plant
    camera = add_system(
        builder,
        "depth_camera",
        DepthCamera(
            dataclasses.replace(lens, seed=lens.seed + scenario.simulation.seed),
            scene=triangle_mesh(scenario.scene.solids()),
            body_meshes=[*_robot_meshes(station), *mover_meshes(scenario, plant)],
        ),
    )
    builder.Connect(
        plant.get_body_poses_output_port(),  # type: ignore[no-untyped-call]
        camera.GetInputPort("body_poses"),
    )
    return camera


def _robot_meshes(station: Station) -> list[BodyMesh]:
    return [
        BodyMesh(
            int(station.plant.GetBodyByName(mesh.body, station.instance).index()),
            mesh.vertices,
            mesh.triangles.astype(np.int64),
        )
        for mesh in body_meshes(station.robot)
    ]
