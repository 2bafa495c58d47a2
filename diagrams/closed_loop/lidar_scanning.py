"""The scanner on the robot's head, and what makes a cloud of its lines."""

from collections.abc import Container

import numpy as np
from pydrake.math import RigidTransform

from footfall.diagrams.closed_loop.robot_station import RobotStation
from footfall.diagrams.closed_loop.setup import Setup
from footfall.diagrams.closed_loop.station_builder import StationBuilder
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_errors import RobotError
from footfall.models.robots.robot_loader import body_meshes
from footfall.models.scenes.solids import triangle_mesh
from footfall.models.values.vector import Vector
from footfall.systems.perception.scan_assembler import (
    ScanAssembler,
    SelfFilterBox,
    box_around,
)
from footfall.systems.sensing.mounted_point import MountedPoint
from footfall.systems.sensing.ray_caster import BodyMesh
from footfall.systems.sensing.tilting_lidar import TiltingLidar


def add_lidar(
    station: StationBuilder,
    setup: Setup,
    true: RobotStation,
    cell: float | None = None,
) -> None:
    """Adds the scanner and what makes a cloud of its lines.

    Parts: `tilting_lidar`, whose rays meet the true bodies, and, of the pose that the
    robot believes in, `scan_assembler` and `viewpoint`. They take `true_body_poses`,
    `body_poses` and `scan`.

    Args:
        station: of perception.
        setup: scenario and robot.
        true: where the bodies are, by which rays are cast.
        cell: side of the columns that lines are cut into as they come, m; None where
            nothing asks for them.

    Raises:
        RobotError: the robot has no head.
    """
    scenario, robot = setup.scenario, setup.robot
    if robot.head_body is None:
        problem = f"head_body: must be given, the scanner's, for {scenario.task.kind}"
        raise RobotError(robot.name, [problem])
    head = int(true.plant.GetBodyByName(robot.head_body, true.instance).index())
    own_head = int(setup.model.GetBodyByName(robot.head_body).index())
    p_HM: Vector = np.array(robot.lidar_position)
    X_HM = RigidTransform(p_HM)
    meshes = [mesh for mesh in robot_meshes(robot, true) if mesh.body_index != head]
    params = scenario.lidar()
    station.add(
        "tilting_lidar",
        lambda: TiltingLidar(
            params,
            mount_body=head,
            X_BM=X_HM,
            scene=triangle_mesh(scenario.scene.solids()),
            body_meshes=meshes,
        ),
    )
    station.add(
        "scan_assembler",
        lambda: ScanAssembler(
            setup.params.scan_assembler,
            beam_angles=params.angles(),
            mount_body=own_head,
            X_BM=X_HM,
            own_boxes=own_boxes(setup, without=(robot.head_body,)),
            cell=cell,
        ),
    )
    station.add("viewpoint", lambda: MountedPoint(own_head, p_HM))
    for port in ("scan", "sweep"):
        station.connect(f"tilting_lidar.{port}", f"scan_assembler.{port}")
    station.take("scan", "tilting_lidar.enable")
    station.take("true_body_poses", "tilting_lidar.body_poses")
    station.take("body_poses", "scan_assembler.body_poses", "viewpoint.body_poses")


def own_boxes(setup: Setup, without: Container[str | None] = ()) -> list[SelfFilterBox]:
    """Gives the boxes about the robot's bodies, by their indices in the robot alone.

    Args:
        setup: the robot.
        without: bodies that no sensor sees.
    """
    return [
        box_around(int(setup.model.GetBodyByName(mesh.body).index()), mesh.vertices)
        for mesh in body_meshes(setup.robot)
        if mesh.body not in without
    ]


def robot_meshes(robot: RobotModel, true: RobotStation) -> list[BodyMesh]:
    """Gives what a sensor sees of the robot, by the bodies of the plant."""
    return [
        BodyMesh(
            int(true.plant.GetBodyByName(mesh.body, true.instance).index()),
            mesh.vertices,
            mesh.triangles.astype(np.int64),
        )
        for mesh in body_meshes(robot)
    ]
