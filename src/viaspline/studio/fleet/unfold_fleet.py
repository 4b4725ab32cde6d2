"""A fleet document with the files that it names in their places.

Tested through ``studio/fleet/test_fleet_server``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from viaspline.errors import Fault, MissionError
from viaspline.formats.yaml_document import read_document
from viaspline.mission.model import Mission
from viaspline.mission.unplaced_faults import located
from viaspline.studio.document import Document
from viaspline.studio.map_cache import ExpandedDocument, MapCache, file_stamp

FileStamp = tuple[str, int, int]


@dataclass(frozen=True)
class MemberMission:
    """The mission file of one robot.

    Attributes:
        stamp: Path, time and size of the file that was read.
        document: What it holds.
        mission: That, sound.
    """

    stamp: FileStamp
    document: Document
    mission: Mission


@dataclass(frozen=True)
class UnfoldedFleet:
    """A fleet document that is ready to become a fleet.

    Attributes:
        expanded: The document with obstacles in place of maps, and missions in place of files.
        missions: Those of robots that have a file, by the file's name.
    """

    expanded: ExpandedDocument
    missions: Mapping[str, MemberMission]


def unfold_fleet(
    document: Document, base: Path, maps: MapCache, known: Mapping[str, MemberMission]
) -> UnfoldedFleet:
    """Read the files that a fleet document names.

    Args:
        document: Sound or not.
        base: The folder of the fleet's file.
        maps: Reads maps; no file is read from outside of its folder.
        known: Missions that were read before: a file that hasn't changed isn't read again.

    Raises:
        MissionError: A file can't be read, lies outside of the folder, or isn't sound.
    """
    expanded = maps.unfold(document, base)
    missions: dict[str, MemberMission] = {}
    members = expanded.data.get("fleet")
    if not isinstance(members, list):
        return UnfoldedFleet(expanded, missions)
    found = []
    for i, member in enumerate(members):
        name = member.get("mission") if isinstance(member, Mapping) else None
        if isinstance(member, Mapping) and isinstance(name, str):
            if name not in missions:
                missions[name] = _read(name, f"fleet[{i}].mission", base, maps, known.get(name))
            found.append({**member, "mission": missions[name].mission})
        else:
            found.append(_with_corridor(member, f"fleet[{i}].", base, maps))
    data = {**expanded.data, "fleet": found}
    return UnfoldedFleet(ExpandedDocument(data, expanded.places), missions)


def _read(
    name: str, key: str, base: Path, maps: MapCache, known: MemberMission | None
) -> MemberMission:
    """The mission of a robot's file; what is wrong with it is said where the file is named."""
    try:
        path = maps.within(name, base)
        stamp = file_stamp(path)
        if known is not None and known.stamp == stamp:
            return known
        found = read_document(path)
        if found.faults:
            raise MissionError(located(list(found.faults), found.data, found))
        mission = Mission.model_validate(maps.unfold(found.data, path.parent).data)
    except MissionError as error:
        raise MissionError([_renamed(fault, key, name) for fault in error.faults]) from None
    return MemberMission(stamp, found.data, mission)


def _renamed(fault: Fault, key: str, name: str) -> Fault:
    where = f"{name}, {fault.key}" if fault.key and fault.key != "map" else name
    return Fault(key, f"{where}: {fault.problem}", fault.remedy)


def _with_corridor(member: Any, key: str, base: Path, maps: MapCache) -> Any:
    return maps.with_corridor(member, base, key) if isinstance(member, Mapping) else member
