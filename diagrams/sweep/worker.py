"""A run of a sweep in a process of its own, which is then gone with all its memory.

    python -m footfall.diagrams.sweep.worker JOB.json

The file names the scenario, what differs, and where the run and its result go. The
result is written whole or not at all, so that whoever reads it finds no half of one.
"""

import json
import os
import resource
import shutil
import sys
import threading
import time
from pathlib import Path
from typing import Any

WATCH = 0.5
"""Between two looks at whether the sweep still lives, s."""


def main() -> None:
    """Runs one job."""
    threading.Thread(target=_follow_parent, args=(os.getppid(),), daemon=True).start()
    job: dict[str, Any] = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    result = run_job(job)
    path = Path(job["result"])
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    partial.replace(path)


def run_job(job: dict[str, Any]) -> dict[str, Any]:
    """Simulates one run of a sweep and gives its summary and what it cost."""
    from footfall.diagrams.closed_loop.tasks import build_task
    from footfall.diagrams.scenario import load_scenario
    from footfall.diagrams.signals import SIGNALS_FOLDER
    from footfall.diagrams.simulation import run_task

    begin, folder = time.perf_counter(), Path(job["run"])
    shutil.rmtree(folder, ignore_errors=True)
    seed = f"simulation.seed={job['seed']}"
    scenario = load_scenario(job["scenario"], [*job["changes"], seed])
    summary = run_task(build_task(scenario), scenario, folder).to_json()
    done = summary["outcome"] == "completed"
    if job["keep"] == "none" or (job["keep"] == "failures" and done):
        shutil.rmtree(folder / SIGNALS_FOLDER, ignore_errors=True)
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return {
        "key": job["key"],
        "summary": summary,
        "wall_s": time.perf_counter() - begin,
        "cpu_s": usage.ru_utime + usage.ru_stime,
        "memory_mb": usage.ru_maxrss / 1024.0,
    }


def _follow_parent(parent: int) -> None:
    """Ends this process when the sweep that began it is gone, however it went."""
    while os.getppid() == parent:
        time.sleep(WATCH)
    os._exit(1)


if __name__ == "__main__":
    main()
