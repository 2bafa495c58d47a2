"""The convex hulls that a robot collides with, body by body."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np

from footfall.models.robots.link_geometry import link_shapes
from footfall.models.robots.robot import RobotModel
from footfall.models.robots.robot_loader import prepared_urdf
from footfall.models.values.vector import Vector


@dataclass(frozen=True)
class CollisionHull:
    """The convex hull of one body."""

    body: str
    vertices: Vector
    """(n, 3), m, in the body's frame."""


def collision_hulls(robot: RobotModel) -> tuple[CollisionHull, ...]:
    """Computes the hull of every body that collides, around all its pieces.

    The soles' rubber is not part of it: a foot's hull ends a little above its sole.
    """
    hulls = []
    for link in ET.fromstring(prepared_urdf(robot)).findall("link"):
        pieces = [
            np.asarray(shape.mesh().vertices, dtype=np.float64)
            for shape in link_shapes(link, "collision", robot.urdf, robot.packages, {})
        ]
        if pieces:
            vertices = np.unique(np.vstack(pieces), axis=0)
            hulls.append(CollisionHull(link.attrib["name"], vertices))
    return tuple(hulls)
