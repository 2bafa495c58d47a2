"""FU: can the robot step over an obstacle, and in which key configuration?

Obstacle paper (Stasse et al. 2009), Sec. II and III-A. The plane across the obstacle:
the rear ankle at x = 0, the front ankle at X_ads, the waist at (X_hds, Z_hds).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from footfall.models.values.feet import FEET
from footfall.models.values.obstacle import Feasibility, KeyConfiguration
from footfall.models.values.validation import Parameters, number
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.leg_clearance import Section, outline_gap
from footfall.systems.planning.whole_body.leg_model import (
    LegModel,
    both_leg_angles,
    outline_points,
)

Mask: TypeAlias = np.ndarray[Any, np.dtype[np.bool_]]

JOINTS = ("hip pitch", "hip roll", "hip yaw", "knee", "ankle roll", "ankle pitch")
SLACKS = (0.5, 0.25, 0.75)
"""Where the obstacle lies in the room between the feet, tried in this order; at 0 and
1 a foot would touch its margin."""
BATCH = 4
"""Step lengths in one pass: as many as stay in a processor's cache."""


@dataclass(kw_only=True)
class FeasibilityParams(Parameters):
    """What the feasibility unit searches and with which margins."""

    s_w: float = number(0.045, "m", least=0.0)
    """Margin on either side of the obstacle, m. The paper has 3 cm; what the eyes and
    the feet err is added, so that 3 cm remain to the true one."""
    s_h: float = number(0.045, "m", least=0.0)
    """Margin above the obstacle, m; likewise."""
    delta_ds: float = number(0.5, above=0.0, below=1.0)
    """delta_DS of Eq. 22, X_hds = delta_DS X_ads: where over the step the waist is."""
    waist_travel: float = number(0.08, "m", least=0.0)
    """How far before and behind X_hds the waist is while both feet are down, m: the
    double support is short, but not nothing."""
    step_increment: float = number(0.01, "m", least=1e-3)
    """By which the step length is raised, m."""
    height_increment: float = number(0.01, "m", least=1e-3)
    """By which the waist is lowered, m."""
    max_step_length: float = number(0.56, "m", above=0.0, most=10.0)
    """Longest step, m: beyond it the swing asks more speed and torque than there is."""
    lowest_waist: float = number(0.62, "m", above=0.0)
    """Lowest waist, m: below it the knees ask for more torque than there is. By default
    the robot's `lowest_waist`."""
    joint_margin: float = number(0.05, "rad", least=0.0)
    """Kept from the joint limits, rad, as the motion about the key configuration and
    its tracking need some."""


class Checked(NamedTuple):
    """Which constraints configurations of the double support meet."""

    reached: Vector
    """Whether both ankles are within reach of the hips, (n,), 0 or 1."""
    limits: Vector
    """Eq. 1, q_min <= q <= q_max: by how much each joint of either leg exceeds its
    limits, (n, 6), rad; not positive where it does not."""
    gap: Vector
    """Eq. 5, A_{x_i x_i+1 o_j o_j+1} < 0, as a distance of the legs to the obstacle,
    (n,), m: below the knee of their outline, above it of the line to the hip."""
    knees: Vector
    """Distance from the rear ankle to the knees of rear and front leg, (n, 2), m."""

    def within(self, margin: float) -> Mask:
        """Tells which are in reach and keep a margin, rad, from the limits, (n,)."""
        fine: Mask = (self.reached > 0.5) & (self.limits <= -margin).all(axis=1)
        return fine


class _Legs(NamedTuple):
    """Both legs of n configurations in the plane, the rear one first."""

    soles: Vector
    """(n, 2, 6)."""
    angles: Vector
    """(n, 2, 6), rad."""
    reached: Vector
    limits: Vector
    """These two as in `Checked`."""


