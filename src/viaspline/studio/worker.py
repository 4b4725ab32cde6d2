"""A thread that works off calls one after the other and never keeps the program from ending.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import asyncio
import traceback
from collections.abc import Callable
from contextlib import suppress
from queue import SimpleQueue
from threading import Thread
from typing import TypeVar

T = TypeVar("T")


class Worker:
    """One daemon thread; an executor's would be waited for at the end of the program.

    Args:
        name: What the thread is called.
    """

    def __init__(self, name: str) -> None:
        self._calls: SimpleQueue[Callable[[], None]] = SimpleQueue()
        Thread(target=self._work, name=name, daemon=True).start()

    def _work(self) -> None:
        while True:
            self._calls.get()()

    def do(self, call: Callable[[], None]) -> None:
        """Do something some time, without anybody waiting for it; a defect is printed."""

        def work() -> None:
            try:
                call()
            except Exception as error:
                traceback.print_exception(error)

        self._calls.put(work)

    async def run(self, call: Callable[[], T]) -> T:
        """What a call returns or raises."""
        loop = asyncio.get_running_loop()
        future: asyncio.Future[T] = loop.create_future()

        def settle(result: T | None, error: BaseException | None) -> None:
            if future.done():  # nobody waits any more
                return
            if error is not None:
                future.set_exception(error)
            else:
                future.set_result(result)  # type: ignore[arg-type]

        def work() -> None:
            result, error = None, None
            try:
                result = call()
            except BaseException as raised:
                error = raised
            with suppress(RuntimeError):  # the loop has ended meanwhile
                loop.call_soon_threadsafe(settle, result, error)

        self._calls.put(work)
        return await future
