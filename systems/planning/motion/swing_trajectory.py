"""The way of a foot through the air, over the edges that stick out into it.

The toe edge is what is steered, since a foot that is put down flat after its heel was
lifted would else push its toes forward into the riser. Height and way of the toe edge
and pitch follow quintic blends at rest at both ends (so twice continuously
differentiable), but that in the end the foot goes down evenly and feels for the ground.
When each blend begins and ends is searched on a small grid: the gentlest timing whose
sole keeps off every edge.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import TypeAlias

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw

from footfall.models.robots.robot import Sole
from footfall.models.values.geometry import heading
from footfall.models.values.validation import RIGHT_ANGLE, Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import sole_corners, wrap

LIFTED = (0.3, 0.4, 0.5, 0.6, 0.7)
"""When the foot is at its highest, as a part of the duration."""
LOWERING = (0.3, 0.4, 0.5, 0.6, 0.7)
"""When it starts down."""
DEPARTURES = (0.0, 0.08, 0.16, 0.24, 0.32, 0.4, 0.5)
"""When it starts forward."""
ARRIVALS = (1.0, 0.94, 0.88, 0.82, 0.76, 0.7, 0.62)
"""When it is over its foothold."""
GRID: Vector = np.array(
    [
        row
        for row in product(LIFTED, LOWERING, DEPARTURES, ARRIVALS)
        if row[0] <= row[1] and row[3] - row[2] >= 0.2
    ]
)
"""Every timing, (lifted, lowering, departure, arrival), (n, 4)."""
LONGEST_LANDING = 0.2
"""Most of the duration for which the foot goes down evenly in the end."""
FEELING = 1.5
"""Its way until it stands since it began to, in that of going evenly."""
SAMPLES: Vector = np.linspace(0.0, 1.0, 61)
"""Where a timing is checked, as a part of the duration."""


@dataclass(kw_only=True)
class SwingParams(Parameters):
    """How a foot swings."""

    apex_clearance: float = number(0.05, "m", least=0.0)
    """Height of the sole's lowest point over the highest of both footholds and all
    edges at the top of the swing, m."""
    edge_clearance: float = number(0.03, "m", least=0.0)
    """Distance kept from an edge, m: above it, or behind and beyond it. Less only
    where the sole stands nearer at the start or the end."""
    touch_down_height: float = number(0.015, "m", least=0.0)
    """From this height above the foothold, m, the foot comes straight down, so that a
    ground up to that much too high is met without a knock forward."""
    landing_speed: float = number(0.033, "m/s", least=0.0, most=1.0)
    """At which the foot goes down evenly in the end, m/s: slowly enough to meet the
    ground a little early or late without a knock."""
    landing_time: float = number(0.08, "s", above=0.0)
    """For how long it does, s."""
    swing_pitch: float = number(0.0, "rad", above=-RIGHT_ANGLE, below=RIGHT_ANGLE)
    """Pitch of the foot at the top of the swing, rad; negative lifts the toes."""
    retraction: float = number(0.0, "m", least=0.0)
    """How far the foot first draws back where there is an edge on the way, m."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        landing = FEELING * self.landing_speed * self.landing_time
        lower = max(self.edge_clearance, self.touch_down_height, landing)
        if not self.apex_clearance >= lower:
            raise ValueError(
                "apex_clearance: must not be less than edge_clearance, "
                "touch_down_height and the way of landing_speed in landing_time, "
                f"got {self.apex_clearance:g} m"
            )


@dataclass(frozen=True)
class SwingTrajectory:
    """Poses of a sole frame from lift-off to touch-down."""

    positions: Vector
    """p_WF, (n, 3), m."""
    rpy: Vector
    """Roll, pitch, yaw of F in W, (n, 3), rad."""
    clearance: float
    """Least distance from an edge, above or before or behind it, m; inf without."""
    status: str
    """"ok", or what the swing falls short of, in one line."""


@dataclass(frozen=True)
class _Swing:
    """The toe edge in the plane of the heading: x ahead of its start, z as in W."""

    start_z: float
    start_pitch: float
    start_yaw: float
    """From the heading, rad."""
    way: float
    """Horizontal distance that the toe edge travels, m."""
    end_x: float
    end_z: float
    end_pitch: float
    apex: float
    """Height of the toe edge at the top, m."""
    pitch: float
    """At the top, rad."""
    landing: float
    """What is left of the height when the foot begins to feel for the ground, m."""
    retraction: float
    """m."""
    edges: Vector
    """(m, 2), (x, z), m."""
    sole: Sole


def quintic(u: Vector) -> Vector:
    """Blend from 0 at u <= 0 to 1 at u >= 1 with no velocity or acceleration there."""
    u = np.clip(u, 0.0, 1.0)
    return u**3 * (10.0 - 15.0 * u + 6.0 * u**2)


