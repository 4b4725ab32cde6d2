"""Who lays the paths of a fleet: a cluster, processes of this machine, or this process.

Tested through ``fleet/laying/test_laying_workers``.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from typing import Any

from viaspline.errors import WorkersError
from viaspline.fleet.laying.laying_workers import Cluster, LayingWorkers, Processes, ThisProcess

ROBOTS_SAVED = 500
"""So many robots a first process has to be spared before it is worth it that others start."""
MOST_PROCESSES = 32
"""So many at most, where nobody says."""
CONNECT_S = 10.0
"""So long a scheduler may take to answer [s]."""


def usual_count(robots: int) -> int:
    """How many processes lay the paths of so many robots where nobody says.

    Args:
        robots: Of the fleet.
    """
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    count = min(cores or 1, MOST_PROCESSES)
    return count if robots - robots // count >= ROBOTS_SAVED else 1


@contextmanager
def local_workers(count: int) -> Iterator[LayingWorkers]:
    """So many processes of this machine; this process alone where one is enough.

    Args:
        count: How many.
    """
    if count == 1:
        yield ThisProcess()
        return
    with Processes(count) as workers:
        yield workers


@contextmanager
def cluster_workers(scheduler: str) -> Iterator[LayingWorkers]:
    """The workers of a cluster of ``dask.distributed``.

    Args:
        scheduler: The address of its scheduler, as in ``tcp://10.0.0.5:8786``.

    Raises:
        WorkersError: ``distributed`` isn't installed, or there is no scheduler at this address.
    """
    try:
        distributed: Any = import_module("distributed")
    except ImportError as error:
        raise WorkersError(
            "a cluster needs dask.distributed, which isn't installed; "
            'pip install "viaspline[cluster]"'
        ) from error
    client = distributed.Client.__new__(distributed.Client)
    try:
        client.__init__(scheduler, timeout=CONNECT_S)
    except (OSError, ValueError) as error:
        # Left to the garbage collector it would close itself while another one begins, and both
        # would wait for the same lock for ever.
        with suppress(Exception):
            client.close()
        raise WorkersError(
            f"no scheduler of dask answers at {scheduler}; start one (dask scheduler), and give "
            "the address that it tells"
        ) from error
    with client:
        yield Cluster(client)
