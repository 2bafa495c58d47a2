"""Where a sole fits on a tread: the middle of its rectangle, kept off the edges.

Stair frame S here: W turned about z by the staircase's yaw (same origin), so that x_S
points up the stairs and y_S to the left of a robot that climbs them.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import acos, atan2, cos, sin

import numpy as np
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import Foot
from footfall.models.values.geometry import heading, rotate
from footfall.models.values.perceived import PlaneSegment
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

SIDE: Mapping[Foot, float] = {"left": 1.0, "right": -1.0}
"""Sign of a foot's lateral position."""


@dataclass(frozen=True)
class Refusal:
    """Why the planner does not step there, in one line."""

    reason: str


def wrap(angle: float) -> float:
    """The same angle within -pi and pi, rad."""
    return atan2(sin(angle), cos(angle))


def tilt(normal: Vector) -> float:
    """Angle between a unit normal (3,) and the vertical, rad."""
    return acos(min(1.0, max(-1.0, float(normal[2]))))


def plane_height(plane: PlaneSegment, p: Vector) -> float:
    """Height in W, m, of the unbounded plane over the horizontal point p (2,), m."""
    centre = plane.X_WR.translation()
    n = plane.normal
    return float(centre[2] - (n[:2] @ (p - centre[:2])) / n[2])


def sole_outline(sole: Sole) -> Vector:
    """The sole's corners in its frame F, (4, 2), m, counter-clockwise from above."""
    b, f, w = -sole.heel, sole.toe, sole.half_width
    return np.array([[b, -w], [f, -w], [f, w], [b, w]])


def sole_corners(X_WF: RigidTransform, sole: Sole) -> Vector:
    """The sole's corners in W, (4, 3), m."""
    p_F = np.hstack([sole_outline(sole), np.zeros((4, 1))])
    return np.array(X_WF.multiply(p_F.T)).T


def sole_centre(X_WF: RigidTransform, sole: Sole) -> Vector:
    """The middle of the sole in W, (3,), m."""
    p_F: Vector = np.array([(sole.toe - sole.heel) / 2.0, 0.0, 0.0])
    return np.array(X_WF.multiply(p_F))


def sole_pose(
    plane: PlaneSegment, p: Vector, yaw: float, sole: Sole, flat_tolerance: float
) -> RigidTransform:
    """Pose X_WF of a sole that stands on a plane.

    Args:
        plane: what it stands on.
        p: horizontal position of F's origin in W, (2,), m.
        yaw: heading of the sole in W, rad.
        sole: the sole, which meets a nearly level plane under its middle.
        flat_tolerance: planes that tilt less, rad, get a level sole, the others one
            along the plane.
    """
    if tilt(plane.normal) <= flat_tolerance:
        middle = p + rotate(yaw, np.array([(sole.toe - sole.heel) / 2.0, 0.0]))
        p_WF: Vector = np.array([*p, plane_height(plane, middle)])
        return RigidTransform(RollPitchYaw(0.0, 0.0, yaw), p_WF)
    z_W = plane.normal
    y_W = np.cross(z_W, [cos(yaw), sin(yaw), 0.0])
    y_W /= np.linalg.norm(y_W)
    R_WF: Vector = np.column_stack([np.cross(y_W, z_W), y_W, z_W])
    p_WF = np.array([*p, plane_height(plane, p)])
    return RigidTransform(RotationMatrix(R_WF), p_WF)


def lateral_interval(
    tread: PlaneSegment, yaw: float, sole: Sole, margin: float
) -> tuple[float, float]:
    """The y_S of the sole frames, m, at which a sole fits between the tread's sides.

    Args:
        tread: the rectangle.
        yaw: the staircase's yaw, which the soles have, rad.
        sole: the sole.
        margin: distance to keep from the sides, m.

    Returns:
        The least and the largest y_S; the first is the larger where none fits.
    """
    turn = wrap(heading(tread.X_WR) - yaw)
    half = np.abs(rotate(-turn, sole_outline(sole))[:, 1]).max()
    room = (tread.size[1] / 2.0 - margin - half) * cos(turn)
    room -= abs(sin(turn)) * tread.size[0] / 2.0
    middle = rotate(-yaw, tread.X_WR.translation()[:2])[1]
    return middle - room, middle + room


def front_edge(tread: PlaneSegment, yaw: float, y: float) -> float:
    """The x_S of the tread's front edge at the lateral position y_S, m."""
    corners = rotate(-yaw, tread.corners()[:, :2])
    (x0, y0), (x1, y1) = corners[0], corners[3]
    return float(x0 + (y - y0) * (x1 - x0) / (y1 - y0))


def foothold_x(
    tread: PlaneSegment,
    above: PlaneSegment | None,
    yaw: float,
    y: float,
    y_middle: float,
    sole: Sole,
    params: FootstepPlannerParams,
) -> float | Refusal:
    """How far up the stairs a foot stands on a tread (paper Sec. 6.1).

    The middle of the sole goes to the middle of the tread, halfway between its front
    edge and its back edge (or the next tread's front edge where that hangs over it),
    and as far from there as margins and `foothold_bias` ask; on a landing it goes to
    `landing_foothold` from the front edge. Both feet get the same
    x_S unless the tread is turned so far that one of them would not fit.

    Args:
        tread: the rectangle to stand on.
        above: the next tread up, where one is known.
        yaw: the staircase's yaw, which the soles have, rad.
        y: lateral position y_S of the sole frame, m.
        y_middle: y_S midway between the feet, m.
        sole: the sole.
        params: margins.

    Returns:
        x_S of the sole frame, m, or why the tread is too shallow.
    """
    turn = wrap(heading(tread.X_WR) - yaw)
    outline = rotate(-turn, sole_outline(sole))
    heel, toe = outline[:, 0].min(), outline[:, 0].max()
    front = back = tread.size[0] / 2.0
    if tread.size[0] > params.landing_depth:
        room = max(2.0 * params.landing_foothold, toe - heel + 2.0 * params.edge_margin)
        back = min(front, room - front)
    centre = rotate(-yaw, tread.X_WR.translation()[:2])
    if above is not None:
        for side in (-sole.half_width, sole.half_width):
            x = front_edge(above, yaw, y + side) - centre[0]
            back = min(back, x * cos(turn) + (y + side - centre[1]) * sin(turn))
    last = back - params.edge_margin - toe
    first = -front + params.edge_margin - heel
    if first > last:
        overhang = -front - (last + heel)
        if overhang > params.max_heel_overhang + 1e-9:
            return Refusal(
                f"is {front + back:.3f} m deep, too shallow for the "
                f"{sole.length:.3f} m sole: its heel would stand out by "
                f"{overhang:.3f} m, more than {params.max_heel_overhang:.3f} m"
            )
        first = last
    wanted = (back - front - heel - toe) / 2.0 + params.foothold_bias
    wanted += sin(turn) * (y - y_middle)
    x_R = min(max(wanted, first), last)
    return float(centre[0] + (x_R - sin(turn) * (y - centre[1])) / cos(turn))


def min_width(turn: float, foot: Foot, sole: Sole, gap: float) -> float:
    """Least lateral distance of a foot from the stance foot, m.

    Beyond it the two soles are apart by `gap` whatever their sagittal distance.

    Args:
        turn: yaw of the foot in the stance foot's frame, rad.
        foot: the foot that steps.
        sole: both soles.
        gap: distance to keep, m.
    """
    inward = rotate(turn, sole_outline(sole))[:, 1] * -SIDE[foot]
    return float(sole.half_width + gap + inward.max())
