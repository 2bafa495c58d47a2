"""Values that perception puts on its ports: scan lines, planes, stairs."""

from dataclasses import dataclass, field

from pydrake.math import RigidTransform

from footfall.models.values.geometry import rectangle_corners_world
from footfall.models.values.value import Value
from footfall.models.values.vector import Vector


@dataclass(frozen=True, eq=False)
class LaserScan(Value):
    """One line of a scanner on a tilt servo."""

    time: float
    """Time at which the line was taken, s."""
    tilt: float
    """Angle of the tilt servo, rad; positive looks down."""
    ranges: Vector
    """Measured ranges, (n,), m, in the order of the beams; inf where nothing was
    hit, nan where the return was below the least range."""


@dataclass(frozen=True, eq=False)
class SeenEdges(Value):
    """Which edges of a tread were seen as edges: a face at it, or what lies beyond it.

    Any other edge is hidden or where the view ended; to it depth or width are lower
    bounds.
    """

    front: bool
    """Of the edge one steps over going up."""
    back: bool
    """Of the edge to the next tread; of the last one, to what lies behind it."""
    right: bool
    """Of the right end, looking up the stairs."""
    left: bool
    """Of the left end."""


@dataclass(frozen=True, eq=False)
class PlaneSegment(Value):
    """A bounded patch of plane that was seen."""

    polygon: Vector
    """Convex outline of the supporting points, (n, 3), m, counter-clockwise seen from
    the side its normal points to."""
    X_WR: RigidTransform
    """Pose of the oriented rectangle R: origin at its centre, z along the normal, x
    along the side named first in `size`."""
    size: Vector
    """Side lengths of the rectangle along R's x and y, (2,), m."""
    normal: Vector
    """Unit normal, (3,), pointing up."""
    area: float
    """Area of the supporting voxels, m^2."""
    support_count: int
    """Number of points that support the plane."""
    edges: SeenEdges | None = None
    """Of a tread, which of its edges were seen; None of any other plane."""

    def corners(self) -> Vector:
        """Computes the rectangle's corners in W, (4, 3), m, counter-clockwise."""
        return rectangle_corners_world(self.X_WR, self.size)


@dataclass(frozen=True, eq=False)
class Staircase(Value):
    """The treads that were found, lowest first, with the ground in front of them."""

    treads: tuple[PlaneSegment, ...] = ()
    """Treads from the lowest to the highest; R's x points up the stairs, so `size` is
    (depth, width)."""
    floor: PlaneSegment | None = None
    """The horizontal plane that the staircase rises from, where it was seen."""


@dataclass(frozen=True, eq=False)
class PlaneSegmentation(Value):
    """Plane segments of one cloud, and the staircase among them."""

    planes: tuple[PlaneSegment, ...] = ()
    """Every horizontal plane segment large enough for a foot, largest first."""
    staircase: Staircase = field(default_factory=Staircase)
    """The nearest flight of stairs."""
    flights: tuple[Staircase, ...] = ()
    """Every straight flight that was seen, `staircase` first: behind a landing where
    the way turns another one begins."""
    times_ms: tuple[tuple[str, float], ...] = ()
    """Wall time of each stage, (stage, ms), in order."""
    sensed_at: float | None = None
    """Time at which the work on its sweep began, s; None for a cloud without a time."""
