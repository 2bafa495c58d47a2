"""What an obstacle crossing is measured by, from the truth of the plant."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from footfall.diagrams.judge.box_clearance import BoxClearance, crossed
from footfall.diagrams.judge.measures import LIFTED, contact_intervals
from footfall.diagrams.judge.true_motion import TrueMotion
from footfall.models.scenes.solids import Box
from footfall.models.values.feet import FEET, Foot
from footfall.models.values.obstacle import Obstacle, ObstacleMap
from footfall.models.values.value import Json, to_json
from footfall.models.values.vector import Vector
from footfall.systems.planning.crossing.report import CrossingReport

LANDING_TIME = 0.05
"""After touch-down a foot's force counts as impact for this long, s; later it is the
weight that the robot puts on it."""
SAME = 0.3
"""What was seen within this of a true obstacle is that obstacle, m."""


@dataclass(frozen=True)
class CrossingEvidence:
    """What the judge is shown of an obstacle crossing."""

    boxes: tuple[Box, ...]
    """The true obstacles."""
    clearances: tuple[BoxClearance, ...]
    """How near the robot came to each that it came near to."""
    maps: tuple[ObstacleMap, ...]
    """What the eyes saw, one entry a sweep."""
    reports: tuple[CrossingReport, ...]
    """What the planner says of its motions."""


@dataclass(frozen=True)
class CrossingMeasures:
    """One box that was crossed."""

    time: float
    """From the first foot's lift-off to the second's touch-down: phases 1 to 3, s."""
    impact: float | None
    """Largest mean upward force on a crossing foot as it lands, in body weights; None
    where it was not measured."""


def midpoints(motion: TrueMotion) -> Vector:
    """Midpoint of the feet over time, (n, 2), m."""
    both = [motion.X_WF[foot][:, :2, 3] for foot in FEET]
    middle: Vector = np.mean(both, axis=0)
    return middle


def measure_crossing(
    motion: TrueMotion,
    loads: Mapping[Foot, Vector],
    felt: Mapping[Foot, Vector] | None,
    weight: float,
    box: Box,
) -> CrossingMeasures | None:
    """Phases 1 to 3 over one box; None where not both feet crossed it.

    A foot that passes beside the box's end has not crossed it.

    Args:
        motion: where the feet truly were.
        loads: upward force on each foot, (n,), N.
        felt: the same averaged over the time that impacts are, (n,), N; None where it
            was not measured.
        weight: of the robot, N.
        box: which.
    """
    lifts, lands, impacts = [], [], []
    crossed_by: set[Foot] = set()
    for foot in FEET:
        p_W = motion.X_WF[foot][:, :3, 3]
        p_B = np.array(box.X_WB.inverse().multiply(p_W.T)).T
        thin = int(np.argmin(box.size[:2]))
        intervals = contact_intervals(loads[foot], weight)
        for before, after in pairwise(intervals):
            # A foot may stand long before it is loaded, where the robot goes slowly.
            in_air = loads[foot][before.end : after.start + 1]
            start = before.end - 1
            end = before.end + int(np.argmax(in_air > LIFTED * weight))
            if _passes_over(p_B[start : end + 1], thin, box):
                crossed_by.add(foot)
                lifts.append(float(motion.time[start]))
                lands.append(float(motion.time[end]))
                landing = (motion.time >= motion.time[end]) & (
                    motion.time <= motion.time[end] + LANDING_TIME
                )
                if felt is not None:
                    impacts.append(float(felt[foot][landing].max() / weight))
    if len(crossed_by) < len(FEET):
        return None
    return CrossingMeasures(max(lands) - min(lifts), max(impacts) if impacts else None)


def _passes_over(p_B: Vector, thin: int, box: Box) -> bool:
    """Tells whether a path in the box's frame, (n, 3), crosses it, not past its end.

    Args:
        p_B: m.
        thin: the axis across the box.
        box: which.
    """
    if not p_B[0, thin] * p_B[-1, thin] < 0.0:
        return False
    middle = int(np.argmin(np.abs(p_B[:, thin])))
    return bool(abs(p_B[middle, 1 - thin]) <= box.size[1 - thin] / 2.0)


def obstacles_crossed(motion: TrueMotion, boxes: Sequence[Box]) -> int:
    """Counts the boxes that the feet, or one of them, went over and ended beyond."""
    paths = [midpoints(motion), *(motion.X_WF[foot][:, :2, 3] for foot in FEET)]
    return sum(any(crossed(path, box) for path in paths) for box in boxes)


def obstacle_map_errors(evidence: CrossingEvidence) -> dict[str, Json]:
    """Compares the obstacles that were seen with the true ones.

    `frames`, then over all that were seen the mean and the largest error of the width,
    the height and the distance of the front face (m) and of the yaw (deg); None
    without any.
    """
    errors = [
        error
        for seen in evidence.maps
        for obstacle in seen.obstacles
        if (error := _errors(obstacle, seen.floor_height, evidence.boxes)) is not None
    ]
    summary: dict[str, Json] = {}
    if errors:
        names = ("width_m", "height_m", "front_m", "yaw_deg")
        for name, column in zip(names, np.abs(errors).T, strict=True):
            summary[f"mean_{name}"] = round(float(column.mean()), 5)
            summary[f"max_{name}"] = round(float(column.max()), 5)
    return {"frames": len(evidence.maps), "errors": summary or None}


def _errors(obstacle: Obstacle, floor: float, boxes: Sequence[Box]) -> Vector | None:
    if not boxes:
        return None
    box = min(
        boxes,
        key=lambda item: float(
            np.linalg.norm(item.X_WB.translation()[:2] - obstacle.center)
        ),
    )
    middle = box.X_WB.translation()[:2]
    if np.linalg.norm(middle - obstacle.center) > SAME:
        return None
    thin = int(np.argmin(box.size[:2]))
    across = np.array(box.X_WB.rotation().matrix()[:2, thin])
    ahead = np.array([np.cos(obstacle.yaw), np.sin(obstacle.yaw)])
    across = across if across @ ahead >= 0.0 else -across
    turn = np.degrees(
        np.arcsin(np.clip(across[0] * ahead[1] - across[1] * ahead[0], -1, 1))
    )
    true_front = box.X_WB.translation()[:2] @ across - box.size[thin] / 2.0
    front = obstacle.center @ across - obstacle.width / 2.0
    height = box.X_WB.translation()[2] + box.size[2] / 2.0
    return np.array(
        [
            obstacle.width - box.size[thin],
            obstacle.height - (height - floor),
            front - true_front,
            turn,
        ]
    )


def planning_summary(reports: Sequence[CrossingReport]) -> dict[str, Json] | None:
    """Gives the planner's figures of its crossings, the worst of each; None if none.

    ZMP errors are (x, y), m, over phases 1 to 3, of the multibody ZMP to its reference.
    Static margin and torque are those of a quasi-static plan, None of a dynamic one.
    """
    reports = [report for report in reports if report.obstacles]
    if not reports:
        return None
    before = np.max([report.zmp_error_before for report in reports], axis=0)
    after = np.max([report.zmp_error_after for report in reports], axis=0)
    times = [sum(ms for _, ms in report.planning_ms) for report in reports]
    balances = [report.balance for report in reports if report.balance]
    return {
        "zmp_error_after_cwtg1_m": to_json(np.round(before, 5)),
        "zmp_error_after_cwtg2_m": to_json(np.round(after, 5)),
        "planned_gap_m": round(min(report.gap for report in reports), 5),
        "static_margin_m": min((round(b.margin, 5) for b in balances), default=None),
        "static_torque_fraction": max(
            (round(b.torque_share, 3) for b in balances), default=None
        ),
        "planning_ms": round(max(times), 1),
        "keys": [to_json(key) for report in reports for key in report.keys],
        "repairs": [to_json(report.repairs) for report in reports],
    }
