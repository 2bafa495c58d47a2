"""A straight staircase from its few dimensions."""

from dataclasses import dataclass

import numpy as np
from pydrake.math import RigidTransform

from models.solids import Box, Rgba, upright_pose
from models.validation import require_finite, require_positive
from systems.ports import Vector
from systems.values import Value

COLOR: Rgba = (0.76, 0.62, 0.42, 1.0)


@dataclass(frozen=True, eq=False)
class Tread(Value):
    """The true upper face of one step."""

    name: str
    """The solid that it belongs to, e.g. "staircase/step_2"."""
    X_WR: RigidTransform
    """Pose of the rectangle: origin at its centre, x up the stairs, z out of it."""
    size: Vector
    """Depth along x and width along y, (2,), m."""


@dataclass(kw_only=True)
class StaircaseParams:
    """A straight staircase standing on the floor z = 0."""

    steps: int = 3
    """How many risers, and as many treads."""
    rise: float = 0.20
    """Height of each step, m (stair paper, experiment 1)."""
    run: float = 0.27
    """Depth of each tread, the top one included, m (stair paper, experiment 1)."""
    width: float = 0.50
    """Width across, m (stair paper, experiment 1)."""
    closed_risers: bool = True
    """Whether each step is solid down to the floor, or a plate with air beneath."""
    tread_thickness: float = 0.04
    """Thickness of the plates where the risers are open, m."""
    friction: float = 0.8
    """Coulomb friction coefficient between the treads and a sole."""
    x: float = 0.6
    """Where the foot of the first riser has its middle, along x of W, m."""
    y: float = 0.0
    """The same along y of W, m."""
    yaw: float = 0.0
    """Direction in which the stairs go up, about z of W from its x, rad."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        if self.steps < 1:
            raise ValueError(f"steps: must be at least 1, got {self.steps}")
        for field in ("rise", "run", "width", "tread_thickness"):
            require_positive(field, getattr(self, field), "m")
        if not self.closed_risers and self.tread_thickness >= self.rise:
            raise ValueError(
                "tread_thickness: must be less than the rise where risers are open, "
                f"got {self.tread_thickness:g} m at a rise of {self.rise:g} m"
            )
        require_positive("friction", self.friction)
        require_finite("x", self.x, "m")
        require_finite("y", self.y, "m")
        require_finite("yaw", self.yaw, "rad")

    def X_WS(self) -> RigidTransform:
        """Pose of the staircase frame S: at the foot of the first riser, x up."""
        return upright_pose(x=self.x, y=self.y, yaw=self.yaw)

    def solids(self) -> tuple[Box, ...]:
        """A box a step, lowest first, named "staircase/step_1" and so on.

        A closed step spans its own run from the floor up, so that boxes touch without
        overlapping; an open one is a plate under its tread.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        boxes = []
        for tread in self.treads():
            top = float(tread.X_WR.translation()[2])
            height = top if self.closed_risers else self.tread_thickness
            X_RB = upright_pose(z=-height / 2.0)
            size = np.array([*tread.size, height])
            boxes.append(
                Box(tread.name, tread.X_WR.multiply(X_RB), size, self.friction, COLOR)
            )
        return tuple(boxes)

    def treads(self) -> tuple[Tread, ...]:
        """The true treads, lowest first.

        Raises:
            ValueError: a field is wrong; see `validate`.
        """
        self.validate()
        X_WS = self.X_WS()
        size = np.array([self.run, self.width])
        return tuple(
            Tread(
                f"staircase/step_{step}",
                X_WS.multiply(
                    upright_pose(x=(step - 0.5) * self.run, z=step * self.rise)
                ),
                size,
            )
            for step in range(1, self.steps + 1)
        )
