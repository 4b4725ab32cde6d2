"""From data to a mission, or to every fault that the data has.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar, cast

from pydantic import ModelWrapValidatorHandler, ValidationError

from viaspline.caller_warning import warn_caller
from viaspline.errors import MissionError
from viaspline.mission.kept_headings import warn_of_headings
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.resolve_files import resolve_maps
from viaspline.mission.semantic_checks import semantic_faults
from viaspline.mission.track_file import given_twice, resolve_corridor
from viaspline.mission.unplaced_faults import Origin, UnplacedFault, located
from viaspline.mission.world_spec import WorldSpec

Sound = TypeVar("Sound", bound=MissionParts)
Modelled = TypeVar("Modelled")


class Context:
    """What the validator is told of data that came from a file."""

    def __init__(self, origin: Origin) -> None:
        self.origin = origin


def sound_mission(
    data: Any, handler: ModelWrapValidatorHandler[Sound], context: Any = None
) -> Sound:
    """The mission that ``data`` describes.

    Args:
        data: A mapping with what a mission file holds, or a mission. Files of maps are read; they
            are looked for beside the mission file, or from the working directory if there is none.
        handler: Pydantic's own validation.
        context: A `Context` if the data came from a file.

    Raises:
        MissionError: The data has faults; all of them.
    """
    if isinstance(data, MissionParts):
        return cast(Sound, data)
    origin = context.origin if isinstance(context, Context) else None
    faults: list[UnplacedFault] = list(origin.faults) if origin is not None else []
    folder = Path(origin.source).parent if origin is not None else Path()
    if origin is not None:
        faults += given_twice(data)
    with_line, of_corridor = resolve_corridor(data, folder)
    faults += of_corridor
    resolved = resolve_maps(with_line, folder)
    faults += resolved.faults
    mission: Sound | None = None
    try:
        mission = validated(resolved.data, handler)
        partial = PartialMission.of(mission, resolved)
    except ValidationError as error:
        # Imported late: a sound mission needs no words for what is wrong.
        from viaspline.mission.schema_errors import schema_faults

        found = schema_faults(error)
        faults += (fault._replace(path=resolved.original(fault.path)) for fault in found)
        partial = PartialMission.salvage(resolved)
    faults += semantic_faults(partial)
    if faults or mission is None:
        raise MissionError(located(faults, data, origin)) from None
    warn_of_jumps(mission.world)
    warn_of_headings(mission)
    return mission


def warn_of_jumps(world: WorldSpec) -> None:
    """Say what moves in a way that nothing can."""
    obstacles = (*world.known, *world.unseen)
    if all(obstacle.motion is None for obstacle in obstacles):
        return
    from viaspline.mission.motion_checks import jumps_in_words

    words = jumps_in_words(obstacles)
    if words is not None:
        warn_caller(words)


def validated(data: Any, handler: ModelWrapValidatorHandler[Modelled]) -> Modelled:
    """Validate; if that fails because of numpy's numbers, once more with Python's."""
    try:
        return handler(data)
    except ValidationError as error:
        if not any(_is_scalar(detail["input"]) for detail in error.errors(include_url=False)):
            raise
    return handler(_plain(data))


def _is_scalar(value: Any) -> bool:
    """Whether this is a number of numpy's that is none of Python's."""
    return hasattr(value, "tolist") and getattr(value, "shape", None) == ()


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):
        return cast(Any, value.tolist())
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value
