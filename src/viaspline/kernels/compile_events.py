"""Hearing of what numba compiles.

Tested through ``kernels/test_jit``.
"""

from __future__ import annotations

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
