"""A robot that is made of balls, over slabs: contacts whose forces are known."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from pydrake.geometry import Box, SceneGraph, Sphere
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    CoulombFriction,
    MultibodyPlant,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import ModelInstanceIndex, SpatialInertia
from pydrake.systems.framework import DiagramBuilder

FEET = ("LEFT", "RIGHT")
GROUND = frozenset({"room/floor", "staircase/step_1"})
"""What soles may touch."""
WEIGHT = 9.81
"""Of a ball, N."""
FRICTION = CoulombFriction(0.5, 0.5)
BODY_OF = {"shin": "SHIN", "sole": "LEFT", "right": "RIGHT"}
FAR = {"shin": 20.0, "sole": 30.0, "right": 40.0}
"""Where balls that are not asked for fly, m."""


@dataclass(frozen=True)
class BallScene:
    """A plant in a builder."""

    builder: DiagramBuilder
    plant: MultibodyPlant
    scene_graph: SceneGraph
    robot: ModelInstanceIndex


def is_sole(name: str) -> bool:
    """Whether a geometry, with or without scope, is a sole's."""
    return name.rpartition("::")[2].startswith(("sole", "right"))


def ball_scene(
    slabs: Mapping[str, float],
    balls: Mapping[str, tuple[float, float]],
    step: float,
    slope: float = 0.0,
    solver: str = "lagged",
) -> BallScene:
    """Balls of 1 kg and 10 cm of radius over slabs.

    Args:
        slabs: by name, the height of the upper face of each, m.
        balls: "shin", "sole" or "right", the x and z of its centre, m; the others are
            far away.
        step: of the plant, s.
        slope: of the slabs about y, rad.
        solver: the plant's contact approximation.
    """
    builder = DiagramBuilder()
    config = MultibodyPlantConfig(
        time_step=step, contact_model="point", discrete_contact_approximation=solver
    )
    plant, scene_graph = AddMultibodyPlant(config, builder)
    for name, height in slabs.items():
        X_WS = RigidTransform(RollPitchYaw(0.0, slope, 0.0), np.array([0, 0, height]))
        slab = X_WS.multiply(RigidTransform(np.array([0.0, 0.0, -0.5])))
        plant.RegisterCollisionGeometry(
            plant.world_body(), slab, Box(4.0, 4.0, 1.0), name, FRICTION
        )
    robot = plant.AddModelInstance("robot")
    for ball, body_name in BODY_OF.items():
        body = plant.AddRigidBody(
            body_name, robot, SpatialInertia.SolidSphereWithMass(1.0, 0.1)
        )
        plant.RegisterCollisionGeometry(
            body, RigidTransform(), Sphere(0.1), f"{ball}_hull", FRICTION
        )
    plant.Finalize()
    for ball, body_name in BODY_OF.items():
        x, z = balls.get(ball, (FAR[ball], 0.0))
        plant.SetDefaultFloatingBaseBodyPose(
            plant.GetBodyByName(body_name), RigidTransform(np.array([x, 0.0, z]))
        )
    return BallScene(builder, plant, scene_graph, robot)
