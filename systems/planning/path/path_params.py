"""Parameters of the path planner."""

from dataclasses import dataclass

from footfall.models.values.validation import MAX_SEED, Parameters, number


@dataclass(kw_only=True)
class PathPlannerParams(Parameters):
    """The robot's footprint, and how a path is looked for.

    The footprint is a disc about the point midway between the ankles. A humanoid that
    walks forward needs the width of its shoulders whatever its heading, and where it
    turns on the spot it sweeps that disc; so a gap that a rectangle would pass only
    sideways is left out, and every heading is free everywhere on a path.
    """

    footprint_radius: float = number(0.39, "m", above=0.0)
    """Farthest part of the standing robot from the point midway between its ankles, m;
    by default the robot's `footprint_radius`."""
    margin: float = number(0.06, "m", least=0.0)
    """Safety margin around the footprint, m (the room paper's "security quantity"):
    the sway of a walk, 4 cm, and the error of a box, 2 cm."""
    extension: float = number(0.5, "m", least=0.01)
    """How far a tree grows at a time, m."""
    time_limit: float = number(2.0, "s", above=0.0)
    """After this long without a path the search is given up, s."""
    attempts: int = number(2, least=1, most=1000)
    """How many pairs of trees are grown; the shortest path counts. A single one often
    takes the wrong side of a box."""
    shortcuts: int = number(120, least=0)
    """How many random shortcuts a path is offered."""
    seed: int = number(1, least=0, most=MAX_SEED)
    """Of the samples and shortcuts."""

    @property
    def clearance(self) -> float:
        """Least distance of the robot's middle to boxes and the floor's edge, m."""
        return self.footprint_radius + self.margin
