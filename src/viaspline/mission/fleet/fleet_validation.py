"""From data to a fleet, or to every fault that the data has.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any, TypeVar, cast

from pydantic import ModelWrapValidatorHandler, ValidationError

from viaspline.errors import Fault, MissionError
from viaspline.mission.fleet.fleet_checks import fleet_faults
from viaspline.mission.fleet.fleet_parts import FleetParts
from viaspline.mission.fleet.member_files import MemberFiles, read_members
from viaspline.mission.fleet.partial_fleet import PartialFleet
from viaspline.mission.resolve_files import resolve_maps
from viaspline.mission.unplaced_faults import Origin, UnplacedFault, children, located
from viaspline.mission.validation import Context, validated, warn_of_jumps

SoundFleet = TypeVar("SoundFleet", bound=FleetParts)


def sound_fleet(
    data: Any, handler: ModelWrapValidatorHandler[SoundFleet], context: Any = None
) -> SoundFleet:
    """The fleet that ``data`` describes.

    Args:
        data: A mapping with what a fleet file holds, or a fleet. Files of maps and missions are
            read; they are looked for beside the fleet file, or from the working directory if there
            is none.
        handler: Pydantic's own validation.
        context: A `Context` if the data came from a file.

    Raises:
        MissionError: The data has faults; all of them.
    """
    if isinstance(data, FleetParts):
        return cast(SoundFleet, data)
    origin = context.origin if isinstance(context, Context) else None
    faults: list[UnplacedFault] = list(origin.faults) if origin is not None else []
    folder = FilePath(origin.source).parent if origin is not None else FilePath()
    resolved = resolve_maps(data, folder)
    faults += resolved.faults
    files = read_members(resolved.data, (children(data) or {}).get("world"), folder)
    faults += files.faults
    read = replace(resolved, data=files.data)
    fleet: SoundFleet | None = None
    try:
        fleet = validated(files.data, handler)
        is_whole = not (files.faults or files.own_faults)
        partial = PartialFleet.of(fleet, resolved) if is_whole else PartialFleet.salvage(read)
    except ValidationError as error:
        # Imported late: a sound fleet needs no words for what is wrong.
        from viaspline.mission.schema_errors import schema_faults

        found = schema_faults(error, root=FleetParts)
        faults += (fault._replace(path=resolved.original(fault.path)) for fault in found)
        partial = PartialFleet.salvage(read)
    faults += fleet_faults(partial)
    if faults or files.own_faults or fleet is None:
        raise MissionError([*_placed(faults, data, origin, files), *files.own_faults]) from None
    warn_of_jumps(fleet.world)
    return fleet


def _placed(
    faults: list[UnplacedFault], data: Any, origin: Origin | None, files: MemberFiles
) -> Iterator[Fault]:
    """Faults with their places: those of what a robot's own file holds are there."""
    of_fleet: list[UnplacedFault] = []
    of_files: dict[int, list[UnplacedFault]] = {}
    for fault in faults:
        match fault.path:
            case ("fleet", int(i), "mission", *rest) if rest and i in files.documents:
                there = fault._replace(path=tuple(rest), changes=())
                of_files.setdefault(i, []).append(there)
            case _:
                of_fleet.append(fault)
    yield from located(of_fleet, data, origin)
    for i, found in sorted(of_files.items()):
        yield from located(found, files.documents[i].data, files.documents[i])
