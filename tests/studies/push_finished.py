"""Pushes robots that have finished their task, and writes what the judge makes of it.

    python tests/studies/push_finished.py --out tests/studies/push_finished.md

Three scenarios are run as they are, to learn when their executives say that they are
done, and again with a push of 0.1 s on the torso 0.1 s later: hard ones that make the
robot fall, and the same ones of 20 N, which it stands. A judge that looks away too
early calls all of them completed.
"""

import argparse
import multiprocessing
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.judge.summary import Summary
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signals import load_run
from footfall.diagrams.simulation import run_task
from footfall.diagrams.task_params import PushParams

SCENARIOS = ("stairs-exp1", "obstacle-15cm", "room")
AFTER = 0.1
"""When the push begins, s after the executive is done."""
DURATION = 0.1
"""s."""
HARD = {"sideways": (0.0, 700.0), "back": (-700.0, 0.0), "forward": (900.0, 0.0)}
"""Force ahead and to the left of the robot, N."""
SOFT = 20.0
"""N."""
COLUMNS = ("scenario", "push [N]", "outcome", "reason", "watched until [s]")


def run(
    name: str, overrides: list[str], push: PushParams | None
) -> tuple[Summary, float]:
    """Runs a scenario; its summary, and when its executive was done, s."""
    scenario = load_scenario(name, overrides)
    if push is not None:
        scenario.task.pushes.append(push)
    with tempfile.TemporaryDirectory() as folder:
        summary = run_task(build_task(scenario), scenario, Path(folder) / "run")
        entries = load_run(Path(folder) / "run").values("executive.status")
    done = [time for time, value in entries if value["state"] == "finished"]
    return summary, done[0] if done else float("nan")


def pushes(name: str, finished: float) -> Iterator[tuple[str, PushParams]]:
    """What a robot is pushed with, and how that is called."""
    goal = load_scenario(name).task.goal
    yaw = goal[2] if load_scenario(name).scene.staircase is None else 0.0
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    for direction, force in HARD.items():
        for size in (float(np.linalg.norm(force)), SOFT):
            pushed = turn @ np.array(force) * size / np.linalg.norm(force)
            yield (
                f"{size:.0f} {direction}",
                PushParams(
                    time=finished + AFTER,
                    duration=DURATION,
                    force=[float(pushed[0]), float(pushed[1]), 0.0],
                ),
            )


def row(name: str, push: str, summary: Summary) -> str:
    """A line of the table."""
    return (
        f"| {name} | {push} | {summary.outcome} | {summary.reason} | "
        f"{summary.simulated_time_s:.2f} |"
    )


def rows(name: str, overrides: list[str]) -> list[str]:
    """The lines of one scenario: as it is, then with every push."""
    summary, finished = run(name, overrides, None)
    found = [row(name, "none", summary)]
    for what, push in pushes(name, finished):
        summary, _ = run(name, overrides, push)
        found.append(row(name, what, summary))
    return found


def main() -> None:
    """Runs all combinations and writes a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("push_finished.md"))
    parser.add_argument("--scenarios", nargs="+", default=list(SCENARIOS))
    parser.add_argument("--set", dest="overrides", action="append", default=[])
    parser.add_argument("--workers", type=int, default=2)
    arguments = parser.parse_args()
    lines = ["| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(arguments.workers, mp_context=context) as pool:
        several = partial(rows, overrides=arguments.overrides)
        for found in pool.map(several, arguments.scenarios):
            lines += found
            arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
