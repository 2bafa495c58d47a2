"""Runs for long and prints what memory it takes: a robot that stands, closed loop.

    python tests/studies/long_run.py --seconds 300

Every controller is at work and every signal is logged; the robot settles before its
first scan for longer than the run. Prints the resident memory every 30 s of simulated
time, and once the run is judged and its folder is whole.
"""

import argparse
import resource
import tempfile
from pathlib import Path

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.simulation import run_task

EVERY = 30.0
"""Between two lines, s of simulated time."""


def main() -> None:
    """Simulates for so long as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=300.0)
    seconds = parser.parse_args().seconds
    scenario = load_scenario(
        "stairs-exp1",
        [
            f"simulation.max_time={seconds:g}",
            f"parameters.executive.settle_time={2.0 * seconds:g}",
        ],
    )
    told = 0.0

    def tell(time: float, activity: str) -> None:
        nonlocal told
        if time > told + EVERY - 1e-9:
            told += EVERY
            print(f"{time:6.1f} s, {activity}: {megabytes():.1f} MB", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        summary = run_task(build_task(scenario), scenario, Path(folder) / "run", tell)
    print(f"{summary.outcome}, judged and written: {megabytes():.1f} MB")


def megabytes() -> float:
    """The memory of this process that is resident."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


if __name__ == "__main__":
    main()
