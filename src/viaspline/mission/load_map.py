"""Maps for those who build their world in Python.

Tested through ``mission/test_resolve_files``.
"""

from __future__ import annotations

import os
from pathlib import Path as FilePath
from typing import Final

from pydantic import ValidationError

from viaspline.errors import MissionError
from viaspline.maps.reading import Unknown
from viaspline.mission.map_spec import MapSpec
from viaspline.mission.resolve_files import obstacles_of
from viaspline.mission.schema_errors import schema_faults
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.unplaced_faults import Path, located

_IN_A_MISSION: Final[Path] = ("world", "known", 0)
"""Where a mission asks for a map: its keys are those of this place."""


def load_map(
    path: str | os.PathLike[str],
    *,
    unknown: Unknown | None = None,
    resolution_m: float | None = None,
    name: str | None = None,
) -> tuple[Obstacle, ...]:
    """Read the obstacles of a map, as ``map:`` does in a mission.

    Args:
        path: A map of squares (ROS's map_server YAML, MovingAI's ``.map``), which is one obstacle
            with a `Grid`, or one of areas (``.svg``, ``.geojson``), each of which is one.
        unknown: What to make of squares that nobody has seen; they are blocked if it isn't given.
        resolution_m: Side of a square of a MovingAI map, or length of a unit of a drawing [m]; 1 if
            it isn't given.
        name: What it is called; several areas are numbered.

    Raises:
        MissionError: The map can't be read or makes no sense, or has no use for an argument.

    Warns:
        MissionWarning: For areas that have no area.

    >>> load_map("depot.pgm")
    Traceback (most recent call last):
    viaspline.errors.MissionError: depot.pgm: is a picture, not a map; give the YAML file of ...
    """
    asked = {"map": path, "unknown": unknown, "resolution_m": resolution_m, "name": name}
    try:
        spec = MapSpec.model_validate(asked)
    except ValidationError as error:
        faults = schema_faults(error, at=_IN_A_MISSION)
        own = [fault._replace(path=fault.path[len(_IN_A_MISSION) :]) for fault in faults]
        raise MissionError(located(own, asked, None)) from None
    return tuple(obstacles_of(spec, FilePath(), set()))