def swing_trajectory(
    X_WStart: RigidTransform,
    X_WEnd: RigidTransform,
    duration: float,
    period: float,
    edges: Vector,
    sole: Sole,
    params: SwingParams,
) -> SwingTrajectory:
    """Lifts a foot, carries it over the edges and sets it down from above.

    Args:
        X_WStart: pose X_WF at lift-off, pitched where the heel left the ground before.
        X_WEnd: pose X_WF at touch-down.
        duration: of the swing, s.
        period: time between rows, s.
        edges: a point of each edge on the way (the nosings, and the tread's own front
            edge when going down), (m, 3), m, in W; an edge runs across the heading
            of X_WEnd.
        sole: the sole.
        params: clearances.

    Returns:
        The poses, the first at lift-off, the last at touch-down, and the clearance.

    Raises:
        ValueError: duration or period is not positive, or the shape of edges is wrong.
    """
    if not (duration > 0.0 and period > 0.0):
        raise ValueError(
            f"duration and period must be positive, got {duration} s and {period} s"
        )
    if edges.ndim != 2 or edges.shape[1] != 3:
        raise ValueError(f"edges: expected shape (m, 3), got {edges.shape}")
    toe: Vector = np.array([sole.toe, 0.0, 0.0])
    p0: Vector = np.array(X_WStart.multiply(toe))
    p1: Vector = np.array(X_WEnd.multiply(toe))
    rpy0: Vector = np.array(RollPitchYaw(X_WStart.rotation()).vector())
    rpy1: Vector = np.array(RollPitchYaw(X_WEnd.rotation()).vector())
    ahead = heading(X_WEnd)
    x_W: Vector = np.array([np.cos(ahead), np.sin(ahead), 0.0])
    lowest = max(sole_corners(X, sole)[:, 2].min() for X in (X_WStart, X_WEnd))
    landing_time = min(params.landing_time, LONGEST_LANDING * duration)
    sink = max(0.0, -sole.length * np.sin(params.swing_pitch))
    swing = _Swing(
        start_z=p0[2],
        start_pitch=rpy0[1],
        start_yaw=wrap(rpy0[2] - ahead),
        way=float(np.hypot(p1[0] - p0[0], p1[1] - p0[1])),
        end_x=float((p1 - p0) @ x_W),
        end_z=p1[2],
        end_pitch=rpy1[1],
        apex=max(lowest, *edges[:, 2], p0[2], p1[2]) + params.apex_clearance + sink,
        pitch=params.swing_pitch,
        landing=FEELING * params.landing_speed * landing_time,
        retraction=params.retraction if len(edges) else 0.0,
        edges=np.column_stack([(edges - p0) @ x_W, edges[:, 2]]),
        sole=sole,
    )
    touch_down = 1.0 - landing_time / duration
    timing, short = _gentlest(swing, params, touch_down)
    n = max(1, round(duration / period))
    u = np.linspace(0.0, 1.0, n + 1)
    shares = _shares(timing[None, :], u, touch_down)
    progress, back, z, pitch = (rows[0] for rows in _blends(swing, shares))
    roll = rpy0[0] + progress * wrap(rpy1[0] - rpy0[0])
    yaw = rpy0[2] + progress * wrap(rpy1[2] - rpy0[2])
    level = sole.toe * np.cos(pitch)
    positions = p0 + progress[:, None] * (p1 - p0) - back[:, None] * x_W
    positions[:, 0] -= level * np.cos(yaw)
    positions[:, 1] -= level * np.sin(yaw)
    positions[:, 2] = z + sole.toe * np.sin(pitch)
    clearance = np.inf
    if len(edges):
        gaps = _gaps(swing, progress, back, z, pitch)
        clearance = float(gaps.max(axis=-1).min())
    status = "ok"
    if short > 1e-6:
        status = f"the sole comes {short:.3f} m too near to an edge or to the ground"
    rpy = np.column_stack([roll, pitch, yaw])
    return SwingTrajectory(positions, rpy, clearance, status)


_Shares: TypeAlias = tuple[Vector, Vector, Vector, Vector, Vector]


def _feeling(u: Vector, touch_down: float) -> Vector:
    """How far the foot has gone of the last of its way: 0, then evenly on, to 1.

    Its speed grows as a quintic over as long as it then lasts, half a way ahead.

    Args:
        u: time as a part of the duration, (n,).
        touch_down: from when on it goes evenly.
    """
    span = 1.0 - touch_down
    w = np.clip((u - touch_down + span) / span, 0.0, 1.0)
    begun = w**4 * (2.5 - 3.0 * w + w**2)
    even = np.clip((u - touch_down) / span, 0.0, 1.0)
    share: Vector = (begun + even) / FEELING
    return share


