"""Works of a page: too many are refused, and each is closed whatever becomes of it."""

from __future__ import annotations

import asyncio
import gc
import inspect
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

import pytest

from viaspline.studio.refused_error import RefusedError
from viaspline.studio.running_jobs import MAX_RUNNING_JOBS, RunningJobs

T = TypeVar("T")


def run(scenario: Coroutine[Any, Any, T]) -> T:
    """In a thread of its own: tests in a browser have a loop in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, scenario).result()


def test_a_work_that_is_broken_off_before_it_began_is_closed() -> None:
    async def scenario() -> Coroutine[Any, Any, None]:
        jobs = RunningJobs(nobody)
        work = asyncio.sleep(0)
        jobs.begin(work, 1, "edit")
        jobs.cancel()
        return work  # and the loop ends

    work = run(scenario())
    assert inspect.getcoroutinestate(work) == inspect.CORO_CLOSED
    del work
    gc.collect()  # a coroutine that was never awaited would be warned of, which is an error here


def test_what_a_work_raises_is_told_with_its_message() -> None:
    told: list[tuple[str, Any, str | None]] = []

    async def refuse(error: Exception, number: Any, kind: str | None) -> None:
        told.append((str(error), number, kind))

    async def scenario() -> None:
        jobs = RunningJobs(refuse)
        jobs.begin(failing(), 7, "export")
        await asyncio.sleep(0.01)

    run(scenario())
    assert told == [("no such format", 7, "export")]


def test_too_many_at_once_are_refused_and_there_is_room_again_when_one_has_ended() -> None:
    async def scenario() -> None:
        jobs, gate = RunningJobs(nobody), asyncio.Event()
        for _ in range(MAX_RUNNING_JOBS):
            jobs.begin(passing(gate), None, "open")
        with pytest.raises(RefusedError, match="too many"):
            jobs.begin(passing(gate), None, "open")
        gate.set()
        await asyncio.sleep(0.01)
        jobs.begin(passing(gate), None, "open")
        await asyncio.sleep(0.01)

    run(scenario())


async def nobody(error: Exception, number: Any, kind: str | None) -> None:
    raise AssertionError(error)


async def failing() -> None:
    raise ValueError("no such format")


async def passing(gate: asyncio.Event) -> None:
    await gate.wait()
