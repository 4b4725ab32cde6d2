"""Where on earth a mission in metres is, as the studio keeps it beside the mission's file."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Final

from viaspline.bounded_file import FileKind, is_there, read_text
from viaspline.errors import Fault, MissionError
from viaspline.formats.items import LatLon

STUDIO_ENDING: Final = ".studio.json"
STUDIO_FILE: Final = FileKind("file of the studio", 100_000, "take out what isn't needed")
REMEDY: Final = "give --origin LAT,LON, or set it again in the studio under Ground"


def beside(mission: Path) -> Path:
    """The file in which the studio keeps what a mission's own file can't hold.

    >>> print(beside(Path("patrol.yaml")))
    patrol.yaml.studio.json
    """
    return mission.with_name(mission.name + STUDIO_ENDING)


def studio_origin(mission: Path) -> LatLon | None:
    """Latitude and longitude of a mission's 0, 0 as they were set in the studio [deg].

    Args:
        mission: The mission's file; it needn't be there.

    Returns:
        None if the studio keeps none.

    Raises:
        MissionError: The studio's file can't be read, or its origin can't be meant.

    >>> studio_origin(Path("nowhere.yaml")) is None
    True
    """
    file = beside(mission)
    if not is_there(file):
        return None
    try:
        data = json.loads(read_text(file, STUDIO_FILE))
    except (ValueError, RecursionError):
        raise MissionError([Fault("", "isn't JSON", REMEDY, str(file))]) from None
    said = data.get("origin") if isinstance(data, dict) else None
    if said is None:
        return None
    if not _is_on_globe(said):
        problem = f"{json.dumps(said)[:40]} isn't a latitude and a longitude"
        raise MissionError([Fault("origin", problem, REMEDY, str(file))])
    return float(said[0]), float(said[1])


def studio_note(mission: Path, origin: LatLon) -> str:
    """What is to be said of an origin that neither a mission nor its user has said.

    Args:
        mission: The mission's file.
        origin: Latitude and longitude of its 0, 0 [deg].

    >>> studio_note(Path("yard.yaml"), (47.25, 8.5))
    '0, 0 lies at 47.25, 8.5, as yard.yaml.studio.json says'
    """
    return f"0, 0 lies at {origin[0]:.7g}, {origin[1]:.7g}, as {beside(mission).name} says"


def _is_on_globe(said: Any) -> bool:
    """Whether something is the latitude and longitude of a place; 0, 0 means nowhere."""
    if not isinstance(said, list) or len(said) != 2:
        return False
    for value, most in zip(said, (90.0, 180.0), strict=True):
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not is_number or not math.isfinite(value) or abs(value) > most:
            return False
    return said != [0, 0]
