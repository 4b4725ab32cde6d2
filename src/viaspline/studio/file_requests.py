"""What a page asks of files: which there are, open, save, export. Each gives an answer to send.

Tested through ``studio/test_server_files``.
"""

from __future__ import annotations

import base64
import os
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from viaspline.bounded_file import MISSION_FILE, read_bytes
from viaspline.errors import ViasplineError
from viaspline.studio import yaml_round_trip
from viaspline.studio.document import Document, is_fleet
from viaspline.studio.engine import Engine, Planned
from viaspline.studio.load_document import opened
from viaspline.studio.open_mission import OpenMission
from viaspline.studio.page_messages import Message, text_of
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.save_document import is_yaml, origin_from, waypoints_of

if TYPE_CHECKING:
    from viaspline.studio.exports import AnyPlan, AnyRun
    from viaspline.studio.plan_document import PlannedDocument
    from viaspline.studio.space.planned_spatial import PlannedSpatial

Answer = dict[str, Any]
Driven = tuple[Document, "AnyRun", int]


def files(current: OpenMission) -> Answer:
    """The files of the folder."""
    return {"type": "files", "missions": current.folder.missions(), "maps": current.folder.maps()}


def open_file(current: OpenMission, message: Message) -> Answer:
    """Open a mission."""
    return _opened(current, current.open(text_of(message, "name")))


def new(current: OpenMission) -> Answer:
    """Begin a new mission."""
    current.clear()
    return _opened(current, ())


def _opened(current: OpenMission, notes: tuple[str, ...]) -> Answer:
    return {
        "type": "opened", "name": current.name, "document": current.document,
        "warnings": notes, "origin": current.origin,
    }  # fmt: skip


async def save(
    current: OpenMission,
    message: Message,
    planned: Callable[[], Awaitable[PlannedDocument | PlannedSpatial]],
) -> Answer:
    """Save the document, or ask before another file is replaced.

    Args:
        current: Its document is saved.
        message: With a ``name`` and perhaps ``replace`` and ``origin``.
        planned: Gives the plan, of whose mission the way points are.
    """
    name = text_of(message, "name")
    path = current.folder.to_save(name)
    if is_fleet(current.document) and not is_yaml(path):
        raise RefusedError(f"fleets are saved as YAML: call it '{path.stem}.yaml'")
    if not is_yaml(path):
        return await _save_waypoints(current, message, path, planned)
    if path.exists() and message.get("replace") is not True:
        lost = current.would_lose(name, path)
        if lost or name != current.name:
            return {"type": "exists", "name": name, "lost": lost}
    old = _text_of(path) if path.exists() else None
    if path.parent != current.base:
        current.document = _moved(current.document, current.base, path.parent)
    current.folder.save(path, yaml_round_trip.text_of(current.document, old))
    current.saved_as(name)
    return _saved(name, current.document, (), current)


async def _save_waypoints(
    current: OpenMission,
    message: Message,
    path: Path,
    planned: Callable[[], Awaitable[PlannedDocument | PlannedSpatial]],
) -> Answer:
    """Save a file that may not hold the whole mission; then it is a copy of a part of it."""
    name, document, before = text_of(message, "name"), current.document, current.name
    origin = origin_from(text_of(message, "origin", "")) or current.origin
    there: tuple[str, ...] = ()
    if path.exists():
        unread = map(current.folder.told, _not_understood(path))
        there = (*unread, *current.would_lose(name, path))
    if path.exists() and (name != current.name or there) and message.get("replace") is not True:
        return {"type": "exists", "name": name, "lost": there}
    mission = (await planned()).mission
    if mission is None:
        raise RefusedError("only a sound mission has way points: save it as YAML, or mend it")
    text, lost = waypoints_of(mission, path, origin)
    if maps := _maps_in(document):
        lost = (*lost, f"maps, of which the file holds polygons only: {', '.join(maps)}")
    current.folder.save(path, text)
    if current.name == before:  # nothing else was opened meanwhile
        current.lies_at(origin)
        if not lost:
            current.saved_as(name)
        document = current.document  # which may say where it lies
    return {**_saved(name, document, lost, current), "origin": origin}


def _saved(name: str, document: Document, lost: tuple[str, ...], current: OpenMission) -> Answer:
    return {
        "type": "saved", "name": name, "document": document, "lost": lost, "origin": current.origin,
    }  # fmt: skip


