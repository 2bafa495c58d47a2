"""Segments sweeps of the stair paper's two staircases and writes what was seen.

    python -m tests.studies.see_stairs --out tests/studies/see_stairs.md

Stair paper (Zhang, Caron, Nakamura 2016), Sec. 5: Experiment 1 (three steps of 20 cm,
27 cm deep, 50 cm wide) and 2 (eleven of 18 cm, 26.5 cm deep, 123 cm wide), each seen
from 20 poses, with closed and open risers and six range noises. A tread that is mostly
in view (`IN_VIEW`) must be found; what lies on a true tread by less than half is
invented. Areas are compared with what is in view of the tread (with the whole of it
where its back is said to be seen), Eq. 3's with the count of voxels that the same
rectangle touches.
"""

import argparse
import itertools
import multiprocessing
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

import numpy as np

from footfall.models.robots.jvrc1 import JVRC1
from footfall.models.values.perceived import PlaneSegment
from footfall.systems.perception.planes.plane_segmentation import segment_planes
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from tests.systems.perception.stair_scans import Array, StairScene, scan_scene

EXPERIMENTS = {
    1: StairScene(steps=3, rise=0.20, run=0.27, width=0.50),
    2: StairScene(steps=11, rise=0.18, run=0.265, width=1.23, room=(11.0, 7.0, 5.0)),
}
"""The staircases of the paper's two experiments."""
NOISES = (0.0, 0.003, 0.005, 0.010, 0.020, 0.030)
"""Standard deviations of a range, m."""
POSES = 20
"""Poses of the scanner before each staircase."""
GRAVITY = np.array([0.0, 0.0, -9.81])
IN_VIEW = 0.8
"""Part of a tread from which on it is mostly in view."""
CELL = 0.04
"""Side of the cells of a tread that are in view where a ray of the sweep ends, m."""
SAME_HEIGHT = 0.03
"""Most that what was found is off a true tread's height to be meant by it, m."""
SNAP = 0.02
"""Rays end this near to an edge that is in view, m."""
VOXEL = 0.02
"""Side of a voxel of Eq. 3, m."""


@dataclass(frozen=True)
class Case:
    """One sweep."""

    experiment: int
    open_risers: bool
    noise: float
    pose: int


@dataclass(frozen=True)
class Seen:
    """What was found of a true tread that is mostly in view."""

    number: int
    """Of the tread, from 0."""
    found: bool
    height: float = np.nan
    """Error, m."""
    front: float = np.nan
    """Error of the front edge, up the stairs, m."""
    back: float = np.nan
    """Error of the back edge against what is in view, m."""
    yaw: float = np.nan
    """Error, rad."""
    rectangle: float = np.nan
    """Area of the rectangle, as part of what is in view."""
    voxels: float = np.nan
    """Eq. 3: area of the voxels, as part of what is in view."""
    geometric: float = np.nan
    """Eq. 3 of the true tread: voxels that what is in view touches."""


@dataclass(frozen=True)
class Result:
    """Of one sweep."""

    case: Case
    treads: tuple[Seen, ...]
    invented: int
    cpu: float
    """s."""


def view(case: Case) -> tuple[StairScene, Array]:
    """The staircase, turned by up to 20 deg, and where the scanner is."""
    rng = np.random.default_rng((case.experiment, case.pose))
    yaw = rng.uniform(-1.0, 1.0) * np.radians(20.0)
    p_S = rng.uniform([-1.4, -0.25, 1.35], [-0.4, 0.25, 1.60])
    scene = replace(EXPERIMENTS[case.experiment], yaw=yaw, open_risers=case.open_risers)
    return scene, p_S @ scene.rotation().T


@dataclass(frozen=True)
class View:
    """What noiseless rays meet of a tread."""

    part: float
    """Of its cells."""
    low: Array
    """Front right corner of the rectangle in view, in S, (2,), m."""
    high: Array
    """Back left corner, in S, (2,), m."""
    area: float
    """Of what is in view, m^2: less than the rectangle's where the view ends askew."""


