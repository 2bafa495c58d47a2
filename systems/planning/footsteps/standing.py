"""What the robot stands on, from where its feet are and what was seen."""

from collections.abc import Mapping
from math import degrees

import numpy as np
from pydrake.math import RigidTransform

from footfall.models.robots.robot import Sole
from footfall.models.values.feet import Foot, other_foot
from footfall.models.values.perceived import PlaneSegment, Staircase
from footfall.models.values.vector import Vector
from footfall.systems.planning.footsteps.foothold import (
    Refusal,
    plane_height,
    sole_centre,
    tilt,
)
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams

FLOOR = -1
"""Stands for the floor where a tread's index is meant."""
HIDDEN = -2
"""Stands for a ground under the feet that was not seen: the robot hides it."""


def standing_on(
    staircase: Staircase,
    feet: Mapping[Foot, RigidTransform],
    params: FootstepPlannerParams,
    sole: Sole,
) -> int | Refusal:
    """The tread under both feet, FLOOR, or HIDDEN where the robot hides its tread."""
    poses = {
        f: (X.translation(), tilt(X.rotation().matrix()[:, 2])) for f, X in feet.items()
    }
    for f, (_, slope) in poses.items():
        if slope > params.max_slope:
            return Refusal(
                f"the {f} sole is tilted by {degrees(slope):.1f} deg, more than "
                f"{degrees(params.max_slope):.1f} deg"
            )
    rise = float(poses["left"][0][2] - poses["right"][0][2])
    if abs(rise) > params.height_tolerance:
        upper: Foot = "left" if rise > 0.0 else "right"
        return Refusal(
            f"the {upper} foot stands {abs(rise):.3f} m above the {other_foot(upper)} "
            f"one, more than {params.height_tolerance:.3f} m"
        )
    apart = (feet["right"].inverse() @ feet["left"]).translation()[1]
    if apart < 2.0 * sole.half_width:
        return Refusal(
            f"the left foot is {apart:.3f} m to the left of the right one, less than "
            f"the {2.0 * sole.half_width:.3f} m that the soles take"
        )
    centres = [sole_centre(X, sole) for X in feet.values()]
    planes = dict(enumerate(staircase.treads))
    gaps = {
        i: max(abs(float(c[2]) - plane_height(tread, c[:2])) for c in centres)
        for i, tread in planes.items()
        if all(_beside(tread, c) <= params.support_reach for c in centres)
    }
    floor = staircase.floor
    if floor is not None:
        gaps[FLOOR] = max(
            abs(float(c[2]) - plane_height(floor, c[:2])) for c in centres
        )
    if gaps:
        nearest = min(gaps, key=lambda i: gaps[i])
        if gaps[nearest] <= params.height_tolerance:
            return nearest
    for i, tread in planes.items():
        if all(_beside(tread, c) <= 0.0 for c in centres):
            return Refusal(
                f"the feet are {gaps[i]:.3f} m off the height of tread {i + 1} "
                "where they stand"
            )
    z = float(np.mean([c[2] for c in centres]))
    if floor is not None and z < plane_height(floor, np.mean(centres, axis=0)[:2]):
        return Refusal(
            f"the feet are {gaps[FLOOR]:.3f} m below the floor that was seen"
        )
    return HIDDEN


def _beside(plane: PlaneSegment, p: Vector) -> float:
    """Horizontal distance of p (3,) from the plane's rectangle, m; 0 inside."""
    p_R = np.abs(np.array(plane.X_WR.inverse().multiply(p))[:2]) - plane.size / 2.0
    return float(np.linalg.norm(np.maximum(p_R, 0.0)))
