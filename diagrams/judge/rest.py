"""Whether a robot has come to rest, from its true state alone; pure."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import shapely  # type: ignore[import-untyped]

from footfall.diagrams.judge.ground import (
    ABOVE,
    DEEP,
    SOLE_ON_GROUND,
    Ground,
    carried_outlines,
    corner_heights,
    share_over,
    sole_outlines,
)
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.vector import Vector

REST_TIME = 1.0
"""For so long on end a robot must be at rest, s."""
BEARS = 0.1
"""Share of the weight that each sole bears at rest."""
UPRIGHT = np.deg2rad(15.0)
"""The torso leans no more than this, rad."""
DCM_MARGIN = 0.02
"""The DCM is inside the support by this, m."""
STILL = 0.02
"""The CoM is slower than this, m/s."""
LONGEST_GAP = 0.02
"""Between two samples; what happens in a longer one is not known, s."""
GRAVITY = 9.81
OVERLAP = 1e-6
"""Soles that share more than this of the ground are inside each other, m^2."""

Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]


@dataclass(frozen=True)
class RestFigures:
    """What rest is judged by, over n samples; nan where it is not known."""

    time: Vector
    """(n,), s."""
    heights: Mapping[Foot, Vector]
    """Of each sole's corners above the ground it should stand on, (n, 4), m."""
    over: Mapping[Foot, Vector]
    """Share of each sole over that ground, (n,)."""
    overlap: Vector
    """What the soles share of the ground, (n,), m^2."""
    loads: Mapping[Foot, Vector]
    """Upward force on each foot as a share of the weight, (n,)."""
    tilt: Vector
    """Of the torso, (n,), rad."""
    dcm_margin: Vector
    """Distance of the true DCM to the edge of the support, positive inside, (n,), m."""
    speed: Vector
    """Of the CoM, (n,), m/s."""


def true_dcm(motion: TrueMotion) -> Vector:
    """CoM + v / omega, (n, 2), m, with omega^2 = g over the CoM's height.

    The height is that above the mean of the soles' origins.
    """
    soles = np.mean([motion.X_WF[foot][:, 2, 3] for foot in FEET], axis=0)
    height = np.maximum(motion.com[:, 2] - soles, 1e-6)
    omega = np.sqrt(GRAVITY / height)
    dcm: Vector = motion.com[:, :2] + motion.com_velocity[:, :2] / omega[:, None]
    return dcm


def support_margin(points: Vector, motion: TrueMotion, ground: Ground) -> Vector:
    """Distance of points to the edge of the support, positive inside, (n,), m.

    The support is the hull of what of the two soles lies over the ground, seen from
    above.

    Args:
        points: (n, 2), m.
        motion: whose soles, n samples.
        ground: which.
    """
    soles = [carried_outlines(motion.sole_corners[foot], ground) for foot in FEET]
    hulls = shapely.convex_hull(shapely.union(*soles))
    places = shapely.points(points)
    distance = shapely.distance(shapely.boundary(hulls), places)
    inside = shapely.contains(hulls, places)
    margin: Vector = np.where(inside, distance, -distance)
    margin[shapely.is_empty(hulls)] = -np.inf
    return margin


def rest_figures(
    motion: TrueMotion,
    loads: Mapping[Foot, Vector] | None,
    weight: float,
    ground: Ground,
) -> RestFigures:
    """Measures a motion by what rest is judged by.

    Args:
        motion: n samples.
        loads: upward force on each foot, (n,), N; None where unknown.
        weight: of the robot, N.
        ground: what both soles should stand on.
    """
    unknown = np.full(len(motion.time), np.nan)
    corners = motion.sole_corners
    outlines = [sole_outlines(corners[foot]) for foot in FEET]
    return RestFigures(
        time=motion.time,
        heights={foot: corner_heights(corners[foot], ground) for foot in FEET},
        over={foot: share_over(corners[foot], ground) for foot in FEET},
        overlap=shapely.area(shapely.intersection(*outlines)),
        loads={foot: loads[foot] / weight if loads else unknown for foot in FEET},
        tilt=np.arccos(np.clip(motion.torso_up, -1.0, 1.0)),
        dcm_margin=support_margin(true_dcm(motion), motion, ground),
        speed=np.linalg.norm(motion.com_velocity, axis=1),
    )


def at_rest(figures: RestFigures) -> Flags:
    """Tells whether the robot is at rest, (n,); never where a figure is not known."""
    # Every comparison with nan is false, and so speaks against rest.
    rests = (
        (figures.overlap <= OVERLAP)
        & (figures.tilt <= UPRIGHT)
        & (figures.dcm_margin >= DCM_MARGIN)
        & (figures.speed < STILL)
    )
    for foot in FEET:
        heights = figures.heights[foot]
        rests &= (heights <= ABOVE).all(axis=1) & (heights >= -DEEP).all(axis=1)
        rests &= figures.over[foot] >= SOLE_ON_GROUND
        rests &= figures.loads[foot] >= BEARS
    return np.asarray(rests)


def rest_faults(figures: RestFigures, ground: Ground) -> list[str]:
    """Says why the last `REST_TIME` of a motion was no rest; empty where it was.

    Args:
        figures: of the motion to its end.
        ground: what both soles should stand on.
    """
    time = figures.time
    last = time >= time[-1] - REST_TIME - 1e-6
    if time[last][0] > time[-1] - REST_TIME + 1e-6:
        return [f"it was not watched for {REST_TIME:g} s"]
    if np.diff(time[last]).max(initial=0.0) > LONGEST_GAP:
        return [f"its last {REST_TIME:g} s were not all recorded"]
    if at_rest(figures)[last].all():
        return []
    faults = [
        fault for foot in FEET for fault in _sole_faults(figures, foot, last, ground)
    ]
    if not (figures.overlap[last] <= OVERLAP).all():
        faults.append("one sole is inside the other")
    tilt, margin = figures.tilt[last], figures.dcm_margin[last]
    speed = figures.speed[last]
    if not (tilt <= UPRIGHT).all():
        faults.append(f"the torso leans by {np.degrees(tilt.max()):.0f} deg")
    if not (margin >= DCM_MARGIN).all():
        faults.append(f"the DCM is {1e3 * margin.min():.0f} mm inside the support")
    if not (speed < STILL).all():
        faults.append(f"the CoM moves at {1e2 * speed.max():.1f} cm/s")
    return faults


def _sole_faults(
    figures: RestFigures, foot: Foot, last: Flags, ground: Ground
) -> list[str]:
    faults = []
    heights, over = figures.heights[foot][last], figures.over[foot][last]
    load = figures.loads[foot][last]
    if not ((heights <= ABOVE) & (heights >= -DEEP)).all():
        low, high = 1e3 * heights.min(), 1e3 * heights.max()
        faults.append(
            f"the {foot} sole is not flat on {ground.name} "
            f"(corners {low:.0f} to {high:.0f} mm above it)"
        )
    elif not (over >= SOLE_ON_GROUND).all():
        faults.append(
            f"the {foot} sole is not on {ground.name} ({100 * over.min():.0f} % of it)"
        )
    if np.isnan(load).any():
        faults.append(f"what the {foot} sole bears was not measured")
    elif not (load >= BEARS).all():
        faults.append(
            f"the {foot} sole bears {100 * load.min():.0f} % of the weight alone"
        )
    return faults
