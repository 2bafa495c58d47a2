"""A stand-in for the worker of a sweep: a result in no time, or none.

A run whose `scene.staircase.steps` is 3 dies, one with 4 hangs, the rise decides on
success; each leaves its number in a file `tried`.
"""

import json
import sys
import time
from pathlib import Path


def main() -> None:
    """Does what the job's values say."""
    job = json.loads(Path(sys.argv[1]).read_text())
    path = Path(job["result"])
    with (path.parent.parent / "tried").open("a") as tried:
        tried.write(path.stem + "\n")
    said = dict(change.split("=") for change in job["changes"])
    if said.get("scene.staircase.steps") == "3":
        print("a bad day", file=sys.stderr)
        sys.exit(3)
    if said.get("scene.staircase.steps") == "4":
        time.sleep(60.0)
    good = float(said.get("scene.staircase.rise", 0.1)) < 0.15
    summary = {
        "outcome": "completed" if good else "fell",
        "reason": "on top" if good else "the robot fell",
        "climb_time_s": 1.0 + job["seed"],
        "max_foot_slip_m": None,
        "wall_time_s": time.time(),
    }
    costs = {"wall_s": time.time(), "cpu_s": 1.0, "memory_mb": 2.0}
    path.write_text(json.dumps({"key": job["key"], "summary": summary, **costs}))


if __name__ == "__main__":
    main()
