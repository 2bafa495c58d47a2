"""Carries a sweep out: each run in a process of its own, several at a time, resumed."""

import hashlib
import json
import os
import shlex
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.sweep.definition import Sweep, SweepError, sweep_to_json
from footfall.diagrams.sweep.sampling import Job, jobs_of

DEFINITION_FILE = "sweep.json"
RESULTS_FOLDER, RUNS_FOLDER, JOBS_FOLDER = "results", "runs", "jobs"
WORKER = (sys.executable, "-m", "footfall.diagrams.sweep.worker")
End: TypeAlias = Literal["done", "died", "hung"]
"""How a worker ended: it gave a result, it did not, or its time was up."""
TAIL = 300
"""How much of what a worker said last is told, characters."""


@dataclass(frozen=True)
class JobEnd:
    """What became of a run."""

    job: Job
    end: End
    reason: str
    """In one line."""


Progress: TypeAlias = Callable[[JobEnd, int, int], None]
"""Is told what ended, how many have ended, and of how many."""


def run_sweep(
    sweep: Sweep,
    folder: Path,
    jobs: int,
    progress: Progress | None = None,
    worker: Sequence[str] = WORKER,
) -> list[JobEnd]:
    """Runs what of a sweep has no result yet.

    A run whose worker dies or hangs is told and has no result; the rest goes on, and
    the next time it is tried again. Ctrl-C ends the runs that go on; what has a result
    keeps it.

    Args:
        sweep: what is run.
        folder: where everything goes; one that holds this sweep already is gone on
            with.
        jobs: how many runs go on at a time.
        progress: is told each run that ends.
        worker: the command that runs the job whose file is its argument.

    Returns:
        What became of the runs that were tried.

    Raises:
        SweepError: the folder holds another sweep.
        OSError: it cannot be written to.
    """
    listed = jobs_of(sweep)
    _take_folder(sweep, listed, folder)
    left = [job for job in listed if read_result(sweep, job, folder) is None]
    pool, ends = _Workers(sweep, folder, worker), []
    with ThreadPoolExecutor(max_workers=jobs) as executor:
        futures = [executor.submit(pool.run, job) for job in left]
        try:
            for future in as_completed(futures):
                ends.append(future.result())
                if progress is not None:
                    done = len(listed) - len(left) + len(ends)
                    progress(ends[-1], done, len(listed))
        except BaseException:
            pool.stop()
            for future in futures:
                future.cancel()
            raise
    return ends


class _Workers:
    """The processes of a sweep."""

    def __init__(self, sweep: Sweep, folder: Path, worker: Sequence[str]) -> None:
        self._sweep, self._folder, self._worker = sweep, folder, worker
        self._running: set[subprocess.Popen[str]] = set()
        self._lock = threading.Lock()
        self._stopped = False

    def run(self, job: Job) -> JobEnd:
        """Runs one job in a process of its own."""
        path = self._folder / JOBS_FOLDER / f"{job.number:05d}.json"
        with whole_file(path) as partial:
            data = job_data(self._sweep, job, self._folder)
            partial.write_text(json.dumps(data, indent=1), encoding="utf-8")
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        with self._lock:
            if self._stopped:
                return JobEnd(job, "died", "the sweep was ended")
            process = subprocess.Popen(
                [*self._worker, str(path)],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
                env=environment,
                start_new_session=True,
            )
            self._running.add(process)
        try:
            _, said = process.communicate(timeout=self._sweep.timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            limit = f"{self._sweep.timeout:g} s"
            return JobEnd(job, "hung", f"no result within {limit}, so it was ended")
        finally:
            self._running.discard(process)
        result = read_result(self._sweep, job, self._folder)
        if result is None:
            lines = said.strip().splitlines()
            last = lines[-1][-TAIL:] if lines else "it said nothing"
            return JobEnd(job, "died", f"exit status {process.returncode}: {last}")
        summary = result["summary"]
        return JobEnd(job, "done", f"{summary['outcome']}: {summary['reason']}")

    def stop(self) -> None:
        """Ends all that goes on, and lets nothing begin."""
        with self._lock:
            self._stopped = True
            for process in list(self._running):
                process.kill()


def job_data(sweep: Sweep, job: Job, folder: Path) -> dict[str, Any]:
    """Gives what a worker needs to know of a job, as plain JSON data."""
    name = f"{job.number:05d}"
    return {
        "key": job_key(sweep, job),
        "scenario": sweep.scenario,
        "changes": job.changes(sweep),
        "seed": job.seed,
        "keep": sweep.keep,
        "run": str((folder / RUNS_FOLDER / name).absolute()),
        "result": str((folder / RESULTS_FOLDER / f"{name}.json").absolute()),
    }


def job_key(sweep: Sweep, job: Job) -> str:
    """Computes what tells whether a result belongs to a job."""
    said = json.dumps([sweep.scenario, job.changes(sweep), job.seed])
    return hashlib.sha256(said.encode()).hexdigest()[:16]


def command_of(sweep: Sweep, job: Job) -> str:
    """Writes the command that repeats a run."""
    parts = ["footfall", "run", sweep.scenario, "--seed", str(job.seed)]
    for change in job.changes(sweep):
        parts += ["--set", change]
    return shlex.join(parts)


def read_result(sweep: Sweep, job: Job, folder: Path) -> dict[str, Any] | None:
    """Reads the result of a job; None where there is none, or another job's."""
    path = folder / RESULTS_FOLDER / f"{job.number:05d}.json"
    try:
        result: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, json.JSONDecodeError):
        return None
    return result if result.get("key") == job_key(sweep, job) else None


def _take_folder(sweep: Sweep, jobs: Sequence[Job], folder: Path) -> None:
    """Makes the folder, or finds this sweep in it."""
    keys = [job_key(sweep, job) for job in jobs]
    path = folder / DEFINITION_FILE
    if path.exists():
        found = json.loads(path.read_text(encoding="utf-8"))
        if found["keys"] != keys:
            raise SweepError(
                f"--out {folder}: holds another sweep than {sweep.name}; choose "
                "another folder, or remove it"
            )
    elif folder.exists() and any(folder.iterdir()):
        raise SweepError(f"--out {folder}: exists and is not an empty folder")
    folder.mkdir(parents=True, exist_ok=True)
    # Anew each time: how it is grouped and kept may change without another run.
    with whole_file(path) as partial:
        data = {"keys": keys, "sweep": sweep_to_json(sweep)}
        partial.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    for name in (RESULTS_FOLDER, RUNS_FOLDER, JOBS_FOLDER):
        (folder / name).mkdir(exist_ok=True)
