"""Has a worker run jobs, and says of each what became of it, however it ended."""

import json
import os
import select
import signal
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

from footfall.diagrams.signal_files import whole_file
from footfall.diagrams.sweep.serving import ERRORS

WORKER = (sys.executable, "-m", "footfall.diagrams.sweep.worker")
End: TypeAlias = Literal["done", "died", "hung"]
"""How a job ended: it gave a result, it did not, or its time was up."""
Work: TypeAlias = Mapping[str, Any]
"""What a worker needs to know of a job, plain JSON data; "number" tells it apart."""
TAIL = 300
"""How much of what a job said last is told, characters."""


@dataclass(frozen=True)
class Attempt:
    """What became of a job that was tried."""

    end: End
    reason: str = ""
    """Why there is no result, in one line; empty where there is one."""
    result: Mapping[str, Any] | None = None
    """What the job gave, plain JSON data; None where it gave nothing."""


class Launcher:
    """One worker: begun when there is a job, and again where it is gone.

    `stop` may be called from another thread than `run`, `close` when that is over.
    """

    def __init__(self, worker: Sequence[str], folder: Path, name: str) -> None:
        """Begins nothing yet.

        Args:
            worker: the command that serves jobs, see `serving`.
            folder: for the files of jobs and what they say; it exists.
            name: tells the workers of a folder apart.
        """
        self._worker, self._folder = worker, folder
        self._errors = folder / f"worker-{name}{ERRORS}"
        self._process: subprocess.Popen[str] | None = None
        self._lock = threading.Lock()
        self._stopped = False

    def run(self, work: Work, timeout: float) -> Attempt:
        """Runs a job.

        Args:
            work: the job.
            timeout: after which it counts as hung and is ended, s of wall time.
        """
        file = self._folder / f"{work['number']:05d}.json"
        given = file.with_suffix(".result")
        try:
            with whole_file(file) as partial:
                data = {**work, "result": str(given.absolute())}
                partial.write_text(json.dumps(data, indent=1), encoding="utf-8")
            process = self._running()
            if process is None:
                return Attempt("died", "the sweep was ended")
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(f"{file.absolute()}\n")
            process.stdin.flush()
        except OSError as error:
            return Attempt("died", f"could not be begun: {error}")
        ready, _, _ = select.select([process.stdout], [], [], timeout)
        if not ready:
            self._end(process)
            return Attempt("hung", f"no result within {timeout:g} s, so it was ended")
        answer = process.stdout.readline().strip()
        if not answer:
            self._end(process)
            return Attempt("died", self._why(file, f"its worker, {process.returncode}"))
        return self._attempt(file, given, answer)

    def stop(self) -> None:
        """Ends what goes on, and lets nothing begin."""
        with self._lock:
            self._stopped = True
            if self._process is not None:
                self._end(self._process)

    def close(self) -> None:
        """Ends the worker; nothing runs any more."""
        self.stop()
        if self._process is not None:
            _close(self._process)

    def _running(self) -> subprocess.Popen[str] | None:
        """Gives the worker, begun where there is none; None after `stop`."""
        with self._lock:
            if self._stopped:
                return None
            if self._process is None or self._process.poll() is not None:
                if self._process is not None:
                    _close(self._process)
                with self._errors.open("w", encoding="utf-8") as errors:
                    self._process = subprocess.Popen(
                        self._worker,
                        stdin=subprocess.PIPE,
                        stdout=subprocess.PIPE,
                        stderr=errors,
                        text=True,
                        env={**os.environ, "OMP_NUM_THREADS": "1"},
                        start_new_session=True,
                    )
            return self._process

    def _attempt(self, file: Path, given: Path, status: str) -> Attempt:
        """Reads what a job that has ended left, and removes it."""
        try:
            result = json.loads(given.read_text(encoding="utf-8"))
        except (OSError, json.JSONDecodeError):
            return Attempt("died", self._why(file, f"exit status {status}"))
        for path in (file, given, file.with_suffix(ERRORS)):
            path.unlink(missing_ok=True)
        return Attempt("done", result=result)

    def _why(self, file: Path, status: str) -> str:
        """Says how a job ended that gave nothing, and what it said last."""
        last = _last_line(file.with_suffix(ERRORS)) or _last_line(self._errors)
        return f"{status}: {last or 'it said nothing'}"

    @staticmethod
    def _end(process: subprocess.Popen[str]) -> None:
        """Kills a worker with the job that it has forked, and waits for it."""
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _close(process: subprocess.Popen[str]) -> None:
    """Closes the pipes of a worker that is gone, whatever was still in them."""
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            with suppress(OSError):
                pipe.close()


def _last_line(path: Path) -> str:
    """Gives the end of the last line of a file; nothing where there is none."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return ""
    return next((line[-TAIL:] for line in reversed(lines) if line.strip()), "")
