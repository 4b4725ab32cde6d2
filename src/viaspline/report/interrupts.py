"""Ctrl-C and SIGTERM: they end the work even where the exception that they raise is swallowed.

A signal that arrives while a compiler calls back into Python raises its exception in a place from
which it can't travel on: Python reports it as ignored and goes on. So the signal is remembered as
well, and comes through at the next step of the work.
"""

from __future__ import annotations

import signal
import sys


class Terminated(BaseException):
    """The process was asked to end (SIGTERM)."""


_remembered: list[type[BaseException]] = []


def install() -> None:
    """Handle SIGINT and SIGTERM from now on; for the main thread of a process of its own."""
    signal.signal(signal.SIGINT, _interrupt)
    signal.signal(signal.SIGTERM, _terminate)
    usual = sys.unraisablehook

    def quiet(unraisable: sys.UnraisableHookArgs) -> None:
        if not issubclass(unraisable.exc_type, KeyboardInterrupt | Terminated):
            usual(unraisable)

    sys.unraisablehook = quiet


def remembered() -> type[BaseException] | None:
    """The signal that has come, as the exception that it raises."""
    return _remembered[-1] if _remembered else None


def come_through() -> None:
    """Raise the signal that has come, if one has."""
    if _remembered:
        raise _remembered[-1]


def _interrupt(signum: int, frame: object) -> None:
    _remembered.append(KeyboardInterrupt)
    raise KeyboardInterrupt


def _terminate(signum: int, frame: object) -> None:
    _remembered.append(Terminated)
    raise Terminated
