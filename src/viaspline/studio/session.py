"""One open page: its document, the newest plan of it, and what it asks for.

An edit is answered by a plan. While one is planned, newer edits are gathered; only the newest
document is planned next, so the page never lags behind.
"""

from __future__ import annotations

import asyncio
import base64
import os
import traceback
from collections.abc import Awaitable, Callable, Coroutine
from pathlib import Path
from threading import Event as Flag
from typing import TYPE_CHECKING, Any, Final

from starlette.websockets import WebSocket, WebSocketDisconnect

from viaspline import __version__
from viaspline.errors import ViasplineError
from viaspline.formats.items import LatLon
from viaspline.studio import keeping
from viaspline.studio.document import EMPTY, Document, changed
from viaspline.studio.engine import Engine
from viaspline.studio.folder import Folder
from viaspline.studio.messages import Message, count_of, decoded, encoded, text_of
from viaspline.studio.opening import opened
from viaspline.studio.refused import RefusedError
from viaspline.studio.saving import is_yaml, origin_from, waypoints_of

if TYPE_CHECKING:
    from viaspline.robot.run import Run
    from viaspline.studio.planning import Planned

IDLE: Final = 0.1  # so long without an edit, and an expensive ledger is drawn up [s]
MOST_JOBS: Final = 32


