"""One way in for every kind of mission file."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from viaspline.formats.file_faults import refusal
from viaspline.formats.items import Itinerary, LatLon, Place
from viaspline.mission.model import Mission
from viaspline.mission.yaml_document import read_text

_UNDERSTOOD: Final = (
    "understood are viaspline's YAML (.yaml, .yml), QGroundControl's plans (.plan, and .mission "
    "in JSON) and texts that begin with QGC WPL 110 (.txt, .waypoints, .mission)"
)


def load(path: str | Path) -> Mission:
    """Read a mission from a file of any kind that is understood.

    YAML (``.yaml``, ``.yml``), QGroundControl's ``.plan`` and older JSON, and ``QGC WPL`` texts
    whatever their suffix. In files with latitudes and longitudes the start, and the origin of the
    mission's frame, is the home position if there is a plausible one (not 0/0), else the first
    item with a position.

    Args:
        path: The file.

    Returns:
        The mission, sound in itself.

    Raises:
        MissionError: The file can't be read, its kind isn't known, or its mission has faults.

    Warns:
        MissionWarning: One for each kind of thing in the file that a mission can't represent.

    >>> load("survey.kml")
    Traceback (most recent call last):
    viaspline.errors.MissionError: survey.kml: there is no such file; give the path of ...
    """
    # Imported late, so that reading YAML doesn't wait for what the other formats need.
    if _is_yaml(path):
        from viaspline.mission.yaml_reader import read_yaml

        return read_yaml(path)
    from viaspline.formats.interpret import mission_of

    return mission_of(_itinerary(path))


def origin_of(path: str | Path) -> LatLon | None:
    """Where the 0, 0 of a file's mission is: latitude and longitude [deg].

    Args:
        path: The file.

    Returns:
        None if the file has metres, or no position at all.

    Raises:
        MissionError: The file can't be read.

    >>> origin_of("patrol.yaml") is None
    True
    """
    if _is_yaml(path):
        return None
    from viaspline.formats.interpret import origin_in

    return origin_in(_itinerary(path))


def _is_yaml(path: str | Path) -> bool:
    return Path(path).suffix.lower() in (".yaml", ".yml")


def _itinerary(path: str | Path) -> Itinerary:
    """What a file with latitudes and longitudes holds."""
    text = read_text(path)
    start = text.lstrip()[:16]
    if start.startswith("QGC WPL"):
        from viaspline.formats.qgc_wpl import parse_qgc_wpl

        return parse_qgc_wpl(text, str(path))
    if Path(path).suffix.lower() == ".plan" or start.startswith("{"):
        from viaspline.formats.qgc_plan import parse_qgc_plan

        return parse_qgc_plan(text, str(path))
    problem = "is a kind of file that isn't understood" if start else "the file is empty"
    raise refusal(str(path), Place(""), problem, _UNDERSTOOD)
