"""What a page has asked for and is still waited for."""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any, Final

from viaspline.studio.refused_error import RefusedError

MAX_RUNNING_JOBS: Final = 32

Work = Coroutine[Any, Any, None]
Refuses = Callable[[Exception, Any, "str | None"], Awaitable[None]]


class RunningJobs:
    """Works that go on beside each other, as long as their page is open.

    Args:
        refuse: Is told of what a work has raised, with number and kind of the message.
    """

    def __init__(self, refuse: Refuses) -> None:
        self._refuse = refuse
        self._loop = asyncio.get_running_loop()
        self._works: dict[asyncio.Task[None], Work] = {}

    def begin(self, work: Work, number: Any, kind: str) -> None:
        """Begin a work soon.

        Args:
            work: It; it is closed even if it never begins.
            number: What the page calls its message.
            kind: Of the message.

        Raises:
            RefusedError: Too many are under way.
        """
        if len(self._works) >= MAX_RUNNING_JOBS:
            work.close()
            raise RefusedError("too many things are asked for at once")
        task = self._loop.create_task(self._guarded(work, number, kind))
        self._works[task] = work
        task.add_done_callback(self._ended)

    def cancel(self) -> None:
        """Break all of them off."""
        for task, work in self._works.items():
            task.cancel()
            if inspect.getcoroutinestate(work) == inspect.CORO_CREATED:
                work.close()  # now: its task never awaits it, and the loop may be about to end

    def _ended(self, task: asyncio.Task[None]) -> None:
        self._works.pop(task).close()

    async def _guarded(self, work: Work, number: Any, kind: str) -> None:
        try:
            await work
        except Exception as error:
            await self._refuse(error, number, kind)
