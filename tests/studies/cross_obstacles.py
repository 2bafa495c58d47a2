"""Crosses obstacles of many kinds and writes what came of it.

    python tests/studies/cross_obstacles.py --out result.md

Three groups: heights in steps of 1 cm; obstacles drawn at random, turned and aside;
and the cases at the edge: next to nothing, behind the robot, across half the way, two
in a row. Each is crossed, walked past, or refused with a reason; none is touched.
"""

import argparse
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import Scenario, load_scenario
from footfall.diagrams.simulation import run_task

COLUMNS = (
    "outcome",
    "reason",
    "obstacles_crossed",
    "crossing_time_s",
    "min_clearance_m",
    "crossing_impact_body_weights",
    "max_impact_body_weights",
    "max_dcm_error_m",
    "max_foot_slip_m",
    "goal_error_m",
)
GROUPS = ("heights", "random", "edges")


def box(
    width: float,
    height: float,
    x: float = 1.2,
    y: float = 0.0,
    length: float = 1.2,
    yaw: float = 0.0,
    name: str = "obstacle",
) -> str:
    """One obstacle as a scenario writes it."""
    return (
        f"{{name: {name}, x: {x:.3f}, y: {y:.3f}, yaw: {yaw:.4f}, "
        f"size: [{width:.3f}, {length:.3f}, {height:.3f}]}}"
    )


def heights() -> Iterator[tuple[str, list[str]]]:
    """5 cm wide, from 10 cm on upwards."""
    for height in np.arange(0.10, 0.325, 0.01):
        yield f"{100 * height:.0f} x 5 cm", [box(0.05, height)]


def drawn(seed: int, count: int) -> Iterator[tuple[str, list[str]]]:
    """Drawn at random."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        width, height = random.uniform(0.02, 0.12), random.uniform(0.05, 0.22)
        x, y = random.uniform(0.8, 1.5), random.uniform(-0.2, 0.2)
        yaw = np.deg2rad(random.uniform(-15.0, 15.0))
        name = (
            f"{100 * height:.1f} x {100 * width:.1f} cm at ({x:.2f}, {y:.2f}) m, "
            f"{np.rad2deg(yaw):.0f} deg"
        )
        yield name, [box(width, height, x, y, yaw=yaw)]


def edges() -> Iterator[tuple[str, list[str]]]:
    """What a careless planner kicks."""
    yield "none", []
    yield "1 x 1 x 1 mm", [box(0.001, 0.001, length=0.001)]
    yield "1 cm high", [box(0.05, 0.01)]
    yield "3 cm high", [box(0.05, 0.03)]
    yield "behind", [box(0.05, 0.15, x=-0.6)]
    yield "left half of the way", [box(0.05, 0.15, y=0.5, length=1.0)]
    yield "right half of the way", [box(0.05, 0.15, y=-0.5, length=1.0)]
    yield "beside the way", [box(0.05, 0.15, y=0.9, length=1.0)]
    yield "turned 15 deg", [box(0.05, 0.15, yaw=np.deg2rad(15.0))]
    yield "turned -30 deg", [box(0.05, 0.15, yaw=np.deg2rad(-30.0))]
    yield "at the toes", [box(0.05, 0.15, x=0.25)]
    yield "at the goal", [box(0.05, 0.15, x=2.3)]
    yield "beyond the goal", [box(0.05, 0.15, x=2.8)]
    for apart in (0.3, 0.6, 0.9):
        yield (
            f"two, {100 * apart:.0f} cm apart",
            [
                box(0.05, 0.12, x=1.0, name="first"),
                box(0.05, 0.12, x=1.0 + apart, name="second"),
            ],
        )
    yield "a cube in the way", [box(0.15, 0.15, length=0.15)]
    yield "as wide as a table", [box(0.5, 0.10)]
    yield "as high as a table", [box(0.05, 0.7)]


def main() -> None:
    """Runs the study."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--group", choices=GROUPS, default=None)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=20, help="obstacles at random")
    parser.add_argument("--out", type=Path, default=None)
    parser.add_argument("--keep", type=Path, default=None, help="folder for the runs")
    parser.add_argument("--set", action="append", default=[], dest="changes")
    arguments = parser.parse_args()
    lines = ["| obstacle | " + " | ".join(COLUMNS) + " |"]
    lines.append("|" + "---|" * (len(COLUMNS) + 1))
    print("\n".join(lines), flush=True)
    groups = {
        "heights": heights(),
        "random": drawn(arguments.seed, arguments.count),
        "edges": edges(),
    }
    for group in GROUPS if arguments.group is None else (arguments.group,):
        for name, boxes in groups[group]:
            changes = [f"scene.boxes=[{', '.join(boxes)}]", *arguments.changes]
            scenario = load_scenario("obstacle-15cm", changes)
            lines.append(f"| {name} | " + " | ".join(_run(scenario, arguments.keep)))
            lines[-1] += " |"
            print(lines[-1], flush=True)
    if arguments.out is not None:
        arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _run(scenario: Scenario, keep: Path | None) -> list[str]:
    with tempfile.TemporaryDirectory() as scratch:
        folder = (keep or Path(scratch)) / "run"
        summary = run_task(build_task(scenario), scenario, folder).to_json()
    return [_format(summary[name]) for name in COLUMNS]


def _format(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
