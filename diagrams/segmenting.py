"""Perception alone on a file: planes as JSON and as a picture."""

import json
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import numpy as np
from matplotlib.figure import Figure

from footfall.diagrams.figures.colors import PLANE_KINDS
from footfall.models.robots.robot import Sole
from footfall.models.robots.robot_description import default_sole
from footfall.models.values.perceived import PlaneSegment, PlaneSegmentation
from footfall.models.values.value import to_json
from footfall.models.values.vector import Vector
from footfall.systems.perception.clouds.cloud_files import read_cloud
from footfall.systems.perception.planes.cloud_doubts import describe_cloud, doubt_cloud
from footfall.systems.perception.planes.normals import gravity_aligned_rotation
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams

DRAWN_POINTS = 60_000
"""More points would not change the picture, only slow it."""


@dataclass(frozen=True, eq=False)
class SegmentedFile:
    """What `segment_file` found and wrote."""

    points: int
    """How many points the cloud has."""
    segmentation: PlaneSegmentation
    """Planes and staircase, in the cloud's frame; with the time of reading first."""
    doubts: tuple[str, ...]
    """Of a cloud without planes: what it is like, and what is likely wrong with it."""
    planes_json: Path
    """The planes as JSON."""
    planes_png: Path
    """The picture."""


def segment_file(
    cloud: Path,
    gravity: Vector,
    out: Path,
    params: PlaneSegmenterParams | None = None,
    sole: Sole | None = None,
    viewpoint: Vector | None = None,
) -> SegmentedFile:
    """Segments the cloud in a file and writes `planes.json` and `planes.png`.

    Each file appears when it is complete, or not at all.

    Args:
        cloud: a file that `read_cloud` reads.
        gravity: gravity in the cloud's frame, (3,), any length: it points down.
        out: folder to write to; it is made where it is missing.
        params: parameters; None for the paper's.
        sole: of the robot, by default of JVRC-1; what is smaller is no plane to stand
            on.
        viewpoint: where the cloud was seen from, (3,), m; None where it is unknown.

    Raises:
        CloudFileError: the file is no cloud.
        ValueError: gravity has no direction, or a parameter makes no sense.
        OSError: `out` cannot be written to.
    """
    params = params or PlaneSegmenterParams()
    params.validate()
    sole = sole or default_sole()
    R_GW = gravity_aligned_rotation(gravity)
    start = perf_counter()
    points = read_cloud(cloud)
    read = ("read", (perf_counter() - start) * 1e3)
    found, _ = segment_planes(points, gravity, params, sole, viewpoint)
    segmentation = replace(found, times_ms=(read, *found.times_ms))
    out.mkdir(parents=True, exist_ok=True)
    result = SegmentedFile(
        points=len(points),
        segmentation=segmentation,
        doubts=() if segmentation.planes else _doubts(points, gravity, params, sole),
        planes_json=out / "planes.json",
        planes_png=out / "planes.png",
    )
    figure = draw_segmentation(points, segmentation, R_GW, cloud.name)
    _write_atomically(
        result.planes_png, lambda path: figure.savefig(path, format="png", dpi=110)
    )
    _write_atomically(
        result.planes_json,
        lambda path: path.write_text(
            json.dumps(_document(cloud, gravity, result), indent=1) + "\n",
            encoding="utf-8",
        ),
    )
    return result


def _doubts(
    points: Vector, gravity: Vector, params: PlaneSegmenterParams, sole: Sole
) -> tuple[str, ...]:
    likely = doubt_cloud(points, gravity, params, params.min_voxels(sole))
    return (describe_cloud(points), *likely)


def _document(cloud: Path, gravity: Vector, result: SegmentedFile) -> dict[str, object]:
    segmentation = result.segmentation
    return {
        "cloud": cloud.name,
        "points": result.points,
        "gravity": to_json(np.asarray(gravity, dtype=np.float64)),
        "planes": to_json(segmentation.planes),
        "staircase": to_json(segmentation.staircase),
        "flights": to_json(segmentation.flights),
        "doubts": list(result.doubts),
        "times_ms": {stage: round(ms, 3) for stage, ms in segmentation.times_ms},
    }


