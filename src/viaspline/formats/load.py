"""One way in for every kind of mission file.

Tested through ``formats/test_format_registry``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from viaspline.bounded_file import MISSION_FILE, read_text
from viaspline.formats.format_registry import format_of
from viaspline.formats.items import LatLon
from viaspline.handed_in import check_kind

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission


def load(path: str | Path) -> Mission | Fleet:
    """Read a mission, or a fleet, from a file of any kind that is understood.

    YAML (``.yaml``, ``.yml``; with the key ``fleet`` it is a fleet), QGroundControl's ``.plan`` and
    older JSON, and ``QGC WPL`` texts whatever their suffix. In files with latitudes and longitudes
    the start, and the origin of the mission's frame, is the home position if there is a plausible
    one (not 0/0), else the first item with a position.

    Args:
        path: The file.

    Returns:
        The mission or the fleet, sound in itself.

    Raises:
        MissionError: The file can't be read, its kind isn't known, or what it asks for has faults.

    Warns:
        MissionWarning: One for each kind of thing in the file that a mission can't represent.

    >>> load("survey.kml")
    Traceback (most recent call last):
    viaspline.errors.MissionError: survey.kml: there is no such file; give the path of ...
    """
    check_kind("path", path, str | Path, "give the path of a mission file")
    text = read_text(path, MISSION_FILE)
    return format_of(Path(path), text).read(text, str(path))


def origin_of(path: str | Path) -> LatLon | None:
    """Where the 0, 0 of a file's mission is: latitude and longitude [deg].

    Args:
        path: The file.

    Returns:
        None if the file has metres, or no position at all.

    Raises:
        MissionError: The file can't be read.

    >>> origin_of("survey.plan")
    Traceback (most recent call last):
    viaspline.errors.MissionError: survey.plan: there is no such file; give the path of ...
    """
    text = read_text(path, MISSION_FILE)
    return format_of(Path(path), text).origin(text, str(path))
