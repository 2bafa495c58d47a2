"""Parameters of the path planner."""

import math
from dataclasses import dataclass

from models.validation import require_at_least, require_positive


@dataclass(kw_only=True)
class PathPlannerParams:
    """The robot's footprint, and how a path is looked for.

    The footprint is a disc about the point midway between the ankles. A humanoid that
    walks forward needs the width of its shoulders whatever its heading, and where it
    turns on the spot it sweeps that disc; so a gap that a rectangle would pass only
    sideways is left out, and every heading is free everywhere on a path.
    """

    footprint_radius: float = 0.39
    """Farthest part of the robot from the point midway between its ankles, m: JVRC-1's
    fingers when it stands."""
    margin: float = 0.06
    """Safety margin around the footprint, m (the room paper's "security quantity"):
    the sway of a walk, 4 cm, and the error of a box, 2 cm."""
    extension: float = 0.5
    """How far a tree grows at a time, m."""
    time_limit: float = 2.0
    """After this long without a path the search is given up, s."""
    attempts: int = 2
    """How many pairs of trees are grown; the shortest path counts. A single one often
    takes the wrong side of a box."""
    shortcuts: int = 120
    """How many random shortcuts a path is offered."""
    seed: int = 1
    """Of the samples and shortcuts."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        require_positive("footprint_radius", self.footprint_radius, "m")
        require_at_least("margin", self.margin, 0.0, "m")
        require_positive("extension", self.extension, "m")
        if not 0.0 < self.time_limit < math.inf:
            raise ValueError(f"time_limit: must be positive, got {self.time_limit} s")
        require_at_least("attempts", self.attempts, 1)
        require_at_least("shortcuts", self.shortcuts, 0)
        require_at_least("seed", self.seed, 0)

    @property
    def clearance(self) -> float:
        """Least distance of the robot's middle to boxes and the floor's edge, m."""
        return self.footprint_radius + self.margin