async def export(
    current: OpenMission,
    message: Message,
    engine: Engine,
    planned: Callable[[], Awaitable[Planned]],
    driven: Driven | None,
) -> Answer:
    """A file of the plan or of the newest drive.

    Args:
        current: Of whose document.
        message: With the ``kind``, of a fleet the name of a ``robot``, and perhaps an ``origin``.
        engine: Writes the file.
        planned: Gives the plan.
        driven: The document that was driven last, the run and its seed.
    """
    from viaspline.fleet.fleet_plan import FleetPlan
    from viaspline.studio.exports import PATH_FILES, RUN_FILES, check_kind

    kind = text_of(message, "kind")
    check_kind(kind)
    stem = Path(current.name).stem if current.name is not None else "mission"
    told: tuple[str, ...] = ()
    if kind in RUN_FILES:
        if driven is None or driven[0] is not current.document:
            raise RefusedError("drive the mission first; it has changed since")
        if kind == "run.csv" and is_fleet(current.document):
            raise RefusedError("a fleet's drive has run.json and run.png")
        content = await engine.others.run_file(driven[1], kind, stem, driven[2])
    else:
        plan = _plan_of(await planned(), kind, message)
        stem = f"{stem}-{message['robot']}" if "robot" in message else stem
        if kind in PATH_FILES:
            assert not isinstance(plan, FleetPlan)  # which has files of its own
            origin = origin_from(text_of(message, "origin", "")) or current.origin
            content, told = await engine.others.path_file(plan, kind, stem, origin)
        else:
            content = await engine.others.plan_file(plan, kind, stem)
    data = base64.b64encode(content).decode()
    return {
        "type": "exported", "name": f"{stem}-{kind}", "kind": kind, "data": data, "told": told,
    }  # fmt: skip


def _plan_of(planned: Planned, kind: str, message: Message) -> AnyPlan:
    """The plan that is to be exported: the mission's, the fleet's or that of the robot named."""
    from viaspline.studio.fleet.planned_fleet import PlannedFleet
    from viaspline.studio.fleet.simulated_fleet import FLEET_FILES

    found: AnyPlan | None
    if not isinstance(planned, PlannedFleet):
        if kind in FLEET_FILES:
            raise RefusedError(f"this isn't a fleet: it has no {kind}")
        found = planned.plan
    elif kind in FLEET_FILES:
        found = planned.plan
    else:
        plans = {} if planned.plan is None else planned.plan.planar_plans
        found = plans.get(text_of(message, "robot"))
    if found is None:
        raise RefusedError("there is no path to export")
    return found


def _text_of(path: Path) -> str:
    """What a mission's file holds that is going to be replaced, as far as it is a text."""
    return read_bytes(path, MISSION_FILE).decode("utf-8", errors="replace")


def _not_understood(path: Path) -> tuple[str, ...]:
    """What stands in a file of way points that saving over it would drop."""
    try:
        return opened(path).warnings
    except ViasplineError as error:
        return (str(error),)


def _moved(document: Document, old: Path, new: Path) -> Document:
    """The document for another folder: maps are named from there."""
    if isinstance(members := document.get("fleet"), list):
        document = {**document, "fleet": [_renamed(one, old, new, "mission") for one in members]}
    world = dict(document.get("world") or {})
    for key in ("known", "unseen"):
        items = world.get(key)
        if isinstance(items, list):
            world[key] = [_named_from(item, old, new) for item in items]
    if "ground" in world:
        world["ground"] = _renamed(world["ground"], old, new, "terrain")
    return {**document, "world": world} if "world" in document else document


def _named_from(item: Any, old: Path, new: Path) -> Any:
    """An obstacle whose file, if it has one, is named from another folder."""
    if isinstance(item, dict) and isinstance(item.get("voxels"), dict):
        return {**item, "voxels": _renamed(item["voxels"], old, new, "file")}
    return _renamed(item, old, new, "map")


def _maps_in(document: Document) -> list[str]:
    """The files of maps that a sound document names."""
    items = (document.get("world") or {}).get("known") or []
    return [str(item["map"]) for item in items if isinstance(item, dict) and "map" in item]


def _renamed(item: Any, old: Path, new: Path, key: str) -> Any:
    if not isinstance(item, dict) or not isinstance(item.get(key), str):
        return item
    return {**item, key: Path(os.path.relpath(old / item[key], new)).as_posix()}
