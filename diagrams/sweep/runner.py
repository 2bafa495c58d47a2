"""Carries a sweep out: each run in a process of its own, several at a time, resumed."""

import hashlib
import json
import shlex
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.sweep.definition import Sweep, SweepError, sweep_to_json
from footfall.diagrams.sweep.launcher import Attempt, End
from footfall.diagrams.sweep.pools import Pool
from footfall.diagrams.sweep.sampling import Job, jobs_of

DEFINITION_FILE = "sweep.json"
RESULTS_FOLDER, RUNS_FOLDER, JOBS_FOLDER = "results", "runs", "jobs"


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
    sweep: Sweep, folder: Path, pool: Pool, progress: Progress | None = None
) -> list[JobEnd]:
    """Runs what of a sweep has no result yet.

    A run whose worker dies or hangs, or whose result cannot be written, is told and has
    no result; the rest goes on, and the next time it is tried again. Ctrl-C ends the
    runs that go on; what has a result keeps it.

    Args:
        sweep: what is run.
        folder: where everything goes; one that holds this sweep already is gone on
            with.
        pool: where the runs go on, and how many at a time.
        progress: is told each run that ends.

    Returns:
        What became of the runs that were tried.

    Raises:
        SweepError: the folder holds another sweep, or the pool is not to be had.
        OSError: the folder cannot be made.
    """
    listed = jobs_of(sweep)
    _take_folder(sweep, listed, folder)
    left = [job for job in listed if read_result(sweep, job, folder) is None]
    works = [job_data(sweep, job, folder) for job in left]
    ends: list[JobEnd] = []
    tried = pool.run(works, sweep.timeout, folder / JOBS_FOLDER)
    with closing(tried):
        for work, attempt in tried:
            ends.append(_keep(listed[work["number"]], attempt, folder))
            if progress is not None:
                done = len(listed) - len(left) + len(ends)
                progress(ends[-1], done, len(listed))
    return ends


def _keep(job: Job, attempt: Attempt, folder: Path) -> JobEnd:
    """Writes the result of a job, and says what became of it."""
    if attempt.result is None:
        return JobEnd(job, attempt.end, attempt.reason)
    try:
        with whole_file(_result_file(job, folder)) as partial:
            text = json.dumps(attempt.result, indent=1) + "\n"
            partial.write_text(text, encoding="utf-8")
    except OSError as error:
        return JobEnd(job, "died", f"its result cannot be written: {error}")
    summary = attempt.result["summary"]
    return JobEnd(job, "done", f"{summary['outcome']}: {summary['reason']}")


def job_data(sweep: Sweep, job: Job, folder: Path) -> Mapping[str, Any]:
    """Gives what a worker needs to know of a job, as plain JSON data."""
    return {
        "number": job.number,
        "key": job_key(sweep, job),
        "scenario": sweep.scenario,
        "changes": job.changes(sweep),
        "seed": job.seed,
        "keep": sweep.keep,
        "run": str((folder / RUNS_FOLDER / f"{job.number:05d}").absolute()),
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
    try:
        text = _result_file(job, folder).read_text(encoding="utf-8")
        result: dict[str, Any] = json.loads(text)
    except (FileNotFoundError, json.JSONDecodeError):
        return None
    return result if result.get("key") == job_key(sweep, job) else None


def _result_file(job: Job, folder: Path) -> Path:
    return folder / RESULTS_FOLDER / f"{job.number:05d}.json"


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
