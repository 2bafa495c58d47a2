"""FTG: the path of a foot through the air, over the obstacle and gently down.

Obstacle paper, Sec. III-B: clamped cubic splines for three translations and the pitch;
before touch-down the speed falls linearly to nothing (Fig. 3). The fourth-order
polynomial that the paper compares it with is here too.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from footfall.models.values.validation import RIGHT_ANGLE, Parameters, choice, number
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.leg_clearance import Section
from footfall.systems.planning.whole_body.leg_model import LegOutline

PROFILES = ("splines", "polynomial")


@dataclass(kw_only=True)
class FootTrajectoryParams(Parameters):
    """Control points of the foot's path, as shares of its duration."""

    profile: str = choice("splines", PROFILES)
    """"splines" (the paper's), or "polynomial": height of fourth order, horizontal way
    of third, what the paper compares with."""
    apex: float = number(0.02, "m", least=0.0)
    """Height of the foot's lowest point over the inflated obstacle, m."""
    level_apex: float = number(0.05, "m", least=0.0)
    """Height of the foot's lowest point over level ground, m."""
    retraction: float = number(0.03, "m", least=0.0)
    """How far the foot draws back from where it stood while it rises, m."""
    lifted: float = number(0.34, above=0.0, below=1.0)
    """When the foot is above the obstacle, its toe still before it."""
    lowering: float = number(0.70, above=0.0, below=1.0)
    """When its heel is beyond the obstacle and it goes down."""
    lead_pitch: float = number(-0.10, "rad", above=-RIGHT_ANGLE, below=RIGHT_ANGLE)
    """Pitch of the first foot over the obstacle, rad; negative lifts the toes."""
    trail_pitch: float = number(0.45, "rad", above=-RIGHT_ANGLE, below=RIGHT_ANGLE)
    """Pitch of the second foot while it rises, rad; positive lifts the heel."""

    over_share: float = number(0.6, least=0.0, most=1.0)
    """Share of that pitch that is left in the middle over the obstacle."""

    def validate(self) -> None:
        """Checks every field, and those that concern each other.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        super().validate()
        if not self.lifted < self.lowering:
            raise ValueError(
                f"lifted: must be less than lowering, got {self.lifted:g} and "
                f"{self.lowering:g}"
            )


@dataclass(frozen=True)
class Crossing:
    """What a foot has to pass."""

    inflated: Section
    """The obstacle with its margins."""
    front: float
    """Distance of its inflated front face ahead of the foot's start, m."""
    leads: bool
    """Whether it is the first foot that crosses."""


def sole_height(outline: LegOutline, ankle_height: float, pitch: float) -> float:
    """Height of the sole frame over the foot's lowest point when it pitches, m."""
    x, z = outline.foot.T
    lowest: float = ((z + ankle_height) * np.cos(pitch) - x * np.sin(pitch)).min()
    return -lowest


def foot_trajectory(
    start: Vector,
    end: Vector,
    time: Vector,
    duration: float,
    crossing: Crossing | None,
    outline: LegOutline,
    ankle_height: float,
    params: FootTrajectoryParams,
    shift: float = 0.0,
) -> Vector:
    """Sole poses along a step.

    Args:
        start: sole frame (x, y, z, roll, pitch, yaw) it leaves, flat, (6,).
        end: sole frame it takes, flat, (6,).
        time: since lift-off, (n,), s.
        duration: until touch-down, s.
        crossing: the obstacle on the way, ahead along the yaw of `end`; None over
            free ground.
        outline: of the leg.
        ankle_height: above the sole, m.
        params: control points.
        shift: how far the foot's way over the obstacle is moved to the rear, m
            (Sec. III-E1).

    Returns:
        Poses, (n, 6).
    """
    u = np.clip(time / duration, 0.0, 1.0)
    ahead = np.array([np.cos(end[5]), np.sin(end[5])])
    aside = np.array([-ahead[1], ahead[0]])
    delta = end[:2] - start[:2]
    way, sideways = float(delta @ ahead), float(delta @ aside)
    knots = _level_knots(way, end[2] - start[2], params)
    if crossing is not None:
        knots = _crossing_knots(
            way, end[2] - start[2], crossing, outline, ankle_height, params, shift
        )
    x, z, pitch = _spline(knots, u)
    if params.profile == "polynomial":
        x = way * (3.0 * u**2 - 2.0 * u**3)
        z = 16.0 * knots[:, 2].max() * u**2 * (1.0 - u) ** 2
        z = z + (end[2] - start[2]) * (3.0 * u**2 - 2.0 * u**3)
    blend = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    turn = (end[5] - start[5] + np.pi) % (2.0 * np.pi) - np.pi
    poses = np.zeros((len(u), 6))
    poses[:, :2] = start[:2] + x[:, None] * ahead + (sideways * blend)[:, None] * aside
    poses[:, 2] = start[2] + z
    poses[:, 4] = pitch
    poses[:, 5] = start[5] + turn * blend
    return poses


def _spline(knots: Vector, u: Vector) -> Vector:
    """Clamped cubic splines through the rows (u, x, z, pitch) of knots, (3, n)."""
    spline = CubicSpline(knots[:, 0], knots[:, 1:], bc_type="clamped")
    return np.asarray(spline(u)).T


def _landing(u0: float, height: float) -> Vector:
    """Rows (u, z) from u0 to 1 with a speed that falls linearly to nothing.

    Half as many rows let the spline swing about that line: the foot then meets the
    ground with twice the force.
    """
    s = np.linspace(0.0, 1.0, 7)[1:]
    return np.column_stack([u0 + (1.0 - u0) * s, height * (1.0 - s) ** 2])


def _level_knots(way: float, rise: float, params: FootTrajectoryParams) -> Vector:
    apex = params.level_apex + max(rise, 0.0)
    top = 0.4
    down = _landing(top, apex - rise)
    rows = [[0.0, 0.0, 0.0, 0.0], [top, 0.6 * way, apex, 0.0]]
    for u, z in down:
        left = (1.0 - u) / (1.0 - top)
        rows.append([u, (1.0 - 0.4 * left**4) * way, rise + z, 0.0])
    return np.array(rows)


def _crossing_knots(
    way: float,
    rise: float,
    crossing: Crossing,
    outline: LegOutline,
    ankle_height: float,
    params: FootTrajectoryParams,
    shift: float,
) -> Vector:
    """Up behind the obstacle, over it, down beyond it, without speed at the ground."""
    top = crossing.inflated.height + params.apex
    first = params.lead_pitch if crossing.leads else params.trail_pitch
    over = params.over_share * first
    heights = [
        top + sole_height(outline, ankle_height, pitch) for pitch in (first, over)
    ]
    high = top + sole_height(outline, ankle_height, 0.0)
    # The toe stays behind the inflated front face until it is above the top.
    toe = outline.toe * np.cos(first)
    back = min(-params.retraction, crossing.front - toe) - shift
    beyond = crossing.front + crossing.inflated.width + outline.heel
    last = max(min(way, beyond + 0.01), way - 0.03)
    lifted, lowering = params.lifted, params.lowering
    middle = 0.5 * (lifted + lowering)
    rows = [
        [0.0, 0.0, 0.0, 0.0],
        [0.5 * lifted, 0.6 * back, 0.4 * heights[0], 0.5 * first],
        [lifted, back + 0.02, heights[0], first],
        [middle, 0.5 * (back + last), max(heights[1], high), over],
        [lowering, last, high, 0.0],
    ]
    for u, z in _landing(lowering, high - rise):
        rows.append([u, way, rise + z, 0.0])
    return np.array(rows)
