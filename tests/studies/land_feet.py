"""Reads of a sweep's runs what feet feel that land along splines and polynomials.

    footfall sweep tests/studies/land_feet.yaml
    python tests/studies/land_feet.py sweeps/land_feet --out result.md

The obstacle paper's comparison (Sec. III-B: 1200 N against 625 N). Both trajectories
have the same highest point, over an obstacle of 5 cm that both clear; at the paper's
step time for level walking and at ours for crossing; with and without the landing
adaptor's compensation of the legs' sag, which the paper's robot does not have.
"""

import argparse
from pathlib import Path

import numpy as np

from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.sweep.runner import RUNS_FOLDER
from footfall.diagrams.sweep.sampling import jobs_of
from footfall.diagrams.sweep.sweep_folder import SweepFolder, load_sweep
from footfall.diagrams.sweep.table import table_row

WINDOW = 0.05
"""After touch-down a force counts as impact for this long, s."""
TOUCH = 20.0
"""Force that is a touch-down, N."""
WEIGHT = 62.4 * 9.81
"""Of JVRC-1, N."""
HIGH = 0.15
"""Feet that were lifted this high have crossed, m."""
COLUMNS = (
    "profile",
    "single support [s]",
    "sag compensated",
    "outcome",
    "touch-down speed, first and second foot [m/s]",
    "impact, first and second foot [N]",
    "[body weights]",
)


def landings(run: Run) -> list[tuple[float, float]]:
    """Speed, m/s, and largest force, N, of every foot that lands after a crossing."""
    forces, feet = run.signals["station.foot_wrenches"], run.signals["feet.true"]
    contacts = run.signals["motion_player.contacts"]
    time = forces["time"].to_numpy()
    found = []
    for side in ("left", "right"):
        planned = contacts[f"{side}_contact"].to_numpy()
        z = np.interp(time, feet["time"], feet[f"{side}_z"])
        speed = -np.gradient(z, time)
        force = forces[f"{side}_fz"].to_numpy()
        for row in np.flatnonzero(np.diff(planned) > 0.0):
            lands = contacts["time"].to_numpy()[row]
            if z[(time > lands - 1.0) & (time < lands)].max() < HIGH:
                continue
            near = np.flatnonzero((time > lands - 0.15) & (force > TOUCH))[0]
            window = (time >= time[near]) & (time < time[near] + WINDOW)
            # The sample before the last one in the air: differences look both ways.
            found.append(
                (time[near], float(speed[near - 2]), float(force[window].max()))
            )
    return [(v, f) for _, v, f in sorted(found)]


def felt(found: SweepFolder) -> list[str]:
    """Writes what every run of a sweep felt, a row each."""
    lines = [table_row(COLUMNS), "|" + "---|" * len(COLUMNS)]
    for job, outcome in zip(jobs_of(found.sweep), found.table["outcome"], strict=True):
        support, gain, profile = (value for _, value in job.values)
        run = load_run(found.folder / RUNS_FOLDER / f"{job.number:05d}")
        landed = landings(run)
        shown = (
            ", ".join(f"{v:.3f}" for v, _ in landed),
            ", ".join(f"{f:.0f}" for _, f in landed),
            ", ".join(f"{f / WEIGHT:.2f}" for _, f in landed),
        )
        row = (profile, support, "yes" if gain else "no", outcome, *shown)
        lines.append(table_row(row))
    return lines


def main() -> None:
    """Writes the table of a sweep of landings."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sweep", type=Path, help="the sweep's folder")
    parser.add_argument("--out", type=Path, required=True, help="Markdown file")
    arguments = parser.parse_args()
    lines = felt(load_sweep(arguments.sweep))
    arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
