"""Parameters of quasi-static motion (stair paper, Sec. 6.1)."""

from dataclasses import dataclass

from footfall.models.values.validation import Parameters, number


@dataclass(kw_only=True)
class QuasiStaticParams(Parameters):
    """How slowly and where the CoM goes.

    The paper climbs one step of 24 cm in 90 s.
    """

    com_speed: float = number(0.10, "m/s", least=1e-3)
    """Mean speed of the CoM along its lines, m/s: the ZMP stays within 2 cm of it."""
    foot_speed: float = number(0.20, "m/s", least=1e-3)
    """Mean speed of the free foot along its way, m/s."""
    min_time: float = number(1.2, "s", least=0.05, most=60.0)
    """A segment lasts at least this long, s."""
    rest: float = number(0.1, "s", least=0.0, most=60.0)
    """Standing still between two segments, s."""
    margin: float = number(0.02, "m", least=0.0)
    """Both ends of a CoM line lie at least this far inside the segment's polygon, m."""
    friction: float = number(0.6, above=0.0, most=10.0, shared="parameters.friction")
    """mu of the pyramids that the polygons are computed with; below the ground's."""
    forward: float = number(0.035, "m", least=0.0)
    """CoM over the foot it stands on, ahead of the ankle, m."""
    inward: float = number(0.008, "m", least=0.0)
    """CoM over the foot it stands on, towards the other foot, m."""
