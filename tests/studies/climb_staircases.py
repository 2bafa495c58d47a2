"""Climbs staircases drawn at random and writes what came of it, a row each.

    python tests/studies/climb_staircases.py --count 12 --seed 1 --out result.md

The ranges are those within which the robot is meant to climb: rises of 10 to 20 cm,
runs of 27 to 32 cm, two to five steps, yawed by up to 10 deg.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.simulation import run_task

COLUMNS = (
    "outcome",
    "reason",
    "steps_climbed",
    "climb_time_s",
    "max_dcm_error_m",
    "max_foot_slip_m",
    "min_clearance_m",
    "max_speed_fraction",
    "real_time_factor",
)


def overrides(rng: np.random.Generator) -> list[str]:
    """A staircase, where the robot starts before it, and the seed of its noise."""
    rise, run = rng.uniform(0.10, 0.20), rng.uniform(0.27, 0.32)
    yaw = np.radians(rng.uniform(-10.0, 10.0))
    return [
        f"scene.staircase.rise={rise:.3f}",
        f"scene.staircase.run={run:.3f}",
        f"scene.staircase.steps={rng.integers(2, 6)}",
        f"scene.staircase.width={rng.uniform(0.5, 1.2):.2f}",
        f"scene.staircase.closed_risers={'true' if rng.random() < 0.7 else 'false'}",
        f"scene.staircase.x={rng.uniform(0.45, 0.75):.3f}",
        f"scene.staircase.y={rng.uniform(-0.05, 0.05):.3f}",
        f"scene.staircase.yaw={yaw:.4f}",
        f"simulation.seed={rng.integers(1000)}",
    ]


def main() -> None:
    """Runs the study."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, default=None, help="one row of the study")
    parser.add_argument("--out", type=Path, default=None)
    parser.add_argument("--keep", type=Path, default=None, help="folder for the runs")
    parser.add_argument("--set", action="append", default=[], dest="changes")
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    lines = ["| # | staircase | " + " | ".join(COLUMNS) + " |"]
    lines.append("|" + "---|" * (len(COLUMNS) + 2))
    print("\n".join(lines), flush=True)
    for number in range(arguments.count):
        chosen = overrides(rng)
        if arguments.only not in (None, number):
            continue
        scenario = load_scenario("stairs-exp1", [*chosen, *arguments.changes])
        with tempfile.TemporaryDirectory() as scratch:
            folder = (arguments.keep or Path(scratch)) / f"run-{number}"
            summary = run_task(build_task(scenario), scenario, folder).to_json()
        staircase = ", ".join(
            item.removeprefix("scene.staircase.").removeprefix("simulation.")
            for item in chosen
        )
        values = [_format(summary[name]) for name in COLUMNS]
        lines.append(f"| {number} | {staircase} | " + " | ".join(values) + " |")
        print(lines[-1], flush=True)
    if arguments.out is not None:
        arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _format(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
