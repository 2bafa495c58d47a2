"""The convex hulls that a robot collides with, body by body."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np
import trimesh

from models.robot import RobotModel
from models.robot_loader import prepared_urdf
from systems.ports import Vector


@dataclass(frozen=True)
class CollisionHull:
    """The convex hull of one body."""

    body: str
    vertices: Vector
    """(n, 3), m, in the body's frame."""


def collision_hulls(robot: RobotModel) -> tuple[CollisionHull, ...]:
    """The hull of every body that has one, as the plant gets it.

    The soles' contact spheres are not among them: a foot's hull ends a little above
    its sole.
    """
    hulls = []
    for link in ET.fromstring(prepared_urdf(robot)).findall("link"):
        mesh = link.find("collision/geometry/mesh")
        if mesh is None:
            continue
        hull = trimesh.load_mesh(mesh.attrib["filename"].removeprefix("file://"))
        vertices = np.unique(np.asarray(hull.vertices, dtype=np.float64), axis=0)
        hulls.append(CollisionHull(link.attrib["name"], vertices))
    return tuple(hulls)
