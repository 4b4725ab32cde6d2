"""Everything that viaspline can need, compiled with all cores.

Each kind of mission is driven in a process of its own; what one has compiled the next finds. The
first ones have little in common, so that no kernel is compiled twice.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from threading import Event
from typing import Final

from viaspline.warming.compile_apart import Tell, compile_apart
from viaspline.warming.mission_kind import MissionKind, kind_named

MAX_PROCESSES: Final = 4

Done = Callable[[MissionKind, float, bool], None]


def every_kind() -> Iterator[MissionKind]:
    """The kinds of missions in which every kernel is called that any can need.

    Every part is in one of them. A mission of a kind that isn't among them finds all of its kernels
    compiled, and only lists which they are.

    >>> from viaspline.warming.mission_kind import PARTS
    >>> kinds = list(every_kind())
    >>> {part for kind in kinds for part in kind.parts} == set(PARTS)
    True
    """
    names = (
        "plain", "space", "fleet", "lidar+differential+footprint",
        "fleet+ackermann+footprint+turning", "lidar", "lidar+map+passive", "ackermann+turning",
        "moving+corridor", "localization+jerk+yaw+laps+zones", "omnidirectional+map+moving",
        "skid_steer+footprint+corridor", "lidar+differential",
    )  # fmt: skip
    yield from map(kind_named, names)


def warm_everything(kinds: Sequence[MissionKind], tell: Tell, done: Done) -> None:
    """Compile all that kinds of missions need, in as many processes as there are cores.

    Args:
        kinds: Of missions, in this order.
        tell: Hears the name of every kernel that is compiled.
        done: Hears of each kind how long it took [s], and whether its process came to its end.
    """
    stopped = Event()

    def one(kind: MissionKind) -> tuple[MissionKind, float, bool]:
        began = time.perf_counter()
        worked = not stopped.is_set() and compile_apart(kind, tell, "alone")
        return kind, time.perf_counter() - began, worked

    with ThreadPoolExecutor(min(os.cpu_count() or 1, MAX_PROCESSES)) as pool:
        try:
            for future in as_completed([pool.submit(one, kind) for kind in kinds]):
                done(*future.result())
        finally:
            stopped.set()