def check_double_support(
    section: Section,
    X_ads: Vector,
    X_hds: Vector,
    Z_hds: Vector,
    front: Vector,
    leg: LegModel,
) -> Checked:
    """Evaluates Eqs. 1 and 5 for double supports, whose feet stand (Eqs. 3 and 4).

    q_min <= q <= q_max (1); x_1 = x_5 = const (3), z_1 = z_5 = 0 (4);
    A_{x_i x_i+1 o_j o_j+1} < 0 (5).

    Args:
        section: the obstacle.
        X_ads: step lengths, (n,), m.
        X_hds: rear ankle to waist, (n,), m.
        Z_hds: heights of the waist, (n,), m.
        front: rear ankle to the front face, (n,), m.
        leg: the legs.
    """
    legs = _legs(X_ads, X_hds, Z_hds, leg)
    shape = (legs.soles, legs.angles)
    gap, knees = _clearance(section, shape, X_hds, Z_hds, front, leg)
    return Checked(legs.reached, legs.limits, gap, knees)


def _legs(X_ads: Vector, X_hds: Vector, Z_hds: Vector, leg: LegModel) -> _Legs:
    """Solves the IK of both legs and tests q_min <= q <= q_max (Eq. 1)."""
    n = len(X_ads)
    hips = np.array([leg.hips[foot] for foot in FEET])
    soles = np.zeros((n, 2, 6))
    soles[:, 1, 0] = X_ads
    soles[:, :, 1] = hips[:, 1]
    waist = np.column_stack([X_hds - hips[0, 0], np.zeros(n), Z_hds - hips[0, 2]])
    upright = np.broadcast_to(np.eye(3), (n, 3, 3))
    angles, short = both_leg_angles(leg, waist, upright, soles)
    beyond = np.maximum(angles - leg.upper, leg.lower - angles).max(axis=1)
    reached = np.where((short > 0.0).any(axis=1), 0.0, 1.0)
    return _Legs(soles, angles, reached, beyond)


def _clearance(
    section: Section,
    legs: tuple[Vector, Vector],
    X_hds: Vector,
    Z_hds: Vector,
    front: Vector,
    leg: LegModel,
) -> tuple[Vector, Vector]:
    """Computes gaps (Eq. 5), (n,), m, and knees, (n, 2), m, of the legs."""
    soles, angles = (part.reshape(-1, 6) for part in legs)
    points, knee = outline_points(leg, FEET[0], angles, soles)
    hip = np.repeat(np.column_stack([X_hds, Z_hds]), 2, axis=0)
    origin = np.repeat(np.column_stack([front, np.zeros(len(front))]), 2, axis=0)
    thigh = np.stack([knee[:, ::2], hip], axis=1)
    gaps = [
        outline_gap(line - origin[:, None], section)
        for line in (points[:, :, ::2], thigh)
    ]
    gap = np.minimum(*gaps).reshape(-1, 2).min(axis=1)
    return gap, knee[:, 0].reshape(-1, 2)


def check_about(
    section: Section,
    X_ads: Vector,
    X_hds: Vector,
    Z_hds: Vector,
    front: Vector,
    leg: LegModel,
    travel: float,
    margin: float,
) -> Checked:
    """The worst of `check_double_support` while the waist is within X_hds +- travel.

    Of the knees those at the middle. Gap and knees are looked at only where the legs
    are in reach and keep a margin, rad, from their limits; -inf and nan elsewhere.
    """
    n = len(X_ads)
    hips = (X_hds + np.array([[-travel], [0.0], [travel]])).ravel()
    heights = np.tile(Z_hds, 3)
    legs = _legs(np.tile(X_ads, 3), hips, heights, leg)
    checked = Checked(
        legs.reached.reshape(3, n).min(axis=0),
        legs.limits.reshape(3, n, 6).max(axis=0),
        np.full(n, -np.inf),
        np.full((n, 2), np.nan),
    )
    within = checked.within(margin)
    if within.any():
        kept = np.tile(within, 3)
        gap, knees = _clearance(
            section,
            (legs.soles[kept], legs.angles[kept]),
            hips[kept],
            heights[kept],
            np.tile(front[within], 3),
            leg,
        )
        checked.gap[within] = gap.reshape(3, -1).min(axis=0)
        checked.knees[within] = knees.reshape(3, -1, 2)[1]
    return checked


