"""Who does independent pieces of work: this process, several of this machine, or a cluster.

What comes of a piece depends on the piece alone, so the bytes of the whole don't depend on who does
it, in which order, or how often it has to be done again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from importlib import import_module
from multiprocessing import get_context
from typing import Any, Protocol, TypeVar

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


@dataclass(frozen=True)
class Processes:
    """Does them in processes of this machine; what one did when it died is done again.

    Attributes:
        count: How many.
    """

    count: int

    def each(
        self, task: Callable[[Part], Done], parts: Sequence[Part]
    ) -> Iterator[tuple[int, Done]]:
        """See ``LayingWorkers``.

        Raises:
            BrokenProcessPool: When processes die again and again.
        """
        left = set(range(len(parts)))
        for death in range(MAX_DEATHS + 1):
            try:
                # Spawned, never forked: a fork would take over the locks of numba's threads.
                with ProcessPoolExecutor(self.count, get_context("spawn")) as pool:
                    futures = {pool.submit(task, parts[k]): k for k in sorted(left)}
                    for future in as_completed(futures):
                        done = future.result()
                        left.discard(futures[future])
                        yield futures[future], done
            except BrokenProcessPool:
                if death == MAX_DEATHS:
                    raise
            if not left:
                return


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
        """See ``LayingWorkers``."""
        gathered: Any = import_module("distributed").as_completed
        futures = [self.client.submit(task, part, pure=False) for part in parts]
        numbers = {future.key: k for k, future in enumerate(futures)}
        for future, done in gathered(futures, with_results=True):
            yield numbers[future.key], done