class Session:
    """A connection to a page.

    Args:
        socket: The connection, not yet accepted.
        engine: Plans and drives.
        folder: Where missions are opened and saved.
        name: The mission that the studio was started with.
    """

    def __init__(self, socket: WebSocket, engine: Engine, folder: Folder, name: str | None) -> None:
        self._socket = socket
        self._engine = engine
        self._folder = folder
        self._name = name
        self._origin: LatLon | None = None
        self._document: Document = EMPTY
        self._revision = 0
        self._latest: Planned | None = None
        self._run: tuple[Document, Run, int] | None = None
        self._wanted = asyncio.Event()
        self._sending = asyncio.Lock()
        self._stop = Flag()
        self._jobs: set[asyncio.Task[None]] = set()
        self._loop = asyncio.get_running_loop()

    async def talk(self) -> None:
        """Until the page is closed."""
        await self._socket.accept()
        self._engine.listeners.add(self._compiling)
        planning = self._loop.create_task(self._plan_forever())
        try:
            await self._greet()
            while True:
                await self._hear(await self._socket.receive_text())
        except (WebSocketDisconnect, KeyError):
            pass  # closed, or a message that is no text
        finally:
            self._engine.listeners.discard(self._compiling)
            self._stop.set()
            for task in (planning, *self._jobs):
                task.cancel()

    async def _greet(self) -> None:
        problem: str | None = None
        notes: tuple[str, ...] = ()
        if self._name is not None:
            try:
                notes = self._open(self._name)
            except ViasplineError as error:
                problem = str(error)
        await self._send(
            type="hello",
            version=__version__,
            folder=self._folder.root.name,
            name=self._name,
            document=self._document,
            origin=self._origin,
            empty=EMPTY,
            problem=problem,
            warnings=notes,
        )
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
                self._spawn(handler(self, message), number, kind)
        except Exception as error:
            await self._refuse(error, number, kind)

    def _spawn(self, work: Coroutine[Any, Any, None], number: Any, kind: str) -> None:
        if len(self._jobs) >= MOST_JOBS:
            work.close()
            raise RefusedError("too many things are asked for at once")

        async def guarded() -> None:
            try:
                await work
            except Exception as error:
                await self._refuse(error, number, kind)

        task = self._loop.create_task(guarded())
        self._jobs.add(task)
        task.add_done_callback(self._jobs.discard)

    async def _refuse(self, error: Exception, number: Any, kind: str | None) -> None:
        if isinstance(error, WebSocketDisconnect):
            raise error
        words = str(error)
        if not isinstance(error, ViasplineError):
            if os.environ.get("VIASPLINE_DEBUG"):
                traceback.print_exception(error)
            words = f"defect: {type(error).__name__}: {words}"
        sound = number if isinstance(number, int | str) else None
        await self._send(type="refused", id=sound, about=kind, message=words)

    async def _send(self, **message: Any) -> None:
        await self._send_text(encoded(message))

    async def _send_text(self, text: str) -> None:
        async with self._sending:
            await self._socket.send_text(text)

    def _compiling(self, kernel: str, count: int) -> None:
        """Hear from another thread of a kernel that is compiled; no name: they all are."""
        message = {"type": "compiling", "kernel": kernel, "count": count, "done": not kernel}

        def tell() -> None:
            self._spawn(self._send(**message), None, "compiling")

        self._loop.call_soon_threadsafe(tell)

    # --- editing and planning

    async def _edit(self, message: Message) -> None:
        revision = count_of(message, "rev")
        self._document = changed(self._document, message.get("changes"))
        self._revision = revision
        self._wanted.set()

    async def _plan_forever(self) -> None:
        while True:
            await self._wanted.wait()
            self._wanted.clear()
            document, revision = self._document, self._revision
            try:
                self._latest, text, later = await self._engine.plan(document, self._base, revision)
                await self._send_text(text)
                if later and self._latest.plan is not None and await self._is_idle():
                    await self._send_text(await self._engine.ledger(self._latest, revision))
            except WebSocketDisconnect:
                return
            except Exception as error:
                await self._refuse(error, None, "edit")

    async def _is_idle(self) -> bool:
        try:
            await asyncio.wait_for(self._wanted.wait(), IDLE)
        except TimeoutError:
            return True
        return False

    async def _planned(self) -> Planned:
        """The plan of the document as it is now."""
        document = self._document
        if self._latest is not None and self._latest.document is document:
            return self._latest
        planned, _, _ = await self._engine.plan(document, self._base, self._revision)
        return planned

    # --- driving

    async def _drive(self, message: Message) -> None:
        seed, number = count_of(message, "seed"), message.get("id")
        self._stop.set()
        self._stop = stop = Flag()
        planned = await self._planned()
        if planned.plan is None:
            raise RefusedError("there is no path to drive")

        def tell(done: float) -> None:
            self._loop.call_soon_threadsafe(
                lambda: self._spawn(self._send(type="driving", done=done), None, "drive")
            )

        driven = await self._engine.drive(
            planned.plan, head={"id": number}, seed=seed, stop=stop, tell=tell
        )
        if driven is None:
            await self._send(type="stopped", id=number)
            return
        run, text = driven
        self._run = (planned.document, run, seed)
        await self._send_text(text)

    async def _halt(self, message: Message) -> None:
        self._stop.set()

    # --- files

    @property
    def _base(self) -> Path:
        """The folder of the mission's file."""
        if self._name is None:
            return self._folder.root
        return self._folder.inside(self._name).parent

    def _open(self, name: str) -> tuple[str, ...]:
        found = opened(self._folder.to_open(name))
        self._document, self._name, self._origin = found.document, name, found.origin
        self._latest = None
        return found.warnings

    async def _files(self, message: Message) -> None:
        await self._send(
            type="files", id=message.get("id"),
            missions=self._folder.missions(), maps=self._folder.maps(),
        )  # fmt: skip

    async def _open_file(self, message: Message) -> None:
        notes = self._open(text_of(message, "name"))
        await self._send(
            type="opened", id=message.get("id"), name=self._name, document=self._document,
            warnings=notes, origin=self._origin,
        )  # fmt: skip

    async def _new(self, message: Message) -> None:
        self._document, self._name, self._latest = EMPTY, None, None
        self._origin = None
        await self._send(
            type="opened", id=message.get("id"), name=None, document=self._document,
            warnings=(), origin=None,
        )  # fmt: skip

    async def _save(self, message: Message) -> None:
        name, document = text_of(message, "name"), self._document
        path = self._folder.to_save(name)
        if not is_yaml(path):
            await self._save_waypoints(message, name, path)
            return
        if path.exists() and name != self._name and message.get("replace") is not True:
            await self._send(type="exists", id=message.get("id"), name=name)
            return
        old = None
        if path.exists():
            old = path.read_text(encoding="utf-8", errors="replace")
        if path.parent != self._base:
            document = _moved(document, self._base, path.parent)
        self._folder.save(path, keeping.text_of(document, old))
        self._name = name
        if document is not self._document:
            self._document = document
        await self._send(
            type="saved", id=message.get("id"), name=name, document=document, lost=(),
            origin=self._origin,
        )  # fmt: skip

    async def _save_waypoints(self, message: Message, name: str, path: Path) -> None:
        """Save a file that may not hold the whole mission; then it is a copy of a part of it."""
        document, before = self._document, self._name
        origin = origin_from(text_of(message, "origin", "")) or self._origin
        there = _not_understood(path) if path.exists() else ()
        if path.exists() and (name != self._name or there) and message.get("replace") is not True:
            await self._send(type="exists", id=message.get("id"), name=name, lost=there)
            return
        mission = (await self._planned()).mission
        if mission is None:
            raise RefusedError("only a sound mission has way points: save it as YAML, or mend it")
        text, lost = waypoints_of(mission, path, origin)
        if maps := _maps_in(document):
            lost = (*lost, f"maps, of which the file holds polygons only: {', '.join(maps)}")
        self._folder.save(path, text)
        if self._name == before:  # nothing else was opened meanwhile
            self._origin = origin
            self._name = before if lost else name
        await self._send(
            type="saved", id=message.get("id"), name=name, document=document, lost=lost,
            origin=origin,
        )  # fmt: skip

    async def _export(self, message: Message) -> None:
        from viaspline.studio.exports import OF_RUNS, check_kind

        kind = text_of(message, "kind")
        check_kind(kind)
        stem = Path(self._name).stem if self._name is not None else "mission"
        document = self._document
        if kind in OF_RUNS:
            if self._run is None or self._run[0] is not document:
                raise RefusedError("drive the mission first; it has changed since")
            _, run, seed = self._run
            content = await self._engine.run_file(run, kind, stem, seed)
        else:
            planned = await self._planned()
            if planned.plan is None:
                raise RefusedError("there is no path to export")
            content = await self._engine.plan_file(planned.plan, kind, stem)
        data = base64.b64encode(content).decode()
        await self._send(
            type="exported", id=message.get("id"), name=f"{stem}-{kind}", kind=kind, data=data
        )


