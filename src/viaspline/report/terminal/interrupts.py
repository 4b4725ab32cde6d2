"""Ctrl-C and SIGTERM: they end the work even where the exception that they raise is swallowed.

A signal that arrives while a compiler calls back into Python raises its exception in a place from
which it can't travel on: Python reports it as ignored and goes on. So the signal is remembered as
well, and comes through at the next step of the work.

A kernel that runs for long lets no handler run at all. So another thread hears of the signal too,
and if the process is still there some seconds later, it tidies up and ends it.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Thread
from typing import Final

GRACE_S: Final = 2.0
"""How long after a signal the work may take to end by itself [s]."""


class Terminated(BaseException):
    """The process was asked to end (SIGTERM)."""


_remembered: list[type[BaseException]] = []
_undoing: list[Callable[[], object]] = []


def install() -> None:
    """Handle SIGINT and SIGTERM from now on; for the main thread of a process of its own."""
    signal.signal(signal.SIGINT, _interrupt)
    signal.signal(signal.SIGTERM, _terminate)
    _watch_over_kernels()
    usual = sys.unraisablehook

    def quiet(unraisable: sys.UnraisableHookArgs) -> None:
        # What was being made when the signal came may be deleted half made, and complain of that.
        if not _remembered:
            usual(unraisable)

    sys.unraisablehook = quiet


def remembered() -> type[BaseException] | None:
    """The signal that has come, as the exception that it raises."""
    return _remembered[-1] if _remembered else None


def come_through() -> None:
    """Raise the signal that has come, if one has."""
    if _remembered:
        raise _remembered[-1]


@contextmanager
def undone_at_the_end(undo: Callable[[], object]) -> Iterator[None]:
    """Within the block ``undo`` is called if the process has to be ended from outside of it."""
    _undoing.append(undo)
    try:
        yield
    finally:
        _undoing.remove(undo)


def _watch_over_kernels() -> None:
    """Hear of signals in a thread of their own, while the main one is in a kernel."""
    hearing, telling = os.pipe()
    os.set_blocking(telling, False)
    signal.set_wakeup_fd(telling, warn_on_full_buffer=False)
    Thread(target=_end_after, args=(hearing,), daemon=True).start()


def _end_after(hearing: int) -> None:
    """Wait for a signal, and end the process if that doesn't end by itself."""
    signum = 0
    while signum not in (signal.SIGINT, signal.SIGTERM):
        signum = os.read(hearing, 1)[0]
    time.sleep(GRACE_S)
    for undo in reversed(_undoing.copy()):
        with suppress(Exception):
            undo()
    word = "interrupted" if signum == signal.SIGINT else "terminated"
    with suppress(OSError):
        os.write(2, f"viaspline: {word}; no file was left half written\n".encode())
    os._exit(128 + signum)


def _interrupt(signum: int, frame: object) -> None:
    _remembered.append(KeyboardInterrupt)
    raise KeyboardInterrupt


def _terminate(signum: int, frame: object) -> None:
    _remembered.append(Terminated)
    raise Terminated
