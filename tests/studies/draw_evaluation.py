"""Draws the evaluation of the plane segmentation as the stair paper does (Sec. 5).

    python -m tests.studies.draw_evaluation --out evaluation

Fig. 5(a): estimated area of the first tread (Eq. 3) and time over the neighbourhood k;
Fig. 5(b): where the time goes at k = 10, the normals apart; Fig. 6: footholds on the
planes that were seen, before anything moves. All of both experiments, in the published
order and in ours. `evaluation.md` has the numbers beside the paper's.
"""

import argparse
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

import numpy as np
from matplotlib.figure import Figure
from pydrake.math import RigidTransform, RotationMatrix

from footfall.diagrams.segmenting import draw_segmentation
from footfall.models.robots.jvrc1 import JVRC1
from footfall.systems.perception.planes.normals import estimate_normals
from footfall.systems.perception.planes.plane_segmentation import (
    Stages,
    segment_planes,
)
from footfall.systems.perception.planes.segmenter_params import PlaneSegmenterParams
from footfall.systems.perception.planes.voxels import voxelize
from footfall.systems.planning.footsteps.foothold import sole_corners
from footfall.systems.planning.footsteps.footstep_params import FootstepPlannerParams
from footfall.systems.planning.footsteps.footstep_planner import plan_footsteps
from tests.studies.see_stairs import EXPERIMENTS, GRAVITY
from tests.systems.perception.stair_scans import Array, scan_scene

NEIGHBOURS = (5, 10, 15, 20, 25)
"""k of Fig. 5(a)."""
ORDERS = {
    "published": PlaneSegmenterParams(threads=1).published(),
    "supervoxels, ours": PlaneSegmenterParams(threads=1, method="supervoxels"),
    "surfaces": PlaneSegmenterParams(threads=1),
}
"""In what order and how the planes are found; the last one knows no k."""
COLOURS = {1: "#1971c2", 2: "#d9480f"}
"""Blue is Experiment 1, red Experiment 2, as in the paper."""
DASHES = {"published": ":", "supervoxels, ours": "--", "surfaces": "-"}
NOISE = 0.005
"""Standard deviation of a range, m."""
DISTANCE = 0.6
"""Of the scanner before the first riser, m."""
PAPER = {1: 550, 2: 190}
"""Supervoxels that the paper counts."""


@dataclass(frozen=True)
class Frame:
    """Of one cloud."""

    area: float
    """Eq. 3 of the first tread, a part of its true area; 0 where it was not found."""
    cpu: float
    """ms."""
    normals: float
    """Of that, for the normals, ms."""
    stages: tuple[tuple[str, float], ...]
    """Wall time of each stage, ms."""
    supervoxels: int


def first_area(cloud: Array, experiment: int, params: PlaneSegmenterParams) -> Frame:
    """Segments a frame and measures the first tread."""
    scene = EXPERIMENTS[experiment]
    start = process_time()
    found, stages = segment_planes(
        cloud, GRAVITY, params, JVRC1.sole, scene.sensor(distance=DISTANCE)
    )
    cpu = process_time() - start
    area = 0.0
    for plane in found.planes:
        middle = plane.corners().mean(axis=0)
        on = abs(middle[2] - scene.rise) < 0.03 and 0.0 < middle[0] < scene.run
        area = max(area, plane.area if on else 0.0)
    return Frame(
        area / (scene.run * scene.width),
        1e3 * cpu,
        1e3 * time_normals(stages, params),
        found.times_ms,
        0 if stages.supervoxels is None else len(stages.supervoxels.count),
    )


def time_normals(stages: Stages, params: PlaneSegmenterParams) -> float:
    """How long the normals of a frame take, s, in the order asked for."""
    if params.method == "surfaces":
        return 0.0
    points = stages.cloud
    if params.order == "voxels_first":
        points = voxelize(points, params.voxel_size).mean
    start = process_time()
    estimate_normals(points, params.neighbors, params.threads)
    return process_time() - start


def frames(experiment: int, count: int) -> list[Array]:
    """Sweeps of one place that differ by their noise."""
    scene = EXPERIMENTS[experiment]
    eye = scene.sensor(distance=DISTANCE)
    return [scan_scene(scene, eye, noise=NOISE, seed=seed) for seed in range(count)]


def mean(values: list[float]) -> float:
    """Of all frames."""
    return float(np.mean(values))


def draw_area_and_time(
    results: dict[tuple[int, str, int], list[Frame]], count: int
) -> Figure:
    """Fig. 5(a)."""
    figure = Figure(figsize=(11.0, 4.8), layout="constrained")
    areas, times = figure.subplots(1, 2)
    for experiment, colour in COLOURS.items():
        for order in ORDERS:
            lines = [results[experiment, order, k] for k in NEIGHBOURS]
            label = f"Exp. {experiment}, {order}"
            area = [100.0 * mean([f.area for f in line]) for line in lines]
            time = [mean([f.cpu for f in line]) for line in lines]
            areas.plot(NEIGHBOURS, area, DASHES[order], color=colour, label=label)
            times.plot(NEIGHBOURS, time, DASHES[order], color=colour, label=label)
    areas.axhline(100.0, color="#868e96", linewidth=0.8)
    areas.set_ylabel("estimated area of the first tread, Eq. 3 [%]")
    times.set_ylabel("CPU a frame [ms]")
    times.set_ylim(bottom=0.0)
    for axes in (areas, times):
        axes.set_xlabel("neighbours k")
        axes.legend(fontsize=8)
    figure.suptitle(
        f"Fig. 5(a): mean of {count} frames. Flat: a tread's area counts the voxels of "
        "its points within its edges,\nwhich no normal decides; surfaces know no k.",
        fontsize=10,
    )
    return figure


