"""What touches: soles and ground as Drake's contact models see them, and friction.

A sole is a rectangle of rubber that carries wherever something is under it, a nosing
or a slat as well as the floor. Drake's hydroelastic contact does that with one box: the
pressure is that of the rubber over the whole patch. Its point contact knows one point a
pair of shapes, so there a sole is six small spheres and, a millimetre above them, a
plate for the edges that come between them.
"""

from typing import Literal, TypeAlias

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddRigidHydroelasticProperties,
    Box,
    ProximityProperties,
    Shape,
    Sphere,
)
from pydrake.math import RigidTransform
from pydrake.multibody.plant import CoulombFriction, MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex

from footfall.models.robots.robot import RobotModel
from footfall.models.values.feet import FEET
from footfall.models.values.vector import Vector

ContactModel: TypeAlias = Literal["hydroelastic", "point"]
CONTACT_MODELS: tuple[ContactModel, ...] = ("hydroelastic", "point")

SOLE_PREFIX = "sole"
"""What the names of the sole's contact geometries begin with."""
SOLE_FRICTION = 1.0
"""Coefficient that a sole is registered with; see `surface_properties`."""
GREATEST_FRICTION = 2.0 * SOLE_FRICTION
"""No surface gives this much with a sole."""
SOLE_THICKNESS = 0.010
"""Of the rubber, m."""
SOLE_MODULUS = 1.0e7
"""Hydroelastic modulus of the rubber, Pa: hard as of a shoe's heel. Standing on both
feet it gives by a hundredth of a millimetre, tipping over an edge by tenths."""
SOLE_DISSIPATION = 1.0
"""Hunt and Crossley's, s/m."""
SPHERE_RADIUS = 0.005
"""Radius of the spheres a sole touches the ground with in point contact, m."""
PLATE_RECESS = 0.001
"""How far the plate of a sole in point contact lies above its spheres' lowest points,
m: farther than they sink in under any load."""


def surface_properties(friction: float) -> ProximityProperties:
    """Makes the properties of a rigid surface on which a sole has this friction.

    Drake combines the coefficients a, b of two surfaces as mu = 2 a b / (a + b). For
    mu to be what the scene says, the surface is registered with b = mu a / (2 a - mu),
    a being the sole's.

    Args:
        friction: mu that acts between a sole and the surface, static and dynamic.

    Raises:
        ValueError: no coefficient gives that friction with the sole's.
    """
    if not 0.0 < friction < GREATEST_FRICTION:
        raise ValueError(
            f"friction: must be above 0 and below {GREATEST_FRICTION:g}, "
            f"got {friction:g}"
        )
    mu = friction * SOLE_FRICTION / (GREATEST_FRICTION - friction)
    properties = ProximityProperties()
    properties.AddProperty("material", "coulomb_friction", CoulombFriction(mu, mu))
    AddRigidHydroelasticProperties(1.0, properties)
    return properties


def sole_properties() -> ProximityProperties:
    """Makes the properties of a sole's rubber."""
    properties = ProximityProperties()
    properties.AddProperty(
        "material", "coulomb_friction", CoulombFriction(SOLE_FRICTION, SOLE_FRICTION)
    )
    properties.AddProperty("material", "hunt_crossley_dissipation", SOLE_DISSIPATION)
    AddCompliantHydroelasticProperties(SOLE_THICKNESS, SOLE_MODULUS, properties)
    return properties


def add_soles(
    plant: MultibodyPlant,
    instance: ModelInstanceIndex,
    robot: RobotModel,
    contact_model: ContactModel,
) -> None:
    """Registers the contact geometry of both soles.

    Args:
        plant: not finalised yet, with the robot in it.
        instance: the robot.
        robot: its names and its sole.
        contact_model: that the plant will use.
    """
    shapes = _boxes if contact_model == "hydroelastic" else _spheres_and_plate
    for foot in FEET:
        body = plant.GetBodyByName(robot.foot_bodies[foot], instance)
        for number, (shape, p_F) in enumerate(shapes(robot)):
            p_B = p_F - np.array([0.0, 0.0, robot.sole.ankle_height])
            plant.RegisterCollisionGeometry(
                body,
                RigidTransform(p_B),
                shape,
                f"{SOLE_PREFIX}_{foot}_{number}",
                sole_properties(),
            )


def is_sole(name: str) -> bool:
    """Tells whether a geometry (by its name, scope or none) belongs to a sole."""
    return name.rpartition("::")[2].startswith(SOLE_PREFIX)


def _boxes(robot: RobotModel) -> list[tuple[Shape, Vector]]:
    """Lists the rubber's boxes; centres in F."""
    return [_slab(robot, 0.0)]


def _spheres_and_plate(robot: RobotModel) -> list[tuple[Shape, Vector]]:
    """Lists three spheres along each side and the plate; centres in F."""
    sole = robot.sole
    spheres: list[tuple[Shape, Vector]] = [
        (Sphere(SPHERE_RADIUS), np.array([x, y, SPHERE_RADIUS]))
        for x in np.linspace(-sole.heel, sole.toe, 3)
        for y in (-sole.half_width, sole.half_width)
    ]
    return [*spheres, _slab(robot, PLATE_RECESS)]


def _slab(robot: RobotModel, recess: float) -> tuple[Shape, Vector]:
    """Makes the sole's rectangle, `recess` to `SOLE_THICKNESS` above the sole plane."""
    sole = robot.sole
    height = SOLE_THICKNESS - recess
    centre = [(sole.toe - sole.heel) / 2.0, 0.0, recess + height / 2.0]
    return Box(sole.length, 2.0 * sole.half_width, height), np.array(centre)
