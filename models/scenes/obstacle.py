"""A box that stands in the way: an obstacle to step over, or clutter to walk round."""

from dataclasses import dataclass

import numpy as np

from footfall.models.robots.contact_geometry import GREATEST_FRICTION
from footfall.models.scenes.solid_names import BOX
from footfall.models.scenes.solids import Box, Rgba, upright_pose
from footfall.models.values.validation import Parameters, number

COLOR: Rgba = (0.75, 0.30, 0.25, 1.0)


@dataclass(kw_only=True)
class BoxParams(Parameters):
    """An upright box."""

    name: str = "box"
    """What it is called in contacts and messages, unique in its scene."""
    x: float = number(0.6, "m")
    """Centre along x of W, m."""
    y: float = number(0.0, "m")
    """Centre along y of W, m."""
    z: float = number(0.0, "m")
    """Height of its lower face above the floor, m."""
    yaw: float = number(0.0, "rad")
    """Direction of the box's x, about z of W, rad."""
    size: list[float] = number([0.05, 1.0, 0.15], "m", above=0.0, length=3)
    """Side lengths along its x, y and z, m (obstacle paper: 5 cm thick, 15 cm high)."""
    friction: float = number(0.8, above=0.0, below=GREATEST_FRICTION)
    """Coulomb friction coefficient between its surface and a sole."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.name:
            raise ValueError("name: must not be empty")

    def solid(self) -> Box:
        """The box, named "box/" and its name.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        self.validate()
        size = np.array(self.size, dtype=np.float64)
        X_WB = upright_pose(self.x, self.y, self.z + size[2] / 2.0, self.yaw)
        return Box(f"{BOX}{self.name}", X_WB, size, self.friction, COLOR, "box")
