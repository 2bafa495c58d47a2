"""An empty room: floor, four walls and a ceiling."""

from dataclasses import dataclass

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.contact_geometry import GREATEST_FRICTION
from footfall.models.scenes.solid_names import ROOM
from footfall.models.scenes.solids import Box, Rgba, Role, upright_pose
from footfall.models.values.validation import Parameters, number

FLOOR_COLOR: Rgba = (0.82, 0.82, 0.80, 1.0)
WALL_COLOR: Rgba = (0.90, 0.90, 0.93, 0.12)
"""Nearly clear, so that one can look into the room from outside."""
FLOOR_THICKNESS = 0.5
"""Thickness of floor and ceiling, m; deep, so that nothing is pushed out below."""


@dataclass(kw_only=True)
class RoomParams(Parameters):
    """A box-shaped room whose floor is z = 0."""

    length: float = number(11.0, "m", above=0.0)
    """Inner length along the room's x, m (stair paper, Sec. 5)."""
    width: float = number(7.0, "m", above=0.0)
    """Inner width along the room's y, m (stair paper, Sec. 5)."""
    height: float = number(3.0, "m", above=0.0)
    """Inner height, m (stair paper, Sec. 5)."""
    wall_thickness: float = number(0.10, "m", above=0.0)
    """Thickness of the four walls, m."""
    friction: float = number(0.8, above=0.0, below=GREATEST_FRICTION)
    """Coulomb friction coefficient between floor or walls and a sole."""
    x: float = number(0.0, "m")
    """Centre of the floor along x of W, m."""
    y: float = number(0.0, "m")
    """Centre of the floor along y of W, m."""
    yaw: float = number(0.0, "rad")
    """Direction of the room's x, about z of W, rad."""

    def X_WR(self) -> RigidTransform:
        """Pose of the room frame R: at the middle of the floor, x along the length."""
        return upright_pose(x=self.x, y=self.y, yaw=self.yaw)

    def solids(self) -> tuple[Box, ...]:
        """The floor, the walls and the ceiling, "room/floor" first.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        self.validate()
        X_WR = self.X_WR()
        thickness = self.wall_thickness
        length, width = self.length + 2.0 * thickness, self.width + 2.0 * thickness
        dx, dy = (self.length + thickness) / 2.0, (self.width + thickness) / 2.0
        half, deep = self.height / 2.0, FLOOR_THICKNESS

        def box(name: str, p_R: list[float], size: list[float], color: Rgba) -> Box:
            X_WB = X_WR.multiply(upright_pose(*p_R))
            role: Role = "floor" if name == "floor" else "wall"
            name, sides = f"{ROOM}{name}", np.array(size)
            return Box(name, X_WB, sides, self.friction, color, role)

        slab = [length, width, deep]
        across, along = (
            [thickness, width, self.height],
            [length, thickness, self.height],
        )
        above = self.height + deep / 2.0
        return (
            box("floor", [0.0, 0.0, -deep / 2.0], slab, FLOOR_COLOR),
            box("wall_front", [dx, 0.0, half], across, WALL_COLOR),
            box("wall_back", [-dx, 0.0, half], across, WALL_COLOR),
            box("wall_left", [0.0, dy, half], along, WALL_COLOR),
            box("wall_right", [0.0, -dy, half], along, WALL_COLOR),
            box("ceiling", [0.0, 0.0, above], slab, WALL_COLOR),
        )
