"""Documents as the text of a mission file, by its ending."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Final

from viaspline.errors import OutputError
from viaspline.formats.format_registry import format_to_save, formats
from viaspline.formats.items import LatLon
from viaspline.formats.mission_format import Whereabouts, Written
from viaspline.formats.mission_yaml import MissionYaml
from viaspline.studio.refused_error import RefusedError

if TYPE_CHECKING:
    from viaspline.mission.model import Mission

SAVED_SUFFIXES: Final = tuple(ending for each in formats() for ending in each.saved_endings)
"""The endings by which missions are saved."""


def is_yaml(path: Path) -> bool:
    """Whether a file holds the document itself, not way points with latitudes and longitudes."""
    return path.suffix.lower() in MissionYaml.saved_endings


def waypoints_of(mission: Mission, path: Path, origin: LatLon | None) -> Written:
    """A mission as the text of a file of way points, and what isn't in it.

    Raises:
        RefusedError: There is no origin, or the mission reaches too far from it.
    """
    kind = format_to_save(path)
    assert kind is not None, path
    try:
        return kind.write(mission, Whereabouts(path.parent, origin))
    except OutputError as error:
        raise RefusedError(str(error).removeprefix("<mission>: ")) from None


def origin_from(text: str) -> LatLon | None:
    """Latitude and longitude as they are typed; None if nothing is.

    Raises:
        RefusedError: It is something else.

    >>> origin_from("47.1, 8.5"), origin_from(" ")
    ((47.1, 8.5), None)
    """
    if not text.strip():
        return None
    try:
        latitude, longitude = map(float, text.replace(",", " ").split())
    except ValueError:
        latitude = longitude = math.nan
    if not (math.isfinite(latitude) and math.isfinite(longitude)):
        raise RefusedError(f"'{text:.40}' isn't an origin; give latitude, longitude in degrees")
    return latitude, longitude
