"""How a path is exported: what was handed in, checked.

Tested through ``exports/test_export_path``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from viaspline.errors import GeometryError
from viaspline.formats.items import LatLon
from viaspline.handed_in import number_from
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission


@dataclass(frozen=True)
class ExportOptions:
    """How a path is exported.

    Attributes:
        origin: Latitude and longitude of the mission's 0, 0 [deg]. None: as the mission says.
        chord_error: How far from the exact curve the lines may be [m]. None: a tenth of the
            clearance, 1 to 25 cm.
        acceptance: How near to a point a vehicle turns to the next one [m]. None: as much as can be
            proven, up to 2 m.
        spacing: The longest line [m]. None: that of the format.

    >>> ExportOptions(origin=(47.3977, 8.5456), chord_error=0.05).checked().chord_error
    0.05
    """

    origin: LatLon | None = None
    chord_error: float | None = None
    acceptance: float | None = None
    spacing: float | None = None

    def checked(self) -> ExportOptions:
        """Them as numbers.

        Raises:
            GeometryError: One can't be meant.
        """
        return replace(
            self,
            chord_error=_length("chord_error", self.chord_error, 1e-4),
            acceptance=_length("acceptance", self.acceptance, 0.0),
            spacing=_length("spacing", self.spacing, 1e-3),
            origin=None if self.origin is None else _origin(self.origin),
        )

    def placed(self, asked: Mission | Fleet) -> ExportOptions:
        """Them with the origin that a mission or a fleet says, where they have none."""
        said = asked.world.origin_deg
        return self if self.origin is not None or said is None else replace(self, origin=said)


def _length(name: str, value: Any, least: float) -> float | None:
    if value is None:
        return None
    length = number_from(name, value)
    if not least <= length <= 1e4:
        raise GeometryError(f"{name} is {value!r:.40}; give metres from {least:g} to 10000")
    return length


def _origin(value: Any) -> LatLon:
    try:
        latitude, longitude = (number_from("origin", number) for number in value)
    except (TypeError, ValueError):
        raise GeometryError(f"origin is {value!r:.40}; give (latitude, longitude)") from None
    if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0) or latitude == longitude == 0.0:
        problem = f"{latitude:g}, {longitude:g} can't be the origin"
        remedy = "latitudes are -90 to 90, longitudes -180 to 180 degrees, and 0, 0 means nowhere"
        raise GeometryError(f"{problem}; {remedy}")
    return latitude, longitude
