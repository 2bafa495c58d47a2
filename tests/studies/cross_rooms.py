"""Says of the rooms of a sweep whether they can be crossed, by a search of its own.

    footfall sweep tests/studies/cross_rooms.yaml
    python tests/studies/cross_rooms.py sweeps/cross_rooms --out result.md

A refusal is right when a grid search on the true boxes finds no path either.
"""

import argparse
from pathlib import Path

import numpy as np
import shapely
from scipy.ndimage import label

from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.diagrams.sweep.sampling import jobs_of
from footfall.diagrams.sweep.sweep_folder import SweepFolder, load_sweep
from footfall.diagrams.sweep.table import table_row

CELL = 0.05
"""Grid of the independent search, m."""


def grid_finds_a_path(scenario: Scenario) -> bool:
    """Tells whether start and goal are connected for the robot's disc, on a grid."""
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


def rooms(found: SweepFolder) -> list[str]:
    """Writes the rows of a sweep's table beside what the grid finds."""
    columns = ("outcome", "reason", *found.sweep.show)
    heads = ("seed", "boxes", "grid finds a path", *columns)
    lines = [table_row(heads), "|" + "---|" * len(heads)]
    for job, (_, run) in zip(jobs_of(found.sweep), found.table.iterrows(), strict=True):
        changes = [*job.changes(found.sweep), f"simulation.seed={job.seed}"]
        scenario = load_scenario(found.sweep.scenario, changes)
        boxes, path = len(scenario.scene.boxes), grid_finds_a_path(scenario)
        told = (run.get(name) for name in columns)
        lines.append(table_row((job.seed, boxes, path, *told)))
    return lines


def main() -> None:
    """Writes the table of a sweep of rooms."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sweep", type=Path, help="the sweep's folder")
    parser.add_argument("--out", type=Path, required=True, help="Markdown file")
    arguments = parser.parse_args()
    lines = rooms(load_sweep(arguments.sweep))
    arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
