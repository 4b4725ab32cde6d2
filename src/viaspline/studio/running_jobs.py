"""What a page has asked for and is still waited for."""

from __future__ import annotations

import asyncio
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
        self._tasks: set[asyncio.Task[None]] = set()

    def begin(self, work: Work, number: Any, kind: str) -> None:
        """Begin a work soon.

        Args:
            work: It; it is closed even if it never begins.
            number: What the page calls its message.
            kind: Of the message.

        Raises:
            RefusedError: Too many are under way.
        """
        if len(self._tasks) >= MAX_RUNNING_JOBS:
            work.close()
            raise RefusedError("too many things are asked for at once")
        task = self._loop.create_task(self._guarded(work, number, kind))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        # A page that is closed at once has it cancelled before it begins to await the work.
        task.add_done_callback(lambda _: work.close())

    def cancel(self) -> None:
        """Break all of them off."""
        for task in self._tasks:
            task.cancel()

    async def _guarded(self, work: Work, number: Any, kind: str) -> None:
        try:
            await work
        except Exception as error:
            await self._refuse(error, number, kind)
