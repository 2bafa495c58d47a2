"""The worker of a sweep, which `serving` describes.

    python -m footfall.diagrams.sweep.worker

A job's file names the scenario, what differs, and where the run and its result go. The
result is written whole or not at all, so that whoever reads it finds no half of one.
"""

import json
import resource
import shutil
import time
from importlib import import_module
from pathlib import Path
from typing import Any

from footfall.diagrams.closed_loop.tasks import build_task
from footfall.diagrams.scenario import load_scenario
from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.signals import SIGNALS_FOLDER
from footfall.diagrams.simulation import run_task
from footfall.diagrams.sweep.serving import serve


def main() -> None:
    """Serves jobs."""
    # Half of what there is to import; systems that need it import it late.
    import_module("footfall.systems.open3d_loader")
    serve(run_file)


def run_file(file: Path) -> None:
    """Runs the job of a file and writes its result.

    Raises:
        OSError: the result, or the run, cannot be written.
    """
    job: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    result = run_job(job)
    with whole_file(Path(job["result"])) as partial:
        partial.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


def run_job(job: dict[str, Any]) -> dict[str, Any]:
    """Simulates one run of a sweep and gives its summary and what it cost."""
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


if __name__ == "__main__":
    main()