def step_lengths(least: float, params: FeasibilityParams) -> Iterator[Vector]:
    """Step lengths to look at in one pass each, m, the shortest first.

    The least step itself, at which toe and heel touch the margins, is not among them.
    """
    most, by = params.max_step_length + 1e-9, params.step_increment
    lengths = np.arange(least, most, by)[1:]
    for first in range(0, len(lengths), BATCH):
        yield lengths[first : first + BATCH]


def feasibility_unit(
    section: Section, walking_waist: float, leg: LegModel, params: FeasibilityParams
) -> Feasibility:
    """The key configuration, by the paper's search.

    It begins with the least step length that straddles the obstacle and the waist as
    high as in walking; the waist is lowered and the step length raised until the double
    support reaches the ground on both sides and meets nothing.

    Args:
        section: the obstacle: o_w, o_h.
        walking_waist: height of the hips above the ground in walking, m.
        leg: the legs.
        params: margins and increments.

    Returns:
        The key configuration, or the constraint that no configuration meets.
    """
    params.validate()
    x0, x1, top = section.inflated(params.s_w, params.s_h)
    inflated = Section(x1 - x0, top)
    toe, heel = leg.outline.toe, leg.outline.heel
    least = toe + heel + inflated.width
    shortest = least + params.step_increment
    if shortest > params.max_step_length + 1e-9:
        return Feasibility(
            constraint=f"the obstacle is {section.width:.2f} m wide: a step over it is "
            f"{shortest:.2f} m long at least, more than {params.max_step_length:.2f} m"
        )
    heights = np.arange(
        walking_waist, params.lowest_waist - 1e-9, -params.height_increment
    )
    margin = params.joint_margin
    tried: list[Checked] = []
    for lengths in step_lengths(least, params):
        X, Z, share = (
            grid.ravel()
            for grid in np.meshgrid(lengths, heights, SLACKS, indexing="ij")
        )
        front = toe + share * (X - least)
        hips = params.delta_ds * X
        checked = check_about(
            inflated, X, hips, Z, front, leg, params.waist_travel, margin
        )
        free: Mask = checked.gap > 0.0
        if free.any():
            best = int(np.argmax(free))
            key = KeyConfiguration(
                float(X[best]),
                float(hips[best]),
                float(Z[best]),
                float(front[best] - x0),
            )
            return Feasibility(key)
        tried.append(checked)
    every = Checked(*map(np.concatenate, zip(*tried, strict=True)))
    return Feasibility(constraint=failing(every, margin, section))


def failing(checked: Checked, margin: float, section: Section) -> str:
    """The constraint that no configuration meets, in one line.

    Args:
        checked: all configurations.
        margin: kept from the joint limits, rad.
        section: the obstacle.
    """
    what = f"an obstacle {section.height:.2f} m high and {section.width:.2f} m wide"
    within = checked.within(margin)
    if within.any():
        # Rounded up, for what meets the obstacle is never 0 mm deep in it.
        depth = ceil(-1e3 * float(checked.gap[within].max()))
        return (
            f"Eq. 5: over {what} no double support keeps the legs off the obstacle and "
            f"its margins; the best is {depth} mm too deep"
        )
    if not (checked.reached > 0.5).any():
        return f"Eq. 1: over {what} the legs are too short for any double support"
    excess = checked.limits[checked.reached > 0.5] + margin
    joint = int(np.argmax(excess[np.argmin(excess.max(axis=1))]))
    return f"Eq. 1: over {what} the {JOINTS[joint]} reaches its limit"
