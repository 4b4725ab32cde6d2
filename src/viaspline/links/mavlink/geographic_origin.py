"""Where on earth a mission's 0, 0 is: as its file says, or as somebody says."""

from __future__ import annotations

from pathlib import Path

from viaspline.errors import LinkError
from viaspline.formats.items import LatLon
from viaspline.formats.load import origin_of


def mission_origin(path: Path, given: str | None) -> LatLon:
    """Latitude and longitude of a mission's 0, 0 [deg].

    Args:
        path: Its file; those with latitudes and longitudes have an origin.
        given: What somebody says instead, as ``LAT,LON``.

    Raises:
        LinkError: Nobody says it, or it can't be meant.
        MissionError: The file can't be read.

    >>> mission_origin(Path("patrol.yaml"), "47.1, 8.2")
    (47.1, 8.2)
    """
    if given is None:
        origin = origin_of(path)
        if origin is None:
            problem = "the mission is in metres, and a vehicle drives in latitudes and longitudes"
            raise LinkError(path, problem, "say where its 0, 0 is: --origin LAT,LON")
        return origin
    try:
        latitude, longitude = (float(part) for part in given.split(","))
    except ValueError:
        raise LinkError(given, "is no origin", "give --origin 47.1,8.2") from None
    is_on_globe = abs(latitude) <= 90 and abs(longitude) <= 180
    if not is_on_globe or (latitude == 0 and longitude == 0):
        remedy = "latitudes are -90 to 90, longitudes -180 to 180 degrees, and 0,0 means nowhere"
        raise LinkError(given, "can't be the origin", remedy)
    return latitude, longitude
