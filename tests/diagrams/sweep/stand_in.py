"""A stand-in for the worker of a sweep: a result in no time, or none.

A run whose `scene.staircase.steps` is 3 dies, one with 4 hangs, one with 6 finds the
disk full, one with 7 is killed, one with 8 takes its worker with it, "cluster"
the worker of the cluster; the rise decides on success. Each leaves its number in a file
`tried`.
"""

import json
import os
import signal
import sys
import time
from pathlib import Path

from footfall.diagrams.sweep.serving import serve


def main() -> None:
    """Serves jobs."""
    serve(run_file)


def run_file(file: Path) -> None:
    """Does what the job's values say."""
    job = json.loads(file.read_text())
    with (Path(job["run"]).parent.parent / "tried").open("a") as tried:
        tried.write(file.stem + "\n")
    said = dict(change.split("=") for change in job["changes"])
    steps = said.get("scene.staircase.steps")
    if steps == "3":
        print("a bad day", file=sys.stderr)
        sys.exit(3)
    if steps == "4":
        time.sleep(60.0)
    if steps == "6":
        Path("/dev/full").write_text("more than fits")
    if steps == "7":
        os.kill(os.getpid(), signal.SIGKILL)
    if steps == "8":
        os.kill(os.getppid(), signal.SIGKILL)
        time.sleep(60.0)
    if steps == '"cluster"':
        worker = Path(f"/proc/{os.getppid()}/stat").read_text()
        os.kill(int(worker.rpartition(")")[2].split()[1]), signal.SIGKILL)
    good = float(said.get("scene.staircase.rise", 0.1)) < 0.15
    summary = {
        "outcome": "completed" if good else "fell",
        "reason": "on top" if good else "the robot fell",
        "climb_time_s": 1.0 + job["seed"],
        "max_foot_slip_m": None,
        "wall_time_s": time.time(),
    }
    costs = {"wall_s": time.time(), "cpu_s": 1.0, "memory_mb": 2.0}
    Path(job["result"]).write_text(
        json.dumps({"key": job["key"], "summary": summary, **costs})
    )


if __name__ == "__main__":
    main()
