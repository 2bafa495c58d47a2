"""A robot in its scene, rendered without a display."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from pydrake.geometry import (
    ClippingRange,
    ColorRenderCamera,
    LightParameter,
    MakeRenderEngineVtk,
    RenderCameraCore,
    RenderEngineVtkParams,
)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.sensors import CameraInfo

from footfall.diagrams.signals import Run
from footfall.models.robots.robot_loader import add_robot
from footfall.models.scenes.mover import add_movers
from footfall.models.scenes.solids import add_solids
from footfall.models.values.vector import Vector

WIDTH, HEIGHT = 320, 480
"""Of a picture of a strip, pixels."""
VIEW = np.array([0.5, -2.1, 0.3])
"""From the robot's base to the camera, m: from its right, a little from the front."""
CROSSING_VIEW = np.array([1.1, -1.75, 0.55])
"""The same over obstacles: from higher up and farther ahead, so that neither the near
leg nor the obstacle hides a foot."""
LIGHTS = (((0.35, 0.6, -0.7), 1.0), ((-0.7, 0.3, -0.4), 0.55))
"""Directions in W in which light falls, and how bright it is."""
_ENGINE = "film"


def render_states(
    run: Run,
    states: Vector,
    view: Vector = VIEW,
    movers: Vector | None = None,
    size: tuple[int, int] = (WIDTH, HEIGHT),
    targets: Vector | None = None,
) -> Iterator[Vector]:
    """Renders the robot in its scene at each state, one after the other.

    Args:
        run: its robot and scene.
        states: positions, then velocities of the robot, (n, nq + nv).
        view: from the robot's base to the camera in W, (3,), m.
        movers: x and y of each box that moves, in turn, (n, 2 k), m; None leaves them
            where they stand at first.
        size: width and height of a picture, pixels.
        targets: where the camera looks at each, and is moved with, p_W, (n, 3), m; None
            for the robot's base.

    Yields:
        Red, green and blue, (height, width, 3), 0 to 255 each.
    """
    scenario = run.scenario
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    solids = scenario.scene.solids()
    add_solids(
        plant,
        (solid for solid in solids if solid.role != "wall"),
    )
    robot = scenario.robot.model()
    instance = add_robot(plant, scene_graph, robot)
    moving = add_movers(plant, scenario.scene.movers)
    plant.Finalize()
    lights = [
        LightParameter(
            type="directional",
            frame="world",
            direction=np.array(direction) / np.linalg.norm(direction),
            intensity=intensity,
        )
        for direction, intensity in LIGHTS
    ]
    with _without_warnings_of_materials():
        scene_graph.AddRenderer(
            _ENGINE, MakeRenderEngineVtk(RenderEngineVtkParams(lights=lights))
        )
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    plant_context = plant.GetMyMutableContextFromRoot(context)
    query = scene_graph.get_query_output_port()
    scene_context = scene_graph.GetMyContextFromRoot(context)
    camera = ColorRenderCamera(
        RenderCameraCore(
            _ENGINE,
            CameraInfo(*size, np.deg2rad(50.0)),
            ClippingRange(0.05, 20.0),
            RigidTransform(),
        ),
        False,
    )
    base = plant.GetBodyByName(robot.base_body, instance)
    positions = plant.num_positions(instance)
    for index, row in enumerate(states):
        q: Vector = row[:positions]
        plant.SetPositions(plant_context, instance, q)
        if movers is not None:
            p_WM: Vector = movers[index]
            plant.SetPositions(plant_context, moving, p_WM)
        p_WTarget = base.EvalPoseInWorld(plant_context).translation()
        if targets is not None:
            p_WTarget = targets[index]
        image = query.Eval(scene_context).RenderColorImage(
            camera, scene_graph.world_frame_id(), look_at(p_WTarget + view, p_WTarget)
        )
        yield np.array(image.data)[:, :, :3]


@contextmanager
def _without_warnings_of_materials() -> Iterator[None]:
    """Drake warns of every mesh that brings its own material, as all of them do."""
    logger = logging.getLogger("drake")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


def look_at(p_WCamera: Vector, p_WTarget: Vector) -> RigidTransform:
    """Pose of a camera (x right, y down, z ahead) that looks at a point, upright."""
    ahead = (p_WTarget - p_WCamera) / np.linalg.norm(p_WTarget - p_WCamera)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    R: Vector = np.column_stack([right, np.cross(ahead, right), ahead])
    return RigidTransform(RotationMatrix(R), p_WCamera)


def turned(v: Vector, yaw: float) -> Vector:
    """Turns a vector by yaw, rad, about z, (3,)."""
    R_z: Vector = RotationMatrix.MakeZRotation(yaw).matrix()
    return R_z @ v
