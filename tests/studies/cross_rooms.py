"""Crosses rooms with boxes at random, seed by seed, and writes what came of it.

    python tests/studies/cross_rooms.py --first 0 --last 19 --out result.md

A refusal is right when a grid search on the true boxes finds no path either.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
import shapely
from scipy.ndimage import label

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.diagrams.simulation import run_task

COLUMNS = (
    "outcome",
    "reason",
    "goal_error_m",
    "goal_turn_rad",
    "footsteps",
    "max_dcm_error_m",
    "max_foot_slip_m",
    "max_speed_fraction",
    "simulated_time_s",
    "real_time_factor",
)
CELL = 0.05
"""Grid of the independent search, m."""


def grid_finds_a_path(scenario: Scenario) -> bool:
    """Whether start and goal are connected for the robot's disc, on a grid."""
    clearance = scenario.parameters.path_planner.clearance
    room = scenario.scene.room
    x = np.arange(-room.length / 2, room.length / 2, CELL)
    y = np.arange(-room.width / 2, room.width / 2, CELL)
    points = shapely.points(*np.meshgrid(x, y, indexing="ij"))
    inner = shapely.box(
        -room.length / 2, -room.width / 2, room.length / 2, room.width / 2
    ).buffer(-clearance)
    free = shapely.contains(inner, points)
    for box in scenario.scene.boxes:
        half = np.array(box.size[:2]) / 2.0
        turn = np.array(
            [
                [np.cos(box.yaw), -np.sin(box.yaw)],
                [np.sin(box.yaw), np.cos(box.yaw)],
            ]
        )
        signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        outline = shapely.Polygon((signs * half) @ turn.T + [box.x, box.y])
        free &= shapely.distance(outline, points) > clearance
    parts, _ = label(free)
    start = (scenario.robot.x, scenario.robot.y)
    ends = [
        parts[int((p[0] - x[0]) / CELL), int((p[1] - y[0]) / CELL)]
        for p in (start, scenario.task.goal[:2])
    ]
    return bool(ends[0] == ends[1] != 0)


def main() -> None:
    """Runs the study."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--last", type=int, default=19)
    parser.add_argument("--out", type=Path, default=None)
    parser.add_argument("--keep", type=Path, default=None, help="folder for the runs")
    parser.add_argument("--set", action="append", default=[], dest="changes")
    arguments = parser.parse_args()
    lines = ["| seed | boxes | grid finds a path | " + " | ".join(COLUMNS) + " |"]
    lines.append("|" + "---|" * (len(COLUMNS) + 3))
    print("\n".join(lines), flush=True)
    for seed in range(arguments.first, arguments.last + 1):
        changes = [f"simulation.seed={seed}", *arguments.changes]
        scenario = load_scenario("room", changes)
        with tempfile.TemporaryDirectory() as scratch:
            folder = (arguments.keep or Path(scratch)) / f"seed-{seed}"
            summary = run_task(build_task(scenario), scenario, folder).to_json()
        values = [_format(summary[name]) for name in COLUMNS]
        boxes, path = len(scenario.scene.boxes), grid_finds_a_path(scenario)
        lines.append(f"| {seed} | {boxes} | {path} | " + " | ".join(values) + " |")
        print(lines[-1], flush=True)
    if arguments.out is not None:
        arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _format(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