def draw_shares(results: dict[tuple[int, str, int], list[Frame]]) -> Figure:
    """Fig. 5(b)."""
    figure = Figure(figsize=(11.0, 5.0), layout="constrained")
    axes = figure.subplots(1, 1)
    names: list[str] = []
    for place, (experiment, order) in enumerate(
        (e, o) for e in EXPERIMENTS for o in ORDERS
    ):
        found = results[experiment, order, 10]
        shares = {
            stage: mean([dict(f.stages)[stage] for f in found])
            for stage, _ in found[0].stages
        }
        normals = mean([f.normals for f in found])
        if "filters" in shares:
            shares["filters"] = max(shares["filters"] - normals, 0.0)
            shares = {"normals": normals, **shares}
        left = 0.0
        for stage, milliseconds in shares.items():
            names += [stage] * (stage not in names)
            axes.barh(place, milliseconds, left=left, color=f"C{names.index(stage)}")
            left += milliseconds
    labels = [f"Exp. {e}\n{o}" for e in EXPERIMENTS for o in ORDERS]
    axes.set_yticks(range(len(labels)), labels, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("time [ms]")
    for number, name in enumerate(names):
        axes.barh(0, 0, color=f"C{number}", label=name)
    axes.legend(fontsize=8)
    figure.suptitle("Fig. 5(b): where the time goes at k = 10", fontsize=10)
    return figure


def draw_footholds(experiment: int, cloud: Array) -> Figure:
    """Fig. 6: the plan on what was seen."""
    scene = EXPERIMENTS[experiment]
    found, _ = segment_planes(
        cloud, GRAVITY, ORDERS["surfaces"], JVRC1.sole, scene.sensor(distance=DISTANCE)
    )
    feet = [
        RigidTransform(RotationMatrix(), [-DISTANCE, y, 0.0]) for y in (0.095, -0.095)
    ]
    plan = plan_footsteps(found.staircase, *feet, FootstepPlannerParams(), JVRC1.sole)
    title = f"Fig. 6, Exp. {experiment}: {len(plan.footsteps)} footholds"
    figure = draw_segmentation(cloud, found, np.eye(3), title)
    above, side = figure.axes
    for step in plan.footsteps:
        corners = sole_corners(step.X_WF, JVRC1.sole)
        corners = np.vstack([corners, corners[:1]])
        above.plot(corners[:, 0], corners[:, 1], color="#2b8a3e", linewidth=1.4)
        side.plot(corners[:, 0], corners[:, 2], color="#2b8a3e", linewidth=2.4)
    return figure


def main() -> None:
    """Measures, draws, and writes a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("evaluation"))
    parser.add_argument("--frames", type=int, default=100)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    results: dict[tuple[int, str, int], list[Frame]] = {}
    lines = [
        "| experiment | order | k | Eq. 3 [%] | CPU [ms] | normals [ms] | supervoxels "
        "| paper's supervoxels | paper's time [ms] |",
        "|" + "---|" * 9,
    ]
    for experiment in EXPERIMENTS:
        clouds = frames(experiment, arguments.frames)
        for order, params in ORDERS.items():
            for k in NEIGHBOURS:
                if order == "surfaces" and k != NEIGHBOURS[0]:
                    results[experiment, order, k] = results[
                        experiment, order, NEIGHBOURS[0]
                    ]
                    continue
                found = [
                    first_area(cloud, experiment, replace(params, neighbors=k))
                    for cloud in clouds
                ]
                results[experiment, order, k] = found
                known = order == "surfaces"
                lines.append(
                    f"| {experiment} | {order} | {'none' if known else k} | "
                    f"{100.0 * mean([f.area for f in found]):.1f} | "
                    f"{mean([f.cpu for f in found]):.0f} | "
                    f"{mean([f.normals for f in found]):.0f} | "
                    f"{mean([float(f.supervoxels) for f in found]):.0f} | "
                    f"{PAPER[experiment]} | 100 |"
                )
                print(lines[-1], flush=True)
                (arguments.out / "evaluation.md").write_text(
                    "\n".join(lines) + "\n", encoding="utf-8"
                )
        figure = draw_footholds(experiment, clouds[0])
        figure.savefig(arguments.out / f"fig6_exp{experiment}.png", dpi=110)
    draw_area_and_time(results, arguments.frames).savefig(
        arguments.out / "fig5a.png", dpi=110
    )
    draw_shares(results).savefig(arguments.out / "fig5b.png", dpi=110)


if __name__ == "__main__":
    main()
