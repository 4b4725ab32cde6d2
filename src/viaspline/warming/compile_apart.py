"""Processes of their own that compile and list what kinds of missions need.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from viaspline.kernels.kernel_cache import CACHE_FOLDER
from viaspline.report.terminal.interrupts import undone_at_the_end
from viaspline.warming.mission_kind import MissionKind

Tell = Callable[[str], None]


def compile_apart(kind: MissionKind, tell: Tell, *how: str) -> bool:
    """Have another process compile and list what a kind of mission needs.

    Args:
        kind: Of mission.
        tell: Hears the name of every kernel that it compiles.
        *how: ``alone``: without a third process.

    Returns:
        Whether it could: not where nothing can be kept, nor where there is no interpreter.
    """
    if CACHE_FOLDER is None:
        return False
    command = [sys.executable, "-P", "-m", "viaspline.warming.record_kind", kind.name, *how]
    try:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            text=True, encoding="utf-8",
        )  # fmt: skip
    except OSError:  # no interpreter of its own, as in a frozen program
        return False
    with _ended(process):
        assert process.stdout is not None
        for line in process.stdout:
            tell(line.strip())
        return process.wait() == 0


@contextmanager
def _ended(process: subprocess.Popen[str]) -> Iterator[None]:
    """At the end of the block the process has ended, however that comes."""

    def end() -> None:
        process.kill()
        process.wait()

    try:
        with undone_at_the_end(end):
            yield
    finally:
        end()
        if process.stdout is not None:
            process.stdout.close()
