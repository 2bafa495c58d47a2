"""A straight staircase from its few dimensions."""

from dataclasses import dataclass

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.contact_geometry import GREATEST_FRICTION
from footfall.models.scenes.flight import step_box
from footfall.models.scenes.solid_names import STAIRCASE
from footfall.models.scenes.solids import Box, upright_pose
from footfall.models.scenes.tread import Tread
from footfall.models.values.validation import Parameters, number


@dataclass(kw_only=True)
class StaircaseParams(Parameters):
    """A straight staircase standing on the floor z = 0."""

    steps: int = number(3, least=1, most=100)
    """How many risers, and as many treads."""
    rise: float = number(0.20, "m", above=0.0)
    """Height of each step, m (stair paper, experiment 1)."""
    run: float = number(0.27, "m", above=0.0)
    """Depth of each tread, the top one included, m (stair paper, experiment 1)."""
    width: float = number(0.50, "m", above=0.0)
    """Width across, m (stair paper, experiment 1)."""
    closed_risers: bool = True
    """Whether each step is solid down to the floor, or a plate with air beneath."""
    tread_thickness: float = number(0.04, "m", above=0.0)
    """Thickness of the plates where the risers are open, m."""
    friction: float = number(0.8, above=0.0, below=GREATEST_FRICTION)
    """Coulomb friction coefficient between the treads and a sole."""
    x: float = number(0.6, "m")
    """Where the foot of the first riser has its middle, along x of W, m."""
    y: float = number(0.0, "m")
    """The same along y of W, m."""
    yaw: float = number(0.0, "rad")
    """Direction in which the stairs go up, about z of W from its x, rad."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.closed_risers and self.tread_thickness >= self.rise:
            raise ValueError(
                "tread_thickness: must be less than the rise where risers are open, "
                f"got {self.tread_thickness:g} m at a rise of {self.rise:g} m"
            )

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
        return tuple(
            step_box(
                tread,
                float(tread.X_WR.translation()[2])
                if self.closed_risers
                else self.tread_thickness,
                self.friction,
            )
            for tread in self.treads()
        )

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
                f"{STAIRCASE}step_{step}",
                X_WS.multiply(
                    upright_pose(x=(step - 0.5) * self.run, z=step * self.rise)
                ),
                size,
            )
            for step in range(1, self.steps + 1)
        )
