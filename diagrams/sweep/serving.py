"""How a worker serves: it imports once, and each job is a fork of it.

A worker reads the paths of job files, a line each, from its standard input. Each job
runs in a process forked from the worker, which is then gone with all its memory
(diagrams leak in Drake: drake#23161), yet has not to import anything. When that
process has ended the worker answers with its exit status on a line of its standard
output; a negative one is the signal that ended it. What the job says goes to the file
`ERRORS` beside its job file.

The worker itself must have no threads that hold locks when it forks: it imports, and
does nothing else.
"""

import os
import select
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

ERRORS = ".stderr"
"""What the name of the file ends with that takes what a job says."""
WATCH = 0.5
"""Between two looks of a job at whether its worker still lives, s."""


def serve(run: Callable[[Path], None]) -> None:
    """Runs jobs until the standard input ends; what goes on then is ended too.

    Args:
        run: runs the job whose file it is given, in a process of its own.
    """
    # Not by Python's buffer: select must see what is there.
    reader = os.fdopen(os.dup(0), "rb", buffering=0)
    while line := reader.readline():
        status = _run_apart(run, Path(line.decode().rstrip("\n")), reader.fileno())
        if status is None:
            return
        print(status, flush=True)


def _run_apart(run: Callable[[Path], None], job: Path, asked: int) -> int | None:
    """Runs a job in a fork; its exit status, or None where it was broken off.

    Args:
        run: runs it.
        job: its file.
        asked: file descriptor of the standard input: nothing is asked while a job runs,
            so that it can be read means that the sweep is gone.
    """
    # Ends when the fork does, for nobody else holds its other end.
    ended, held = os.pipe()
    worker = os.getpid()
    child = os.fork()
    if child == 0:
        os.close(ended)
        _become(run, job, worker)
    os.close(held)
    try:
        ready, _, _ = select.select([ended, asked], [], [])
        if ended not in ready:
            os.kill(child, signal.SIGKILL)
    finally:
        os.close(ended)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status) if ended in ready else None


def _become(run: Callable[[Path], None], job: Path, worker: int) -> NoReturn:
    """Runs a job and ends this process, whatever becomes of it."""
    status = 1
    try:
        nothing = os.open(os.devnull, os.O_RDWR)
        errors = os.open(job.with_suffix(ERRORS), os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        for target, source in ((0, nothing), (1, nothing), (2, errors)):
            os.dup2(source, target)
        threading.Thread(target=_follow, args=(worker,), daemon=True).start()
        run(job)
        status = 0
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 1
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        # Without the worker's own clean-up.
        os._exit(status)


def _follow(worker: int) -> None:
    """Ends this process when its worker is gone, however it went."""
    while os.getppid() == worker:
        time.sleep(WATCH)
    os._exit(1)
