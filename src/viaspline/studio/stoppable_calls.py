"""Calls that are stopped from another thread, at their next step in Python.

The planner has no place where it asks whether it is still wanted; Ctrl-C ends it by an exception
that comes from outside. So does this, for a thread that is not the main one.
"""

from __future__ import annotations

import ctypes
import math
import sys
import time
from collections.abc import Callable
from threading import Lock, get_ident
from typing import Final, TypeVar

T = TypeVar("T")

UNBROKEN_PACKAGES: Final = ("importlib", "_frozen_importlib", "numba", "llvmlite")
"""Packages whose work is never broken off: half an import or a kernel would be left behind."""


RESEND_AFTER_S: Final = 0.05
"""Pause before an exception that may have been lost is sent once more [s]: a call that is about to
end has to come through with it, and would not under a hail of them."""


class StoppedCallError(BaseException):
    """The call was stopped; like KeyboardInterrupt nothing on its way takes it for a fault."""


class Stoppable:
    """One call that may be stopped.

    >>> Stoppable().run(lambda: 7)
    7
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._thread: int | None = None
        self._is_over = False
        self._was_stopped = False
        self._sent = -math.inf

    def run(self, call: Callable[[], T]) -> T:
        """What the call returns or raises.

        Raises:
            StoppedCallError: It was stopped, or was to be before it began.
        """
        try:
            self._begin()
            try:
                return call()
            finally:
                self._end()
        except BaseException as error:
            self._end()  # the exception may have come while the call was about to end
            if self._was_stopped and not isinstance(error, StoppedCallError):
                raise StoppedCallError from error  # compiled code makes another one of it
            raise

    def stop(self) -> None:
        """Stop the call, or keep it from beginning.

        What it imports or compiles is finished first, and an exception that comes within a
        callback of a compiler is lost: ask again until the call has ended.
        """
        with self._lock:
            if self._thread is None:
                self._is_over = True
            elif time.monotonic() - self._sent > RESEND_AFTER_S and _is_free(self._thread):
                self._was_stopped, self._sent = True, time.monotonic()
                _raise_in(self._thread, StoppedCallError)

    def _begin(self) -> None:
        with self._lock:
            if self._is_over:
                raise StoppedCallError
            self._thread = get_ident()

    def _end(self) -> None:
        with self._lock:
            may_still_come = self._thread is not None and self._was_stopped
            self._thread, self._is_over = None, True
        if may_still_come:
            _catch_what_was_sent()


def _is_free(thread: int) -> bool:
    """Whether a thread is doing nothing that has to be done whole."""
    frame = sys._current_frames().get(thread)
    while frame is not None:
        if str(frame.f_globals.get("__name__")).split(".")[0] in UNBROKEN_PACKAGES:
            return False
        frame = frame.f_back
    return True


def _catch_what_was_sent() -> None:
    """Have what was sent to this thread, and has perhaps not been raised yet, raised here.

    To take it back instead leaves CPython 3.11 looking for it for ever: every call and every turn
    of a loop, in all threads, is slower from then on, and ``cProfile`` never ends.
    """
    try:
        _raise_in(get_ident(), StoppedCallError)  # there is one at most: this is in its place
        while True:
            pass
    except StoppedCallError:
        pass


def _raise_in(thread: int, error: type[BaseException]) -> None:
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(error))
