"""A process that drives a kind of mission, compiles what that needs, and lists it.

``python -m viaspline.warming.record_kind lidar+footprint``: every kernel that it compiles is a line
of its output. Another process compiles as well, unless ``alone`` is said after that.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

from viaspline.kernels.compile_events import compile_progress
from viaspline.precompile import Job, second_compiler
from viaspline.warming.driven_kinds import drive_kind, jobs_of_kind
from viaspline.warming.kernel_list import KernelList, package_key
from viaspline.warming.mission_kind import MissionKind, kind_named


def record(kind: MissionKind, tell: Callable[[str], None], jobs: Sequence[Job]) -> KernelList:
    """Drive a kind of mission, and list the kernels that it needs.

    Args:
        kind: Of mission.
        tell: Hears the name of every kernel that is compiled here.
        jobs: What another process compiles meanwhile.
    """
    key = package_key()
    with compile_progress(tell), second_compiler(jobs):
        drive_kind(kind)
    listed = KernelList.of_this_process()
    listed.write(kind, key)
    return listed


def _say(kernel: str) -> None:
    sys.stdout.write(f"{kernel}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    asked = kind_named(sys.argv[1])
    record(asked, _say, () if "alone" in sys.argv[2:] else jobs_of_kind(asked))
