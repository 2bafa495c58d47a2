"""FU: can the robot step over an obstacle, and in which key configuration?

Obstacle paper (Stasse et al. 2009), Sec. II and III-A. The plane across the obstacle:
the rear ankle at x = 0, the front ankle at X_ads, the waist at (X_hds, Z_hds).
"""

from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from models.validation import require_at_least, require_positive
from systems.obstacle_values import Feasibility, KeyConfiguration
from systems.planning.leg_clearance import Section, outline_gap
from systems.planning.leg_model import LegModel, leg_angles, outline_points, rotations
from systems.ports import Vector
from systems.values import FEET

Mask: TypeAlias = np.ndarray[Any, np.dtype[np.bool_]]

JOINTS = ("hip pitch", "hip roll", "hip yaw", "knee", "ankle roll", "ankle pitch")
SLACKS = (0.5, 0.25, 0.75, 0.0, 1.0)
"""Where the obstacle lies in the room between the feet, tried in this order."""


@dataclass(kw_only=True)
class FeasibilityParams:
    """What the feasibility unit searches and with which margins."""

    s_w: float = 0.045
    """Margin on either side of the obstacle, m. The paper has 3 cm; what the eyes and
    the feet err is added, so that 3 cm remain to the true one."""
    s_h: float = 0.045
    """Margin above the obstacle, m; likewise."""
    delta_ds: float = 0.5
    """delta_DS of Eq. 22: share of the step length at which the waist is."""
    waist_travel: float = 0.08
    """How far before and behind X_hds the waist is while both feet are down, m: the
    double support is short, but not nothing."""
    step_increment: float = 0.01
    """By which the step length is raised, m."""
    height_increment: float = 0.01
    """By which the waist is lowered, m."""
    max_step_length: float = 0.56
    """Longest step, m: beyond it the swing asks more speed and torque than there is."""
    lowest_waist: float = 0.62
    """Lowest waist, m: below it the knees ask for more torque than there is."""
    joint_margin: float = 0.05
    """Kept from the joint limits, rad, as the motion about the key configuration and
    its tracking need some."""

    def validate(self) -> None:
        """Checks every field.

        Raises:
            ValueError: "field: reason, got x" for the first field that is wrong.
        """
        for name in ("s_w", "s_h", "joint_margin", "waist_travel"):
            require_at_least(name, getattr(self, name), 0.0)
        for name in (
            "step_increment",
            "height_increment",
            "max_step_length",
            "lowest_waist",
        ):
            require_positive(name, getattr(self, name), "m")
        if not 0.0 < self.delta_ds < 1.0:
            raise ValueError(f"delta_ds: must lie in (0, 1), got {self.delta_ds:g}")


class Checked(NamedTuple):
    """Which constraints configurations of the double support meet."""

    reached: Vector
    """Eq. 1: both ankles are within reach of the hips, (n,), 0 or 1."""
    limits: Vector
    """Eq. 1: by how much each joint of either leg exceeds its limits, (n, 6), rad;
    not positive where it does not."""
    gap: Vector
    """Eq. 5: distance of the legs to the obstacle, (n,), m: below the knee their
    outline, above it the line to the hip."""
    knees: Vector
    """Rear ankle to the knee of the rear and of the front leg, (n, 2), m."""


