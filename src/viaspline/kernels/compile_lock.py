"""One process compiles a kernel; the others that need it meanwhile wait and take what it kept.

Several processes that begin on an empty cache would else compile the same kernels at the same
time, each for itself. The lock is the system's and dies with who holds it.

Tested through ``kernels/test_jit``.
"""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # not a Unix: each compiles for itself
    fcntl = None  # type: ignore[assignment]

MAX_WAIT_S = 400.0  # no kernel takes that long: who holds the lock then has failed at it [s]
PAUSE_S = 0.02  # between two looks [s]


class CompileLock:
    """A lock among processes, named by a file; who holds it may take it again.

    Where there are no locks (a file system without, a folder that can't be written) it is free.
    """

    def __init__(self, file: Path) -> None:
        self._file, self._held, self._times = file, -1, 0

    def take(self) -> bool:
        """Take the lock as soon as nobody else holds it.

        Returns:
            Whether somebody else held it meanwhile, and may have kept what is wanted.
        """
        self._times += 1
        if self._times > 1 or fcntl is None:
            return False
        try:
            self._file.parent.mkdir(exist_ok=True)
            self._held = os.open(self._file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        except OSError:
            return False
        return self._wait()

    def _wait(self) -> bool:
        end = time.monotonic() + MAX_WAIT_S
        waited = False
        while time.monotonic() < end:
            try:
                fcntl.flock(self._held, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                waited = True
                time.sleep(PAUSE_S)
            except OSError:
                break
            else:
                return waited
        return waited

    def give_back(self) -> None:
        """Let the next one have it."""
        self._times -= 1
        if not self._times and self._held >= 0:
            with suppress(OSError):
                os.close(self._held)
            self._held = -1