def in_view(scene: StairScene, number: int, clean: Array) -> View:
    """Measures what is in view of a tread: rays end within a spacing of its edges."""
    local = clean @ scene.rotation()
    low = np.array([number * scene.run, -scene.width / 2.0])
    size = np.array([scene.run, scene.width])
    on = np.abs(local[:, 2] - (number + 1) * scene.rise) < 1e-4
    on &= np.all((local[:, :2] > low) & (local[:, :2] < low + size), axis=1)
    if np.count_nonzero(on) < 10:
        return View(0.0, low, low, 0.0)
    counts = np.ceil(size / CELL).astype(int)
    cells = np.minimum((local[on, :2] - low) / size * counts, counts - 1).astype(int)
    part = len(np.unique(cells[:, 0] * counts[1] + cells[:, 1])) / np.prod(counts)

    def outward(ends: Array, edge: float) -> Array:
        """Moves ends that are within a spacing of an edge onto it."""
        return np.where(np.abs(ends - edge) < SNAP, edge, ends)

    back, front = np.full(counts[1], -np.inf), np.full(counts[1], np.inf)
    np.maximum.at(back, cells[:, 1], local[on, 0])
    np.minimum.at(front, cells[:, 1], local[on, 0])
    used = np.isfinite(back)
    back = outward(back[used], low[0] + size[0])
    front = outward(front[used], low[0])
    right = float(outward(local[on, 1].min(), low[1]))
    left = float(outward(local[on, 1].max(), low[1] + size[1]))
    return View(
        part=float(part),
        low=np.array([front.mean(), right]),
        high=np.array([back.mean(), left]),
        area=float((back - front).mean() * (left - right)),
    )


def voxels_of(low: Array, high: Array, rotation: Array) -> int:
    """How many voxels of the grid of W a rectangle of S touches."""
    x, y = (np.arange(a, b, VOXEL / 8.0) for a, b in zip(low, high, strict=True))
    grid = np.column_stack([np.repeat(x, len(y)), np.tile(y, len(x))])
    cells = np.floor(grid @ rotation[:2, :2].T / VOXEL).astype(int)
    return len(np.unique(cells, axis=0))


def compare(scene: StairScene, number: int, seen: View, plane: PlaneSegment) -> Seen:
    """Compares a true tread, of which a part is in view, with what was found."""
    rotation = scene.rotation()
    corners = plane.corners() @ rotation
    low, high, area = seen.low, seen.high, seen.area
    if plane.edges is not None and plane.edges.back:
        # Where the view ends askew it may still show a part of the edge.
        high = np.array([(number + 1) * scene.run, high[1]])
        area = float(np.prod(high - low))
    axis = plane.X_WR.rotation().matrix()[:, 0] @ rotation
    order = np.sort(corners[:, 0])
    return Seen(
        number=number,
        found=True,
        height=float(corners[:, 2].mean()) - (number + 1) * scene.rise,
        front=float(order[:2].mean() - low[0]),
        back=float(order[2:].mean() - high[0]),
        yaw=float(np.arctan2(axis[1], axis[0])),
        rectangle=float(np.prod(plane.size)) / area,
        voxels=plane.area / area,
        geometric=voxels_of(low, high, rotation) * VOXEL**2 / area,
    )


def on_tread(scene: StairScene, plane: PlaneSegment) -> tuple[int, float]:
    """The true tread nearest in height, and the part of the rectangle that is on it."""
    corners = plane.corners() @ scene.rotation()
    low, high = corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)
    number = round(float(corners[:, 2].mean()) / scene.rise) - 1
    if not 0 <= number < scene.steps:
        return -1, 0.0
    if abs(corners[:, 2].mean() - (number + 1) * scene.rise) > SAME_HEIGHT:
        return -1, 0.0
    least = np.array([number * scene.run, -scene.width / 2.0])
    most = least + np.array([scene.run, scene.width])
    common = np.clip(np.minimum(high, most) - np.maximum(low, least), 0.0, None)
    return number, float(np.prod(common) / max(np.prod(high - low), 1e-9))


