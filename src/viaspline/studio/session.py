"""One open page: what it says, and what it is answered.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import asyncio
import os
import traceback
from collections.abc import Callable, Coroutine
from threading import Event as Flag
from typing import Any, Final

from starlette.websockets import WebSocket, WebSocketDisconnect

from viaspline import __version__
from viaspline.errors import ViasplineError
from viaspline.studio import file_requests
from viaspline.studio.background import background_requests
from viaspline.studio.background.background_pictures import BackgroundPictures
from viaspline.studio.document import EMPTY_DOCUMENT, changed
from viaspline.studio.drive_forms import drive_forms
from viaspline.studio.engine import Engine
from viaspline.studio.folder import Folder
from viaspline.studio.live_planning import LivePlan
from viaspline.studio.open_mission import OpenMission
from viaspline.studio.page_messages import Message, count_of, decoded, encoded
from viaspline.studio.pasted_parts import pasted_parts
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.running_jobs import RunningJobs
from viaspline.studio.variant_comparison import VariantComparison


class Session:
    """A connection to a page.

    Args:
        socket: The connection, not yet accepted.
        engine: Plans and drives.
        folder: Where missions are opened and saved.
        name: The mission that the studio was started with.
        backgrounds: Opens the pictures under missions.
    """

    def __init__(
        self,
        socket: WebSocket,
        engine: Engine,
        folder: Folder,
        name: str | None,
        backgrounds: BackgroundPictures,
    ) -> None:
        self._socket = socket
        self._backgrounds = backgrounds
        self._engine = engine
        self._current = OpenMission(folder, name)
        self._live = LivePlan(engine, self._current, self._send_text, self._refuse_edit)
        self._comparison = VariantComparison(engine.variants, self._current, self._send_text)
        self._driven: file_requests.Driven | None = None
        self._sending = asyncio.Lock()
        self._stop = Flag()
        self._jobs = RunningJobs(self._refuse)
        self._loop = asyncio.get_running_loop()

    async def talk(self) -> None:
        """Until the page is closed."""
        await self._socket.accept()
        self._engine.listeners.add(self._compiling)
        planning = self._loop.create_task(self._live.forever())
        try:
            await self._greet()
            while True:
                await self._hear(await self._socket.receive_text())
        except (WebSocketDisconnect, KeyError):
            pass  # closed, or a message that is no text
        finally:
            self._engine.listeners.discard(self._compiling)
            self._stop.set()
            self._live.close()
            self._comparison.stop()
            planning.cancel()
            self._jobs.cancel()

    async def _greet(self) -> None:
        current = self._current
        problem: str | None = None
        notes: tuple[str, ...] = ()
        if current.name is not None:
            try:
                notes = current.open(current.name)
            except ViasplineError as error:
                problem = current.folder.told(str(error))
        await self._send(
            type="hello",
            version=__version__,
            folder=current.folder.root.name,
            name=current.name,
            document=current.document,
            origin=current.origin,
            empty=EMPTY_DOCUMENT,
            drives=drive_forms(),
            problem=problem,
            warnings=notes,
        )
        self._show_background()
        if not self._engine.ready and self._engine.compiling is not None:
            self._compiling(*self._engine.compiling)

    async def _hear(self, text: str) -> None:
        number, kind = None, None
        try:
            message = decoded(text)
            number, kind = message.get("id"), message["type"]
            handler = _HANDLERS.get(kind)
            if handler is None:
                raise RefusedError(f"there is no message of the type {kind!r:.40}")
            if kind == "edit":
                await handler(self, message)
            else:
                self._jobs.begin(handler(self, message), number, kind)
        except Exception as error:
            await self._refuse(error, number, kind)

    async def _refuse(self, error: Exception, number: Any, kind: str | None) -> None:
        if isinstance(error, WebSocketDisconnect):
            raise error
        words = self._current.folder.told(str(error))
        if not isinstance(error, ViasplineError):
            if os.environ.get("VIASPLINE_DEBUG"):
                traceback.print_exception(error)
            words = f"defect: {type(error).__name__}: {words}"
        sound = number if isinstance(number, int | str) else None
        await self._send(type="refused", id=sound, about=kind, message=words)

    async def _refuse_edit(self, error: Exception) -> None:
        await self._refuse(error, None, "edit")

    async def _send(self, **message: Any) -> None:
        await self._send_text(encoded(message))

    async def _send_text(self, text: str) -> None:
        async with self._sending:
            await self._socket.send_text(text)

    def _compiling(self, kernel: str, count: int) -> None:
        """Hear from another thread of a kernel that is compiled; no name: they all are."""
        message = {"type": "compiling", "kernel": kernel, "count": count, "done": not kernel}

        def tell() -> None:
            self._jobs.begin(self._send(**message), None, "compiling")

        self._loop.call_soon_threadsafe(tell)

    # --- what a page may ask for

    async def _edit(self, message: Message) -> None:
        revision = count_of(message, "rev")
        self._current.document = changed(self._current.document, message.get("changes"))
        self._live.want(revision)

    async def _advise(self, message: Message) -> None:
        planned = await self._live.planned_mission()
        if planned.mission is None:
            raise RefusedError("the mission isn't sound")
        if planned.mission.is_spatial:
            raise RefusedError("no tension is suggested for missions in space; set spline.tension")
        await self._answer(message, await self._engine.others.advise(planned.mission))

    async def _compare(self, message: Message) -> None:
        await self._answer(message, await self._comparison.compare(message))

    async def _stop_comparing(self, message: Message) -> None:
        self._comparison.stop()

    async def _drive(self, message: Message) -> None:
        from viaspline.fleet.fleet_plan import FleetPlan
        from viaspline.space.spatial_plan import SpatialPlan

        seed, number = count_of(message, "seed"), message.get("id")
        self._stop.set()
        self._stop = stop = Flag()
        planned = await self._live.planned()
        if planned.plan is None:
            raise RefusedError("there is no path to drive")
        if isinstance(planned.plan, SpatialPlan):
            flew, text = await self._engine.others.fly(planned.plan, head={"id": number})
            self._driven = (planned.document, flew, seed)
            await self._send_text(text)
            return
        if isinstance(planned.plan, FleetPlan):
            head = {"id": number}
            drove, text = await self._engine.others.drive_fleet(planned.plan, head=head, seed=seed)
            self._driven = (planned.document, drove, seed)
            await self._send_text(text)
            return

        def tell(done: float) -> None:
            self._loop.call_soon_threadsafe(
                lambda: self._jobs.begin(self._send(type="driving", done=done), None, "drive")
            )

        driven = await self._engine.others.drive(
            planned.plan, head={"id": number}, seed=seed, stop=stop, tell=tell
        )
        if driven is None:
            await self._send(type="stopped", id=number)
            return
        run, text = driven
        self._driven = (planned.document, run, seed)
        await self._send_text(text)

    async def _paste(self, message: Message) -> None:
        parts = await asyncio.to_thread(pasted_parts, message.get("text"))
        await self._answer(message, {"type": "pasted", "parts": parts})

    async def _halt(self, message: Message) -> None:
        self._stop.set()

    async def _files(self, message: Message) -> None:
        await self._answer(message, file_requests.files(self._current))

    async def _open(self, message: Message) -> None:
        answer = file_requests.open_file(self._current, message)
        self._live.forget()
        await self._answer(message, answer)
        self._show_background()

    async def _new(self, message: Message) -> None:
        self._live.forget()
        await self._answer(message, file_requests.new(self._current))
        self._show_background()

    async def _save(self, message: Message) -> None:
        await self._answer(
            message, await file_requests.save(self._current, message, self._live.planned_mission)
        )

    async def _export(self, message: Message) -> None:
        answer = await file_requests.export(
            self._current, message, self._engine, self._live.planned, self._driven
        )
        await self._answer(message, answer)

    def _show_background(self) -> None:
        """Tell of the picture under the mission: first that it isn't the one before."""
        name = self._current.name

        async def show() -> None:
            if self._current.settings.background is not None:
                await self._send(type="background", background=None)
            found = await background_requests.shown(self._current, self._backgrounds)
            if self._current.name == name:  # nothing else was opened meanwhile
                await self._send(type="background", **found)

        self._jobs.begin(show(), None, "background")

    async def _pictures(self, message: Message) -> None:
        await self._answer(message, background_requests.pictures(self._current))

    async def _picture(self, message: Message) -> None:
        answer = await background_requests.picture(self._current, message, self._backgrounds)
        await self._answer(message, answer)

    async def _remember(self, message: Message) -> None:
        answer = await background_requests.remember(self._current, message, self._backgrounds)
        await self._answer(message, answer)

    async def _answer(self, message: Message, answer: file_requests.Answer) -> None:
        await self._send(id=message.get("id"), **answer)


_HANDLERS: Final[dict[str, Callable[[Session, Message], Coroutine[Any, Any, None]]]] = {
    "edit": Session._edit,
    "advise": Session._advise,
    "compare": Session._compare,
    "stop_comparing": Session._stop_comparing,
    "drive": Session._drive,
    "halt": Session._halt,
    "paste": Session._paste,
    "files": Session._files,
    "open": Session._open,
    "new": Session._new,
    "save": Session._save,
    "export": Session._export,
    "pictures": Session._pictures,
    "picture": Session._picture,
    "remember": Session._remember,
}
