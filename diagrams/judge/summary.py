"""The summary of a run: what `summary.json` holds."""

import json
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from importlib.metadata import version
from pathlib import Path

import numpy as np
from pydrake.systems.framework import Diagram

from footfall.diagrams.closed_loop.leaf_systems import leaf_systems
from footfall.diagrams.judge.outcome import Judgement
from footfall.models.scenes.tread import Tread
from footfall.models.values.perceived import PlaneSegment, PlaneSegmentation, Staircase
from footfall.models.values.value import Json, to_json
from footfall.models.values.vector import Vector
from footfall.systems.timing import stopwatch

PACKAGES = ("footfall", "drake", "numpy", "scipy", "open3d-cpu", "daqp")
"""Whose versions a summary names."""


@dataclass(frozen=True, kw_only=True)
class Summary(Judgement):
    """A judgement and the circumstances; a figure that was not measured is None."""

    scenario: str
    seed: int
    """What was run, and the seed of everything random in it."""
    simulated_time_s: float
    wall_time_s: float
    real_time_factor: float | None
    """How long it took, in the simulation (scans and thinking included) and on your
    clock (without building and writing), and the ratio."""
    perception: Mapping[str, Json] | None = None
    """Frames, milliseconds a frame by stage, and errors against the true treads, boxes
    or obstacles."""
    estimate: Mapping[str, Json] | None = None
    """What the robot believed of itself against the truth: RMS and largest error of the
    pelvis' place, yaw, tilt and velocity, of CoM, its velocity and DCM; drift in per
    cent of the way and of the climb; for how long contacts were misjudged; mean square
    of errors over the filter's own deviations (`squared_error`); slips found; seconds
    without inertial unit. Null on the true state."""
    timing_us: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """Median and 99th percentile of every system's callbacks, µs."""
    replaced: Mapping[str, str] = field(default_factory=dict)
    """The class of every part of the closed loop that was put in the place of ours, by
    the part's name."""
    versions: Mapping[str, str] = field(default_factory=dict)
    """Of Python and the packages that matter."""

    def to_json(self) -> dict[str, Json]:
        """Computes the summary as plain JSON data, the outcome first."""
        first = ("scenario", "outcome", "reason", "seed")
        data = {name: to_json(value) for name, value in asdict(self).items()}
        return {name: data[name] for name in first} | data

    def write(self, path: Path) -> None:
        """Writes the summary as a JSON file."""
        text = json.dumps(self.to_json(), indent=2, allow_nan=False)
        path.write_text(text + "\n", encoding="utf-8")


def timing_us(diagram: Diagram) -> dict[str, dict[str, float]]:
    """Median, 99th percentile and count of the timed callbacks of every system, us."""
    timings = {}
    for _, system in leaf_systems(diagram):
        watch = stopwatch(system)
        if watch is not None and watch.count:
            timings[system.get_name()] = {
                "median": round(watch.quantile(0.5) * 1e6, 1),
                "p99": round(watch.quantile(0.99) * 1e6, 1),
                "calls": watch.count,
            }
    return timings


def installed_versions() -> dict[str, str]:
    """Version of Python and of every package of `PACKAGES` that is installed."""
    versions = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            versions[package] = version(package)
        except ModuleNotFoundError:  # open3d goes by another name on some systems
            continue
    return versions


def perception_summary(
    segmentations: Sequence[PlaneSegmentation],
    staircases: Sequence[Staircase],
    treads: Sequence[Tread],
) -> dict[str, Json] | None:
    """Summarises perception; None where nothing of it was logged.

    Args:
        segmentations: one a frame, poses in W; empty where they were not logged.
        staircases: what was made of them, one a change, poses in W.
        treads: the true ones.

    Returns:
        `frames` and `ms_per_frame`, the median by stage and in all, None without
        segmentations; `errors`: over all treads of all frames (of the staircases
        where the frames were not logged) the mean and largest error of the height (m),
        of the front edge (m) and of the normal (deg), None where there is nothing to
        compare.
    """
    if segmentations:
        staircases = [segmentation.staircase for segmentation in segmentations]
    if not any(staircase.treads for staircase in staircases) and not segmentations:
        return None
    errors = [
        error
        for staircase in staircases
        for seen in staircase.treads
        if (error := _tread_error(seen, treads)) is not None
    ]
    return {
        "frames": len(segmentations) or None,
        "ms_per_frame": _stage_medians(segmentations) if segmentations else None,
        "errors": _error_summary(np.array(errors)) if errors else None,
    }


def _stage_medians(segmentations: Sequence[PlaneSegmentation]) -> dict[str, Json]:
    """Median time of every stage and of a whole frame, ms."""
    stages: dict[str, list[float]] = {}
    for segmentation in segmentations:
        for stage, milliseconds in segmentation.times_ms:
            stages.setdefault(stage, []).append(milliseconds)
        total = sum(milliseconds for _, milliseconds in segmentation.times_ms)
        stages.setdefault("total", []).append(total)
    return {stage: round(float(np.median(times)), 2) for stage, times in stages.items()}


def _tread_error(seen: PlaneSegment, treads: Sequence[Tread]) -> Vector | None:
    """Height, front edge (m) and normal (deg) against the nearest true tread, (3,)."""
    centre = np.array(seen.X_WR.translation())
    if not treads:
        return None
    true = min(
        treads, key=lambda t: float(np.linalg.norm(t.X_WR.translation() - centre))
    )
    corners = np.array(true.X_WR.inverse().multiply(seen.corners().T))
    up = np.array(true.X_WR.rotation().col(2))
    front = corners[0].min() + true.size[0] / 2.0
    tilt = np.arccos(np.clip(seen.normal @ up, -1.0, 1.0))
    return np.abs([corners[2].mean(), front, np.rad2deg(tilt)])


def _error_summary(errors: Vector) -> dict[str, Json]:
    names = ("height_m", "front_edge_m", "normal_deg")
    summary: dict[str, Json] = {"treads": len(errors)}
    for name, column in zip(names, errors.T, strict=True):
        summary[f"mean_{name}"] = round(float(column.mean()), 5)
        summary[f"max_{name}"] = round(float(column.max()), 5)
    return summary
