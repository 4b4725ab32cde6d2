"""Where on earth a mission's 0, 0 is: says its file, or somebody, or the studio beside the file.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

from pathlib import Path

from viaspline.errors import LinkError
from viaspline.formats.items import LatLon
from viaspline.formats.load import origin_of
from viaspline.formats.studio_origin import studio_note, studio_origin


def mission_origin(path: Path, given: str | None) -> LatLon:
    """Latitude and longitude of a mission's 0, 0 [deg].

    Args:
        path: Its file; those with latitudes and longitudes have an origin.
        given: What somebody says instead, as ``LAT,LON``.

    Raises:
        LinkError: Nobody says it, two say it, or it can't be meant.
        MissionError: The file can't be read, or what the studio keeps beside it.
    """
    own = origin_of(path)
    if own is not None and given is not None:
        problem = f"the file has its own origin, {own[0]:g},{own[1]:g}"
        raise LinkError(path, problem, "leave out --origin")
    if own is not None:
        return own
    if given is None:
        kept = studio_origin(path)
        if kept is not None:
            return kept
        problem = "the mission is in metres, and a vehicle drives in latitudes and longitudes"
        raise LinkError(path, problem, "say where its 0, 0 is: --origin LAT,LON")
    try:
        latitude, longitude = (float(part) for part in given.split(","))
    except ValueError:
        raise LinkError(given, "isn't an origin", "give --origin 47.1,8.2") from None
    is_on_globe = abs(latitude) <= 90 and abs(longitude) <= 180
    if not is_on_globe or (latitude == 0 and longitude == 0):
        remedy = "latitudes are -90 to 90, longitudes -180 to 180 degrees, and 0,0 means nowhere"
        raise LinkError(given, "can't be the origin", remedy)
    return latitude, longitude


def origin_note(path: Path, given: str | None) -> str | None:
    """What is to be said of an origin that neither the mission nor its user has said.

    Args:
        path: The mission's file.
        given: What somebody says, as ``LAT,LON``.

    Returns:
        None where one of them has said it.

    Raises:
        MissionError: A file can't be read.
    """
    if given is not None or origin_of(path) is not None:
        return None
    kept = studio_origin(path)
    return None if kept is None else studio_note(path, kept)