def check_double_support(
    section: Section,
    X_ads: Vector,
    X_hds: Vector,
    Z_hds: Vector,
    front: Vector,
    leg: LegModel,
) -> Checked:
    """Eqs. 1, 3, 4 and 5 for configurations of the double support.

    Args:
        section: the obstacle.
        X_ads: step lengths, (n,), m.
        X_hds: rear ankle to waist, (n,), m.
        Z_hds: heights of the waist, (n,), m.
        front: rear ankle to the front face, (n,), m.
        leg: the legs.
    """
    n = len(X_ads)
    upright = rotations(np.zeros((n, 3)))
    reached, gap = np.ones(n), np.full(n, np.inf)
    limits, knees = np.full((n, 6), -np.inf), np.zeros((n, 2))
    for i, foot in enumerate(FEET):
        sole = np.zeros((n, 6))
        sole[:, 0] = 0.0 if i == 0 else X_ads
        waist = np.column_stack([X_hds, -leg.hips[foot][1] * np.ones(n), Z_hds])
        waist[:, 0] -= leg.hips[foot][0]
        waist[:, 2] -= leg.hips[foot][2]
        found = leg_angles(leg, foot, waist, upright, sole)
        reached = np.where(found.short > 0.0, 0.0, reached)
        beyond = np.maximum(found.angles - leg.upper[i], leg.lower[i] - found.angles)
        limits = np.maximum(limits, beyond)
        points, knee = outline_points(leg, foot, found.angles, sole)
        knees[:, i] = knee[:, 0]
        hip = np.column_stack([X_hds, np.zeros(n), Z_hds])
        thigh = np.stack([knee, hip], axis=1)
        for line in (points, thigh):
            planar = line[:, :, [0, 2]].copy()
            planar[:, :, 0] -= front[:, None]
            gap = np.minimum(gap, outline_gap(planar, section))
    return Checked(reached, limits, gap, knees)


def check_about(
    section: Section,
    X_ads: Vector,
    X_hds: Vector,
    Z_hds: Vector,
    front: Vector,
    leg: LegModel,
    travel: float,
) -> Checked:
    """The worst of `check_double_support` while the waist is within X_hds +- travel.

    Of the knees those at the middle.
    """
    parts = [
        check_double_support(section, X_ads, X_hds + way, Z_hds, front, leg)
        for way in (-travel, 0.0, travel)
    ]
    return Checked(
        np.min([part.reached for part in parts], axis=0),
        np.max([part.limits for part in parts], axis=0),
        np.min([part.gap for part in parts], axis=0),
        parts[1].knees,
    )


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
    if least > params.max_step_length:
        return Feasibility(
            constraint=f"the obstacle is {section.width:.2f} m wide: a step over it is "
            f"{least:.2f} m long at least, more than {params.max_step_length:.2f} m"
        )
    heights = np.arange(
        walking_waist, params.lowest_waist - 1e-9, -params.height_increment
    )
    Z, share = (grid.ravel() for grid in np.meshgrid(heights, SLACKS, indexing="ij"))
    margin = params.joint_margin
    tried: list[tuple[Checked, Mask]] = []
    for X_ads in np.arange(least, params.max_step_length + 1e-9, params.step_increment):
        X = np.full(len(Z), X_ads)
        front = toe + share * (X - least)
        hips = params.delta_ds * X
        checked = check_about(inflated, X, hips, Z, front, leg, params.waist_travel)
        within: Mask = (checked.reached > 0.5) & (checked.limits <= -margin).all(axis=1)
        free: Mask = within & (checked.gap > 0.0)
        if free.any():
            best = int(np.argmax(free))
            key = KeyConfiguration(
                float(X_ads),
                float(hips[best]),
                float(Z[best]),
                float(front[best] - x0),
            )
            return Feasibility(key)
        tried.append((checked, within))
    every = Checked(
        *map(np.concatenate, zip(*(part for part, _ in tried), strict=True))
    )
    inside: Mask = np.concatenate([within for _, within in tried])
    return Feasibility(constraint=failing(every, inside, margin, section))


def failing(checked: Checked, within: Mask, margin: float, section: Section) -> str:
    """The constraint that no configuration meets, in one line.

    Args:
        checked: all configurations.
        within: those that are in reach and within the joint limits, (n,).
        margin: kept from the joint limits, rad.
        section: the obstacle.
    """
    what = f"an obstacle {section.height:.2f} m high and {section.width:.2f} m wide"
    if within.any():
        short = -float(checked.gap[within].max())
        return (
            f"Eq. 5: over {what} no double support keeps the legs off the obstacle and "
            f"its margins; the best is {1e3 * short:.0f} mm too deep"
        )
    if not (checked.reached > 0.5).any():
        return f"Eq. 1: over {what} the legs are too short for any double support"
    excess = checked.limits[checked.reached > 0.5] + margin
    joint = int(np.argmax(excess[np.argmin(excess.max(axis=1))]))
    return f"Eq. 1: over {what} the {JOINTS[joint]} reaches its limit"
