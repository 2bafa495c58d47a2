"""Boxes that move: pushed across the floor at a given time."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.geometry import Box as BoxShape
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    ModelInstanceIndex,
    PdControllerGains,
    PrismaticJoint,
    SpatialInertia,
)

from footfall.models.robots.contact_geometry import surface_properties
from footfall.models.scenes.obstacle import COLOR, BoxParams
from footfall.models.scenes.solid_names import BOX
from footfall.models.values.validation import number
from footfall.models.values.vector import Vector

MASS = 30.0
"""Of a moving box, kg: heavy enough that the robot does not push it along."""
GAINS = PdControllerGains(p=2e5, d=1e4)
"""Of what pushes it along each axis, N/m and N s/m."""


@dataclass(kw_only=True)
class MoverParams(BoxParams):
    """An upright box that stands at first and is moved once."""

    time: float = number(6.0, "s", least=0.0)
    """When it begins to move, s."""
    duration: float = number(1.0, "s", least=0.05)
    """How long it takes, s."""
    to_x: float = number(0.0, "m")
    """Where its centre comes to along x of W, m."""
    to_y: float = number(0.0, "m")
    """Where its centre comes to along y of W, m."""


def add_movers(
    plant: MultibodyPlant, movers: Sequence[MoverParams]
) -> ModelInstanceIndex:
    """Adds the boxes on slides along x and y of W, each slide with a servo.

    Args:
        plant: not finalised yet.
        movers: the boxes; none is fine.

    Returns:
        Their model instance; its actuators are x, y of each box in turn.
    """
    instance = plant.AddModelInstance("movers")
    for mover in movers:
        size: Vector = np.array(mover.size)
        light = SpatialInertia.SolidBoxWithMass(1.0, 0.1, 0.1, 0.1)
        carriage = plant.AddRigidBody(f"carriage_{mover.name}", instance, light)
        body = plant.AddRigidBody(
            f"mover_{mover.name}",
            instance,
            SpatialInertia.SolidBoxWithMass(MASS, *size),
        )
        axes = (
            (plant.world_body(), carriage, "x", mover.x, [1.0, 0.0, 0.0]),
            (carriage, body, "y", mover.y, [0.0, 1.0, 0.0]),
        )
        for parent, child, name, start, axis in axes:
            direction: Vector = np.array(axis)
            joint = plant.AddJoint(
                PrismaticJoint(
                    f"{mover.name}_{name}",
                    parent.body_frame(),
                    child.body_frame(),
                    direction,
                )
            )
            at: Vector = np.array([start])
            joint.set_default_positions(at)
            actuator = plant.AddJointActuator(f"{mover.name}_{name}", joint)
            actuator.set_controller_gains(GAINS)
        p_BG: Vector = np.array([0.0, 0.0, mover.z + 0.5 * size[2]])
        # A hair above the floor, on which it would else rub.
        p_BG[2] += 1e-3
        X_BG = RigidTransform(RollPitchYaw(0.0, 0.0, mover.yaw), p_BG)
        surface = surface_properties(mover.friction)
        name = f"{BOX}{mover.name}"
        color: Vector = np.array(COLOR)
        plant.RegisterCollisionGeometry(body, X_BG, BoxShape(*size), name, surface)
        plant.RegisterVisualGeometry(body, X_BG, BoxShape(*size), name, color)
    return instance
