"""The missions that a fleet names, read and put beside their names.

What comes after sees, for each robot that has a file, what the file holds beside its world.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from pathlib import Path as FilePath
from typing import Any, Protocol

from pydantic import ValidationError

from viaspline.errors import Fault, MissionError
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.resolve_files import resolve_maps
from viaspline.mission.schema_errors import schema_faults
from viaspline.mission.track_file import given_twice, resolve_corridor
from viaspline.mission.unplaced_faults import (
    Origin,
    Path,
    UnplacedFault,
    children,
    list_items,
    located,
)
from viaspline.mission.world_spec import WorldSpec


class MemberDocument(Origin, Protocol):
    """A file with what it holds."""

    @property
    def data(self) -> Any:
        """Mappings, lists, texts, numbers."""
        ...


@dataclass(frozen=True)
class MemberFiles:
    """A fleet's data with the missions that it names.

    Attributes:
        data: The data, with what the files hold beside their names.
        faults: What is wrong with what the fleet itself says of them.
        documents: The files, by the index of their robot.
        own_faults: What is wrong in the files, with its place there.
    """

    data: Any
    faults: list[UnplacedFault] = field(default_factory=list)
    documents: dict[int, MemberDocument] = field(default_factory=dict)
    own_faults: list[Fault] = field(default_factory=list)


def read_members(data: Any, given_world: Any, folder: FilePath) -> MemberFiles:
    """Read the missions and the corridors of a fleet's robots.

    Args:
        data: What a fleet holds, sound or not, its maps read.
        given_world: Its world as it was given, with maps by their names.
        folder: Where files are looked for.
    """
    top = children(data) or {}
    found = MemberFiles({**top})
    if not isinstance(top.get("fleet"), list | tuple):
        return MemberFiles(data)
    worlds = _FleetWorld(top.get("world"), given_world, folder)
    members = []
    for i, item in list_items(top["fleet"]):
        keys = children(item)
        members.append(item if keys is None else _read(i, keys, worlds, found))
    found.data["fleet"] = members
    return found


def _read(
    i: int, member: Mapping[Any, Any], worlds: _FleetWorld, found: MemberFiles
) -> Mapping[Any, Any]:
    """A robot with what its files hold; what is wrong is added to what is found."""
    asked = member.get("mission")
    if isinstance(asked, MissionParts):
        if asked.world != WorldSpec() and worlds.sound not in (None, asked.world):
            found.faults.append(UnplacedFault(("fleet", i, "mission"), *_OTHER_WORLD))
        return {**member, "mission": None, "asked": asked}
    if isinstance(asked, str | FilePath) and str(asked) and member.get("route") is None:
        return _of_file(i, member, FilePath(asked), worlds, found)
    route = {"route": member.get("route")}
    with_line, faults = resolve_corridor(route, worlds.folder)
    faults += given_twice(route)
    found.faults.extend(fault._replace(path=("fleet", i, *fault.path)) for fault in faults)
    return member if with_line is route else {**member, **with_line}


_OTHER_WORLD = (
    "its world isn't that of the fleet, which all robots share",
    "leave out its world, or give it that of the fleet",
)


def _of_file(
    i: int, member: Mapping[Any, Any], name: FilePath, worlds: _FleetWorld, found: MemberFiles
) -> Mapping[Any, Any]:
    path = worlds.folder / name
    here: Path = ("fleet", i, "mission")
    try:
        # Formats read missions, and stand above them: this one is looked up by name, and only by
        # a fleet that names a file.
        document = import_module("viaspline.formats.yaml_document").read_document(path)
    except MissionError as error:
        for fault in error.faults:
            if fault.line is None:
                problem = f"{fault.source}: {fault.problem}"
                found.faults.append(UnplacedFault(here, problem, fault.remedy))
            else:
                found.own_faults.append(fault)
        return member
    data = document.data
    if "fleet" in data:
        problem = f"{path} is a fleet, not the mission of one robot"
        found.faults.append(UnplacedFault(here, problem, "name a file with a route"))
        return member
    faults = [*document.faults, *given_twice(data)]
    with_line, of_corridor = resolve_corridor(data, path.parent)
    faults += of_corridor
    if "world" in data:
        faults += worlds.faults_of(data["world"], path.parent)
    try:
        parts = {key: value for key, value in with_line.items() if key != "world"}
        asked = MissionParts.model_validate(parts)
    except ValidationError as error:
        found.own_faults.extend(located([*faults, *schema_faults(error)], data, document))
        return member
    found.own_faults.extend(located(faults, data, document))
    found.documents[i] = document
    return {**member, "mission": path.resolve().as_posix(), "asked": asked}


class _FleetWorld:
    """The world of a fleet, and those of files that were found to be the same or not.

    Args:
        resolved: The fleet's world, its maps read.
        given: As it was given.
        folder: Where the fleet's files are looked for.
    """

    def __init__(self, resolved: Any, given: Any, folder: FilePath) -> None:
        self.folder = folder
        self._resolved = resolved
        self._seen: list[tuple[Any, FilePath, list[UnplacedFault]]] = [
            ({} if given is None else given, folder.resolve(), [])
        ]

    @cached_property
    def sound(self) -> WorldSpec | None:
        """The fleet's world; None if it isn't sound."""
        try:
            return WorldSpec.model_validate({} if self._resolved is None else self._resolved)
        except ValidationError:
            return None

    def faults_of(self, world: Any, folder: FilePath) -> list[UnplacedFault]:
        """What is wrong with the world of a file, or that it is another; it is read once only."""
        folder = folder.resolve()
        for given, place, faults in self._seen:
            if place == folder and given == world:
                return faults
        faults = self._compared(world, folder)
        self._seen.append((world, folder, faults))
        return faults

    def _compared(self, world: Any, folder: FilePath) -> list[UnplacedFault]:
        resolved = resolve_maps({"world": world}, folder)
        if resolved.faults:
            return list(resolved.faults)
        try:
            found = WorldSpec.model_validate(resolved.data["world"])
        except ValidationError as error:
            return [
                fault._replace(path=resolved.original(fault.path))
                for fault in schema_faults(error, ("world",))
            ]
        if self.sound is None or found == self.sound:
            return []
        return [UnplacedFault(("world",), *_OTHER_WORLD, at_key=True)]
