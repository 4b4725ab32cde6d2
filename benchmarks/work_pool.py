"""Jobs on a few processes, each ended when it takes too long."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Callable, Iterable, Iterator
from multiprocessing.connection import Connection, wait
from typing import Any


class Worker:
    """A process that does one job after the other.

    Args:
        do: What is done with each job; it has to be importable.
    """

    def __init__(self, do: Callable[[Any], Any]) -> None:
        self.do, self.job, self.since = do, None, 0.0
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.ends, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs, self.do), daemon=True)
        self.process.start()
        theirs.close()

    def give(self, job: Any) -> None:
        """Have a job done."""
        self.job, self.since = job, time.monotonic()
        self.ends.send(job)

    def take(self) -> Any:
        """What came of its job; None if its process died of it."""
        self.job = None
        try:
            return self.ends.recv()
        except EOFError:
            self.restart()
            return None

    def restart(self) -> None:
        """End the job that is being done."""
        self.job = None
        self.close()
        self._start()

    def close(self) -> None:
        """End its process."""
        self.process.kill()
        self.process.join()
        self.ends.close()


def _serve(ends: Connection, do: Callable[[Any], Any]) -> None:
    while True:
        ends.send(do(ends.recv()))


def done(
    do: Callable[[Any], Any], jobs: Iterable[Any], processes: int, budget: float, limit: float
) -> Iterator[tuple[Any, Any]]:
    """Each job and what came of it, as they end; None for one that took too long or died.

    Args:
        do: What is done with each job.
        jobs: As many as there are.
        processes: At the same time.
        budget: After which no further job is begun [s].
        limit: After which a job is ended [s].
    """
    waiting, end = iter(jobs), time.monotonic() + budget
    workers = [Worker(do) for _ in range(processes)]
    try:
        while True:
            for worker in workers:
                if worker.job is None and time.monotonic() < end:
                    job = next(waiting, None)
                    if job is not None:
                        worker.give(job)
            busy = [worker for worker in workers if worker.job is not None]
            if not busy:
                return
            ready = wait([worker.ends for worker in busy], timeout=0.5)
            for worker in busy:
                job = worker.job
                if worker.ends in ready:
                    yield job, worker.take()
                elif time.monotonic() - worker.since > limit:
                    worker.restart()
                    yield job, None
    finally:
        for worker in workers:
            worker.close()
