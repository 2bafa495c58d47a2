"""Where the jobs of a sweep run: in processes of this machine, or on a Dask cluster."""

import queue
from collections.abc import Generator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import ExitStack, closing
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Protocol, TypeAlias

from footfall.diagrams.sweep.definition import SweepError
from footfall.diagrams.sweep.launcher import WORKER, Attempt, Launcher, Work

CONNECT_TIMEOUT = 10.0
"""How long a cluster's scheduler is waited for, s."""

Tried: TypeAlias = Generator[tuple[Work, Attempt], None, None]
"""Jobs with what became of them, as they end; to close it ends what goes on."""


class Pool(Protocol):
    """Runs jobs, several at a time."""

    def run(self, works: Sequence[Work], timeout: float, folder: Path) -> Tried:
        """Yields each job with what became of it, as they end.

        Args:
            works: the jobs.
            timeout: after which one counts as hung, s of wall time.
            folder: for what workers of this machine need meanwhile; it exists.

        Raises:
            SweepError: there is nothing to run them on.
        """
        ...


class LocalPool:
    """Processes of this machine."""

    def __init__(self, count: int, worker: Sequence[str] = WORKER) -> None:
        """Begins nothing yet.

        Args:
            count: how many jobs go on at a time.
            worker: the command that serves them.
        """
        self._count, self._worker = count, worker

    def run(self, works: Sequence[Work], timeout: float, folder: Path) -> Tried:
        """Yields each job with what became of it, as they end."""
        count = min(self._count, len(works))
        with ExitStack() as stack:
            launchers = [
                stack.enter_context(
                    closing(Launcher(self._worker, folder, f"{number}"))
                )
                for number in range(count)
            ]
            free: queue.SimpleQueue[Launcher] = queue.SimpleQueue()
            for launcher in launchers:
                free.put(launcher)

            def attempt(work: Work) -> Attempt:
                launcher = free.get()
                try:
                    return launcher.run(work, timeout)
                finally:
                    free.put(launcher)

            executor = stack.enter_context(ThreadPoolExecutor(max_workers=count or 1))
            futures = {executor.submit(attempt, work): work for work in works}
            try:
                for future in as_completed(list(futures)):
                    # Not kept: results of many runs are large.
                    yield futures.pop(future), future.result()
            finally:
                for future in futures:
                    future.cancel()
                for launcher in launchers:
                    launcher.stop()


class DaskPool:
    """Workers of a Dask cluster, a job at a time for each of their threads.

    Each job is a process of its own there too. Scenario and sweep folder have the same
    paths everywhere, on a file system that the machines share; results travel by Dask,
    so without one only the signals that are kept stay where they were made. What goes
    on when a sweep is interrupted ends on its own.
    """

    def __init__(self, address: str, worker: Sequence[str] | None = None) -> None:
        """Connects to nothing yet.

        Args:
            address: of the scheduler, "tcp://HOST:PORT".
            worker: the command that serves jobs; by default ours, by the Python that
                the cluster's worker runs with.
        """
        self._address, self._worker = address, worker

    def run(self, works: Sequence[Work], timeout: float, folder: Path) -> Tried:
        """Yields each job with what became of it, as they end."""
        try:
            import distributed
        except ImportError:
            raise SweepError(
                "--scheduler: needs `distributed`: pip install 'footfall[cluster]'"
            ) from None
        try:
            client = distributed.Client(self._address, timeout=CONNECT_TIMEOUT)
        except (OSError, ValueError) as error:
            said = str(error).splitlines()[0] if str(error) else type(error).__name__
            raise SweepError(f"--scheduler {self._address}: {said}") from None
        with client:
            futures = {
                client.submit(
                    attempt_job, dict(work), timeout, self._worker, pure=False
                ): work
                for work in works
            }
            try:
                for future in distributed.as_completed(list(futures)):
                    work = futures.pop(future)
                    if future.status == "finished":
                        yield work, future.result()
                    elif future.status == "error":
                        yield work, Attempt("died", _one_line(future.exception()))
                    else:
                        yield work, Attempt("died", "the cluster gave it up")
            finally:
                client.cancel(list(futures))


def attempt_job(work: Work, timeout: float, worker: Sequence[str] | None) -> Attempt:
    """Runs a job on the machine that this is called on.

    Args:
        work: the job.
        timeout: after which it counts as hung, s of wall time.
        worker: the command that serves it; None for ours.
    """
    with (
        TemporaryDirectory() as folder,
        closing(Launcher(worker or WORKER, Path(folder), "0")) as launcher,
    ):
        return launcher.run(work, timeout)


def _one_line(error: BaseException | None) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
