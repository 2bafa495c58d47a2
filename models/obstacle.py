"""A box that stands in the way: an obstacle to step over, or clutter to walk round."""

from dataclasses import dataclass, field

import numpy as np

from models.solids import Box, Rgba, upright_pose
from models.validation import require_finite, require_length, require_positive

COLOR: Rgba = (0.75, 0.30, 0.25, 1.0)


@dataclass(kw_only=True)
class BoxParams:
    """An upright box."""

    name: str = "box"
    """What it is called in contacts and messages, unique in its scene."""
    x: float = 0.6
    """Centre along x of W, m."""
    y: float = 0.0
    """Centre along y of W, m."""
    z: float = 0.0
    """Height of its lower face above the floor, m."""
    yaw: float = 0.0
    """Direction of the box's x, about z of W, rad."""
    size: list[float] = field(default_factory=lambda: [0.05, 1.0, 0.15])
    """Side lengths along its x, y and z, m (obstacle paper: 5 cm thick, 15 cm high)."""
    friction: float = 0.8
    """Coulomb friction coefficient between its surface and a sole."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        if not self.name:
            raise ValueError("name: must not be empty")
        for item in ("x", "y", "z"):
            require_finite(item, getattr(self, item), "m")
        require_finite("yaw", self.yaw, "rad")
        require_length("size", self.size, 3)
        for index, length in enumerate(self.size):
            require_positive(f"size[{index}]", length, "m")
        require_positive("friction", self.friction)

    def solid(self) -> Box:
        """The box, named "box/" and its name.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        self.validate()
        size = np.array(self.size, dtype=np.float64)
        X_WB = upright_pose(self.x, self.y, self.z + size[2] / 2.0, self.yaw)
        return Box(f"box/{self.name}", X_WB, size, self.friction, COLOR)
