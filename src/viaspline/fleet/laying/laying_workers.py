"""Who does independent pieces of work: this process, several of this machine, or a cluster.

What comes of a piece depends on the piece alone, so the bytes of the whole don't depend on who does
it, in which order, or how often it has to be done again.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from importlib import import_module
from multiprocessing import get_context
from typing import Any, Protocol, Self, TypeVar

from viaspline.errors import GeometryError, WorkersError

Part = TypeVar("Part")
Done = TypeVar("Done")

MAX_DEATHS = 5
"""After so many deaths of workers the work itself is taken to be what kills them."""


class LayingWorkers(Protocol):
    """Does pieces of work."""

    def each(
        self, task: Callable[[Part], Done], parts: Sequence[Part]
    ) -> Iterator[tuple[int, Done]]:
        """Do a task for every part.

        Args:
            task: A function of a module.
            parts: What it is done for.

        Returns:
            (index of the part, what came of it), in any order.
        """
        ...


@dataclass(frozen=True)
class ThisProcess:
    """Does them here, one after the other."""

    def each(
        self, task: Callable[[Part], Done], parts: Sequence[Part]
    ) -> Iterator[tuple[int, Done]]:
        """See ``LayingWorkers``."""
        return ((k, task(part)) for k, part in enumerate(parts))


class Processes:
    """Does them in processes of this machine; what one did when it died is done again.

    They are spawned, never forked: a fork would take over the locks of numba's threads. So a script
    that makes some has to begin what it does with ``if __name__ == "__main__":``.

    Args:
        count: How many.

    Raises:
        GeometryError: That is no whole number from 1 on.

    Example:
        >>> with Processes(2) as workers:
        ...     sorted(workers.each(abs, [3, -4]))
        [(0, 3), (1, 4)]
    """

    def __init__(self, count: int) -> None:
        if not isinstance(count, int) or count < 1:
            raise GeometryError(f"the number of processes is {count!r:.40}; give one from 1 on")
        self._count = count
        self._pool = self._fresh()

    def _fresh(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self._count, get_context("spawn"), _leave_interrupts)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """End the processes; what they are at is left."""
        self._pool.shutdown(cancel_futures=True)

    def each(
        self, task: Callable[[Part], Done], parts: Sequence[Part]
    ) -> Iterator[tuple[int, Done]]:
        """See ``LayingWorkers``.

        Raises:
            WorkersError: Processes die again and again.
        """
        left = set(range(len(parts)))
        deaths = 0
        while left:
            try:
                futures = {self._pool.submit(task, parts[k]): k for k in sorted(left)}
                for future in as_completed(futures):
                    done = future.result()
                    left.discard(futures[future])
                    yield futures[future], done
            except BrokenProcessPool as error:
                deaths += 1
                self._pool.shutdown()
                self._pool = self._fresh()
                if deaths > MAX_DEATHS:
                    raise WorkersError(
                        f"{deaths} processes died one after the other, the last of them with "
                        f"{len(left)} of {len(parts)} pieces of work left; give fewer workers, "
                        "each of which takes memory"
                    ) from error


def _leave_interrupts() -> None:
    """Leave it to the first process to end the others: they hear the same keys."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@dataclass(frozen=True)
class Cluster:
    """Does them on a cluster of ``dask.distributed``, which does a dead worker's work again.

    Attributes:
        client: A ``distributed.Client`` of the cluster's scheduler.
    """

    client: Any

    def each(
        self, task: Callable[[Part], Done], parts: Sequence[Part]
    ) -> Iterator[tuple[int, Done]]:
        """See ``LayingWorkers``.

        Raises:
            WorkersError: Workers die again and again, or the scheduler is gone.
        """
        distributed: Any = import_module("distributed")
        lost = (distributed.scheduler.KilledWorker, CancelledError, OSError)
        try:
            futures = [self.client.submit(task, part, pure=False) for part in parts]
            numbers = {future.key: k for k, future in enumerate(futures)}
            for future, done in distributed.as_completed(futures, with_results=True):
                yield numbers[future.key], done
        except lost as error:
            raise WorkersError(
                f"the cluster lost a piece of work ({' '.join(str(error).split())}); see that its "
                "scheduler and its workers stay up and have the same viaspline as this machine"
            ) from error
