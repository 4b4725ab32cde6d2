"""What a mission needs, loaded before it is driven; compiled, if that has never been done.

What was never compiled is by driving small missions of its kind, in a process of its own, which
lists what they need. What is on that list is then loaded here, and no garbage collection of a later
step looks at it again.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from viaspline.warming.compile_apart import Tell, compile_apart
from viaspline.warming.kernel_list import KernelList, package_key
from viaspline.warming.mission_kind import MissionKind, kinds_of
from viaspline.warming.spared_collections import spare_collections

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission


def warm_up(asked: Mission | Fleet, tell: Tell | None = None) -> None:
    """Load all kernels and modules that a mission or a fleet can need; compile what isn't yet.

    Args:
        asked: What will be planned and driven.
        tell: Hears the name of every kernel that has to be compiled.
    """
    key = package_key()
    for kind in kinds_of(asked):
        warm_kind(kind, key, tell or _silent)
    spare_collections()


def warm_kind(kind: MissionKind, key: str, tell: Tell) -> None:
    """Load all that a kind of mission can need; compile what isn't yet.

    Args:
        kind: Of mission.
        key: That of the sources, by ``package_key``.
        tell: Hears the name of every kernel that has to be compiled.
    """
    if os.environ.get("NUMBA_DISABLE_JIT") == "1":
        return
    listed = KernelList.read(kind, key)
    if listed is not None and not listed.load():
        return
    compile_apart(kind, tell)
    listed = KernelList.read(kind, key)
    if listed is None or listed.load():  # there is no cache, or no other process
        from viaspline.warming.record_kind import record

        record(kind, tell, ())


def _silent(kernel: str) -> None:
    del kernel