def _write_atomically(path: Path, write: Callable[[Path], object]) -> None:
    handle, name = tempfile.mkstemp(prefix=f".{path.stem}-", dir=path.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        write(temporary)
        # mkstemp makes files for the owner only; a result is for who may read others.
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(0o666 & ~mask)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def draw_segmentation(
    points: Vector, segmentation: PlaneSegmentation, R_GW: Vector, title: str
) -> Figure:
    """Top view and side view of a cloud with its planes, gravity down.

    Args:
        points: the cloud in W, (n, 3), m.
        segmentation: its planes, in W.
        R_GW: rotation into the gravity-aligned frame that is drawn, (3, 3).
        title: what the cloud is called.
    """
    cloud = points @ R_GW.T
    low, high = _window(cloud, segmentation, R_GW)
    cloud = cloud[np.all((cloud >= low) & (cloud <= high), axis=1)]
    cloud = cloud[:: max(1, len(cloud) // DRAWN_POINTS)]
    x_axis, x_label = np.array([1.0, 0.0, 0.0]), "x [m]"
    if segmentation.staircase.treads:
        first = segmentation.staircase.treads[0].X_WR.rotation().matrix()
        x_axis = R_GW @ first[:, 0]
        x_axis = np.array([x_axis[0], x_axis[1], 0.0]) / np.hypot(*x_axis[:2])
        x_label = "way up the stairs [m]"
    across = np.cross([0.0, 0.0, 1.0], x_axis)
    # Each view: where its horizontal and vertical axes and the eye are.
    views = (
        ("from above", np.eye(3), "x [m]", "y [m]"),
        (
            "from the side",
            np.array([x_axis, [0.0, 0.0, 1.0], -across]),
            x_label,
            "z [m]",
        ),
    )
    figure = Figure(figsize=(13.0, 6.4), layout="constrained")
    stairs, planes = len(segmentation.staircase.treads), len(segmentation.planes)
    figure.suptitle(
        f"{title}: {len(points):,} points, {planes} plane{'s' * (planes != 1)}, "
        + (
            f"staircase of {stairs} tread{'s' * (stairs != 1)}"
            if stairs
            else "no stairs"
        )
        + (f", {len(segmentation.flights)} flights" * (len(segmentation.flights) > 1))
    )
    for axes, (name, view, horizontal, vertical) in zip(
        figure.subplots(1, 2), views, strict=True
    ):
        axes.set_title(name)
        axes.set_xlabel(horizontal)
        axes.set_ylabel(vertical)
        axes.set_aspect("equal")
        p = cloud @ view.T
        p = p[np.argsort(p[:, 2], kind="stable")]
        shade = (p @ view)[:, 2]
        dots = axes.scatter(
            p[:, 0], p[:, 1], c=shade, s=1.0, cmap="gray_r", linewidths=0
        )
        # Points at the top would be black on black lines.
        dots.set_clim(low[2] - 0.8 * (high[2] - low[2]), high[2] + 0.3)
        for plane, color, label in _labelled(segmentation):
            outline = plane.polygon @ R_GW.T @ view.T
            corners = plane.corners() @ R_GW.T @ view.T
            axes.fill(*outline[:, :2].T, color=color, alpha=0.25, linewidth=0)
            closed = np.vstack([corners, corners[:1]])
            axes.plot(*closed[:, :2].T, color=color, linewidth=1.6)
            middle = corners.mean(axis=0)
            seen = np.all((middle @ view >= low) & (middle @ view <= high))
            # From the side unordered planes hide one another.
            if label and seen and (stairs or name == "from above"):
                axes.annotate(
                    label,
                    middle[:2],
                    color="white",
                    ha="center",
                    va="center",
                    fontsize=8,
                    bbox={"boxstyle": "circle,pad=0.2", "fc": color, "ec": "white"},
                )
        bounds = np.sort(np.array([low, high]) @ view.T, axis=0)
        axes.set_xlim(*_framed(p[:, 0], bounds[:, 0]))
        axes.set_ylim(*_framed(p[:, 1], bounds[:, 1]))
    return figure


def _framed(drawn: Vector, bounds: Vector) -> tuple[float, float]:
    """Limits of an axis: what is drawn, or the window where nothing is."""
    low, high = (drawn.min(), drawn.max()) if len(drawn) else bounds
    return float(low) - 0.05, float(high) + 0.05


def _labelled(
    segmentation: PlaneSegmentation,
) -> list[tuple[PlaneSegment, str, str]]:
    """Gives each plane its colour and label; treads are numbered from the lowest.

    Those of the second flight are 2.1 and so on.
    """
    staircase, others = segmentation.staircase, segmentation.flights[1:]
    drawn = []
    number = 0
    for plane in segmentation.planes:
        if any(plane in flight.treads for flight in (staircase, *others)):
            continue
        if staircase.floor is not None and plane == staircase.floor:
            drawn.append((plane, PLANE_KINDS["ground"], ""))
            continue
        number += 1
        drawn.append(
            (plane, PLANE_KINDS["plane"], "" if staircase.treads else str(number))
        )
    for index, tread in enumerate(staircase.treads):
        drawn.append((tread, PLANE_KINDS["tread"], str(index + 1)))
    return drawn + [
        (tread, PLANE_KINDS["other tread"], f"{flight}.{index}")
        for flight, other in enumerate(others, start=2)
        for index, tread in enumerate(other.treads, start=1)
    ]


def _window(
    cloud: Vector, segmentation: PlaneSegmentation, R_GW: Vector
) -> tuple[Vector, Vector]:
    """Corners of the box, in G, that is drawn: the stairs, else what has planes."""
    planes = segmentation.staircase.treads or segmentation.planes
    if not planes:
        low, high = np.percentile(cloud, [1.0, 99.0], axis=0)
        return low - 0.1, high + 0.1
    corners = np.concatenate([plane.polygon for plane in planes]) @ R_GW.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    if segmentation.staircase.treads:
        floor = segmentation.staircase.floor
        ground = low[2] if floor is None else (floor.polygon @ R_GW.T)[:, 2].mean()
        margin = np.array([1.0, 0.8, 0.3])
        low, high = low - margin, high + margin
        low[2] = min(low[2], float(ground) - 0.1)
        return low, high
    margin = np.array([0.3, 0.3, 0.2])
    return low - margin, high + margin