def run(case: Case, params: PlaneSegmenterParams | None = None) -> Result:
    """Sweeps, segments and compares."""
    scene, eye = view(case)
    cloud = scan_scene(scene, eye, noise=case.noise, seed=case.pose)
    clean = scan_scene(scene, eye, noise=0.0)
    start = process_time()
    found, _ = segment_planes(
        cloud, GRAVITY, params or PlaneSegmenterParams(), JVRC1.sole, eye
    )
    cpu = process_time() - start
    best: dict[int, PlaneSegment] = {}
    invented = 0
    for tread in found.staircase.treads:
        number, part = on_tread(scene, tread)
        if part < 0.5:
            invented += 1
        elif number not in best or tread.area > best[number].area:
            best[number] = tread
    treads = []
    for number in range(scene.steps):
        seen = in_view(scene, number, clean)
        if seen.part < IN_VIEW:
            continue
        treads.append(
            compare(scene, number, seen, best[number])
            if number in best
            else Seen(number, found=False)
        )
    return Result(case, tuple(treads), invented, cpu)


def worst(values: Iterable[float]) -> float:
    """The largest absolute value; NaN of none."""
    numbers = np.abs([value for value in values if np.isfinite(value)])
    return float(numbers.max()) if len(numbers) else np.nan


def spread(values: Iterable[float]) -> str:
    """Least, median and most, in per cent."""
    numbers = 100.0 * np.array([value for value in values if np.isfinite(value)])
    if not len(numbers):
        return "none"
    return f"{numbers.min():.1f}, {np.median(numbers):.1f}, {numbers.max():.1f}"


COLUMNS = (
    "experiment",
    "risers",
    "noise [mm]",
    "treads in view",
    "found",
    "first two of",
    "invented",
    "height, worst [mm]",
    "front, worst [mm]",
    "back, worst [mm]",
    "yaw, worst [deg]",
    "rectangle, least, median, most [%]",
    "Eq. 3 of the first tread less its geometric value [points]",
    "geometric [%]",
    "CPU, median [ms]",
)


def row(results: list[Result]) -> str:
    """A line of the table, of sweeps that differ by their pose."""
    case = results[0].case
    treads = [tread for result in results for tread in result.treads]
    seen = [tread for tread in treads if tread.found]
    both = sum(
        all(tread.found for tread in result.treads if tread.number < 2)
        for result in results
    )
    cells = (
        f"{case.experiment}",
        "open" if case.open_risers else "closed",
        f"{1e3 * case.noise:g}",
        f"{len(treads)}",
        f"{len(seen)}",
        f"{both} of {len(results)}",
        f"{sum(result.invented for result in results)}",
        f"{1e3 * worst(tread.height for tread in seen):.1f}",
        f"{1e3 * worst(tread.front for tread in seen):.1f}",
        f"{1e3 * worst(tread.back for tread in seen):.1f}",
        f"{np.degrees(worst(tread.yaw for tread in seen)):.2f}",
        spread(tread.rectangle for tread in seen),
        spread(t.voxels - t.geometric for t in seen if t.number == 0),
        f"{100 * np.median([t.geometric for t in seen if t.number == 0]):.1f}"
        if seen
        else "none",
        f"{1e3 * np.median([result.cpu for result in results]):.0f}",
    )
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Runs all cases and writes a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("see_stairs.md"))
    parser.add_argument("--noise", type=float, nargs="*", default=list(NOISES))
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    lines = ["| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(arguments.jobs, mp_context=context) as pool:
        groups = itertools.product(EXPERIMENTS, (False, True), arguments.noise)
        for experiment, open_risers, noise in groups:
            cases = [Case(experiment, open_risers, noise, i) for i in range(POSES)]
            lines.append(row(list(pool.map(run, cases))))
            print(lines[-1], flush=True)
            arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