def _shares(timings: Vector, u: Vector, touch_down: float) -> _Shares:
    """How far up, down, ahead, drawn back and feeling for the ground the foot is.

    0 to 1, (k, n) of k timings.

    They do not depend on the swing.
    """
    lifted, lowering, departure, arrival = timings.T[:, :, None]
    up = quintic(u / lifted)
    down = quintic((u - lowering) / (touch_down - lowering))
    progress = quintic((u - departure) / (arrival - departure))
    back = quintic(u / 0.2) * (1.0 - quintic((u - 0.2) / 0.3)) + 0.0 * up
    return up, down, progress, back, _feeling(u, touch_down) + 0.0 * up


@lru_cache(maxsize=8)
def _grid_shares(touch_down: float) -> _Shares:
    """Of every timing that is tried: the same for every step of a walk."""
    return _shares(GRID, SAMPLES, touch_down)


def _blends(swing: _Swing, shares: _Shares) -> tuple[Vector, Vector, Vector, Vector]:
    """Progress, retraction, m, toe height, m, pitch, rad: (k, n) of k timings."""
    up, down, progress, back, feeling = shares
    z = swing.start_z + up * (swing.apex - swing.start_z)
    z = z + down * (swing.end_z + swing.landing - swing.apex) - feeling * swing.landing
    pitch = swing.start_pitch + up * (swing.pitch - swing.start_pitch)
    pitch = pitch + down * (swing.end_pitch - swing.pitch)
    return progress, swing.retraction * back, z, pitch


def _gaps(
    swing: _Swing, progress: Vector, back: Vector, z: Vector, pitch: Vector
) -> Vector:
    """Gaps between the sole and each edge, (..., m, 3), m.

    How far the toes are before the edge, how far the heel is beyond it (both negative
    where the edge is under the sole), and how high the sole is over it, there or at
    its nearest end.
    """
    x = progress * swing.end_x - back
    yaw = swing.start_yaw * (1.0 - progress)
    length, side = swing.sole.length, swing.sole.half_width * np.abs(np.sin(yaw))
    toe_x = (x + side)[..., None]
    heel_x = (x - length * np.cos(pitch) * np.cos(yaw) - side)[..., None]
    toe_z = z[..., None]
    heel_z = (z + length * np.sin(pitch))[..., None]
    edge_x, edge_z = swing.edges.T
    share = np.clip((edge_x - heel_x) / (toe_x - heel_x), 0.0, 1.0)
    height = heel_z + share * (toe_z - heel_z) - edge_z
    return np.stack([edge_x - toe_x, heel_x - edge_x, height], axis=-1)


def _gentlest(
    swing: _Swing, params: SwingParams, touch_down: float
) -> tuple[Vector, float]:
    """The timing of least accelerations among those that keep the distances.

    What counts is the norm of the peaks on the way up, down and ahead.

    Returns:
        Its row of the grid, and by how much it falls short of the distances, m: above
        0 only where none keeps them, and then the least.
    """
    progress, back, z, pitch = _blends(swing, _grid_shares(touch_down))
    short = np.zeros(len(GRID))
    falling = GRID[:, 1:2] <= SAMPLES
    low = falling & (z - swing.end_z < params.touch_down_height)
    left = (1.0 - progress) * swing.way
    short = np.maximum(short, np.where(low, left - 0.002, 0.0).max(axis=1))
    if len(swing.edges):
        gaps = _gaps(swing, progress, back, z, pitch)
        near = params.edge_clearance
        start, end = gaps[0, 0], gaps[0, -1]
        before = np.clip(start[:, 0], 0.0, near)
        beyond = np.clip(end[:, 1], 0.0, near)
        # A sole that hangs over an edge at rest comes near to it all the same.
        rising = GRID[:, :1] >= SAMPLES
        hangs = [(row[:, :2] < 0.0).all(axis=1) for row in (start, end)]
        above = np.full(gaps.shape[:-1], near)
        for phase, hung, ground in (
            (rising, hangs[0], swing.start_z),
            (falling, hangs[1], swing.end_z),
        ):
            lift = np.minimum(near, z - ground)[..., None]
            above = np.where(phase[..., None] & hung, lift, above)
        wanted = np.stack(np.broadcast_arrays(before, beyond, above), axis=-1)
        missing = (wanted - gaps).min(axis=-1)
        short = np.maximum(short, missing.max(axis=(1, 2)))
    lifted, lowering, departure, arrival = GRID.T
    peaks = [
        (swing.apex - swing.start_z) / lifted**2,
        (swing.apex - swing.end_z) / (touch_down - lowering) ** 2,
        swing.way / (arrival - departure) ** 2,
    ]
    effort = np.linalg.norm(peaks, axis=0)
    kept = short <= 1e-6
    best = np.where(kept, effort, np.inf).argmin() if kept.any() else short.argmin()
    return GRID[best], float(short[best])
