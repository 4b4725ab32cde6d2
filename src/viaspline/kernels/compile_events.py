"""Hearing of what numba compiles.

Tested through ``kernels/test_jit``.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import event


class _CompileListener(event.Listener):
    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell

    def on_start(self, event: Any) -> None:
        function = event.data["dispatcher"].py_func
        if function.__module__.startswith("viaspline."):
            self._tell(f"{function.__module__.rsplit('.', 1)[-1]}.{function.__name__}")

    def on_end(self, event: Any) -> None:
        pass


@contextmanager
def compile_progress(tell: Callable[[str], None]) -> Iterator[None]:
    """Within the block, ``tell`` hears the name of every kernel that has to be compiled."""
    listener = _CompileListener(tell)
    with event.install_listener("numba:compile", listener):
        yield


class _TimeListener(event.Listener):
    def __init__(self, done: Callable[[str, float], None]) -> None:
        self._done, self._depth, self._began = done, 0, 0.0

    def on_start(self, event: Any) -> None:
        self._began = self._began if self._depth else time.perf_counter()
        self._depth += 1

    def on_end(self, event: Any) -> None:
        self._depth -= 1
        function = event.data["dispatcher"].py_func
        if not self._depth and function.__module__.startswith("viaspline."):
            took = time.perf_counter() - self._began
            self._done(f"{function.__module__}.{function.__name__}", took)


@contextmanager
def compile_times(done: Callable[[str, float], None]) -> Iterator[None]:
    """Within the block, ``done`` hears how long each kernel took to compile [s].

    What a kernel calls is compiled with it, and counts as its time.
    """
    with event.install_listener("numba:compile", _TimeListener(done)):
        yield
