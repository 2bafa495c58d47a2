"""What travels on abstract ports: frozen, comparable, each with a JSON form.

World frame W: z up. A foot's sole frame F: origin on the sole under the ankle, x to
the toes, z up out of the ground.
"""

import dataclasses
from dataclasses import dataclass, field
from typing import Literal, Self, TypeAlias, cast

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.math import RigidTransform

from systems.ports import Vector

Foot: TypeAlias = Literal["left", "right"]
FEET: tuple[Foot, Foot] = ("left", "right")
Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"


def other_foot(foot: Foot) -> Foot:
    """The foot on the other side."""
    return "right" if foot == "left" else "left"


def to_json(value: object) -> Json:
    """A value of this module (or a part of one) as plain JSON data.

    Arrays become nested lists (non-finite numbers become null), poses become
    {"translation": [x, y, z], "quaternion": [w, x, y, z]}, dataclasses become
    objects keyed by field name.

    Raises:
        TypeError: the value has no JSON form.
    """
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, np.ndarray):
        return [to_json(item) for item in value]
    if isinstance(value, list | tuple):
        return [to_json(item) for item in value]
    if isinstance(value, dict):
        return {str(key): to_json(item) for key, item in value.items()}
    if isinstance(value, RigidTransform):
        return {
            "translation": to_json(value.translation()),
            "quaternion": to_json(value.rotation().ToQuaternion().wxyz()),
        }
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {
            item.name: to_json(getattr(value, item.name))
            for item in dataclasses.fields(value)
        }
    raise TypeError(f"{type(value).__name__} has no JSON form")


def pose_from_json(data: Json) -> RigidTransform:
    """The pose that `to_json` wrote."""
    parts = cast(dict[str, list[float]], data)
    wxyz: Vector = np.array(parts["quaternion"], dtype=np.float64)
    p: Vector = np.array(parts["translation"], dtype=np.float64)
    return RigidTransform(Quaternion(wxyz), p)


class Value:
    """Base of the frozen dataclasses below: compares field by field, arrays too."""

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(
            _equal(getattr(self, item.name), getattr(other, item.name))
            for item in dataclasses.fields(self)  # type: ignore[arg-type]
        )

    __hash__ = None  # type: ignore[assignment]

    def __deepcopy__(self, memo: dict[int, object]) -> Self:
        """This value itself: it is immutable, and Drake clones state at every event."""
        return self

    def to_json(self) -> Json:
        """This value as plain JSON data."""
        return to_json(self)


def _equal(a: object, b: object) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.shape == b.shape and bool(np.array_equal(a, b, equal_nan=True))
    if isinstance(a, RigidTransform) and isinstance(b, RigidTransform):
        return a.IsExactlyEqualTo(b)
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(_equal, a, b))
    return bool(a == b)


@dataclass(frozen=True, eq=False)
class LaserScan(Value):
    """One line of a scanner on a tilt servo."""

    time: float
    """When the line was taken, s."""
    tilt: float
    """Angle of the tilt servo, rad; positive looks down."""
    ranges: Vector
    """Measured ranges, (n,), m, in the order of the beams; inf where nothing was
    hit, nan where the return was below the least range."""


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
    """How many points support the plane."""

    def corners(self) -> Vector:
        """The rectangle's corners in W, (4, 3), m, counter-clockwise from above."""
        half = self.size / 2.0
        signs = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        p_R = np.hstack([signs * half, np.zeros((4, 1))])
        return np.array(self.X_WR.multiply(p_R.T)).T


@dataclass(frozen=True, eq=False)
class Staircase(Value):
    """The treads that were found, lowest first, with the ground in front of them."""

    treads: tuple[PlaneSegment, ...] = ()
    """Treads from the lowest to the highest; R's x points up the stairs, so `size` is
    (depth, width)."""
    floor: PlaneSegment | None = None
    """The horizontal plane that the staircase rises from, where it was seen."""


@dataclass(frozen=True, eq=False)
class Footstep(Value):
    """Where a foot is to stand."""

    foot: Foot
    X_WF: RigidTransform
    """Pose of the sole frame F."""
    plane: int
    """Index of the tread in the Staircase it was planned on, -1 for the floor."""


@dataclass(frozen=True, eq=False)
class FootstepPlan(Value):
    """A sequence of footsteps, or why there is none."""

    footsteps: tuple[Footstep, ...] = ()
    status: Literal["planned", "infeasible", "finished"] = "finished"
    reason: str = ""
    """Why it is infeasible, in one line; empty otherwise."""