def _not_understood(path: Path) -> tuple[str, ...]:
    """What stands in a file of way points that saving over it would drop."""
    try:
        return opened(path).warnings
    except ViasplineError as error:
        return (str(error),)


def _moved(document: Document, old: Path, new: Path) -> Document:
    """The document for another folder: maps are named from there."""
    world = dict(document.get("world") or {})
    for key in ("known", "unseen"):
        items = world.get(key)
        if isinstance(items, list):
            world[key] = [_renamed(item, old, new) for item in items]
    return {**document, "world": world} if "world" in document else document


def _maps_in(document: Document) -> list[str]:
    """The files of maps that a sound document names."""
    items = (document.get("world") or {}).get("known") or []
    return [str(item["map"]) for item in items if isinstance(item, dict) and "map" in item]


def _renamed(item: Any, old: Path, new: Path) -> Any:
    if not isinstance(item, dict) or not isinstance(item.get("map"), str):
        return item
    return {**item, "map": Path(os.path.relpath(old / item["map"], new)).as_posix()}


_HANDLERS: Final[dict[str, Callable[[Session, Message], Coroutine[Any, Any, None]]]] = {
    "edit": Session._edit,
    "drive": Session._drive,
    "halt": Session._halt,
    "files": Session._files,
    "open": Session._open_file,
    "new": Session._new,
    "save": Session._save,
    "export": Session._export,
}

Talk = Callable[[WebSocket], Awaitable[None]]
