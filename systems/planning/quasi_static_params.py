"""Parameters of quasi-static motion (stair paper, Sec. 6.1)."""

import math
from dataclasses import dataclass


@dataclass(kw_only=True)
class QuasiStaticParams:
    """How slowly and where the CoM goes.

    The paper climbs one step of 24 cm in 90 s.
    """

    com_speed: float = 0.10
    """Mean speed of the CoM along its lines, m/s: the ZMP stays within 2 cm of it."""
    foot_speed: float = 0.20
    """Mean speed of the free foot along its way, m/s."""
    least_time: float = 1.2
    """A segment lasts at least this long, s."""
    rest: float = 0.1
    """Standing still between two segments, s."""
    margin: float = 0.02
    """Both ends of a CoM line lie at least this far inside the segment's polygon, m."""
    friction: float = 0.6
    """mu of the pyramids that the polygons are computed with; below the ground's."""
    forward: float = 0.035
    """CoM over the foot it stands on, ahead of the ankle, m."""
    inward: float = 0.008
    """CoM over the foot it stands on, towards the other foot, m."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        for name in (
            "com_speed",
            "foot_speed",
            "least_time",
            "friction",
        ):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name}: must be positive, got {getattr(self, name)}")
        for name in ("rest", "margin", "forward", "inward"):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise ValueError(
                    f"{name}: must not be negative, got {getattr(self, name)}"
                )
