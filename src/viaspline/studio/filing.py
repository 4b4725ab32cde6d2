"""What a page asks of files: which there are, open, save, export. Each gives an answer to send."""

from __future__ import annotations

import base64
import os
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from viaspline.errors import ViasplineError
from viaspline.studio import keeping
from viaspline.studio.desk import Desk
from viaspline.studio.document import Document
from viaspline.studio.engine import Engine
from viaspline.studio.messages import Message, text_of
from viaspline.studio.opening import opened
from viaspline.studio.refused import RefusedError
from viaspline.studio.saving import is_yaml, origin_from, waypoints_of

if TYPE_CHECKING:
    from viaspline.robot.run import Run
    from viaspline.studio.planning import Planned

Answer = dict[str, Any]
Driven = tuple[Document, "Run", int]


def files(desk: Desk) -> Answer:
    """The files of the folder."""
    return {"type": "files", "missions": desk.folder.missions(), "maps": desk.folder.maps()}


def open_file(desk: Desk, message: Message) -> Answer:
    """Open a mission."""
    return _opened(desk, desk.open(text_of(message, "name")))


def new(desk: Desk) -> Answer:
    """Begin a new mission."""
    desk.clear()
    return _opened(desk, ())


def _opened(desk: Desk, notes: tuple[str, ...]) -> Answer:
    return {
        "type": "opened", "name": desk.name, "document": desk.document,
        "warnings": notes, "origin": desk.origin,
    }  # fmt: skip


async def save(desk: Desk, message: Message, planned: Callable[[], Awaitable[Planned]]) -> Answer:
    """Save the document, or ask before another file is replaced.

    Args:
        desk: Its document is saved.
        message: With a ``name`` and perhaps ``replace`` and ``origin``.
        planned: Gives the plan, of whose mission the way points are.
    """
    name = text_of(message, "name")
    path = desk.folder.to_save(name)
    if not is_yaml(path):
        return await _save_waypoints(desk, message, path, planned)
    if path.exists() and name != desk.name and message.get("replace") is not True:
        return {"type": "exists", "name": name}
    old = path.read_text(encoding="utf-8", errors="replace") if path.exists() else None
    if path.parent != desk.base:
        desk.document = _moved(desk.document, desk.base, path.parent)
    desk.folder.save(path, keeping.text_of(desk.document, old))
    desk.name = name
    return _saved(name, desk.document, (), desk)


async def _save_waypoints(
    desk: Desk, message: Message, path: Path, planned: Callable[[], Awaitable[Planned]]
) -> Answer:
    """Save a file that may not hold the whole mission; then it is a copy of a part of it."""
    name, document, before = text_of(message, "name"), desk.document, desk.name
    origin = origin_from(text_of(message, "origin", "")) or desk.origin
    there = _not_understood(path) if path.exists() else ()
    if path.exists() and (name != desk.name or there) and message.get("replace") is not True:
        return {"type": "exists", "name": name, "lost": there}
    mission = (await planned()).mission
    if mission is None:
        raise RefusedError("only a sound mission has way points: save it as YAML, or mend it")
    text, lost = waypoints_of(mission, path, origin)
    if maps := _maps_in(document):
        lost = (*lost, f"maps, of which the file holds polygons only: {', '.join(maps)}")
    desk.folder.save(path, text)
    if desk.name == before:  # nothing else was opened meanwhile
        desk.origin = origin
        desk.name = before if lost else name
    return {**_saved(name, document, lost, desk), "origin": origin}


def _saved(name: str, document: Document, lost: tuple[str, ...], desk: Desk) -> Answer:
    return {
        "type": "saved", "name": name, "document": document, "lost": lost, "origin": desk.origin,
    }  # fmt: skip


async def export(
    desk: Desk,
    message: Message,
    engine: Engine,
    planned: Callable[[], Awaitable[Planned]],
    driven: Driven | None,
) -> Answer:
    """A file of the plan or of the newest drive.

    Args:
        desk: Of whose document.
        message: With the ``kind``.
        engine: Writes the file.
        planned: Gives the plan.
        driven: The document that was driven last, the run and its seed.
    """
    from viaspline.studio.exports import OF_RUNS, check_kind

    kind = text_of(message, "kind")
    check_kind(kind)
    stem = Path(desk.name).stem if desk.name is not None else "mission"
    if kind in OF_RUNS:
        if driven is None or driven[0] is not desk.document:
            raise RefusedError("drive the mission first; it has changed since")
        content = await engine.run_file(driven[1], kind, stem, driven[2])
    else:
        plan = (await planned()).plan
        if plan is None:
            raise RefusedError("there is no path to export")
        content = await engine.plan_file(plan, kind, stem)
    data = base64.b64encode(content).decode()
    return {"type": "exported", "name": f"{stem}-{kind}", "kind": kind, "data": data}


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
