"""The plan of what is on the screen: the newest document, and none that was overtaken.

While a document is planned, newer ones replace each other; only the newest is planned next. A plan
that takes long is broken off as soon as a newer document is there; of one that will take long the
page is told a provisional path first, and as long as somebody drags nothing else.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any, Final

from starlette.websockets import WebSocketDisconnect

from viaspline.studio.early_paths import is_wanted
from viaspline.studio.engine import Engine, Planned
from viaspline.studio.open_mission import OpenMission
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.stoppable_calls import Stoppable

if TYPE_CHECKING:
    from viaspline.studio.fleet.planned_fleet import PlannedFleet
    from viaspline.studio.plan_document import PlannedDocument
    from viaspline.studio.space.planned_spatial import PlannedSpatial

LEDGER_AFTER_S: Final = 0.1  # so long without an edit, and an expensive ledger is drawn up [s]
OVERTAKEN_AFTER_S: Final = 0.25  # a plan that is done by then is drawn, overtaken or not [s]
STOP_RETRY_S: Final = 0.02  # between two attempts to break a plan off [s]

Sends = Callable[[str], Awaitable[None]]
Refuses = Callable[[Exception], Awaitable[None]]


class LivePlan:
    """Plans what lies on a current whenever it has changed.

    Args:
        engine: Plans.
        current: Whose document is planned.
        send: Hears the plan, its ledger and what it is in time, as text.
        refuse: Hears of a defect.
    """

    def __init__(self, engine: Engine, current: OpenMission, send: Sends, refuse: Refuses) -> None:
        self._engine = engine
        self._current = current
        self._send = send
        self._refuse = refuse
        self._wanted = asyncio.Event()
        self._revision = 0
        self._running = Stoppable()
        self._latest: Planned | None = None

    def want(self, revision: int) -> None:
        """The document has changed: plan it."""
        self._revision = revision
        self._wanted.set()

    def close(self) -> None:
        """Nobody waits any more."""
        self._running.stop()

    async def forever(self) -> None:
        """Plan and tell, until nobody hears it."""
        while True:
            await self._wanted.wait()
            self._wanted.clear()
            try:
                await self._once(self._revision)
            except WebSocketDisconnect:
                return
            except Exception as error:
                await self._refuse(error)

    async def _once(self, revision: int) -> None:
        is_early = await self._tell_early(revision)
        if is_early and not await self._is_idle():
            return  # the newest document has its provisional path first
        self._running = running = Stoppable()
        planning = asyncio.ensure_future(
            self._engine.plan(
                self._current.document, self._current.base, revision, running, self._latest
            )
        )
        patience = 0.0 if is_early else OVERTAKEN_AFTER_S
        overtaking = asyncio.create_task(self._overtake(running, patience))
        planning.add_done_callback(lambda _: overtaking.cancel())
        if is_early and not await self._ends_before_an_edit(planning):
            planning.add_done_callback(_read)
            return  # a kernel may hold its end up: nobody waits for that
        found = await planning
        if found is None:
            return  # overtaken
        planned, text = found
        self._latest = planned
        await self._send(text)
        from viaspline.studio.plan_document import PlannedDocument
        from viaspline.studio.space.planned_spatial import PlannedSpatial

        if isinstance(planned, PlannedSpatial):
            await self._in_space(planned, revision)
            return
        if not isinstance(planned, PlannedDocument):
            await self._whole(planned, revision)
            return
        if planned.plan is None:
            return
        if not (self._engine.ledgers_are_cheap or await self._is_idle()):
            return
        await self._send(await self._engine.ledger(planned, revision))
        if planned.plan.timed is not None:
            await self._send(await self._engine.space_time(planned, revision))

    async def _tell_early(self, revision: int) -> bool:
        """Tell the page where the path will about run, if the plan of it will take long."""
        current = self._current
        if not self._engine.ready or not is_wanted(current.document, self._latest):
            return False
        text = await self._engine.early.told(current.document, current.base, revision, self._latest)
        if text is not None:
            await self._send(text)
        return text is not None

    async def _ends_before_an_edit(self, planning: asyncio.Future[Any]) -> bool:
        edited = asyncio.create_task(self._wanted.wait())
        await asyncio.wait({planning, edited}, return_when=asyncio.FIRST_COMPLETED)
        edited.cancel()
        return planning.done()

    async def _whole(self, planned: PlannedFleet, revision: int) -> None:
        """Try everything for a fleet of which not all are served, once nobody drags any more."""
        if planned.is_whole or not await self._is_idle():
            return
        self._running = running = Stoppable()
        overtaking = asyncio.create_task(self._overtake(running))
        try:
            found = await self._engine.whole_fleet(planned, revision, running)
        finally:
            overtaking.cancel()
        if found is not None:
            self._latest, text = found
            await self._send(text)

    async def _in_space(self, planned: PlannedSpatial, revision: int) -> None:
        """Tell what is round a path in space, and weigh all ways once nobody drags any more."""
        if planned.plan is None:
            return
        if self._engine.elevations_are_cheap or await self._is_idle():
            for text in await self._engine.around_in_space(planned, revision):
                await self._send(text)
        if planned.is_whole or not await self._is_idle():
            return
        self._running = running = Stoppable()
        overtaking = asyncio.create_task(self._overtake(running))
        try:
            found = await self._engine.whole_in_space(planned, revision, running)
        finally:
            overtaking.cancel()
        if found is not None:
            whole, text = found
            self._latest = whole
            await self._send(text)
            await self._in_space(whole, revision)

    async def _overtake(self, running: Stoppable, patience: float = OVERTAKEN_AFTER_S) -> None:
        await asyncio.sleep(patience)
        await self._wanted.wait()
        while True:
            running.stop()
            await asyncio.sleep(STOP_RETRY_S)

    async def _is_idle(self) -> bool:
        try:
            await asyncio.wait_for(self._wanted.wait(), LEDGER_AFTER_S)
        except TimeoutError:
            return True
        return False

    async def planned(self) -> Planned:
        """The plan of the document as it is now."""
        document = self._current.document
        if self._latest is not None and self._latest.document is document:
            return self._latest
        found = await self._engine.plan(
            document, self._current.base, self._revision, Stoppable(), self._latest
        )
        assert found is not None
        return found[0]

    async def planned_mission(self) -> PlannedDocument | PlannedSpatial:
        """The plan of the document as it is now, which has to be that of one robot.

        Raises:
            RefusedError: It is a fleet.
        """
        from viaspline.studio.fleet.planned_fleet import PlannedFleet

        planned = await self.planned()
        if isinstance(planned, PlannedFleet):
            raise RefusedError("that is asked of one robot: this is a fleet")
        return planned

    def forget(self) -> None:
        """Another document has been opened."""
        self._latest = None


def _read(planning: asyncio.Future[Any]) -> None:
    """Take note of how a plan ended that nobody waits for."""
    if not planning.cancelled():
        planning.exception()
