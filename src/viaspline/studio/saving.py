"""Documents as the text of a mission file, by its ending."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Final

from viaspline.errors import OutputError
from viaspline.formats.items import LatLon
from viaspline.studio.refused import RefusedError

if TYPE_CHECKING:
    from viaspline.formats.outgoing import Written
    from viaspline.mission.model import Mission

YAML: Final = (".yaml", ".yml")
PLANS: Final = (".plan",)
TABLES: Final = (".waypoints", ".txt")
SAVED: Final = YAML + PLANS + TABLES


def is_yaml(path: Path) -> bool:
    """Whether a file holds the document itself, not way points with latitudes and longitudes."""
    return path.suffix.lower() in YAML


def waypoints_of(mission: Mission, path: Path, origin: LatLon | None) -> Written:
    """A mission as the text of a plan or a table of way points, and what isn't in it.

    Raises:
        RefusedError: There is no origin, or the mission reaches too far from it.
    """
    from viaspline.formats.write_plan import plan_text
    from viaspline.formats.write_wpl import wpl_text

    write = plan_text if path.suffix.lower() in PLANS else wpl_text
    try:
        return write(mission, origin)
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
        raise RefusedError(f"'{text:.40}' is no origin; give latitude, longitude in degrees")
    return latitude, longitude
