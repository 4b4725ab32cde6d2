"""One way in for every kind of mission file.

Tested through ``formats/test_format_registry``.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from viaspline.bounded_file import MISSION_FILE, read_text
from viaspline.errors import GeometryError
from viaspline.formats.format_registry import format_of
from viaspline.formats.items import LatLon
from viaspline.handed_in import check_kind

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission
    from viaspline.mission.space.ground_spec import GroundSpec


def load(
    path: str | Path, *, ground: Mapping[str, Any] | GroundSpec | None = None
) -> Mission | Fleet:
    """Read a mission, or a fleet, from a file of any kind that is understood.

    YAML (``.yaml``, ``.yml``, or ``.json``, for JSON is YAML; with the key ``fleet`` it is a
    fleet), QGroundControl's ``.plan`` and older JSON, and ``QGC WPL`` texts whatever their suffix.
    In files with latitudes and longitudes the start, and the origin of the mission's frame, is the
    home position if there is a plausible one (not 0/0), else the first item with a position.

    Altitudes above terrain take a ground: with one, such a file is a mission in space, in which
    take-off, landing, climbs and what is looked at are flown. Without, it is a planar mission, and
    heights above terrain are left out.

    Args:
        path: The file.
        ground: The ground of a file with latitudes and longitudes, as ``world.ground`` of a mission
            has it, such as ``{"terrain": "dem.tif", "origin_m": [x, y]}``.

    Returns:
        The mission or the fleet, sound in itself.

    Raises:
        MissionError: The file can't be read, its kind isn't known, or what it asks for has faults.
        GeometryError: There is a ground for a file that says its own.

    Warns:
        MissionWarning: One for each kind of thing in the file that a mission can't represent.

    >>> load("survey.kml")
    Traceback (most recent call last):
    viaspline.errors.MissionError: survey.kml: there is no such file; give the path of ...
    """
    check_kind("path", path, str | Path, "give the path of a mission file")
    text = read_text(path, MISSION_FILE)
    kind = format_of(Path(path), text)
    if ground is None:
        return kind.read(text, str(path))
    from viaspline.formats.waypoint_format import WaypointFormat
    from viaspline.mission.space.ground_spec import GroundSpec

    check_kind("ground", ground, (Mapping, GroundSpec), "give {'flat_m': 0}")
    if not isinstance(kind, WaypointFormat):
        problem = f"{path} says its own ground, and another one is given"
        raise GeometryError(f"{problem}; leave out ground, or change it in the file")
    return kind.read_over(text, str(path), ground)


def origin_of(path: str | Path) -> LatLon | None:
    """Where the 0, 0 of a file's mission is: latitude and longitude [deg].

    Args:
        path: The file.

    Returns:
        None if the file has metres and doesn't say so, or no position at all.

    Raises:
        MissionError: The file can't be read.
        GeometryError: It is no path of a file.

    >>> origin_of("survey.plan")
    Traceback (most recent call last):
    viaspline.errors.MissionError: survey.plan: there is no such file; give the path of ...
    """
    check_kind("path", path, str | Path, "give the path of a mission file")
    text = read_text(path, MISSION_FILE)
    return format_of(Path(path), text).origin(text, str(path))
