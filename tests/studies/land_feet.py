"""Lands feet along splines and along polynomials in physics, and writes what they feel.

    python tests/studies/land_feet.py --out tests/studies/land_feet.md

The obstacle paper's comparison (Sec. III-B: 1200 N against 625 N). Both trajectories
have the same highest point, over an obstacle of 5 cm that both clear; at the paper's
step time for level walking and at ours for crossing; with and without the landing
adaptor's compensation of the legs' sag, which the paper's robot does not have.
"""

import argparse
import itertools
import tempfile
from pathlib import Path

import numpy as np

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import Run, load_run
from footfall.diagrams.simulation import run_task
from footfall.systems.planning.crossing.foot_trajectory_generator import PROFILES

WINDOW = 0.05
"""After touch-down a force counts as impact for this long, s."""
TOUCH = 20.0
"""Force that is a touch-down, N."""
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


def main() -> None:
    """Runs all combinations and writes a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("land_feet.md"))
    path = parser.parse_args().out
    lines = ["| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    for support, gain, profile in itertools.product((1.3, 0.78), (15.0, 0.0), PROFILES):
        scenario = load_scenario(
            "obstacle-15cm",
            [
                "sensors.lidar.tilt_step_deg=0.5",
                "scene.boxes[0].size=[0.05, 1.2, 0.05]",
                "parameters.crossing.feet.apex=0.15",
                "parameters.crossing.min_gap=0.02",
                f"parameters.crossing.feet.profile={profile}",
                f"parameters.crossing.single_support={support}",
                f"parameters.landing.swing_gain={gain}",
            ],
        )
        with tempfile.TemporaryDirectory() as folder:
            summary = run_task(
                build_task(scenario), scenario, Path(folder) / "run"
            ).to_json()
            felt = landings(load_run(Path(folder) / "run"))
        weight = 62.4 * 9.81
        lines.append(
            f"| {profile} | {support:g} | {'yes' if gain else 'no'} | "
            f"{summary['outcome']} | {', '.join(f'{v:.3f}' for v, _ in felt)} | "
            f"{', '.join(f'{f:.0f}' for _, f in felt)} | "
            f"{', '.join(f'{f / weight:.2f}' for _, f in felt)} |"
        )
        print(lines[-1], flush=True)
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