@dataclass(frozen=True, eq=False)
class ContactPhase(Value):
    """A stretch of a motion with the same contacts."""

    start: float
    """s after the motion's start."""
    end: float
    """s after the motion's start."""
    stance: tuple[Foot, ...]
    """The feet on the ground."""
    swing: Foot | None
    """The foot in the air."""


@dataclass(frozen=True, eq=False)
class MotionPlan(Value):
    """What the feet and the CoM are to do, sampled every `period` from `start_time`.

    Row i is due at start_time + i * period; after the last row it is held. Feet are
    in the order left, right.
    """

    start_time: float
    """s."""
    period: float
    """s."""
    footsteps: tuple[Footstep, ...]
    phases: tuple[ContactPhase, ...]
    contacts: Vector
    """1 where a foot is to be on the ground, (n, 2)."""
    foot_poses: Vector
    """Sole frames X_WF as (x, y, z, roll, pitch, yaw) of each foot, (n, 2, 6)."""
    contact_lengths: Vector
    """How much of each sole, from the toe edge back, carries, (n, 2), m: the whole
    sole when flat, a strip at the toes when the heel is lifted."""
    com: Vector
    """p_WCom, (n, 3), m."""
    com_velocity: Vector
    """(n, 3), m/s."""
    com_acceleration: Vector
    """(n, 3), m/s^2."""
    zmp: Vector
    """p_WZmp of that CoM motion with varying height, on the stance, (n, 3), m."""
    cart_zmp: Vector
    """ZMP of the cart-table of constant height that moves like it, (n, 2), m."""
    waist: Vector
    """Pelvis (roll, pitch, yaw) in W, (n, 3), rad."""
    arms: Vector = field(default_factory=lambda: np.zeros(0))
    """How far both shoulders pitch from the posture, (n,), rad, positive to the rear;
    empty where they rest."""
    reason: str = ""
    """Why the footsteps cannot be carried out, in one line; the plan stands then."""

    @property
    def duration(self) -> float:
        """From the first row to the last, s."""
        return (len(self.zmp) - 1) * self.period

    def starting_at(self, time: float) -> "MotionPlan":
        """The same motion from another time on, s."""
        return dataclasses.replace(self, start_time=time)


@dataclass(frozen=True, eq=False)
class PlaneSegmentation(Value):
    """What one cloud says about horizontal planes."""

    planes: tuple[PlaneSegment, ...] = ()
    """Every horizontal plane segment large enough for a foot, largest first."""
    staircase: Staircase = field(default_factory=Staircase)
    """The cluster of planes of like size that makes up the staircase."""
    times_ms: tuple[tuple[str, float], ...] = ()
    """Wall time of each stage, (stage, ms), in order."""
    sensed_at: float | None = None
    """When the work on its sweep began, s; None for a cloud without a time."""


@dataclass(frozen=True, eq=False)
class TaskStatus(Value):
    """How the task is going, as the executive sees it."""

    state: Literal["running", "finished", "infeasible"] = "running"
    activity: str = ""
    """What it is doing now, e.g. "scan", "plan", "move", "stand"."""
    reason: str = ""
    """Why it stopped, in one line."""


@dataclass(frozen=True, eq=False)
class StancePolygon(Value):
    """Where the CoM may be for the robot to stand still on its present contacts."""

    vertices: Vector = field(default_factory=lambda: np.zeros((0, 2)))
    """Counter-clockwise vertices (x, y) in W, (n, 2), m; empty where none exists."""
    status: str = "empty"
    """"ok", or why there is no polygon."""
    margin: float = float("nan")
    """Signed distance of the CoM to the nearest edge, m, positive inside."""


@dataclass(frozen=True, eq=False)
class Touch(Value):
    """Part of the robot that met part of the scene, or of itself."""

    body: str
    """The robot's body."""
    solid: str
    """The scene's solid, e.g. "staircase/step_2", or another of the robot's bodies."""
    duration: float
    """For how long they touched, all in all, s."""
    peak_force: float
    """The largest contact force between them, N."""


@dataclass(frozen=True, eq=False)
class Touches(Value):
    """Every pair that has met since the start."""

    touches: tuple[Touch, ...] = ()
    """One entry a pair, by body and then by solid."""
